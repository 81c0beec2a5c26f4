// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/equilibrium/static_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "structure/magnetics/magnetization.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

const Body& with_elements(const Body& body) {
    if (!body.mesh.elements.empty()) return body;
    refuse("body {} has no elements, at least one is needed", body.name);
}

}  // namespace

Eigen::VectorXd flat_positions(const std::vector<Vec3>& nodes_m) {
    const Eigen::Index size = 3 * nodes_m.size();
    return Eigen::Map<const Eigen::VectorXd>(nodes_m.front().data(), size);
}

std::vector<Vec3> nodes_from(const Eigen::VectorXd& x) {
    std::vector<Vec3> out(static_cast<std::size_t>(x.size() / 3));
    std::copy_n(x.data(), x.size(), out.front().data());
    return out;
}

bool NodalLoads::none() const {
    return dead_n.isZero(0) && gradient == 0 && sources == 0 && driven_m.isZero(0) &&
           turning_t.isZero(0);
}

NodalLoads between(const NodalLoads& from, const NodalLoads& to, double share) {
    return {(1 - share) * from.dead_n + share * to.dead_n,
            (1 - share) * from.gradient + share * to.gradient,
            (1 - share) * from.sources + share * to.sources,
            (1 - share) * from.sources_s + share * to.sources_s,
            (1 - share) * from.driven_m + share * to.driven_m,
            (1 - share) * from.turning_t + share * to.turning_t};
}

StaticProblem::StaticProblem(const Body& body, Surroundings surroundings)
    : StaticProblem(body, build_lattice(with_elements(body)), std::move(surroundings)) {
    require_held(body, {}, surroundings_);
}

StaticProblem::StaticProblem(const Body& body, const Lattice& lattice,
                             Surroundings surroundings)
    : body_(body),
      surroundings_(std::move(surroundings)),
      platform_normal_(normal_of(surroundings_.platform)),
      node_volume_m3_(lattice.node_volume_m3),
      node_mass_kg_(lattice.node_mass_kg),
      charge_(nodal_charges(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m)),
      held_(held_axes(body)),
      matrix_(body_.mesh, held_, node_volume_m3_),
      volume_m3_(std::accumulate(node_volume_m3_.begin(), node_volume_m3_.end(), 0.0)) {
    kernel_.assign(lattice);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        references_.push_back(
            element_reference(gather(body.mesh.nodes, body.mesh.elements[e]),
                              body.element, static_cast<int>(e)));
    }
    for (const HeldAxes& node : held_) {
        for (std::size_t d = 0; d < 3; ++d) {
            held_along_[d] = held_along_[d] || node[d];
        }
    }
    magnetize_surroundings();
    if (surroundings_.platform)
        surface_m2_ = surface_areas(body_.mesh.nodes, body_.mesh.elements);
    measure_stiffness();
}

void StaticProblem::magnetize_surroundings() {
    if (surroundings_.gradient) {
        gradient_elements_ = gradient_elements(body_.mesh.nodes, body_.mesh.elements,
                                               body_.magnetization_a_m);
    }
    if (surroundings_.sources && !body_.magnetization_a_m.empty()) {
        moments_ = moment_elements(body_.mesh.nodes, body_.mesh.elements,
                                   body_.magnetization_a_m);
    }
    if (is_turned(body_)) {
        turned_ = turned_elements(body_.mesh.nodes, body_.mesh.elements,
                                  body_.magnetization_a_m);
    }
}

void StaticProblem::set_magnetization(const std::vector<Vec3>& magnetization_a_m) {
    const auto& elements = body_.mesh.elements;
    if (magnetization_a_m.size() != elements.size())
        refuse("body {}: {} magnetisation vectors found for {} elements", body_.name,
               magnetization_a_m.size(), elements.size());
    body_.magnetization_a_m = magnetization_a_m;
    std::ranges::fill(charge_, 0.0);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Eigen::Vector3d m(magnetization_a_m[e].data());
        const Eigen::Matrix<double, 8, 1> part = references_[e].gradient * m;
        for (int a = 0; a < 8; ++a) charge_[elements[e][a]] += part[a];
    }
    magnetize_surroundings();
}

void StaticProblem::measure_stiffness() {
    const Vec3 side_m = bounds(body_.mesh.nodes).extent_m();
    shortest_side_m_ = std::ranges::min(side_m);
    longest_side_m_ = std::ranges::max(side_m);
    double softest = INFINITY;
    for (const Material& material : used_materials(body_)) {
        const double g = material.shear_modulus_pa;
        softest = std::min(softest, g);
        largest_shear_modulus_pa_ = std::max(largest_shear_modulus_pa_, g);
        largest_modulus_pa_ = std::max(largest_modulus_pa_, material.lame_lambda_pa + g);
    }
    bending_scale_ =
        softest * shortest_side_m_ * shortest_side_m_ / std::pow(longest_side_m_, 4);
}

