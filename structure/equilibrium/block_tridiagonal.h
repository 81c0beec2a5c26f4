// Symmetric block-tridiagonal matrix and its Cholesky factor in place.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace magfsi::structure {

// Dense blocks: for slender bodies (some hundred unknowns a cross-section) their products
// run several times faster than a general sparse factorisation, and the signs of the
// eigenvalues come along. Memory 16 bytes * blocks * size^2.
class BlockTridiagonal {
  public:
    explicit BlockTridiagonal(const std::vector<int>& block_sizes);

    void set_zero();
    // Only the lower triangle is read.
    Eigen::MatrixXd& diagonal(int block) { return diagonal_[block]; }
    // Rows of `block`, columns of block - 1.
    Eigen::MatrixXd& below(int block) { return below_[block]; }

    // A = L L^T in place. False, and the content is lost, if A is not positive definite.
    bool factorize();
    // Solves A x = b after factorize().
    void solve_in_place(Eigen::VectorXd& b) const;
    // Number of negative eigenvalues; the content is lost. The Schur complements of a
    // block elimination have together as many as the matrix (Haynsworth 1968).
    int count_negative();

    int size() const { return offset_.back(); }
    int offset(int block) const { return offset_[block]; }

  private:
    std::vector<int> offset_;
    std::vector<Eigen::MatrixXd> diagonal_, below_;
};

}  // namespace magfsi::structure
