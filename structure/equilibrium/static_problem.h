// SPDX-License-Identifier: GPL-2.0-or-later
// Static problem of one body: loads that are constant or depend on the positions,
// internal forces, energy and tangent.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/equilibrium/stiffness_matrix.h"
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stiffening.h"
#include "structure/magnetics/magnetic_forces.h"
#include "structure/magnetics/turned_moments.h"

namespace magfsi::structure {

// Loads that depend on the positions, and driven nodes. The uniform field and the weight
// are in StaticLoads.
struct Surroundings {
    std::optional<FieldGradient> gradient{};
    std::shared_ptr<SourceField> sources{};  // may be null
    // Smooth platform with a stiffness [Pa/m]: each node of the surface that is behind
    // the plane is pushed back by its area times stiffness times depth.
    std::optional<Platform> platform{};
    // Groups of nodes with a prescribed displacement; clamps of the body hold them.
    std::vector<std::vector<int>> driven{};
};

// Loads at one point of a path. The force q_a B of a uniform field and the weight do not
// depend on the positions (dead loads).
struct StaticLoads {
    Vec3 field_t{};
    Vec3 gravity_m_s2{};
    double gradient = 0;  // acting share of the surroundings' field gradient
    double sources = 0;   // acting share of the field of the surroundings' sources
    // Time at which the sources' places and strengths are taken [s]
    double sources_s = 0;
    // Displacement of each driven group; empty: zeros
    std::vector<Vec3> driven_m{};
};

// Unit normal of a platform; zero without one.
inline Eigen::Vector3d normal_of(const std::optional<Platform>& platform) {
    if (!platform) return Eigen::Vector3d::Zero();
    return Eigen::Map<const Eigen::Vector3d>(platform->normal.data()).normalized();
}

// Throws std::invalid_argument if no support carries the weight of the body, which is
// held along the axes `held`. A smooth platform carries what presses on it but nothing
// along it.
void refuse_to_fall(const Body& body, const HeldAxes& held, const Vec3& gravity_m_s2,
                    const Eigen::Vector3d& platform_normal);

// Throws std::invalid_argument if the body cannot have an equilibrium: it consists of
// separate parts, one of which is not held along all axes; it has weight along an axis on
// which no clamp, roller or platform holds it, so that it would fall; or it is free along
// an axis in a field gradient or in the field of sources, which carry it away.
void require_held(const Body& body, const Vec3& gravity_m_s2,
                  const Surroundings& surroundings = {});

// Loads on the nodes. Vectors have three values per node.
struct NodalLoads {
    Eigen::VectorXd dead_n;  // forces of field and weight
    double gradient = 0;     // this and the next two as in StaticLoads
    double sources = 0, sources_s = 0;
    // Displacement of driven nodes, zero elsewhere; empty if no node is driven
    Eigen::VectorXd driven_m;
    // Uniform field on a magnetisation that follows the rotation, which is no dead load
    Eigen::Vector3d turning_t = Eigen::Vector3d::Zero();

    // True if nothing loads the body.
    bool none() const;
};
// Linear interpolation: share 0 is `from`, 1 is `to`.
NodalLoads between(const NodalLoads& from, const NodalLoads& to, double share);

// Largest residual at which an iteration ends: tolerance times Response::load_n, but not
// less than least_n.
struct Goal {
    double tolerance = 0;
    double least_n = 0;  // rounding of the internal forces [N]
};

// A body with its supports and surroundings, and the functions that the iterations need.
// Vectors x, forces and residuals have three values per node, node by node.
class StaticProblem {
  public:
    // Throws std::invalid_argument on a body without elements or with an unknown face, if
    // require_held refuses it without weight, and as build_lattice does.
    explicit StaticProblem(const Body& body, Surroundings surroundings = {});

    const Body& body() const { return body_; }
    // Axes along which a clamp or a roller holds at least one node. Translations along
    // the others, and turns about the field of a body that can turn so, cost no energy.
    const HeldAxes& held_along() const { return held_along_; }
    const Material& material(std::size_t element) const {
        return material_of(body_, element);
    }
    // Unit normal of the platform, along which it holds the body; zero without a
    // platform.
    const Eigen::Vector3d& platform_normal() const { return platform_normal_; }
    double largest_shear_modulus_pa() const { return largest_shear_modulus_pa_; }
    const std::vector<ElementReference>& references() const { return references_; }
    const std::vector<double>& node_volumes_m3() const { return node_volume_m3_; }
    double volume_m3() const { return volume_m3_; }

