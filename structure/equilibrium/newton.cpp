// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/equilibrium/newton.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structure/magnetics/magnetization.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Limits on iterations: within a load step the mixed one needs 4 to 8 or fails.
constexpr int max_mixed = 12;
constexpr int max_descent = 400;
// Relative residual of the equilibria between two points of the path.
constexpr double passing_tolerance = 1e-4;
// Largest move of a node in a load step, as a share of the body's longest side. Steps
// that move further are repeated smaller, so that no jump to another branch goes
// unnoticed.
constexpr double largest_share_moved = 0.5;
// Smallest step, as a share of the way between two points of the path; if it fails, the
// body is released.
constexpr double smallest_step = 1.0 / 64;
constexpr int max_load_steps = 500;  // between two points of the path

double now_s() {
    return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// Negative eigenvalues of the tangent at x. The foundation shifts the zero eigenvalues of
// rigid motions to positive ones. Leaves the tangent factorised if there are none.
int negative_eigenvalues(StaticProblem& problem, const Eigen::VectorXd& x,
                         const NodalLoads& load) {
    problem.assemble(x, load);
    problem.matrix().raise_foundation(problem.rigid_foundation());
    return problem.matrix().negative_eigenvalues();
}

// Mode m of the lowest eigenvalue w of K m = w V m, with V the volumes of the nodes,
// scaled to a largest component of 1. Inverse iteration on the tangent, made positive
// definite by a shift.
Eigen::VectorXd lowest_mode(StaticProblem& problem, const Eigen::VectorXd& x,
                            const NodalLoads& load) {
    // The shift grows in factors of two. It thus exceeds -w by at most as much, and the
    // iteration gains a factor of at least two on the next mode that is not negative.
    double shift = problem.rigid_foundation();
    problem.assemble(x, load);
    problem.matrix().raise_foundation(shift);
    while (!problem.matrix().factorize()) {
        shift = std::max(2 * shift, 1e-3 * problem.bending_stiffness_scale());
        problem.matrix().raise_foundation(shift);
    }
    // The start has no symmetry and is fixed, so that results repeat.
    Eigen::VectorXd mode(x.size());
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        mode[q] = std::sin(1.0 + 0.7 * static_cast<double>(q % 97));
    }
    for (int iteration = 0; iteration < 20; ++iteration) {
        for (Eigen::Index q = 0; q < x.size(); ++q) {
            mode[q] *= problem.node_volumes_m3()[q / 3];
        }
        mode = problem.matrix().solve(mode);
        mode /= mode.cwiseAbs().maxCoeff();
    }
    return mode;
}

// Equilibrium::displacement_error at x. The matrix must be the one that
// negative_eigenvalues has factorised.
double displacement_error(StaticProblem& problem, const Eigen::VectorXd& x,
                          const NodalLoads& load) {
    const auto deformation_m = [&](const Eigen::VectorXd& force_n) {
        return deformation(problem, x, problem.matrix().solve(force_n))
            .cwiseAbs()
            .maxCoeff();
    };
    double response_m = deformation_m(problem.surrounding_n(x, load));
    if (load.driven_m.size() > 0)
        response_m = std::max(response_m, load.driven_m.cwiseAbs().maxCoeff());
    const double error_m = deformation_m(problem.response(x, load).residual_n);
    return response_m > 0 ? error_m / response_m : 0;
}

}  // namespace

// State on the way from one point of the path to the next.
struct NewtonSolver::Progress {
    Eigen::VectorXd x;
    int load_steps = 0, iterations = 0, releases = 0;
    double start_s = now_s();
    double load_factor = 0;  // share of the way that was tried last

    void take(const Iterate& found) {
        x = found.x;
        ++load_steps;
    }
};

NewtonSolver::NewtonSolver(const Body& body, const EquilibriumOptions& options,
                           Surroundings surroundings)
    : options_(options), problem_(body, std::move(surroundings)) {}

Equilibrium NewtonSolver::solve(const StaticLoads& loads) {
    return follow(problem_.body().mesh.nodes, {}, {&loads, 1}).front();
}

