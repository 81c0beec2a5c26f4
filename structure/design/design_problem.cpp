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
constexpr int most_iterations = 14;
constexpr double largest_part_moved = 0.3;
constexpr double largest_excess = 3;
constexpr double harmless_share = 0.01;

// True if a solution lies so near to the linear prediction that it is on its branch.
bool near_prediction(const Iterate& found, const Eigen::VectorXd& start, double side_m) {
    const double moved_m = (found.x - start).cwiseAbs().maxCoeff();
    return moved_m <= largest_excess * found.first_step_m + harmless_share * side_m;
}

Vec3 blend(const Vec3& a, const Vec3& b, double share) {
    return (1 - share) * a + share * b;
}

std::vector<Vec3> blend(const std::vector<Vec3>& a, const std::vector<Vec3>& b,
                        double share) {
    std::vector<Vec3> out(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3 from = i < a.size() ? a[i] : Vec3{}, to = i < b.size() ? b[i] : Vec3{};
        out[i] = blend(from, to, share);
    }
    return out;
}

StaticLoads blend(const StaticLoads& a, const StaticLoads& b, double share) {
    return {blend(a.field_t, b.field_t, share),
            blend(a.gravity_m_s2, b.gravity_m_s2, share),
            (1 - share) * a.gradient + share * b.gradient,
            (1 - share) * a.sources + share * b.sources,
            b.sources_s,
            blend(a.driven_m, b.driven_m, share)};
}

// Factors at a share of the way; none at all are ones.
std::vector<double> blend(const std::vector<double>& a, const std::vector<double>& b,
                          double share) {
    // Equal ones stay the same to the last digit, so that nothing is built anew for them.
    if (a == b) return a;
    std::vector<double> out(std::max(a.size(), b.size()));
    for (std::size_t r = 0; r < out.size(); ++r)
        out[r] = (1 - share) * (a.empty() ? 1 : a[r]) + share * (b.empty() ? 1 : b[r]);
    return out;
}

void stiffen(Material& material, double factor) {
    material.shear_modulus_pa *= factor;
    material.lame_lambda_pa *= factor;
}

void check_factors(const Body& body, std::span<const double> factor, const char* what) {
    const std::size_t regions = body.mesh.region_names.size();
    if (factor.size() != regions)
        refuse("body {}: {} factors of {} found for {} regions", body.name, factor.size(),
               what, regions);
    for (const double f : factor) {
        if (!(f > 0))
            refuse("body {}: the factor of {} {:g} found, it must be positive", body.name,
                   what, f);
    }
}

int shortest_axis(const Mesh& mesh) {
    const Vec3 side_m = bounds(mesh.nodes).extent_m();
    return static_cast<int>(std::ranges::min_element(side_m) - side_m.begin());
}

}  // namespace

Design between(const Design& from, const Design& to, double share) {
    return {blend(from.magnetization_a_m, to.magnetization_a_m, share),
            blend(from.loads, to.loads, share),
            blend(from.stiffness, to.stiffness, share),
            blend(from.thickness, to.thickness, share)};
}

Body with_stiffness(const Body& body, std::span<const double> factor) {
    if (factor.empty()) return body;
    check_factors(body, factor, "stiffness");
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
            stiffen(material, factor[region]);
            if (entry->second == 0)
                out.material = material;
            else
                out.other_materials.push_back(material);
        }
        out.element_material.push_back(entry->second);
    }
    return out;
}

Body with_thickness(const Body& body, int axis, std::span<const double> factor) {
    if (factor.empty()) return body;
    check_factors(body, factor, "thickness");
    Body out = body;
    std::vector<double> sum(body.mesh.nodes.size()), count(sum.size());
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        for (const int node : body.mesh.elements[e]) {
            sum[node] += factor[body.mesh.region[e]];
            count[node] += 1;
        }
    }
    const Bounds box = bounds(body.mesh.nodes);
    const std::size_t d = axis;
    const double middle_m = 0.5 * (box.low_m[d] + box.high_m[d]);
    for (std::size_t n = 0; n < sum.size(); ++n) {
        if (count[n] == 0) continue;
        double& x = out.mesh.nodes[n][d];
        x = middle_m + sum[n] / count[n] * (x - middle_m);
    }
    return out;
}

