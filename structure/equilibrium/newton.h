// SPDX-License-Identifier: GPL-2.0-or-later
// Static equilibrium of one body under fields, its weight and what holds, moves or bears
// it, followed along a path of loads.
#pragma once

#include <span>
#include <vector>

#include "structure/equilibrium/iteration.h"

namespace magfsi::structure {

struct EquilibriumOptions {
    // Of the largest residual over the largest nodal load, and of the displacements that
    // the residual stands for over those that the load does (Equilibrium).
    double tolerance = 1e-9;
    // Pushes the body off an equilibrium that turns out unstable and releases it.
    bool leave_unstable = false;
};

struct Equilibrium {
    std::vector<Vec3> nodes_m;
    int load_steps = 0;
    int iterations = 0;  // factorised tangents, those of failed steps included
    // How often the equilibrium could not be followed and the body was released: from
    // there on the shape may lie on another branch.
    int releases = 0;
    double residual = 0;  // over the largest nodal load
    // K^-1 residual over K^-1 load, their largest components, K the tangent, rigid
    // motions apart. Above the tolerance only where the residual is rounding. 0 without a
    // load, and where the tangent is not positive definite.
    double displacement_error = 0;
    bool resolved() const { return displacement_error <= 0.01; }
    // Of the tangent: 0 stable, more unstable. Rigid motions that cost no energy do not
    // count.
    int negative_eigenvalues = 0;
    double seconds = 0;
    std::vector<Vec3> support_n{};  // by clamps and rollers on each node
    double energy_elastic_j = 0;
    double energy_magnetic_j = 0;  // - integral of (F M) . B, of the uniform field B
    double energy_weight_j = 0;    // zero in the undeformed mesh
};

// Load stepping with a mixed Newton iteration (iteration.h): steps are halved where
// it fails and doubled where it succeeds. Where the smallest step fails too (a limit
// point, or a free body that must turn far at the first touch of the field) the body is
// released at that load: a damped Newton descent of the energy (iteration.h).
// Without clamps the loads must balance each other; the centre of volume stays, and the
// turn about the field's axis is that of the start (StaticProblem::rigid_foundation).
// Every linear system is made positive definite, so an unstable equilibrium is found only
// where symmetry keeps the body on it; it is then reported as such.
//
// All throw std::runtime_error that names the body, the load and the worst node or
// element if no equilibrium is found, and std::invalid_argument on a free body with
// weight or start positions of another number of nodes.
class NewtonSolver {
  public:
    // Throws as StaticProblem does.
    explicit NewtonSolver(const Body& body, const EquilibriumOptions& options = {},
                          Surroundings surroundings = {});

    // Loads raised from zero on the undeformed body.
    Equilibrium solve(const StaticLoads& loads);

    // The equilibrium at each point of the path, each followed from the one before by
    // loads linear in between: give a turning field in steps of some degrees. `start` is
    // an equilibrium under `from` (else the body is first released there). Clamped nodes
    // stay where the start has them, and driven ones go on from there.
    std::vector<Equilibrium> follow(const std::vector<Vec3>& start,
                                    const StaticLoads& from,
                                    std::span<const StaticLoads> path);

    // From these positions downhill in energy under the full loads, as a slow, strongly
    // damped body would go: the start chooses among several equilibria, and an exactly
    // balanced unstable one is kept.
    Equilibrium release(const std::vector<Vec3>& start, const StaticLoads& loads);

  private:
    struct Progress;
    void advance(Progress& state, const NodalLoads& from, const NodalLoads& to);
    void release_at(Progress& state, const NodalLoads& load);
    void push_off(Progress& state, const NodalLoads& load);
    // Off what is unstable, where that is wanted: on an unstable branch that symmetry
    // keeps, every further step of load would be refused down to the smallest. Returns
    // how many directions are still unstable.
    int settle(Progress& state, const NodalLoads& load);
    // `passing`: where a load step only passes through.
    Goal goal(bool passing = false) const;
    Eigen::VectorXd checked_start(const std::vector<Vec3>& start) const;
    // Goes on until the displacements, too, are within the tolerance.
    void refine(Progress& state, const NodalLoads& load, Equilibrium& out);
    Equilibrium finish(Progress& state, const StaticLoads& loads);
    [[noreturn]] void fail(const Progress& state, const NodalLoads& load,
                           int worst_element) const;

    EquilibriumOptions options_;
    StaticProblem problem_;
};

// What is said of a shape that is not resolved.
std::string unresolved_loads(const std::string& body);

// The shape at rest in a constant uniform field without other loads, released from the
// body's own shape.
std::vector<Vec3> relaxed_shape(const Body& body, const Vec3& field_t);

}  // namespace magfsi::structure