    // Forces of the loads on the undeformed body. Throws std::invalid_argument on weight
    // along an axis on which nothing holds the body.
    NodalLoads load(const StaticLoads& loads) const;

    // Forces and energies at given positions.
    struct Response {
        // Sum of all forces [N], zero where a node is held
        Eigen::VectorXd residual_n;
        // Largest component of the loads, for relative residuals: dead load, forces of
        // gradient and sources, and the forces that move driven nodes.
        double load_n = 0;
        double elastic_j = 0;
        // Elastic energy plus energy of platform and loads; equilibria are its stationary
        // points
        double total_j = 0;
        double smallest_j = 1;
        int element = -1;  // element of smallest J
        // Largest share of the limit of an element that stiffens, and its element
        double largest_share = 0;
        int tight_element = -1;

        // True if no element is inverted or stretched beyond its limit.
        bool sound() const {
            return smallest_j > 0 && largest_share <= largest_share_of_limit;
        }
    };
    Response response(const Eigen::VectorXd& x, const NodalLoads& loads) const;
    // Forces of clamps and rollers on the nodes, zero where nothing holds.
    Eigen::VectorXd support_n(const Eigen::VectorXd& x, const NodalLoads& loads) const;
    // Energy of the uniform field at x [J].
    double field_j(const Eigen::VectorXd& x, const Vec3& field_t) const;
    // Sum of the dead loads and the forces of gradient, sources and platform [N].
    Eigen::VectorXd surrounding_n(const Eigen::VectorXd& x,
                                  const NodalLoads& loads) const;

    // Largest component of the residual over load_n; over the rounding if there is no
    // load.
    double relative_residual(const Response& response) const;
    // Goal of this relative residual, with the rounding of the internal forces as its
    // floor.
    Goal goal(double tolerance) const { return {tolerance, rounding_n()}; }
    static bool reached(const Goal& goal, const Response& response);

    // The tangent, filled by assemble() or by the mixed iteration.
    StiffnessMatrix& matrix() { return matrix_; }
    // Fills the matrix with the second derivative of the energy at x.
    void assemble(const Eigen::VectorXd& x, const NodalLoads& loads = {});
    // Adds the second derivative of the energies of gradient, sources and platform.
    void add_surroundings(const Eigen::VectorXd& x, const NodalLoads& loads);

    // --- for designs (design/design_derivatives.cpp) ---

    // Replaces the magnetisation [A/m]. Throws std::invalid_argument unless there is one
    // vector per element.
    void set_magnetization(const std::vector<Vec3>& magnetization_a_m);
    // Sum of all forces but those of supports [N].
    Eigen::VectorXd force_n(const Eigen::VectorXd& x, const NodalLoads& loads) const;
    using Values24 = Eigen::Matrix<double, 24, 1>;
    using Forces24 = Eigen::Matrix<double, 24, 3>;
    // Product of a vector with the tangent at x, in which nothing is held.
    Eigen::VectorXd tangent_times(const Eigen::VectorXd& x, const NodalLoads& loads,
                                  const Eigen::VectorXd& v) const;
    // For each element the forces on its nodes by a magnetisation of 1 A/m along x, y and
    // z [N per A/m]. All magnetic forces are linear in the magnetisation.
    std::vector<Forces24> forces_by_magnetization(const Eigen::VectorXd& x,
                                                  const StaticLoads& loads) const;
    // Forces by uniform fields of 1 T along x, y and z, one column each [N/T].
    Eigen::MatrixXd forces_by_field() const;
    // Elastic forces of an element on its nodes [N].
    Values24 elastic_force_n(std::size_t element, const Eigen::VectorXd& x) const;