std::vector<Equilibrium> NewtonSolver::follow(const std::vector<Vec3>& start,
                                              const StaticLoads& from,
                                              std::span<const StaticLoads> path) {
    Progress state;
    state.x = checked_start(start);
    NodalLoads load = problem_.load(from);
    Goal here = goal(true);
    // Flat elements at rest leave a larger residual than the rounding of the mean edge
    // tells; they are not to be released for that.
    if (load.none()) here.least_n *= 10;
    if (!StaticProblem::reached(here, problem_.response(state.x, load)))
        release_at(state, load);
    std::vector<Equilibrium> out;
    for (const StaticLoads& point : path) {
        const NodalLoads ahead = problem_.load(point);
        advance(state, load, ahead);
        load = ahead;
        out.push_back(finish(state, point));
        Progress next;
        next.x = std::move(state.x);
        state = std::move(next);
    }
    return out;
}

Equilibrium NewtonSolver::release(const std::vector<Vec3>& start,
                                  const StaticLoads& loads) {
    Progress state;
    state.x = checked_start(start);
    state.load_factor = 1;
    release_at(state, problem_.load(loads));
    return finish(state, loads);
}

void NewtonSolver::advance(Progress& state, const NodalLoads& from,
                           const NodalLoads& to) {
    const double largest_move = largest_share_moved * problem_.longest_side_m();
    double reached = 0;
    double step = 1;
    bool settled = false;  // pushed off the branch in this step
    while (reached < 1) {
        const double ahead = std::min(reached + step, 1.0);
        const NodalLoads load = between(from, to, ahead);
        const Eigen::VectorXd drive_m = (ahead - reached) * (to.driven_m - from.driven_m);
        state.load_factor = ahead;
        const Iterate found = mixed_iteration(problem_, state.x, load, goal(ahead < 1),
                                              max_mixed, largest_move, drive_m);
        state.iterations += found.iterations;
        // The first step is linear in the load step and thus tells how large the next one
        // may be.
        const double room = 0.7 * largest_move / found.first_step_m;
        if (found.converged) {
            state.take(found);
        } else if (options_.leave_unstable && !found.stable_start && !settled) {
            settled = true;
            (void)settle(state, between(from, to, reached));
            continue;
        } else if (step > smallest_step) {
            step =
                std::max((ahead - reached) * std::clamp(room, 0.02, 0.5), smallest_step);
            continue;
        } else {
            if (drive_m.size() > 0) state.x += drive_m;
            release_at(state, load);
            (void)settle(state, load);
        }
        if (state.load_steps > max_load_steps) {
            fail(state, load);
        }
        settled = false;
        step = (ahead - reached) * std::clamp(room, 1.0, 4.0);
        reached = ahead;
    }
}

void NewtonSolver::release_at(Progress& state, const NodalLoads& load) {
    const Iterate found = energy_descent(problem_, state.x, load, goal(), max_descent);
    state.iterations += found.iterations;
    state.take(found);
    ++state.releases;
    if (!found.converged) fail(state, load);
}

void NewtonSolver::push_off(Progress& state, const NodalLoads& load) {
    const double push_m = 0.05 * problem_.shortest_side_m();
    const Eigen::VectorXd mode = lowest_mode(problem_, state.x, load);
    const Eigen::VectorXd balanced = state.x;
    double lowest = INFINITY;
    const auto pushed_j = [&](double way_m) {
        return problem_.response(balanced + way_m * mode, load).total_j;
    };
    // Two ways of the same energy are mirror images, of which one is enough.
    const double one_j = pushed_j(push_m), other_j = pushed_j(-push_m);
    const bool mirrored =
        std::abs(one_j - other_j) <= 1e-4 * std::abs(one_j - pushed_j(0));
    for (double sign : {1.0, -1.0}) {
        if (mirrored && sign < 0 && std::isfinite(lowest)) break;
        const Iterate fallen = energy_descent(problem_, balanced + sign * push_m * mode,
                                              load, goal(), max_descent);
        state.iterations += fallen.iterations;
        const double energy = fallen.response.total_j;
        if (!fallen.converged || !(energy < lowest)) continue;
        lowest = energy;
        state.x = fallen.x;
    }
    ++state.releases;
    if (!std::isfinite(lowest)) {
        fail(state, load);
    }
}

Goal NewtonSolver::goal(bool passing) const {
    return problem_.goal(passing ? passing_tolerance : options_.tolerance);
}

Eigen::VectorXd NewtonSolver::checked_start(const std::vector<Vec3>& start) const {
    const std::size_t nodes = problem_.body().mesh.nodes.size();
    if (start.size() != nodes) {
        refuse("body {}: {} start positions found for {} nodes", problem_.body().name,
               start.size(), nodes);
    }
    return flat_positions(start);
}

