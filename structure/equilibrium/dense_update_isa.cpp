#include "structure/equilibrium/dense_update.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

#if defined(MAGFSI_ISA_avx512)
constexpr int width = 8;
constexpr int tile_columns = 8;
#elif defined(MAGFSI_ISA_avx2)
constexpr int width = 4;
constexpr int tile_columns = 4;
#else
constexpr int width = 2;
constexpr int tile_columns = 4;
#endif

// Loads and stores at any address.
typedef double Loose __attribute__((vector_size(8 * width), aligned(8)));
typedef double Real __attribute__((vector_size(8 * width)));

// A tile of Vectors * width rows and Columns columns, summed in registers.
template <int Vectors, int Columns>
inline void tile(const DenseUpdate& u, int row, int column) {
    Real sum[Vectors][Columns] = {};
    const double* a = u.a + row;
    const double* b = u.b + column;
    for (int k = 0; k < u.depth; ++k, a += u.a_stride, b += u.b_stride) {
        Real rows[Vectors];
        for (int v = 0; v < Vectors; ++v) {
            rows[v] = *reinterpret_cast<const Loose*>(a + v * width);
        }
        for (int j = 0; j < Columns; ++j) {
            for (int v = 0; v < Vectors; ++v) sum[v][j] += rows[v] * b[j];
        }
    }
    for (int j = 0; j < Columns; ++j) {
        double* c = u.c + row + (column + j) * u.c_stride;
        for (int v = 0; v < Vectors; ++v) {
            *reinterpret_cast<Loose*>(c + v * width) -= sum[v][j];
        }
    }
}

template <int Columns>
inline void last_rows(const DenseUpdate& u, int row, int column) {
    double sum[Columns] = {};
    const double* a = u.a + row;
    const double* b = u.b + column;
    for (int k = 0; k < u.depth; ++k, a += u.a_stride, b += u.b_stride) {
        for (int j = 0; j < Columns; ++j) sum[j] += *a * b[j];
    }
    for (int j = 0; j < Columns; ++j) u.c[row + (column + j) * u.c_stride] -= sum[j];
}

template <int Columns>
inline void strip(const DenseUpdate& u, int column) {
    int row = 0;
    for (; row + 3 * width <= u.rows; row += 3 * width) tile<3, Columns>(u, row, column);
    for (; row + width <= u.rows; row += width) tile<1, Columns>(u, row, column);
    for (; row < u.rows; ++row) last_rows<Columns>(u, row, column);
}

}  // namespace

void subtract_product(const DenseUpdate& u) {
    int column = 0;
    for (; column + tile_columns <= u.columns; column += tile_columns) {
        strip<tile_columns>(u, column);
    }
    for (; column < u.columns; ++column) strip<1>(u, column);
}

}  // namespace magfsi::structure::MAGFSI_ISA
