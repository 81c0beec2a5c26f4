// SPDX-License-Identifier: GPL-2.0-or-later
// The sparse stiffness matrix (tangent) of a body, factorised by CHOLMOD.
#pragma once

#include <Eigen/CholmodSupport>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/tangent.h"

namespace magfsi::structure {

// Symmetric matrix of which the lower triangle is stored by columns. Row 3 n + d belongs
// to coordinate d of node n. Held coordinates, and all of a node without elements, have a
// one on the diagonal and no other entry.
class StiffnessMatrix {
  public:
    // Orders the unknowns once and keeps a reference to mesh.elements. held and
    // node_volumes_m3: one entry per node. Throws std::runtime_error if there is not
    // enough memory.
    StiffnessMatrix(const Mesh& mesh, std::span<const HeldAxes> held,
                    std::span<const double> node_volumes_m3);

    // Zeros, except for the ones of held coordinates.
    void set_zero();
    // Adds a symmetric 24x24 matrix; row 3 a + d is coordinate d of the element's node a
    // [N/m].
    void add_element(std::size_t element, const Matrix24& tangent);
    // Adds a symmetric matrix to a node's diagonal block [N/m].
    void add_node(std::size_t node, const Eigen::Matrix3d& tangent);

    // Raises the foundation, springs of each node to its present place, to this stiffness
    // [Pa/m2] times the node's volume. What set_zero or earlier calls left of it is
    // counted.
    void raise_foundation(double foundation);

    // Cholesky factorisation L L^T. False if the matrix is not positive definite. Throws
    // as the constructor does.
    bool factorize();
    // Solution for a right side after factorize(); zero at held coordinates.
    Eigen::VectorXd solve(Eigen::VectorXd right_side) const;
    // The same for each column.
    Eigen::MatrixXd solve_all(Eigen::MatrixXd right_sides) const;
    // Number of negative eigenvalues by the signs of the pivots of L D L^T (Sylvester's
    // law of inertia). It takes several times as long as L L^T and is done only if L L^T
    // fails.
    int negative_eigenvalues();

    const Eigen::SparseMatrix<double>& lower_triangle() const { return matrix_; }

  private:
    // Sets up the sparsity pattern.
    void allocate(const std::vector<std::vector<int>>& neighbours);
    void index_elements(const Mesh& mesh,
                        const std::vector<std::vector<int>>& neighbours);
    void throw_if_out_of_memory();

    // Elements of the mesh, which must outlive this object
    const std::vector<Hexahedron>& elements_;
    std::vector<HeldAxes> held_;
    std::vector<double> volume_m3_;  // three entries per node; zero where held
    double foundation_ = 0;          // part of the diagonal of matrix_ [Pa/m2]
    Eigen::SparseMatrix<double> matrix_;
    // Position of node a among the rows of node b's columns, at 8 a + b, for nodes a >= b
    // of an element. Rows are counted in blocks of three, from the diagonal block on.
    std::vector<std::array<int, 64>> rank_;
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

}  // namespace magfsi::structure
