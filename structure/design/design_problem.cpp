// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/design/design_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Limits of one part of a move: iterations of the mixed method, the largest move of a
// node as a share of the body's longest side, and by how much it may exceed the linear
// prediction before it counts as a jump to another branch.
constexpr int max_iterations = 14;
constexpr double largest_share_moved = 0.3;
constexpr double largest_excess = 3;
constexpr double harmless_share = 0.01;

// True if a solution lies so near to the linear prediction that it is on its branch.
bool near_prediction(const Iterate& found, const Eigen::VectorXd& start, double side_m) {
    const double moved_m = (found.x - start).cwiseAbs().maxCoeff();
    return moved_m <= largest_excess * found.first_step_m + harmless_share * side_m;
}

Vec3 mixed(const Vec3& a, const Vec3& b, double share) {
    return (1 - share) * a + share * b;
}

std::vector<Vec3> mixed(const std::vector<Vec3>& a, const std::vector<Vec3>& b,
                        double share) {
    std::vector<Vec3> out(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3 from = i < a.size() ? a[i] : Vec3{}, to = i < b.size() ? b[i] : Vec3{};
        out[i] = mixed(from, to, share);
    }
    return out;
}

StaticLoads mixed(const StaticLoads& a, const StaticLoads& b, double share) {
    return {mixed(a.field_t, b.field_t, share),
            mixed(a.gravity_m_s2, b.gravity_m_s2, share),
            (1 - share) * a.gradient + share * b.gradient,
            (1 - share) * a.sources + share * b.sources,
            b.sources_s,
            mixed(a.driven_m, b.driven_m, share)};
}

void scale(Material& material, double factor) {
    material.shear_modulus_pa *= factor;
    material.lame_lambda_pa *= factor;
}

}  // namespace

Design between(const Design& from, const Design& to, double share) {
    Design out{mixed(from.magnetization_a_m, to.magnetization_a_m, share),
               mixed(from.loads, to.loads, share),
               {}};
    const std::size_t regions = std::max(from.stiffness.size(), to.stiffness.size());
    for (std::size_t r = 0; r < regions; ++r) {
        const double a = from.stiffness.empty() ? 1 : from.stiffness[r];
        const double b = to.stiffness.empty() ? 1 : to.stiffness[r];
        out.stiffness.push_back((1 - share) * a + share * b);
    }
    return out;
}

Body with_stiffness(const Body& body, std::span<const double> factor) {
    if (factor.empty()) return body;
    const std::size_t regions = body.mesh.region_names.size();
    if (factor.size() != regions)
        refuse("body {}: {} factors of stiffness found for {} regions", body.name,
               factor.size(), regions);
    for (const double f : factor) {
        if (!(f > 0))
            refuse("body {}: the factor of stiffness {:g} found, it must be positive",
                   body.name, f);
    }
    Body out = body;
    out.other_materials.clear();
    out.element_material.clear();
    std::map<std::pair<int, int>, int> number;  // of material and region
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const int old = body.element_material.empty() ? 0 : body.element_material[e];
        const int region = body.mesh.region[e];
        const auto [entry, is_new] =
            number.try_emplace({old, region}, static_cast<int>(number.size()));
        if (is_new) {
            Material material = material_of(body, e);
            scale(material, factor[region]);
            if (entry->second == 0)
                out.material = material;
            else
                out.other_materials.push_back(material);
        }
        out.element_material.push_back(entry->second);
    }
    return out;
}

DesignProblem::DesignProblem(const Body& body, Surroundings surroundings,
                             double tolerance)
    : body_(body), surroundings_(std::move(surroundings)), tolerance_(tolerance) {
    body_.magnetization_a_m.resize(body_.mesh.elements.size());
    problem_ = std::make_unique<StaticProblem>(body_, surroundings_);
}

void DesignProblem::set(const Design& at) {
    if (at.stiffness != stiffness_) {
        problem_ = std::make_unique<StaticProblem>(with_stiffness(body_, at.stiffness),
                                                   surroundings_);
        stiffness_ = at.stiffness;
    }
    problem_->set_magnetization(at.magnetization_a_m);
}

bool DesignProblem::settle(Found& found, const NodalLoads& load) {
    // One more step squares the error of the tolerance; further ones only shuffle the
    // rounding.
    const Iterate closer = mixed_iteration(*problem_, found.x, load, {}, 1,
                                           problem_->longest_side_m());
    found.iterations += closer.iterations;
    const double before = problem_->response(found.x, load).residual_n.norm();
    if (closer.response.smallest_j > 0 && closer.response.residual_n.norm() < before)
        found.x = closer.x;
    problem_->assemble(found.x, load);
    problem_->matrix().raise_foundation(problem_->rigid_foundation());
    ++found.iterations;
    return problem_->matrix().factorize();
}

DesignProblem::Found DesignProblem::move(const Eigen::VectorXd& x, const Design& from,
                                         const Design& to, int halvings) {
    Found out{x, 0, 0};
    const double side_m = problem_->longest_side_m();
    const double smallest = std::ldexp(1.0, -halvings);
    double step = 1;
    while (out.share < 1) {
        const double ahead = std::min(out.share + step, 1.0);
        const Design there = between(from, to, ahead);
        set(there);
        const NodalLoads load = problem_->load(there.loads);
        Eigen::VectorXd drive_m;
        if (load.driven_m.size() > 0)
            drive_m = load.driven_m -
                      problem_->load(mixed(from.loads, to.loads, out.share)).driven_m;
        const Iterate found =
            mixed_iteration(*problem_, out.x, load, problem_->goal(tolerance_),
                            max_iterations, largest_share_moved * side_m, drive_m);
        Found next{found.x, ahead, out.iterations + found.iterations};
        const bool good = found.converged && near_prediction(found, out.x, side_m) &&
                          settle(next, load);
        out.iterations = next.iterations;
        if (good) {
            out = std::move(next);
        } else if (step > smallest) {
            step = std::max(0.5 * (ahead - out.share), smallest);
        } else {
            break;
        }
    }
    return out;
}

DesignProblem::Found DesignProblem::rise(const Design& to) {
    Design from{to.magnetization_a_m, {}, to.stiffness};
    from.loads.sources_s = to.loads.sources_s;
    from.loads.driven_m.resize(to.loads.driven_m.size());
    return move(flat_positions(body_.mesh.nodes), from, to, 8);
}

DesignProblem::Found DesignProblem::release(const Eigen::VectorXd& x, const Design& at) {
    set(at);
    const NodalLoads load = problem_->load(at.loads);
    const Iterate found =
        energy_descent(*problem_, x, load, problem_->goal(tolerance_), 400);
    Found out{found.x, 0, found.iterations};
    if (found.converged && settle(out, load)) out.share = 1;
    return out;
}

Eigen::VectorXd DesignProblem::support_n(const Eigen::VectorXd& x, const Design& at) {
    set(at);
    return problem_->support_n(x, problem_->load(at.loads));
}

}  // namespace magfsi::structure