DesignProblem::DesignProblem(const Body& body, Surroundings surroundings,
                             double tolerance)
    : body_(body),
      surroundings_(std::move(surroundings)),
      tolerance_(tolerance),
      thickness_axis_(shortest_axis(body.mesh)) {
    body_.magnetization_a_m.resize(body_.mesh.elements.size());
    problem_ = std::make_unique<StaticProblem>(body_, surroundings_);
}

void DesignProblem::set(const Design& at) {
    if (at.stiffness != stiffness_ || at.thickness != thickness_) {
        problem_ = std::make_unique<StaticProblem>(shaped(at), surroundings_);
        stiffness_ = at.stiffness;
        thickness_ = at.thickness;
    }
    problem_->set_magnetization(at.magnetization_a_m);
}

Body DesignProblem::shaped(const Design& at) const {
    return with_thickness(with_stiffness(body_, at.stiffness), thickness_axis_,
                          at.thickness);
}

// The change of a node at rest is turned and stretched as its elements are on average.
Eigen::VectorXd DesignProblem::carried(const Eigen::VectorXd& x,
                                       const std::vector<double>& from,
                                       const std::vector<double>& to) const {
    if (from == to) return x;
    const Body before = with_thickness(body_, thickness_axis_, from);
    const Body after = with_thickness(body_, thickness_axis_, to);
    const auto nodes = static_cast<Eigen::Index>(before.mesh.nodes.size());
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, 3 * nodes);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(nodes);
    for (const Hexahedron& element : before.mesh.elements) {
        const Positions8 rest = gather(before.mesh.nodes, element);
        const HexahedronIntegrals integrals = integrate_hexahedron(rest, 0);
        Positions8 now;
        for (int a = 0; a < 8; ++a)
            now.row(a) = x.segment<3>(3 * static_cast<Eigen::Index>(element[a]));
        const Eigen::Matrix3d gradient =
            now.transpose() * integrals.gradient / integrals.volume;
        for (const int node : element) {
            sum.middleCols<3>(3 * static_cast<Eigen::Index>(node)) += gradient;
            count[node] += 1;
        }
    }
    Eigen::VectorXd out = x;
    for (Eigen::Index n = 0; n < nodes; ++n) {
        if (count[n] == 0) continue;
        const Vec3 change = after.mesh.nodes[n] - before.mesh.nodes[n];
        out.segment<3>(3 * n) += sum.middleCols<3>(3 * n) *
                                 Eigen::Map<const Eigen::Vector3d>(change.data()) /
                                 count[n];
    }
    const std::vector<HeldAxes> held = held_axes(body_);
    for (Eigen::Index q = 0; q < out.size(); ++q) {
        if (!held[q / 3][q % 3]) continue;
        const auto n = static_cast<std::size_t>(q / 3),
                   d = static_cast<std::size_t>(q % 3);
        out[q] = x[q] + after.mesh.nodes[n][d] - before.mesh.nodes[n][d];
    }
    return out;
}

bool DesignProblem::settle(Found& found, const NodalLoads& load) {
    // One more step squares the error of the tolerance; further ones only shuffle the
    // rounding.
    const Iterate closer =
        mixed_iteration(*problem_, found.x, load, {}, 1, problem_->longest_side_m());
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
                      problem_->load(blend(from.loads, to.loads, out.share)).driven_m;
        const Eigen::VectorXd start =
            carried(out.x, between(from, to, out.share).thickness, there.thickness);
        const Iterate found =
            mixed_iteration(*problem_, start, load, problem_->goal(tolerance_),
                            most_iterations, largest_part_moved * side_m, drive_m);
        Found next{found.x, ahead, out.iterations + found.iterations};
        const bool good = found.converged && near_prediction(found, start, side_m) &&
                          settle(next, load);
        out.iterations = next.iterations;
        if (good) {
            step = 1.5 * (ahead - out.share);
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
    Design from = to;
    from.loads.field_t = from.loads.gravity_m_s2 = {};
    from.loads.gradient = from.loads.sources = 0;
    std::ranges::fill(from.loads.driven_m, Vec3{});
    return move(flat_positions(shaped(to).mesh.nodes), from, to, 8);
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