NodalLoads StaticProblem::load(const StaticLoads& loads) const {
    refuse_to_fall(body_, held_along_, loads.gravity_m_s2, platform_normal_);
    const auto size = 3 * static_cast<Eigen::Index>(charge_.size());
    NodalLoads out{Eigen::VectorXd(size), surroundings_.gradient ? loads.gradient : 0,
                   moments_.empty() ? 0 : loads.sources, loads.sources_s,
                   Eigen::VectorXd::Zero(surroundings_.driven.empty() ? 0 : size)};
    const double of_charges = turned_.empty() ? 1 : 0;
    for (std::size_t n = 0; n < charge_.size(); ++n) {
        const double mass = node_mass_kg_[n];
        for (std::size_t d = 0; d < 3; ++d) {
            out.dead_n[3 * n + d] =
                of_charges * charge_[n] * loads.field_t[d] + mass * loads.gravity_m_s2[d];
        }
    }
    if (!turned_.empty()) out.turning_t = Eigen::Vector3d(loads.field_t.data());
    for (std::size_t g = 0; g < loads.driven_m.size(); ++g) {
        for (const int node : surroundings_.driven[g])
            out.driven_m.segment<3>(3 * node) =
                Eigen::Map<const Eigen::Vector3d>(loads.driven_m[g].data());
    }
    return out;
}

KernelResult StaticProblem::add_internal(const Eigen::VectorXd& x,
                                         Eigen::VectorXd& force_n) const {
    return kernel_.add_forces_and_energy(x.data(), force_n.data());
}

double StaticProblem::add_gradient(const Eigen::VectorXd& x, double share,
                                   Eigen::VectorXd& force_n) const {
    if (share == 0) return 0;
    Eigen::VectorXd whole_n = Eigen::VectorXd::Zero(x.size());
    const double energy_j =
        add_gradient_forces(gradient_elements_, body_.mesh.elements,
                            *surroundings_.gradient, x.data(), whole_n.data());
    force_n += share * whole_n;
    return share * energy_j;
}

std::vector<FieldSample> StaticProblem::samples(const Eigen::VectorXd& x,
                                                double time_s) const {
    surroundings_.sources->set_time(time_s);
    std::vector<FieldSample> out;
    for (Eigen::Index n = 0; n < x.size(); n += 3)
        out.push_back(surroundings_.sources->sample({x[n], x[n + 1], x[n + 2]}));
    return out;
}

double StaticProblem::add_sources(const Eigen::VectorXd& x, const NodalLoads& loads,
                                  Eigen::VectorXd& force_n) const {
    if (loads.sources == 0) return 0;
    Eigen::VectorXd whole_n = Eigen::VectorXd::Zero(x.size());
    const double energy_j =
        add_source_forces(moments_, body_.mesh.elements, samples(x, loads.sources_s),
                          x.data(), whole_n.data());
    force_n += loads.sources * whole_n;
    return loads.sources * energy_j;
}

double StaticProblem::add_turning(const Eigen::VectorXd& x, const NodalLoads& loads,
                                  Eigen::VectorXd& force_n) const {
    if (loads.turning_t.isZero(0)) return 0;
    return -loads.turning_t.dot(add_turned_forces(
        turned_, body_.mesh.elements, loads.turning_t, x.data(), force_n.data()));
}

double StaticProblem::field_j(const Eigen::VectorXd& x, const Vec3& field_t) const {
    const NodalLoads loads = load({field_t, {}});
    Eigen::VectorXd dropped_n = Eigen::VectorXd::Zero(x.size());
    return add_turning(x, loads, dropped_n) - loads.dead_n.dot(x);
}

double StaticProblem::depth_m(const Eigen::VectorXd& x, Eigen::Index node) const {
    const Eigen::Map<const Eigen::Vector3d> point(surroundings_.platform->point_m.data());
    return platform_normal_.dot(point - x.segment<3>(3 * node));
}

double StaticProblem::add_platform(const Eigen::VectorXd& x,
                                   Eigen::VectorXd& force_n) const {
    double energy_j = 0;
    for (std::size_t n = 0; n < surface_m2_.size(); ++n) {
        const Eigen::Index node = n;
        const double depth = depth_m(x, node);
        if (surface_m2_[n] == 0 || depth <= 0) continue;
        const double spring = surroundings_.platform->stiffness_pa_m * surface_m2_[n];
        energy_j += 0.5 * spring * depth * depth;
        force_n.segment<3>(3 * node) += spring * depth * platform_normal_;
    }
    return energy_j;
}

Eigen::VectorXd StaticProblem::surrounding_n(const Eigen::VectorXd& x,
                                             const NodalLoads& loads) const {
    Eigen::VectorXd out = loads.dead_n;
    add_gradient(x, loads.gradient, out);
    add_sources(x, loads, out);
    add_turning(x, loads, out);
    add_platform(x, out);
    return out;
}

