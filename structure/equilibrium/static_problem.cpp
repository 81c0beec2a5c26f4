#include "structure/equilibrium/static_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "structure/equilibrium/tangent.h"
#include "structure/lattice/lattice.h"
#include "structure/magnetics/nodal_charge.h"

namespace magfsi::structure {
namespace {

std::vector<int> three_times(std::vector<int> sizes) {
    for (int& size : sizes) size *= 3;
    return sizes;
}

std::string known_faces(const Mesh& mesh) {
    std::string out;
    for (const auto& [name, nodes] : mesh.faces) out += (out.empty() ? "" : ", ") + name;
    return out.empty() ? "none" : out;
}

// Without the rows and columns of held axes.
void add_free(Eigen::Ref<Eigen::Matrix3d, 0, Eigen::OuterStride<>> block,
              const Eigen::Matrix3d& tangent, const HeldAxes& row,
              const HeldAxes& column) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (row[i] || column[j]) continue;
            const auto p = static_cast<Eigen::Index>(i), q = static_cast<Eigen::Index>(j);
            block(p, q) += tangent(p, q);
        }
    }
}

}  // namespace

Eigen::VectorXd flat_positions(const std::vector<Vec3>& nodes_m) {
    Eigen::VectorXd out(3 * static_cast<Eigen::Index>(nodes_m.size()));
    for (std::size_t n = 0; n < nodes_m.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            out[static_cast<Eigen::Index>(3 * n + d)] = nodes_m[n][d];
        }
    }
    return out;
}

std::vector<Vec3> nodes_from(const Eigen::VectorXd& x) {
    std::vector<Vec3> out(static_cast<std::size_t>(x.size() / 3));
    for (std::size_t n = 0; n < out.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            out[n][d] = x[static_cast<Eigen::Index>(3 * n + d)];
        }
    }
    return out;
}

StaticProblem::StaticProblem(const Body& body)
    : body_(body),
      levels_(node_levels(body.mesh)),
      matrix_(three_times(levels_.size)),
      charge_(
          nodal_charges(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m)) {
    if (body.mesh.elements.empty()) {
        throw std::invalid_argument(
            fmt::format("body {} has no elements, at least one is needed", body.name));
    }
    const Lattice lattice = build_lattice(body);
    kernel_.assign(lattice);
    node_volume_m3_ = lattice.node_volume_m3;
    node_mass_kg_ = lattice.node_mass_kg;
    volume_m3_ = std::accumulate(node_volume_m3_.begin(), node_volume_m3_.end(), 0.0);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        references_.push_back(
            element_reference(gather(body.mesh.nodes, body.mesh.elements[e]),
                              body.element, static_cast<int>(e)));
    }
    hold_nodes();
    measure_sides();
    measure_stiffness();
}

void StaticProblem::hold_nodes() {
    for (const std::string& face : body_.clamps) {
        if (body_.mesh.faces.contains(face)) continue;
        throw std::invalid_argument(
            fmt::format("body {} is clamped at \"{}\", but its faces are {}", body_.name,
                        face, known_faces(body_.mesh)));
    }
    held_ = held_axes(body_);
    HeldAxes any{};
    for (const HeldAxes& node : held_) {
        for (std::size_t d = 0; d < 3; ++d) any[d] = any[d] || node[d];
    }
    free_ = any == HeldAxes{};
    if (free_ || any == HeldAxes{true, true, true}) return;
    throw std::invalid_argument(fmt::format(
        "body {} is held, but not along every axis: a static solution needs a "
        "clamp, or rollers along x, y and z, or a free body",
        body_.name));
}

void StaticProblem::measure_sides() {
    std::array<double, 3> side{};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto [low, high] = std::ranges::minmax(
            body_.mesh.nodes, {}, [d](const Vec3& node) { return node[d]; });
        side[d] = high[d] - low[d];
    }
    shortest_side_m_ = *std::ranges::min_element(side);
    longest_side_m_ = *std::ranges::max_element(side);
}

