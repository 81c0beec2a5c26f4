// SPDX-License-Identifier: GPL-2.0-or-later
// Derivatives of functionals of an equilibrium, by adjoint solves.
#include <array>
#include <stdexcept>
#include <utility>

#include "structure/design/design_problem.h"
#include "structure/lattice/plain_element.h"

namespace magfsi::structure {
namespace {

using Values24 = StaticProblem::Values24;

// The 24 values of an element's nodes in a vector of all nodes.
Values24 values_of(const Hexahedron& nodes, const Eigen::VectorXd& all) {
    Values24 out;
    for (int a = 0; a < 8; ++a) out.segment<3>(3 * a) = all.segment<3>(3 * nodes[a]);
    return out;
}

// The same for each column.
Eigen::Matrix<double, 24, Eigen::Dynamic> columns_of(const Hexahedron& nodes,
                                                     const Eigen::MatrixXd& all) {
    Eigen::Matrix<double, 24, Eigen::Dynamic> out(24, all.cols());
    for (int a = 0; a < 8; ++a)
        out.middleRows<3>(3 * a) =
            all.middleRows(3 * static_cast<Eigen::Index>(nodes[a]), 3);
    return out;
}

}  // namespace

DesignProblem::Adjoints DesignProblem::right_sides(
    const Eigen::VectorXd& x, const NodalLoads& load,
    std::span<const FunctionalEntry> entries, int rows) const {
    Adjoints out{Eigen::MatrixXd::Zero(x.size(), rows),
                 Eigen::MatrixXd::Zero(x.size(), rows)};
    std::vector<bool> of_support(static_cast<std::size_t>(rows), false);
    for (const FunctionalEntry& entry : entries) {
        if (entry.of_support) {
            of_support[entry.row] = true;
            out.held(entry.coordinate, entry.row) -= entry.weight;
        } else {
            out.right(entry.coordinate, entry.row) += entry.weight;
        }
    }
    for (int row = 0; row < rows; ++row) {
        if (!of_support[row]) continue;
        out.right.col(row) -= problem_->tangent_times(x, load, out.held.col(row));
    }
    return out;
}

Eigen::MatrixXd DesignProblem::solve(const Eigen::VectorXd& x, const NodalLoads& load,
                                     const Eigen::MatrixXd& right) const {
    Eigen::MatrixXd out = problem_->matrix().solve_all(right);
    if (problem_->rigid_foundation() == 0) return out;
    // The foundation that holds rigid motions is about 1e-5 of the bending stiffness; two
    // corrections take its influence away.
    for (int correction = 0; correction < 2; ++correction) {
        Eigen::MatrixXd left = right;
        for (Eigen::Index c = 0; c < out.cols(); ++c)
            left.col(c) -= problem_->tangent_times(x, load, out.col(c));
        out += problem_->matrix().solve_all(left);
    }
    return out;
}

Sensitivity DesignProblem::sensitivity(const Eigen::VectorXd& x, const Design& at,
                                       std::span<const FunctionalEntry> entries,
                                       int rows) {
    set(at);
    const NodalLoads load = problem_->load(at.loads);
    problem_->assemble(x, load);
    problem_->matrix().raise_foundation(problem_->rigid_foundation());
    if (!problem_->matrix().factorize())
        throw std::runtime_error("the equilibrium is unstable");
    const Adjoints adjoints = right_sides(x, load, entries, rows);
    const Eigen::MatrixXd lambda = solve(x, load, adjoints.right) + adjoints.held;

    const auto& elements = body_.mesh.elements;
    Sensitivity out;
    out.magnetization.resize(rows, 3 * static_cast<Eigen::Index>(elements.size()));
    out.stiffness.setZero(rows, static_cast<Eigen::Index>(at.stiffness.size()));
    const auto by_magnetization = problem_->forces_by_magnetization(x, at.loads);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const auto here = columns_of(elements[e], lambda);
        out.magnetization.middleCols<3>(3 * static_cast<Eigen::Index>(e)).noalias() =
            here.transpose() * by_magnetization[e];
        if (at.stiffness.empty()) continue;
        const int region = body_.mesh.region[e];
        out.stiffness.col(region).noalias() +=
            here.transpose() * problem_->elastic_force_n(e, x) / at.stiffness[region];
    }
    out.field = lambda.transpose() * problem_->forces_by_field();
    out.thickness = by_thickness(x, at, lambda, entries);
    return out;
}

// The thickness of a region changes the nodes at rest, and with them charges, masses and
// elements. Their forces at fixed positions (nodes that are held move along) are
// differentiated by central differences of the fourth order, whose error is below 1e-10
// for steps of 0.1 %; equilibria are not differenced.
Eigen::MatrixXd DesignProblem::by_thickness(
    const Eigen::VectorXd& x, const Design& at, const Eigen::MatrixXd& lambda,
    std::span<const FunctionalEntry> entries) const {
    constexpr double step = 1e-3;
    const std::vector<HeldAxes> held = held_axes(body_);
    const std::vector<Vec3> rest = shaped(at).mesh.nodes;
    Eigen::MatrixXd out(lambda.cols(), static_cast<Eigen::Index>(at.thickness.size()));
    for (std::size_t r = 0; r < at.thickness.size(); ++r) {
        Eigen::VectorXd force_n = Eigen::VectorXd::Zero(x.size()), moved = force_n;
        constexpr std::array<std::pair<int, double>, 4> stencil{
            {{1, 8.0}, {-1, -8.0}, {2, -1.0}, {-2, 1.0}}};
        for (const auto& [way, weight] : stencil) {
            Design there = at;
            there.thickness[r] += way * step;
            Body body = shaped(there);
            body.magnetization_a_m = at.magnetization_a_m;
            Eigen::VectorXd positions = x;
            Eigen::VectorXd change =
                flat_positions(body.mesh.nodes) - flat_positions(rest);
            for (Eigen::Index q = 0; q < x.size(); ++q) {
                if (!held[q / 3][q % 3]) change[q] = 0;
            }
            positions += change;
            const StaticProblem other(body, surroundings_);
            force_n +=
                weight / (12 * step) * other.force_n(positions, other.load(at.loads));
            moved += weight / (12 * step) * change;
        }
        const auto column = static_cast<Eigen::Index>(r);
        out.col(column) = lambda.transpose() * force_n;
        for (const FunctionalEntry& entry : entries) {
            if (!entry.of_support)
                out(entry.row, column) += entry.weight * moved[entry.coordinate];
        }
    }
    return out;
}

