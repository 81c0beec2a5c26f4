// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over the markers in every substep (PenaltyForce::apply) on flat arrays. Plain
// data only, because this header is compiled for several instruction sets
// (cmake/IsaVariants.cmake).
#pragma once

namespace magfsi::coupler {

// A node during a substep. Its velocity [m/s] and its force [N] have four numbers each,
// so that they are whole vectors of the processor; the fourth number has no meaning.
struct alignas(64) NodeRow {
    double velocity[4];
    double force[4];
};

// The nodes of a run: of markers that follow each other and share all eight nodes, which
// then are read and written once.
struct MarkerRun {
    NodeRow* node[8];
};
inline constexpr int most_in_run = 4;  // markers

// Runs that follow each other with as many markers each.
struct RunBlock {
    int markers;  // in each of the runs
    int runs;
};

// Nodes and weights of the markers, which stay the same.
struct MarkerLayout {
    // The nodes that markers have, each once, by their index in the nodal arrays; and
    // their rows.
    const int* node;
    NodeRow* row;
    int nodes;
    const double* weight;  // eight for each marker
    const MarkerRun* run;
    const RunBlock* block;
    int blocks;
};

// Values of the markers: the coefficients kappa [kg/s], the fluid's velocities [m/s] and
// the forces of the enclosed fluid [N] in this substep, and the impulses [N s], to which
// it adds. Vectors have three numbers; one more is read past the last velocity and force.
struct MarkerValues {
    const double* kappa;
    const double* fluid_velocity;
    const double* enclosed;
    double* impulse;
};

// One substep of duration_s; nodal_velocity and nodal_force have three numbers for each
// node. Each node sums the forces of its markers in their order, and nothing is fused:
// the results of all instruction sets are the same to the byte.
using MarkerKernel = void (*)(const MarkerLayout& layout, const MarkerValues& values,
                              const double* nodal_velocity, double* nodal_force,
                              double duration_s);

#define MAGFSI_MARKER_KERNEL_OF(isa)                                                     \
    namespace isa {                                                                      \
    void apply_markers(const MarkerLayout&, const MarkerValues&, const double*, double*, \
                       double);                                                          \
    }
MAGFSI_MARKER_KERNEL_OF(sse2)
MAGFSI_MARKER_KERNEL_OF(avx2)
MAGFSI_MARKER_KERNEL_OF(avx512)
#undef MAGFSI_MARKER_KERNEL_OF

}  // namespace magfsi::coupler