int NewtonSolver::settle(Progress& state, const NodalLoads& load) {
    int unstable = negative_eigenvalues(problem_, state.x, load);
    // A second mode may be left after the first: as many pushes as there are negative
    // eigenvalues.
    const int pushes = options_.leave_unstable ? unstable : 0;
    for (int push = 0; push < pushes && unstable > 0; ++push) {
        push_off(state, load);
        unstable = negative_eigenvalues(problem_, state.x, load);
    }
    return unstable;
}

void NewtonSolver::refine(Progress& state, const NodalLoads& load, Equilibrium& out) {
    if (load.none()) return;
    double before = INFINITY;
    while (out.negative_eigenvalues == 0) {
        out.displacement_error = displacement_error(problem_, state.x, load);
        if (out.displacement_error <= options_.tolerance ||
            out.displacement_error > 0.5 * before) {
            return;
        }
        before = out.displacement_error;
        const Iterate closer =
            mixed_iteration(problem_, state.x, load, {}, 2, problem_.longest_side_m());
        state.iterations += closer.iterations;
        if (!(closer.response.smallest_j > 0)) return;
        state.x = closer.x;
        out.negative_eigenvalues = negative_eigenvalues(problem_, state.x, load);
    }
}

Equilibrium NewtonSolver::finish(Progress& state, const StaticLoads& loads) {
    const NodalLoads load = problem_.load(loads);
    Equilibrium out;
    out.negative_eigenvalues = settle(state, load);
    refine(state, load, out);
    const auto response = problem_.response(state.x, load);
    out.residual = problem_.relative_residual(response);
    out.nodes_m = nodes_from(state.x);
    out.support_n = nodes_from(problem_.support_n(state.x, load));
    out.load_steps = state.load_steps;
    out.iterations = state.iterations;
    out.releases = state.releases;
    out.energy_elastic_j = response.elastic_j;
    const Eigen::VectorXd moved = state.x - flat_positions(problem_.body().mesh.nodes);
    out.energy_magnetic_j = problem_.field_j(state.x, loads.field_t);
    out.energy_weight_j = -problem_.load({{}, loads.gravity_m_s2}).dead_n.dot(moved);
    out.seconds = now_s() - state.start_s;
    return out;
}

void NewtonSolver::fail(const Progress& state, const NodalLoads& load) const {
    const auto response = problem_.response(state.x, load);
    const Mesh& mesh = problem_.body().mesh;
    const auto place = [](const Vec3& x) {
        return fmt::format("at ({:.4g}, {:.4g}, {:.4g}) m at rest", x[0], x[1], x[2]);
    };
    if (response.smallest_j > 0 && response.largest_share > largest_share_of_limit) {
        throw std::runtime_error(fmt::format(
            "body {}: no equilibrium at {:.3g} of the load: the element {} is stretched "
            "to {:.3g} % of the limit of its material (of I1 - 3), {:.3g} % are allowed: "
            "use weaker loads or a material with a larger limit",
            problem_.body().name, state.load_factor,
            place(element_centre(mesh, response.tight_element)),
            100 * response.largest_share, 100 * largest_share_of_limit));
    }
    Eigen::Index worst = 0;
    response.residual_n.cwiseAbs().maxCoeff(&worst);
    throw std::runtime_error(fmt::format(
        "body {}: no equilibrium at {:.3g} of the load after {} load steps "
        "and {} iterations; the residual is {:.2g} of the load, largest at "
        "the node {}, and the smallest J is {:.3g} in the element {}: use "
        "weaker loads, a finer mesh or more points on the way",
        problem_.body().name, state.load_factor, state.load_steps, state.iterations,
        problem_.relative_residual(response), place(mesh.nodes[worst / 3]),
        response.smallest_j, place(element_centre(mesh, response.element))));
}

std::string unresolved_loads(const std::string& body) {
    return fmt::format(
        "body {}: its loads are too weak for the rounding of its positions: the shape "
        "under them is not known to 1 %; take stronger loads or none",
        body);
}

std::vector<Vec3> relaxed_shape(const Body& body, const Vec3& field_t) {
    try {
        const Equilibrium found =
            NewtonSolver(body).release(body.mesh.nodes, {field_t, {}});
        if (!found.resolved()) throw std::runtime_error(unresolved_loads(body.name));
        return found.nodes_m;
    } catch (const std::runtime_error& fault) {
        throw std::runtime_error(
            fmt::format("{} (shape relaxed in the field ({:g}, {:g}, {:g}) T)",
                        fault.what(), field_t[0], field_t[1], field_t[2]));
    }
}

}  // namespace magfsi::structure
