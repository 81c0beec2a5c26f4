// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/equilibrium/stiffness_matrix.h"

#include <fmt/format.h>
#include <omp.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <stdexcept>

namespace magfsi::structure {
namespace {

// For each node itself and those nodes of its elements that have larger numbers,
// ascending.
std::vector<std::vector<int>> later_neighbours(const Mesh& mesh) {
    std::vector<std::vector<int>> out(mesh.nodes.size());
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = {static_cast<int>(n)};
    for (const Hexahedron& element : mesh.elements) {
        for (int a : element) {
            for (int b : element) {
                if (a > b) out[b].push_back(a);
            }
        }
    }
    for (std::vector<int>& nodes : out) {
        std::ranges::sort(nodes);
        nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    }
    return out;
}

// Keeps CHOLMOD to one thread. It asks for four, whatever OMP_NUM_THREADS says, and they
// take longer than one on these matrices.
class OneThread {
  public:
    OneThread() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
    ~OneThread() { omp_set_max_active_levels(levels_); }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

  private:
    int levels_;
};

}  // namespace

StiffnessMatrix::StiffnessMatrix(const Mesh& mesh, std::span<const HeldAxes> held,
                                 std::span<const double> node_volumes_m3)
    : elements_(mesh.elements), held_(held.begin(), held.end()) {
    for (std::size_t n = 0; n < held_.size(); ++n) {
        // Node without elements
        if (node_volumes_m3[n] == 0) held_[n] = {true, true, true};
        for (bool is_held : held_[n]) {
            volume_m3_.push_back(is_held ? 0 : node_volumes_m3[n]);
        }
    }
    const auto neighbours = later_neighbours(mesh);
    allocate(neighbours);
    index_elements(mesh, neighbours);
    set_zero();
    factor_.cholmod().print = 0;
    const OneThread one_thread;
    factor_.analyzePattern(matrix_);
    throw_if_out_of_memory();
}

// Columns come in threes, one for each coordinate of a node. The diagonal block holds its
// lower triangle only, which is why it has 3 entries less.
void StiffnessMatrix::allocate(const std::vector<std::vector<int>>& neighbours) {
    const Eigen::Index size = volume_m3_.size();
    Eigen::Index entries = 0;
    for (const auto& nodes : neighbours) {
        entries += 9 * static_cast<Eigen::Index>(nodes.size()) - 3;
    }
    matrix_.resize(size, size);
    matrix_.resizeNonZeros(entries);
    int* column = matrix_.outerIndexPtr();
    int* row = matrix_.innerIndexPtr();
    *column = 0;
    for (const auto& nodes : neighbours) {
        for (int d = 0; d < 3; ++d, ++column) {
            for (int node : nodes) {
                for (int e = node == nodes.front() ? d : 0; e < 3; ++e) {
                    *row++ = 3 * node + e;
                }
            }
            column[1] = row - matrix_.innerIndexPtr();
        }
    }
}

void StiffnessMatrix::index_elements(const Mesh& mesh,
                                     const std::vector<std::vector<int>>& neighbours) {
    for (const Hexahedron& nodes : mesh.elements) {
        auto& rank = rank_.emplace_back();
        for (int a = 0; a < 8; ++a) {
            for (int b = 0; b < 8; ++b) {
                const auto& later = neighbours[nodes[b]];
                rank[8 * a + b] =
                    std::ranges::lower_bound(later, nodes[a]) - later.begin();
            }
        }
    }
}

void StiffnessMatrix::set_zero() {
    matrix_.coeffs().setZero();
    foundation_ = 0;
    for (std::size_t q = 0; q < volume_m3_.size(); ++q) {
        if (held_[q / 3][q % 3]) matrix_.valuePtr()[matrix_.outerIndexPtr()[q]] = 1;
    }
}

void StiffnessMatrix::add_element(std::size_t element, const Matrix24& tangent) {
    const Hexahedron& nodes = elements_[element];
    for (int b = 0; b < 8; ++b) {
        for (int d = 0; d < 3; ++d) {
            if (held_[nodes[b]][d]) continue;
            // The column starts at the diagonal: d rows of the node's block are above it.
            double* column =
                matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * nodes[b] + d] - d;
            for (int a = 0; a < 8; ++a) {
                if (nodes[a] < nodes[b]) continue;
                double* rows = column + 3 * rank_[element][8 * a + b];
                for (int e = a == b ? d : 0; e < 3; ++e) {
                    if (!held_[nodes[a]][e]) rows[e] += tangent(3 * a + e, 3 * b + d);
                }
            }
        }
    }
}

void StiffnessMatrix::add_node(std::size_t node, const Eigen::Matrix3d& tangent) {
    for (int d = 0; d < 3; ++d) {
        double* column = matrix_.valuePtr() +
                         matrix_.outerIndexPtr()[3 * static_cast<int>(node) + d] - d;
        for (int e = d; e < 3; ++e) {
            if (!held_[node][d] && !held_[node][e]) column[e] += tangent(e, d);
        }
    }
}

void StiffnessMatrix::raise_foundation(double foundation) {
    for (std::size_t q = 0; q < volume_m3_.size(); ++q) {
        matrix_.valuePtr()[matrix_.outerIndexPtr()[q]] +=
            (foundation - foundation_) * volume_m3_[q];
    }
    foundation_ = foundation;
}

void StiffnessMatrix::throw_if_out_of_memory() {
    if (factor_.cholmod().status >= CHOLMOD_OK) return;
    throw std::runtime_error(
        fmt::format("not enough memory to factorise the stiffness matrix of {} unknowns; "
                    "take fewer elements, or a machine with more memory",
                    volume_m3_.size()));
}

bool StiffnessMatrix::factorize() {
    const OneThread one_thread;
    factor_.factorize(matrix_);
    throw_if_out_of_memory();
    return factor_.info() == Eigen::Success;
}

Eigen::VectorXd StiffnessMatrix::solve(Eigen::VectorXd right_side) const {
    for (Eigen::Index q = 0; q < right_side.size(); ++q) {
        if (held_[q / 3][q % 3]) right_side[q] = 0;
    }
    const OneThread one_thread;
    return factor_.solve(right_side);
}

Eigen::MatrixXd StiffnessMatrix::solve_all(Eigen::MatrixXd right_sides) const {
    for (Eigen::Index q = 0; q < right_sides.rows(); ++q) {
        if (held_[q / 3][q % 3]) right_sides.row(q).setZero();
    }
    const OneThread one_thread;
    return factor_.solve(right_sides);
}

int StiffnessMatrix::negative_eigenvalues() {
    if (factorize()) return 0;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor;
    factor.analyzePattern(matrix_);
    // A pivot of exactly zero stops the factorisation: the shift, smaller than rounding,
    // moves it away from zero.
    double shift = 0;
    for (factor.factorize(matrix_); factor.info() != Eigen::Success;
         factor.factorize(matrix_)) {
        shift = std::max(2 * shift, 1e-16 * matrix_.coeffs().cwiseAbs().maxCoeff());
        factor.setShift(shift);
    }
    return (factor.vectorD().array() < 0).count();
}

}  // namespace magfsi::structure
