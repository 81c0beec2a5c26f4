// Magnetic forces on the nodes of a lattice with fixed magnetisation: in a uniform field
// and in one that varies linearly in space.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// q_a = sum over elements of M_e . b_a(e) [A m], b_a = integral of grad N_a. In a uniform
// field B the energy -integral of (F M) . B gives the node the force q_a B, whatever the
// deformation. The sum over a body is zero. One value a node; zeros where the
// magnetisation (one vector an element [A/m]) is empty. Throws std::invalid_argument if
// the number of vectors is neither zero nor that of the elements.
std::vector<double> nodal_charges(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements,
                                  const std::vector<Vec3>& magnetization_a_m);

// B(x) = B0 + A (x - origin). Outside its sources a static field has no divergence and no
// curl, so A is symmetric and traceless. A(d, e) = dB_d / dx_e [T/m].
class FieldGradient {
  public:
    // Throws std::invalid_argument, naming the entries, where A is not symmetric or not
    // traceless to 1e-6 of its largest entry, or not finite.
    FieldGradient(const Eigen::Matrix3d& tesla_per_m, const Vec3& origin_m);

    const Eigen::Matrix3d& tesla_per_m() const { return tesla_per_m_; }
    const Vec3& origin_m() const { return origin_m_; }

  private:
    Eigen::Matrix3d tesla_per_m_;
    Vec3 origin_m_;
};

// S_ab = integral of (M . grad N_a) N_b + (M . grad N_b) N_a [A m2], over the undeformed
// element; symmetric. Its rows sum to the nodal charges q_a.
struct GradientElement {
    Matrix8 coupling = Matrix8::Zero();
};

// One an element of the mesh, from one magnetisation vector [A/m] an element. Throws
// std::invalid_argument if the numbers differ.
std::vector<GradientElement> gradient_elements(
    const std::vector<Vec3>& nodes_m, const std::vector<Hexahedron>& elements,
    const std::vector<Vec3>& magnetization_a_m);

// Adds to f the forces of the gradient alone, A sum_b S_ab (x_b - origin) on node a [N],
// and returns their energy -1/2 sum_ab S_ab (x_a - origin) . A (x_b - origin) [J]. They
// are -d/dx_a of -integral of (F M) . A (x - origin); the uniform part B0 adds q_a B0 and
// the energy -B0 . sum q_a x_a (nodal_charges). Not a dead load: it follows the shape.
// nodes: for each element the eight indices of its nodes in x and f, three values a node.
double add_gradient_forces(std::span<const GradientElement> elements,
                           std::span<const std::array<int, 8>> nodes,
                           const FieldGradient& gradient, const double* x, double* f);

}  // namespace magfsi::structure
