// C -= A B^T on dense column-major blocks, in the instruction set of the machine: where
// the factorisation spends its time. Plain pointers only: this header is compiled for
// several instruction sets (cmake/IsaVariants).
#pragma once

namespace magfsi::structure {

struct DenseUpdate {
    double* c = nullptr;        // rows x columns
    const double* a = nullptr;  // rows x depth
    const double* b = nullptr;  // columns x depth
    int rows = 0, columns = 0, depth = 0;
    // Distances between columns.
    long c_stride = 0, a_stride = 0, b_stride = 0;
};

using DenseUpdateFunction = void (*)(const DenseUpdate&);

namespace sse2 {
void subtract_product(const DenseUpdate&);
}
namespace avx2 {
void subtract_product(const DenseUpdate&);
}
namespace avx512 {
void subtract_product(const DenseUpdate&);
}

}  // namespace magfsi::structure
