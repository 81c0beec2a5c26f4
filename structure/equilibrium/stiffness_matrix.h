// SPDX-License-Identifier: GPL-2.0-or-later
// The sparse stiffness matrix (tangent) of a body, factorised by CHOLMOD.
#pragma once

#include <Eigen/CholmodSupport>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/tangent.h"

namespace magfsi::structure {

// Row 3 n + d belongs to coordinate d of node n. Held coordinates, and nodes of no
// element, keep a one on the diagonal and nothing beside it.
class StiffnessMatrix {
  public:
    // Orders the unknowns once; the mesh must stay. Throws std::runtime_error if there is
    // not enough memory.
    StiffnessMatrix(const Mesh& mesh, std::span<const HeldAxes> held,
                    std::span<const double> node_volumes_m3);

    void set_zero();
    void add_element(std::size_t element, const Matrix24& tangent);
    void add_node(std::size_t node, const Eigen::Matrix3d& tangent);

    // Adds to the diagonal what is missing to this foundation: its stiffness [Pa/m2]
    // times the volume of each node.
    void raise_foundation(double foundation);

    // L L^T. False if the matrix is not positive definite. Throws as the constructor
    // does.
    bool factorize();
    // After factorize(); zero where held.
    Eigen::VectorXd solve(Eigen::VectorXd right_side) const;
    // By the signs of the pivots of L D L^T (Sylvester's law of inertia). That takes
    // several times as long as L L^T and is done only where L L^T does not exist.
    int negative_eigenvalues();

    const Eigen::SparseMatrix<double>& lower_triangle() const { return matrix_; }

  private:
    void allocate(const std::vector<std::vector<int>>& neighbours);
    void index_elements(const Mesh& mesh,
                        const std::vector<std::vector<int>>& neighbours);
    void throw_if_out_of_memory();

    const std::vector<Hexahedron>& elements_;
    std::vector<HeldAxes> held_;
    std::vector<double> volume_m3_;       // three a node; zero where held
    double foundation_ = 0;               // in matrix_
    Eigen::SparseMatrix<double> matrix_;  // lower triangle
    // For nodes a >= b of an element (8 a + b): which of the nodes from b on in the
    // columns of b, each with three rows, is a.
    std::vector<std::array<int, 64>> rank_;
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

}  // namespace magfsi::structure
