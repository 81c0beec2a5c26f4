// The static problem of one body: dead loads, internal forces, energy and tangent.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "structure/body.h"
#include "structure/equilibrium/stiffness_matrix.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

// Loads that keep their direction: the force q_a B of a uniform field and the weight.
struct StaticLoads {
    Vec3 field_t{};
    Vec3 gravity_m_s2{};
};

// What has no equilibrium: a body of parts that are not joined, one of which is not held
// along all axes, and a body with weight along an axis on which nothing holds it: it
// would fall without end. Throws std::invalid_argument.
void require_held(const Body& body, const Vec3& gravity_m_s2);

// Three values a node throughout.
class StaticProblem {
  public:
    // Throws std::invalid_argument on a body without elements, an unknown face or what
    // build_lattice refuses.
    explicit StaticProblem(const Body& body);

    const Body& body() const { return body_; }
    // Axes along which a clamp or a roller holds a node. Translations along the others,
    // and turns about the field of a body that may turn so, cost no energy.
    const HeldAxes& held_along() const { return held_along_; }
    const Material& material(std::size_t element) const {
        return material_of(body_, element);
    }
    double largest_shear_modulus_pa() const { return largest_shear_modulus_pa_; }
    const std::vector<ElementReference>& references() const { return references_; }
    const std::vector<double>& node_volumes_m3() const { return node_volume_m3_; }
    double volume_m3() const { return volume_m3_; }

    // Nodal loads [N].
    Eigen::VectorXd load(const StaticLoads& loads) const;

    struct Response {
        Eigen::VectorXd residual_n;  // load + internal forces, zero where a node is held
        double elastic_j = 0;
        double smallest_j = 1;
        int element = -1;  // of smallest J
    };
    Response response(const Eigen::VectorXd& x, const Eigen::VectorXd& load) const;

    // Largest component over the largest load; over the rounding where there is no load.
    double relative_residual(const Response& response, const Eigen::VectorXd& load) const;
    // What may be left of the residual: this share of the present load, but not less than
    // the rounding of the internal forces.
    double allowed_residual_n(const Eigen::VectorXd& load, double tolerance) const;

    StiffnessMatrix& matrix() { return matrix_; }
    // Puts the second derivative of the energy at x into the matrix.
    void assemble(const Eigen::VectorXd& x);

    // G h^2 / L^4 of the shortest and longest side, G of the softest material: about a
    // hundredth of the stiffness [Pa/m2] of the lowest bending mode.
    double bending_stiffness_scale() const { return bending_scale_; }
    // Weak foundation [Pa/m2] that removes the rigid motions of a body that is not held
    // along all axes from the tangent; zero for others. It is about 1e-5 of the stiffness
    // of the lowest bending mode and 1e4 or more times the rounding of the tangent.
    // Forces have no such term: an equilibrium does not feel it. Rigid translations and
    // the turn about the field's axis get this stiffness; an instability that grows more
    // slowly is not seen.
    double rigid_foundation() const;
    double shortest_side_m() const { return shortest_side_m_; }
    double longest_side_m() const { return longest_side_m_; }

    Positions8 element_positions(std::size_t element, const Eigen::VectorXd& x) const;

  private:
    StaticProblem(const Body& body, const Lattice& lattice);
    void measure_stiffness();
    // Of the residual: what internal forces that balance each other leave.
    double rounding_n() const;

    Body body_;
    std::vector<double> node_volume_m3_, node_mass_kg_, charge_;
    std::vector<ElementReference> references_;
    std::vector<HeldAxes> held_;
    HeldAxes held_along_{};
    ElementKernel kernel_;
    StiffnessMatrix matrix_;
    double volume_m3_ = 0;
    double largest_shear_modulus_pa_ = 0, largest_modulus_pa_ = 0;
    double bending_scale_ = 0, shortest_side_m_ = 0, longest_side_m_ = 0;
};

Eigen::VectorXd flat_positions(const std::vector<Vec3>& nodes_m);
std::vector<Vec3> nodes_from(const Eigen::VectorXd& x);

}  // namespace magfsi::structure
