// SPDX-License-Identifier: GPL-2.0-or-later
// The equilibrium of one body in one pose as a function of what a designer may choose:
// magnetisation, loads, stiffness and thickness. Derivatives are by the adjoint method:
// with the residual f(x, p) = 0 and the tangent K = -df/dx, a functional r(x) has
//   dr/dp = lambda . df/dp,   K lambda = dr/dx,
// one solve with Newton's factor for each functional, whatever the number of unknowns.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "structure/equilibrium/newton.h"

namespace magfsi::structure {

// What a designer chooses, with the other loads of the pose.
struct Design {
    std::vector<Vec3> magnetization_a_m;  // one vector per element
    StaticLoads loads;
    // Factor on all moduli of each region of the mesh, in the order of its names; empty:
    // ones
    std::vector<double> stiffness;
    // Factor on the thickness of each region of the mesh; empty: ones
    std::vector<double> thickness;
};

// Entry of a linear functional of the nodes' positions, or of the supports' forces.
struct FunctionalEntry {
    int row = 0;
    int coordinate = 0;  // 3 node + axis
    double weight = 0;
    // True: the weight acts on the force of a clamp or roller on the node
    bool of_support = false;
};

// Derivatives of functionals at an equilibrium, one row for each.
struct Sensitivity {
    Eigen::MatrixXd magnetization;  // columns 3 element + axis [per A/m]
    Eigen::MatrixXd field;          // columns: axes [per T]
    Eigen::MatrixXd stiffness;      // columns: regions [per factor]
    Eigen::MatrixXd thickness;      // columns: regions [per factor]
};

class DesignProblem {
  public:
    // Throws as StaticProblem does. tolerance: largest residual over largest nodal load.
    // The thickness is along the shortest side of the body.
    DesignProblem(const Body& body, Surroundings surroundings, double tolerance = 1e-10);

    const Body& body() const { return body_; }

    // Result of a move or of a rise of the loads.
    struct Found {
        Eigen::VectorXd x;   // positions of the nodes [m]
        double share = 0;    // part of the way on which a stable equilibrium was followed
        int iterations = 0;  // factorised tangents
        bool reached() const { return share == 1; }
    };

    // Follows the stable equilibrium x of `from` to that of `to`, with all of the design
    // linear in between. A part of the way counts as followed only if Newton's method
    // converges near its linear prediction and the tangent there is positive definite;
    // otherwise it is halved, at most `halvings` times. The result ends where the
    // equilibrium was lost, so that the caller can take a smaller step.
    Found move(const Eigen::VectorXd& x, const Design& from, const Design& to,
               int halvings = 3);

    // Follows the equilibrium from the undeformed body without loads while all loads rise
    // in proportion. The share ends at the first limit point or instability.
    Found rise(const Design& to);

    // Energy descent from x: where a strongly damped body would come to rest. The share
    // is 0 if it does not converge, or if what it finds is unstable.
    Found release(const Eigen::VectorXd& x, const Design& at);

    // Derivatives of `rows` linear functionals at the equilibrium x. Throws
    // std::runtime_error if the tangent is not positive definite there.
    Sensitivity sensitivity(const Eigen::VectorXd& x, const Design& at,
                            std::span<const FunctionalEntry> entries, int rows);

    // Forces of clamps and rollers on the nodes [N].
    Eigen::VectorXd support_n(const Eigen::VectorXd& x, const Design& at);

  private:
    // Makes problem_ that of the design.
    void set(const Design& at);
    // The body with the stiffness and the thickness of the design.
    Body shaped(const Design& at) const;
    // Positions of a body that was bent to x, with another thickness.
    Eigen::VectorXd carried(const Eigen::VectorXd& x, const std::vector<double>& from,
                            const std::vector<double>& to) const;
    // Derivatives by the factors of thickness, by differences of the forces alone.
    Eigen::MatrixXd by_thickness(const Eigen::VectorXd& x, const Design& at,
                                 const Eigen::MatrixXd& lambda,
                                 std::span<const FunctionalEntry> entries) const;
    // Sharpens an equilibrium that an iteration has found to the rounding. False if the
    // tangent there is not positive definite.
    bool settle(Found& found, const NodalLoads& load);
    // Right sides K_fh w and values -w at held coordinates for functionals of supports.
    struct Adjoints {
        Eigen::MatrixXd right;  // one column per functional
        Eigen::MatrixXd held;
    };
    Adjoints right_sides(const Eigen::VectorXd& x, const NodalLoads& load,
                         std::span<const FunctionalEntry> entries, int rows) const;
    // One solution for each column, also for bodies that are not held along all axes.
    Eigen::MatrixXd solve(const Eigen::VectorXd& x, const NodalLoads& load,
                          const Eigen::MatrixXd& right) const;

    Body body_;
    Surroundings surroundings_;
    double tolerance_;
    int thickness_axis_;
    std::vector<double> stiffness_, thickness_;  // those of problem_
    std::unique_ptr<StaticProblem> problem_;
};

// Design at a share of the way between two.
Design between(const Design& from, const Design& to, double share);

// The body with these factors on the moduli of its regions. Throws std::invalid_argument
// on another number of factors than regions, or on one that is not positive.
Body with_stiffness(const Body& body, std::span<const double> factor);

// The body with the distances of its nodes from its middle along an axis times these
// factors of its regions; a node between regions takes their mean. Throws as
// with_stiffness does.
Body with_thickness(const Body& body, int axis, std::span<const double> factor);

}  // namespace magfsi::structure