void StaticProblem::measure_stiffness() {
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
    Eigen::VectorXd out(3 * static_cast<Eigen::Index>(charge_.size()));
    for (std::size_t n = 0; n < charge_.size(); ++n) {
        const double mass = node_mass_kg_[n];
        for (std::size_t d = 0; d < 3; ++d) {
            out[static_cast<Eigen::Index>(3 * n + d)] =
                charge_[n] * loads.field_t[d] + mass * loads.gravity_m_s2[d];
        }
    }
    const bool weight =
        std::ranges::any_of(node_mass_kg_, [](double mass) { return mass != 0; }) &&
        std::ranges::any_of(loads.gravity_m_s2, [](double g) { return g != 0; });
    if (free_ && weight) {
        throw std::invalid_argument(fmt::format(
            "body {} has weight but no clamp: only the field may load a free body in a "
            "static solution",
            body_.name));
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

double StaticProblem::relative_residual(const Response& response,
                                        const Eigen::VectorXd& load) const {
    // Positions are rounded to 1e-16 of the longest side, which strains an element of
    // edge l by 1e-16 L / l and gives forces of about (K + G) l^2 times that.
    const double edge = std::cbrt(volume_m3_ / static_cast<double>(references_.size()));
    const double rounding = 1e-16 * largest_modulus_pa_ * edge * longest_side_m_;
    const double scale = std::max(load.cwiseAbs().maxCoeff(), 1e10 * rounding);
    return response.residual_n.cwiseAbs().maxCoeff() / scale;
}

void StaticProblem::add_element(std::size_t element, const Matrix24& tangent) {
    const Hexahedron& nodes = body_.mesh.elements[element];
    for (int a = 0; a < 8; ++a) {
        const int level = levels_.level[nodes[a]];
        for (int b = 0; b < 8; ++b) {
            const int step = level - levels_.level[nodes[b]];
            if (step < 0 || step > 1) continue;
            Eigen::MatrixXd& block =
                step == 0 ? matrix_.diagonal(level) : matrix_.below(level);
            add_free(block.block<3, 3>(row(nodes[a]), row(nodes[b])),
                     tangent.block<3, 3>(3 * a, 3 * b), held_[nodes[a]], held_[nodes[b]]);
        }
    }
}

void StaticProblem::finish_matrix(double foundation) {
    for (int node = 0; node < static_cast<int>(held_.size()); ++node) {
        if (levels_.level[node] < 0) continue;
        auto block =
            matrix_.diagonal(levels_.level[node]).block<3, 3>(row(node), row(node));
        for (int d = 0; d < 3; ++d)
            block(d, d) += held_[node][d] ? 1 : foundation * node_volume_m3_[node];
    }
}

void StaticProblem::assemble(const Eigen::VectorXd& x, double foundation) {
    matrix_.set_zero();
    for (std::size_t e = 0; e < references_.size(); ++e) {
        add_element(
            e, element_tangent(references_[e], material(e), element_positions(e, x)));
    }
    finish_matrix(foundation);
}

Eigen::VectorXd StaticProblem::solve(const Eigen::VectorXd& right_side) const {
    Eigen::VectorXd ordered = Eigen::VectorXd::Zero(matrix_.size());
    const auto place = [this](int node) {
        return matrix_.offset(levels_.level[node]) + row(node);
    };
    const int nodes = static_cast<int>(held_.size());
    for (int node = 0; node < nodes; ++node) {
        if (levels_.level[node] < 0) continue;
        for (int d = 0; d < 3; ++d)
            ordered[place(node) + d] = held_[node][d] ? 0 : right_side[3 * node + d];
    }
    matrix_.solve_in_place(ordered);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(right_side.size());
    for (int node = 0; node < nodes; ++node) {
        if (levels_.level[node] < 0) continue;
        for (int d = 0; d < 3; ++d) {
            if (!held_[node][d]) out[3 * node + d] = ordered[place(node) + d];
        }
    }
    return out;
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