    // G h^2 / L^4 with h and L the shortest and longest side and G of the softest
    // material: about a hundredth of the stiffness [Pa/m2] of the lowest bending mode.
    double bending_stiffness_scale() const { return bending_scale_; }
    // Weak foundation [Pa/m2] that makes the tangent of a body that is not held along all
    // axes positive for rigid motions; zero for other bodies. It is about 1e-5 of the
    // stiffness of the lowest bending mode and at least 1e4 times the rounding of the
    // tangent. Forces have no such term, so equilibria do not depend on it. Rigid
    // translations and the turn about the field's axis get this stiffness; an instability
    // that grows more slowly is not detected.
    double rigid_foundation() const;
    // Edges of the undeformed body's bounding box.
    double shortest_side_m() const { return shortest_side_m_; }
    double longest_side_m() const { return longest_side_m_; }

    // Positions of an element's nodes relative to their mean, which avoids a loss of
    // digits far from the origin.
    Positions8 element_positions(std::size_t element, const Eigen::VectorXd& x) const;

  private:
    StaticProblem(const Body& body, const Lattice& lattice, Surroundings surroundings);
    void measure_stiffness();
    // Sets what gradient and sources take of the magnetisation.
    void magnetize_surroundings();
    // Adds the elastic forces; returns energy and smallest J.
    KernelResult add_internal(const Eigen::VectorXd& x, Eigen::VectorXd& force_n) const;
    // Add the forces of gradient and sources; return their energies [J].
    double add_gradient(const Eigen::VectorXd& x, double share,
                        Eigen::VectorXd& force_n) const;
    double add_sources(const Eigen::VectorXd& x, const NodalLoads& loads,
                       Eigen::VectorXd& force_n) const;
    // Adds the forces of the field on a magnetisation that follows the rotation; returns
    // its energy [J].
    double add_turning(const Eigen::VectorXd& x, const NodalLoads& loads,
                       Eigen::VectorXd& force_n) const;
    // Field of the sources at each node at a time; sets the sources' time.
    std::vector<FieldSample> samples(const Eigen::VectorXd& x, double time_s) const;
    // Tangent of an element in gradient and sources. at: samples() if sources act.
    Matrix24 field_tangent(std::size_t element, const Eigen::VectorXd& x,
                           const NodalLoads& loads,
                           std::span<const FieldSample> at) const;
    // Adds to forces_by_magnetization those of gradient and sources.
    void add_position_forces(std::size_t element, const Eigen::VectorXd& x,
                             const StaticLoads& loads, std::span<const FieldSample> at,
                             Forces24& out) const;
    // Adds the forces of the platform; returns their energy [J].
    double add_platform(const Eigen::VectorXd& x, Eigen::VectorXd& force_n) const;
    // Depth of a node behind the platform's plane [m], negative in front of it.
    double depth_m(const Eigen::VectorXd& x, Eigen::Index node) const;
    // Residual [N] that rounding leaves of internal forces in balance.
    double rounding_n() const;

    Body body_;
    Surroundings surroundings_;
    std::vector<GradientElement> gradient_elements_;
    // Moment matrix of each element; empty without sources
    std::vector<Matrix8> moments_;
    // Elements of a magnetisation that follows the rotation; else empty
    std::vector<TurnedElement> turned_;
    std::vector<double> surface_m2_;  // share of each node; empty without a platform
    Eigen::Vector3d platform_normal_ = Eigen::Vector3d::Zero();
    // Values of the nodes; charge_ is q_a of eq. (6) [A m]
    std::vector<double> node_volume_m3_, node_mass_kg_, charge_;
    std::vector<ElementReference> references_;
    // held_: axes by node; held_along_: axes along which any node is held
    std::vector<HeldAxes> held_;
    HeldAxes held_along_{};
    ElementKernel kernel_;
    StiffnessMatrix matrix_;
    double volume_m3_ = 0;
    // largest_modulus_pa_: largest K + G of the materials
    double largest_shear_modulus_pa_ = 0, largest_modulus_pa_ = 0;
    double bending_scale_ = 0, shortest_side_m_ = 0, longest_side_m_ = 0;
};

// Positions as one vector, x y z of each node in turn, and back.
Eigen::VectorXd flat_positions(const std::vector<Vec3>& nodes_m);
std::vector<Vec3> nodes_from(const Eigen::VectorXd& x);

}  // namespace magfsi::structure
