// SPDX-License-Identifier: GPL-2.0-or-later
// Static equilibrium of one body under magnetic fields, weight and supports, followed
// along a path of loads.
#pragma once

#include <span>
#include <vector>

#include "structure/equilibrium/iteration.h"

namespace magfsi::structure {

// Options of the solver.
struct EquilibriumOptions {
    // Limit of two relative errors: largest residual over largest nodal load, and
    // Equilibrium::displacement_error.
    double tolerance = 1e-9;
    // True: an equilibrium that turns out to be unstable is disturbed along its unstable
    // mode and released.
    bool leave_unstable = false;
};

// A shape at rest and how it was found. SI.
struct Equilibrium {
    std::vector<Vec3> nodes_m;  // positions of the nodes
    int load_steps = 0;
    // Number of factorised tangents, those of failed steps included
    int iterations = 0;
    // Number of releases: times that the equilibrium could not be followed. After a
    // release the shape may lie on another branch.
    int releases = 0;
    double residual = 0;  // largest residual over the largest nodal load
    // Largest component of K^-1 residual over that of K^-1 load, where K is the tangent,
    // both without rigid motions. It exceeds the tolerance only if the residual is
    // rounding. 0 without a load, and if the tangent is not positive definite.
    double displacement_error = 0;
    // False if the loads are too weak against rounding to know the shape to 1 %.
    bool resolved() const { return displacement_error <= 0.01; }
    // Number of negative eigenvalues of the tangent: 0 is stable. Rigid motions that cost
    // no energy do not count.
    int negative_eigenvalues = 0;
    double seconds = 0;             // wall time
    std::vector<Vec3> support_n{};  // force of clamps and rollers on each node
    double energy_elastic_j = 0;
    double energy_magnetic_j = 0;  // - integral of (F M) . B of the uniform field B
    double energy_weight_j = 0;    // zero in the undeformed mesh
};

// Load stepping with a mixed Newton iteration (iteration.h): steps are halved where it
// fails and grow up to fourfold where it succeeds. If the smallest step fails too (at a
// limit point, or for a free body that must turn far at the first touch of the field),
// the body is released at that load by a damped Newton descent of the energy
// (iteration.h). Without clamps the loads must balance each other; the centre of volume
// stays, and the turn about the field's axis is that of the start
// (StaticProblem::rigid_foundation). Every linear system is made positive definite, so an
// unstable equilibrium is found only where symmetry keeps the body on it; it is then
// reported by negative_eigenvalues.
//
// All functions throw std::runtime_error, with body, load and worst node and element, if
// no equilibrium is found, and std::invalid_argument on a free body with weight or on
// start positions of another number of nodes.
class NewtonSolver {
  public:
    // Throws as StaticProblem does.
    explicit NewtonSolver(const Body& body, const EquilibriumOptions& options = {},
                          Surroundings surroundings = {});

    // Equilibrium of loads that are raised from zero on the undeformed body.
    Equilibrium solve(const StaticLoads& loads);

    // The equilibrium at each point of the path, each followed from the one before by
    // loads linear in between, so that a rotating field needs a point every few degrees.
    // start: an equilibrium under `from`; if it is none, the body is released there
    // first. Clamped nodes stay where the start has them, and driven nodes move on from
    // there.
    std::vector<Equilibrium> follow(const std::vector<Vec3>& start,
                                    const StaticLoads& from,
                                    std::span<const StaticLoads> path);

    // Descent in energy from these positions under the full loads, as a slow, strongly
    // damped body would move. The start chooses among several equilibria; an unstable one
    // is kept only if it is exactly balanced.
    Equilibrium release(const std::vector<Vec3>& start, const StaticLoads& loads);

  private:
    struct Progress;
    // Follows the equilibrium from one load to another by steps of the load.
    void advance(Progress& state, const NodalLoads& from, const NodalLoads& to);
    // Energy descent at a constant load. Throws if it does not converge.
    void release_at(Progress& state, const NodalLoads& load);
    // Leaves an unstable equilibrium along its lowest mode, to the side with the lower
    // energy.
    void push_off(Progress& state, const NodalLoads& load);
    // Leaves unstable equilibria if the options ask for it: on an unstable branch that
    // symmetry keeps, every further step of load would be refused down to the smallest.
    // Returns the number of negative eigenvalues that are left.
    int settle(Progress& state, const NodalLoads& load);
    // Goal of an iteration. passing: for equilibria between two points of the path.
    Goal goal(bool passing = false) const;
    // The start as one vector. Throws std::invalid_argument on a wrong number of nodes.
    Eigen::VectorXd checked_start(const std::vector<Vec3>& start) const;
    // Iterates until displacement_error, too, is within the tolerance or stops falling.
    void refine(Progress& state, const NodalLoads& load, Equilibrium& out);
    // Settles and refines the state and fills in the result.
    Equilibrium finish(Progress& state, const StaticLoads& loads);
    [[noreturn]] void fail(const Progress& state, const NodalLoads& load) const;

    EquilibriumOptions options_;
    StaticProblem problem_;
};

// Message for a shape that is not resolved: the loads are too weak against rounding.
std::string unresolved_loads(const std::string& body);

// Positions of the nodes [m] at rest in a constant uniform field without other loads,
// released from the undeformed body. Throws std::runtime_error if there is no such shape
// or it is not resolved.
std::vector<Vec3> relaxed_shape(const Body& body, const Vec3& field_t);

}  // namespace magfsi::structure
