// SPDX-License-Identifier: GPL-2.0-or-later
// A row of four lanes is the vector (x, y, z) of a node or a marker. With markers or
// nodes as lanes the sums would have another order, and the results other last digits.
#include "base/isa/simd.h"
#include "coupler/immersed_boundary/marker_kernel.h"

#if !defined(MAGFSI_ISA)
#error "compiled by magfsi_isa_variants"
#endif

namespace magfsi::coupler::MAGFSI_ISA {
namespace {

constexpr int part_lanes = vector_bytes < 32 ? 2 : 4, parts = 4 / part_lanes;
using Part = Simd<double, part_lanes>::Vector;

// The row in one vector, or in two with SSE2.
struct Row {
    Part part[parts];

    MAGFSI_INLINE Row& operator+=(const Row& b) {
        for (int i = 0; i < parts; ++i) part[i] += b.part[i];
        return *this;
    }
    MAGFSI_INLINE friend Row operator-(const Row& a, const Row& b) {
        Row all;
        for (int i = 0; i < parts; ++i) all.part[i] = a.part[i] - b.part[i];
        return all;
    }
    MAGFSI_INLINE friend Row operator*(const Part& factor, const Row& b) {
        Row all;
        for (int i = 0; i < parts; ++i) all.part[i] = factor * b.part[i];
        return all;
    }
};

// A number in all lanes. For a plain double GCC 12 often takes two instructions.
MAGFSI_INLINE Part everywhere(const double* x) {
#if defined(MAGFSI_ISA_avx2) || defined(MAGFSI_ISA_avx512)
    return _mm256_broadcast_sd(x);
#else
    return splat<Part>(*x);
#endif
}

MAGFSI_INLINE Row row_of_four(const double* x) {
    Row row;
    for (int i = 0; i < parts; ++i) row.part[i] = load<Part>(x + i * part_lanes);
    return row;
}

MAGFSI_INLINE void store_four(double* x, const Row& row) {
    for (int i = 0; i < parts; ++i) store(x + i * part_lanes, row.part[i]);
}

// Three numbers and a zero. P is Part; as a parameter it lets one of the forms be wrong.
template <class P>
MAGFSI_INLINE Row row_of_three(const double* x) {
    if constexpr (parts == 1)
        return {{P{x[0], x[1], x[2], 0}}};
    else
        return {{P{x[0], x[1]}, P{x[2], 0}}};
}

MAGFSI_INLINE void store_three(double* x, const Row& row) {
    for (int d = 0; d < 3; ++d) x[d] = row.part[d / part_lanes][d % part_lanes];
}

// The runs of a block, from its first run and the number of its first marker.
template <int Markers>
[[gnu::noinline]] void run_block(const MarkerLayout& layout, const MarkerValues& values,
                                 const MarkerRun* run, const MarkerRun* end, long first,
                                 double duration_s) {
    const double* weight = layout.weight + 8 * first;
    const double* kappa = values.kappa + first;
    const double* fluid_velocity = values.fluid_velocity + 3 * first;
    const double* enclosed = values.enclosed + 3 * first;
    double* impulse = values.impulse + 3 * first;
    const Part duration = everywhere(&duration_s);
    for (; run != end; ++run) {
        Row velocity[Markers] = {};
        for (int a = 0; a < 8; ++a) {
            const Row nodal = row_of_four(run->node[a]->velocity);
            for (int m = 0; m < Markers; ++m)
                velocity[m] += everywhere(weight + 8 * m + a) * nodal;
        }
        Row force[Markers];
        for (int m = 0; m < Markers; ++m) {
            const Row slip = velocity[m] - row_of_four(fluid_velocity + 3 * m);
            const Row given = everywhere(kappa + m) * slip;
            Row sum = row_of_three<Part>(impulse + 3 * m);
            sum += duration * given;
            store_three(impulse + 3 * m, sum);
            force[m] = row_of_four(enclosed + 3 * m) - given;
        }
        for (int a = 0; a < 8; ++a) {
            Row sum = row_of_four(run->node[a]->force);
            for (int m = 0; m < Markers; ++m)
                sum += everywhere(weight + 8 * m + a) * force[m];
            store_four(run->node[a]->force, sum);
        }
        weight += 8 * Markers;
        kappa += Markers;
        fluid_velocity += 3 * Markers;
        enclosed += 3 * Markers;
        impulse += 3 * Markers;
    }
}

constexpr decltype(&run_block<1>) run_blocks[most_in_run] = {
    &run_block<1>, &run_block<2>, &run_block<3>, &run_block<4>};

}  // namespace

void apply_markers(const MarkerLayout& layout, const MarkerValues& values,
                   const double* nodal_velocity, double* nodal_force, double duration_s) {
    for (int n = 0; n < layout.nodes; ++n) {
        const long at = 3L * layout.node[n];
        store_four(layout.row[n].velocity, row_of_three<Part>(nodal_velocity + at));
        store_four(layout.row[n].force, row_of_three<Part>(nodal_force + at));
    }
    const MarkerRun* run = layout.run;
    long first = 0;
    for (int b = 0; b < layout.blocks; ++b) {
        const RunBlock& block = layout.block[b];
        const MarkerRun* end = run + block.runs;
        run_blocks[block.markers - 1](layout, values, run, end, first, duration_s);
        run = end;
        first += static_cast<long>(block.markers) * block.runs;
    }
    for (int n = 0; n < layout.nodes; ++n)
        store_three(nodal_force + 3L * layout.node[n], row_of_four(layout.row[n].force));
}

}  // namespace magfsi::coupler::MAGFSI_ISA
