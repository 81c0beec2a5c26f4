// SPDX-License-Identifier: GPL-2.0-or-later
// The static problem of one body: loads that are constant or follow from its place,
// internal forces, energy and tangent.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <vector>

#include "structure/body.h"
#include "structure/equilibrium/stiffness_matrix.h"
#include "structure/lattice/element_kernel.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {

// What acts on a body beside a uniform field and its weight.
struct Surroundings {
    std::optional<FieldGradient> gradient{};
    std::shared_ptr<SourceField> sources{};  // null without one
    // Smooth, with a stiffness: each node of the surface that is behind the plane is
    // pushed back by area times stiffness times depth.
    std::optional<Platform> platform{};
    // Groups of nodes that something moves; the body's clamps hold them.
    std::vector<std::vector<int>> driven{};
};

// At one point of a path. The force q_a B of a uniform field and the weight keep their
// direction.
struct StaticLoads {
    Vec3 field_t{};
    Vec3 gravity_m_s2{};
    double gradient = 0;           // acting share of the surroundings' field gradient
    double sources = 0;            // and of their sources, which stand
    double sources_s = 0;          // where they do at this time
    std::vector<Vec3> driven_m{};  // displacement of each driven group; none: zeros
};

// What has no equilibrium: a body of parts that are not joined, one of which is not held
// along all axes; a body with weight along a way on which neither a clamp, a roller nor
// the platform holds it, which would fall without end; one that is free along an axis in
// a field gradient, which carries it away. Throws std::invalid_argument.
void require_held(const Body& body, const Vec3& gravity_m_s2,
                  const Surroundings& surroundings = {});

// The same for the nodes.
struct NodalLoads {
    Eigen::VectorXd dead_n;  // of field and weight
    double gradient = 0;     // these three as in StaticLoads
    double sources = 0, sources_s = 0;
    Eigen::VectorXd driven_m;  // displacement where driven, zero elsewhere; may be empty

    bool none() const;
};
// Linear in between.
NodalLoads between(const NodalLoads& from, const NodalLoads& to, double share);

// What may be left of the residual.
struct Goal {
    double tolerance = 0;  // over Response::load_n
    double least_n = 0;    // nothing below it is asked for
};

// Three values a node throughout.
class StaticProblem {
  public:
    // Throws std::invalid_argument on a body without elements, an unknown face or what
    // build_lattice refuses.
    explicit StaticProblem(const Body& body, Surroundings surroundings = {});

    const Body& body() const { return body_; }
    // Axes along which a clamp or a roller holds a node. Translations along the others,
    // and turns about the field of a body that may turn so, cost no energy.
    const HeldAxes& held_along() const { return held_along_; }
    const Material& material(std::size_t element) const {
        return material_of(body_, element);
    }
    // Of the platform, which holds a body along it; zero without one.
    const Eigen::Vector3d& platform_normal() const { return platform_normal_; }
    double largest_shear_modulus_pa() const { return largest_shear_modulus_pa_; }
    const std::vector<ElementReference>& references() const { return references_; }
    const std::vector<double>& node_volumes_m3() const { return node_volume_m3_; }
    double volume_m3() const { return volume_m3_; }

    // Throws std::invalid_argument on loads under which the body cannot rest.
    NodalLoads load(const StaticLoads& loads) const;

    struct Response {
        Eigen::VectorXd residual_n;  // of all forces, zero where a node is held
        // Largest component of dead load, force of gradient and sources and what drives
        // driven nodes.
        double load_n = 0;
        double elastic_j = 0;
        double total_j = 0;  // less the work of all loads; what equilibria minimise
        double smallest_j = 1;
        int element = -1;  // of smallest J
    };
    Response response(const Eigen::VectorXd& x, const NodalLoads& loads) const;
    // What clamps and rollers do to each node to hold it there.
    Eigen::VectorXd support_n(const Eigen::VectorXd& x, const NodalLoads& loads) const;
    // Dead loads and those that follow from the body's place: of gradient, sources and
    // platform.
    Eigen::VectorXd surrounding_n(const Eigen::VectorXd& x,
                                  const NodalLoads& loads) const;

    // Largest component over the load; over the rounding where there is no load.
    double relative_residual(const Response& response) const;
    // This share of the present load, but not less than the rounding of the internal
    // forces.
    Goal goal(double tolerance) const { return {tolerance, rounding_n()}; }
    static bool reached(const Goal& goal, const Response& response);

    StiffnessMatrix& matrix() { return matrix_; }
    // Puts the second derivative of the energy at x into the matrix.
    void assemble(const Eigen::VectorXd& x, const NodalLoads& loads = {});
    // Adds that of gradient, sources and platform.
    void add_surroundings(const Eigen::VectorXd& x, const NodalLoads& loads);

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
    StaticProblem(const Body& body, const Lattice& lattice, Surroundings surroundings);
    void measure_stiffness();
    KernelResult add_internal(const Eigen::VectorXd& x, Eigen::VectorXd& force_n) const;
    // Return energies.
    double add_gradient(const Eigen::VectorXd& x, double share,
                        Eigen::VectorXd& force_n) const;
    double add_sources(const Eigen::VectorXd& x, const NodalLoads& loads,
                       Eigen::VectorXd& force_n) const;
    // The field at each node that belongs to a magnetised element.
    std::vector<FieldSample> samples(const Eigen::VectorXd& x, double time_s) const;
    double add_platform(const Eigen::VectorXd& x, Eigen::VectorXd& force_n) const;
    double depth_m(const Eigen::VectorXd& x, Eigen::Index node) const;
    // Of the residual: what internal forces that balance each other leave.
    double rounding_n() const;

    Body body_;
    Surroundings surroundings_;
    std::vector<GradientElement> gradient_elements_;
    std::vector<Matrix8> moments_;    // of each element; none without sources
    std::vector<double> surface_m2_;  // of each node; empty without a platform
    Eigen::Vector3d platform_normal_ = Eigen::Vector3d::Zero();
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
