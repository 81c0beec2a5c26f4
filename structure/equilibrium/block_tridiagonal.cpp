#include "structure/equilibrium/block_tridiagonal.h"

namespace magfsi::structure {
namespace {

// below := below * L^-T of the factorised block before it.
void eliminate(const Eigen::MatrixXd& factor, Eigen::MatrixXd& below) {
    factor.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
        below);
}

bool cholesky(Eigen::MatrixXd& block) {
    return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(block).info() == Eigen::Success;
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
            diagonal_[i].selfadjointView<Eigen::Lower>().rankUpdate(below_[i], -1);
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
    Eigen::MatrixXd update;  // what the block before takes off the next one
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        if (i > 0) diagonal_[i].triangularView<Eigen::Lower>() -= update;
        const bool last = i + 1 == diagonal_.size();
        Eigen::MatrixXd factor = diagonal_[i];
        if (cholesky(factor)) {
            if (last) continue;
            eliminate(factor, below_[i + 1]);
            update.noalias() = below_[i + 1] * below_[i + 1].transpose();
            continue;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(diagonal_[i]);
        negative += static_cast<int>((eigen.eigenvalues().array() < 0).count());
        if (last) continue;
        const Eigen::MatrixXd turned = below_[i + 1] * eigen.eigenvectors();
        update.noalias() =
            turned * eigen.eigenvalues().cwiseInverse().asDiagonal() * turned.transpose();
    }
    return negative;
}

}  // namespace magfsi::structure
