#include "structure/equilibrium/block_tridiagonal.h"

#include <algorithm>

#include "isa/instruction_set.h"
#include "structure/equilibrium/dense_update.h"

namespace magfsi::structure {
namespace {

using Eigen::MatrixXd;

// Columns that are factorised at once; the rest of the work is matrix products.
constexpr int panel = 48;

DenseUpdateFunction update_function() {
    switch (choose_instruction_set()) {
        case InstructionSet::avx512:
            return &avx512::subtract_product;
        case InstructionSet::avx2:
            return &avx2::subtract_product;
        case InstructionSet::sse2:
            return &sse2::subtract_product;
    }
    return &sse2::subtract_product;
}

// c(row:, column : column + columns) -= a(row:, : depth) b(column..., : depth)^T.
void update(MatrixXd& c, const MatrixXd& a, const MatrixXd& b, int row, int column,
            int columns, int depth) {
    static const DenseUpdateFunction subtract = update_function();
    if (columns == 0 || depth == 0 || row >= c.rows()) return;
    subtract({&c(row, column), &a(row, 0), &b(column, 0),
              static_cast<int>(c.rows()) - row, columns, depth, c.outerStride(),
              a.outerStride(), b.outerStride()});
}

// below := below * L^-T of the factorised block before it, panel by panel.
void eliminate(const MatrixXd& factor, MatrixXd& below) {
    const int size = static_cast<int>(factor.rows());
    for (int at = 0; at < size; at += panel) {
        const int columns = std::min(panel, size - at);
        update(below, below, factor, 0, at, columns, at);
        auto part = below.middleCols(at, columns);
        factor.block(at, at, columns, columns)
            .triangularView<Eigen::Lower>()
            .transpose()
            .solveInPlace<Eigen::OnTheRight>(part);
    }
}

// The lower triangle of block -= below below^T.
void subtract_square(const MatrixXd& below, MatrixXd& block) {
    const int size = static_cast<int>(block.rows());
    for (int at = 0; at < size; at += panel) {
        update(block, below, below, at, at, std::min(panel, size - at),
               static_cast<int>(below.cols()));
    }
}

bool cholesky(MatrixXd& block) {
    const int size = static_cast<int>(block.rows());
    for (int at = 0; at < size; at += panel) {
        const int columns = std::min(panel, size - at);
        update(block, block, block, at, at, columns, at);
        auto corner = block.block(at, at, columns, columns);
        if (Eigen::LLT<Eigen::Ref<MatrixXd>>(corner).info() != Eigen::Success) {
            return false;
        }
        auto rest = block.block(at + columns, at, size - at - columns, columns);
        corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
            rest);
    }
    return true;
}

}  // namespace

BlockTridiagonal::BlockTridiagonal(const std::vector<int>& block_sizes) {
    offset_.push_back(0);
    int before = 0;
    for (int size : block_sizes) {
        diagonal_.emplace_back(size, size);
        below_.emplace_back(size, before);
        offset_.push_back(offset_.back() + size);
        before = size;
    }
}

void BlockTridiagonal::set_zero() {
    for (Eigen::MatrixXd& block : diagonal_) block.setZero();
    for (Eigen::MatrixXd& block : below_) block.setZero();
}

bool BlockTridiagonal::factorize() {
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        if (i > 0) {
            eliminate(diagonal_[i - 1], below_[i]);
            subtract_square(below_[i], diagonal_[i]);
        }
        if (!cholesky(diagonal_[i])) return false;
    }
    return true;
}

void BlockTridiagonal::solve_in_place(Eigen::VectorXd& b) const {
    const int blocks = static_cast<int>(diagonal_.size());
    const auto part = [&](int i) {
        return b.segment(offset_[i], offset_[i + 1] - offset_[i]);
    };
    for (int i = 0; i < blocks; ++i) {
        auto now = part(i);
        if (i > 0) now.noalias() -= below_[i] * part(i - 1);
        diagonal_[i].triangularView<Eigen::Lower>().solveInPlace(now);
    }
    for (int i = blocks - 1; i >= 0; --i) {
        auto now = part(i);
        if (i + 1 < blocks) now.noalias() -= below_[i + 1].transpose() * part(i + 1);
        diagonal_[i].triangularView<Eigen::Lower>().transpose().solveInPlace(now);
    }
}

int BlockTridiagonal::count_negative() {
    int negative = 0;
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        const bool last = i + 1 == diagonal_.size();
        MatrixXd factor = diagonal_[i];
        if (cholesky(factor)) {
            if (last) continue;
            eliminate(factor, below_[i + 1]);
            subtract_square(below_[i + 1], diagonal_[i + 1]);
            continue;
        }
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(diagonal_[i]);
        negative += static_cast<int>((eigen.eigenvalues().array() < 0).count());
        if (last) continue;
        const MatrixXd turned = below_[i + 1] * eigen.eigenvectors();
        diagonal_[i + 1] -=
            turned * eigen.eigenvalues().cwiseInverse().asDiagonal() * turned.transpose();
    }
    return negative;
}

}  // namespace magfsi::structure
