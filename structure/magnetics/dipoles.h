// SPDX-License-Identifier: GPL-2.0-or-later
// The field of magnetised bodies on each other and on themselves: each element is a
// dipole.
//
// An element's moment is m = integral of F M = sum over its nodes of q_a x_a, at the mean
// x of its nodes. The energy of all is that of magnetostatics for spheres of these
// centres and moments, evenly magnetised:
//   E = - sum over pairs of mu0 / (4 pi) m_e . (grad grad phi(x_e - x_f)) m_f.
// phi is the potential of two evenly charged spheres. Those that do not overlap are
// points to each other, phi = 1 / r; with radii of the mean a that do,
//   phi = (6/5 - u^2/2 + 3 u^3/16 - u^5/160) / a,   u = r / a < 2
// (Jackson, Classical Electrodynamics, 3rd ed., sections 1.11 and 5.10, for the parts),
// whose first three derivatives go over into those of 1 / r: forces have no jump. The
// radius is half of the shortest edge, so that neighbours at rest are points and only
// what comes nearer is softened.
//
// Within a body each element adds its own energy, that of a sphere of its volume V,
//   mu0 m^2 / (6 V),
// so that many cubes have the energy of the solid: the sum over a cubic lattice of
// dipoles lacks just that (Lorentz), and their sum has the solid's demagnetising factor.
//
// Forces are the exact derivatives of E: q_a B + (grad B)^T m / 8 on node a, B the field
// of the others. E is the same for bodies that are moved or turned together, so forces
// and torques balance.
#pragma once

#include <array>
#include <vector>

#include "isa/instruction_set.h"
#include "structure/lattice/hexahedron.h"
#include "structure/magnetics/dipole_sum.h"
#include "structure/magnetics/source_field.h"

namespace magfsi::structure {

// What stays the same of an element's dipole.
struct DipoleElement {
    int element = 0;  // of the mesh
    std::array<double, 8> charge_a_m{};
    double radius_m = 0;
    double volume_m3 = 0;  // at rest
};

// Of the elements that are magnetised. magnetization_a_m: one vector an element [A/m];
// throws std::invalid_argument on another number.
std::vector<DipoleElement> dipole_elements(const std::vector<Vec3>& nodes_m,
                                           const std::vector<Hexahedron>& elements,
                                           const std::vector<Vec3>& magnetization_a_m);

struct Dipole {
    Eigen::Vector3d centre_m, moment_a_m2;
};
// nodes: of the element in x, which holds three values a node.
Dipole dipole_of(const DipoleElement& element, const std::array<int, 8>& nodes,
                 const double* x);

// All dipoles, by number.
class Dipoles {
  public:
    explicit Dipoles(InstructionSet set = choose_instruction_set());

    void resize(std::size_t count);
    std::size_t size() const { return radius_.size(); }
    void set_radius(std::size_t i, double radius_m) { radius_[i] = radius_m; }
    void set(std::size_t i, const Dipole& dipole);
    // Adds the field at dipole i of those from `from` to before `to`, without itself.
    void add_field(std::size_t i, std::size_t from, std::size_t to,
                   FieldSample& sample) const;
    // The same with the nearest image of each, along axes that have a period, else 0.
    void add_field(std::size_t i, std::size_t from, std::size_t to, const Vec3& period_m,
                   FieldSample& sample);

  private:
    void add_sum(const std::array<std::vector<double>, 3>& x, std::size_t i,
                 std::size_t from, std::size_t to, FieldSample& sample) const;

    DipoleSumFunction function_;
    std::array<std::vector<double>, 3> x_, m_, near_;
    std::vector<double> radius_;
};

// The field of the element's own sphere [T], for its energy within a body.
Eigen::Vector3d own_field_t(const DipoleElement& element, const Dipole& dipole);

// Adds the forces of an element's dipole in the field of all others, and its own, to f;
// returns its share of the energy, -1/2 m . B.
double add_dipole_forces(const DipoleElement& element, const std::array<int, 8>& nodes,
                         const Dipole& dipole, const FieldSample& sample, double* f);

}  // namespace magfsi::structure
