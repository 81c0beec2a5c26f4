#include "structure/equilibrium/static_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "structure/magnetics/magnetic_forces.h"
#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

const Body& with_elements(const Body& body) {
    if (!body.mesh.elements.empty()) return body;
    refuse("body {} has no elements, at least one is needed", body.name);
}

void refuse_to_fall(const Body& body, const HeldAxes& held, const Vec3& gravity_m_s2) {
    const bool massive = std::ranges::any_of(
        used_materials(body), [](const Material& m) { return m.density_kg_m3 != 0; });
    for (std::size_t d = 0; d < 3; ++d) {
        if (!massive || held[d] || gravity_m_s2[d] == 0) continue;
        refuse(
            "body {} has weight but no clamp or roller that holds it along {}: only the "
            "field may load a body along an axis on which it is free",
            body.name, "xyz"[d]);
    }
}

}  // namespace

Eigen::VectorXd flat_positions(const std::vector<Vec3>& nodes_m) {
    const auto size = static_cast<Eigen::Index>(3 * nodes_m.size());
    return Eigen::Map<const Eigen::VectorXd>(nodes_m.front().data(), size);
}

std::vector<Vec3> nodes_from(const Eigen::VectorXd& x) {
    std::vector<Vec3> out(static_cast<std::size_t>(x.size() / 3));
    std::copy_n(x.data(), x.size(), out.front().data());
    return out;
}

void require_held(const Body& body, const Vec3& gravity_m_s2) {
    const std::vector<HeldAxes> held = held_axes(body);
    const std::vector<int> part = connected_parts(body.mesh);
    std::vector<HeldAxes> along(1 + static_cast<std::size_t>(std::ranges::max(part)));
    HeldAxes anywhere{};
    for (std::size_t e = 0; e < part.size(); ++e) {
        for (const int node : body.mesh.elements[e]) {
            for (std::size_t d = 0; d < 3; ++d) {
                if (!held[static_cast<std::size_t>(node)][d]) continue;
                along[static_cast<std::size_t>(part[e])][d] = anywhere[d] = true;
            }
        }
    }
    const auto loose = std::ranges::find_if(along, [](const HeldAxes& a) {
        return a != HeldAxes{true, true, true};
    });
    if (along.size() > 1 && loose != along.end()) {
        const auto number = static_cast<int>(loose - along.begin());
        refuse(
            "body {} is in {} parts that share no node, and the part of element {} is "
            "not held along every axis: join the parts in the mesh, clamp each, or make "
            "each a body of its own",
            body.name, along.size(), std::ranges::find(part, number) - part.begin());
    }
    refuse_to_fall(body, anywhere, gravity_m_s2);
}

StaticProblem::StaticProblem(const Body& body)
    : StaticProblem(body, build_lattice(with_elements(body))) {
    require_held(body, {});
}

StaticProblem::StaticProblem(const Body& body, const Lattice& lattice)
    : body_(body),
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
    measure_stiffness();
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

Eigen::VectorXd StaticProblem::load(const StaticLoads& loads) const {
    refuse_to_fall(body_, held_along_, loads.gravity_m_s2);
    Eigen::VectorXd out(3 * static_cast<Eigen::Index>(charge_.size()));
    for (std::size_t n = 0; n < charge_.size(); ++n) {
        const double mass = node_mass_kg_[n];
        for (std::size_t d = 0; d < 3; ++d) {
            out[static_cast<Eigen::Index>(3 * n + d)] =
                charge_[n] * loads.field_t[d] + mass * loads.gravity_m_s2[d];
        }
    }
    return out;
}

StaticProblem::Response StaticProblem::response(const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& load) const {
    Response out;
    out.residual_n = load;
    const KernelResult result =
        kernel_.add_forces_and_energy(x.data(), out.residual_n.data());
    for (std::size_t n = 0; n < held_.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (held_[n][d]) out.residual_n[static_cast<Eigen::Index>(3 * n + d)] = 0;
        }
    }
    out.elastic_j = result.energy_j;
    out.smallest_j = result.smallest_j;
    out.element = result.element;
    return out;
}

double StaticProblem::rounding_n() const {
    // Positions are rounded to 1e-16 of the longest side, which strains an element of
    // edge l by 1e-16 L / l and gives forces of about (K + G) l^2 times that; a node has
    // eight elements, which sum up some ten of them.
    const double edge = std::cbrt(volume_m3_ / static_cast<double>(references_.size()));
    return 10 * 1e-16 * largest_modulus_pa_ * edge * longest_side_m_;
}

double StaticProblem::relative_residual(const Response& response,
                                        const Eigen::VectorXd& load) const {
    const double largest = load.cwiseAbs().maxCoeff();
    return response.residual_n.cwiseAbs().maxCoeff() /
           (largest > 0 ? largest : rounding_n());
}

double StaticProblem::allowed_residual_n(const Eigen::VectorXd& load,
                                         double tolerance) const {
    return std::max(tolerance * load.cwiseAbs().maxCoeff(), rounding_n());
}

double StaticProblem::rigid_foundation() const {
    return held_along_ == HeldAxes{true, true, true} ? 0 : 1e-3 * bending_scale_;
}

void StaticProblem::assemble(const Eigen::VectorXd& x) {
    matrix_.set_zero();
    for (std::size_t e = 0; e < references_.size(); ++e) {
        matrix_.add_element(
            e, element_tangent(references_[e], material(e), element_positions(e, x)));
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