StaticProblem::Response StaticProblem::response(const Eigen::VectorXd& x,
                                                const NodalLoads& loads) const {
    Response out;
    out.residual_n = loads.dead_n;
    out.total_j = -loads.dead_n.dot(x);
    out.total_j += add_gradient(x, loads.gradient, out.residual_n);
    out.total_j += add_sources(x, loads, out.residual_n);
    out.total_j += add_turning(x, loads, out.residual_n);
    out.load_n = out.residual_n.cwiseAbs().maxCoeff();
    const KernelResult result = add_internal(x, out.residual_n);
    out.total_j += add_platform(x, out.residual_n) + result.energy_j;
    for (const std::vector<int>& group : surroundings_.driven) {
        for (const int node : group)
            out.load_n = std::max(
                out.load_n, out.residual_n.segment<3>(3 * node).cwiseAbs().maxCoeff());
    }
    for (std::size_t n = 0; n < held_.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (held_[n][d]) out.residual_n[3 * n + d] = 0;
        }
    }
    out.elastic_j = result.energy_j;
    out.smallest_j = result.smallest_j;
    out.element = result.element;
    out.largest_share = result.largest_share;
    out.tight_element = result.tight_element;
    return out;
}

Eigen::VectorXd StaticProblem::support_n(const Eigen::VectorXd& x,
                                         const NodalLoads& loads) const {
    Eigen::VectorXd out = surrounding_n(x, loads);
    add_internal(x, out);
    for (std::size_t n = 0; n < held_.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            double& force = out[3 * n + d];
            force = held_[n][d] ? -force : 0;
        }
    }
    return out;
}

double StaticProblem::rounding_n() const {
    // Positions are rounded to 1e-16 of the longest side, which strains an element of
    // edge l by 1e-16 L / l and gives forces of about (K + G) l^2 times that; a node has
    // eight elements, which sum up some ten of them.
    const double edge = std::cbrt(volume_m3_ / static_cast<double>(references_.size()));
    return 10 * 1e-16 * largest_modulus_pa_ * edge * longest_side_m_;
}

double StaticProblem::relative_residual(const Response& response) const {
    return response.residual_n.cwiseAbs().maxCoeff() /
           (response.load_n > 0 ? response.load_n : rounding_n());
}

bool StaticProblem::reached(const Goal& goal, const Response& response) {
    return response.residual_n.cwiseAbs().maxCoeff() <=
           std::max(goal.tolerance * response.load_n, goal.least_n);
}

double StaticProblem::rigid_foundation() const {
    return held_along_ == HeldAxes{true, true, true} ? 0 : 1e-3 * bending_scale_;
}

void StaticProblem::assemble(const Eigen::VectorXd& x, const NodalLoads& loads) {
    matrix_.set_zero();
    for (std::size_t e = 0; e < references_.size(); ++e) {
        matrix_.add_element(
            e, element_tangent(references_[e], material(e), element_positions(e, x)));
    }
    add_surroundings(x, loads);
}

Matrix24 StaticProblem::field_tangent(std::size_t element, const Eigen::VectorXd& x,
                                      const NodalLoads& loads,
                                      std::span<const FieldSample> at) const {
    Matrix24 out = Matrix24::Zero();
    if (loads.gradient != 0) {
        const Matrix8& coupling = gradient_elements_[element].coupling;
        for (int a = 0; a < 8; ++a) {
            for (int b = 0; b < 8; ++b)
                out.block<3, 3>(3 * a, 3 * b) = -loads.gradient * coupling(a, b) *
                                                surroundings_.gradient->tesla_per_m();
        }
    }
    if (loads.sources != 0)
        out += loads.sources * source_tangent(moments_[element],
                                              body_.mesh.elements[element], at,
                                              *surroundings_.sources, x.data());
    return out;
}

// The platform's stiffness is that of the nodes in touch at x.
void StaticProblem::add_surroundings(const Eigen::VectorXd& x, const NodalLoads& loads) {
    if (loads.gradient != 0 || loads.sources != 0) {
        std::vector<FieldSample> at;
        if (loads.sources != 0) at = samples(x, loads.sources_s);
        for (std::size_t e = 0; e < references_.size(); ++e)
            matrix_.add_element(e, field_tangent(e, x, loads, at));
    }
    for (std::size_t e = 0; !loads.turning_t.isZero(0) && e < turned_.size(); ++e) {
        matrix_.add_element(
            e, turned_tangent(turned_[e], loads.turning_t, element_positions(e, x)));
    }
    for (std::size_t n = 0; n < surface_m2_.size(); ++n) {
        if (surface_m2_[n] == 0 || depth_m(x, static_cast<Eigen::Index>(n)) <= 0)
            continue;
        const double spring = surroundings_.platform->stiffness_pa_m * surface_m2_[n];
        matrix_.add_node(n, spring * platform_normal_ * platform_normal_.transpose());
    }
}

Positions8 StaticProblem::element_positions(std::size_t element,
                                            const Eigen::VectorXd& x) const {
    Positions8 out;
    const Hexahedron& nodes = body_.mesh.elements[element];
    for (int a = 0; a < 8; ++a) out.row(a) = x.segment<3>(3 * nodes[a]).transpose();
    out.rowwise() -= out.colwise().mean().eval();
    return out;
}

}  // namespace magfsi::structure