// --- what the derivatives take of the static problem -----------------------------------

Eigen::VectorXd StaticProblem::force_n(const Eigen::VectorXd& x,
                                       const NodalLoads& loads) const {
    Eigen::VectorXd out = surrounding_n(x, loads);
    add_internal(x, out);
    return out;
}

Eigen::VectorXd StaticProblem::tangent_times(const Eigen::VectorXd& x,
                                             const NodalLoads& loads,
                                             const Eigen::VectorXd& v) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(x.size());
    std::vector<FieldSample> at;
    if (loads.sources != 0) at = samples(x, loads.sources_s);
    for (std::size_t e = 0; e < references_.size(); ++e) {
        const Hexahedron& nodes = body_.mesh.elements[e];
        const Values24 here = values_of(nodes, v);
        if (here.isZero(0)) continue;
        Matrix24 tangent =
            element_tangent(references_[e], material(e), element_positions(e, x));
        tangent += field_tangent(e, x, loads, at);
        const Values24 product = tangent * here;
        for (int a = 0; a < 8; ++a)
            out.segment<3>(3 * nodes[a]) += product.segment<3>(3 * a);
    }
    for (std::size_t n = 0; n < surface_m2_.size(); ++n) {
        const auto node = static_cast<Eigen::Index>(n);
        if (surface_m2_[n] == 0 || depth_m(x, node) <= 0) continue;
        const double spring = surroundings_.platform->stiffness_pa_m * surface_m2_[n];
        out.segment<3>(3 * node) +=
            spring * platform_normal_.dot(v.segment<3>(3 * node)) * platform_normal_;
    }
    return out;
}

std::vector<StaticProblem::Forces24> StaticProblem::forces_by_magnetization(
    const Eigen::VectorXd& x, const StaticLoads& loads) const {
    const auto& elements = body_.mesh.elements;
    const Eigen::Vector3d field_t(loads.field_t.data());
    std::vector<FieldSample> at;
    if (loads.sources != 0 && surroundings_.sources) at = samples(x, loads.sources_s);
    const bool in_gradient = surroundings_.gradient && loads.gradient != 0;
    std::vector<Forces24> out(elements.size(), Forces24::Zero());
    for (std::size_t e = 0; e < elements.size(); ++e) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d)
                out[e].row(3 * a + d) = field_t[d] * references_[e].gradient.row(a);
        }
        if (in_gradient || !at.empty()) add_position_forces(e, x, loads, at, out[e]);
    }
    return out;
}

// Adds the forces of a magnetisation of 1 A/m along each axis in the field of gradient
// and sources, on a copy of the element with nodes of its own.
void StaticProblem::add_position_forces(std::size_t e, const Eigen::VectorXd& x,
                                        const StaticLoads& loads,
                                        std::span<const FieldSample> at,
                                        Forces24& out) const {
    const Hexahedron& nodes = body_.mesh.elements[e];
    const std::vector<Hexahedron> alone(1, Hexahedron{0, 1, 2, 3, 4, 5, 6, 7});
    std::vector<Vec3> rest_m;
    std::vector<FieldSample> here;
    for (const int node : nodes) {
        rest_m.push_back(body_.mesh.nodes[node]);
        if (!at.empty()) here.push_back(at[node]);
    }
    const Values24 now = values_of(nodes, x);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 unit{};
        unit[axis] = 1;
        Values24 force_n = Values24::Zero();
        if (surroundings_.gradient && loads.gradient != 0) {
            const auto part = gradient_elements(rest_m, alone, {unit});
            add_gradient_forces(part, alone, *surroundings_.gradient, now.data(),
                                force_n.data());
            out.col(axis) += loads.gradient * force_n;
        }
        if (here.empty()) continue;
        force_n.setZero();
        const auto part = moment_elements(rest_m, alone, {unit});
        add_source_forces(part, alone, here, now.data(), force_n.data());
        out.col(axis) += loads.sources * force_n;
    }
}

Eigen::MatrixXd StaticProblem::forces_by_field() const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * charge_.size(), 3);
    for (std::size_t n = 0; n < charge_.size(); ++n)
        out.middleRows<3>(3 * static_cast<Eigen::Index>(n))
            .diagonal()
            .setConstant(charge_[n]);
    return out;
}

StaticProblem::Values24 StaticProblem::elastic_force_n(std::size_t element,
                                                       const Eigen::VectorXd& x) const {
    const Positions8 force = element_energy(references_[element], material(element),
                                            element_positions(element, x))
                                 .force_n;
    Values24 out;
    for (int a = 0; a < 8; ++a) out.segment<3>(3 * a) = force.row(a).transpose();
    return out;
}

}  // namespace magfsi::structure
