// SPDX-License-Identifier: GPL-2.0-or-later
// How well the immersed boundary holds: the no-slip error and the leakage, measured at
// the markers at the end of coupled steps.
//
//   no-slip error  rms over markers and samples of |U - V|: U the fluid's velocity
//                  sampled after its step, before the next force acts, V the marker's;
//                  in forcing no_slip the velocity that carried mass in the step and
//                  the marker's mean one
//   leakage        half the sum over the surface of |(U - V) . n| dA: what flows in on
//                  one side of the body and out on the other [m3/s]
//
// The net flux says nothing, for it vanishes in every incompressible flow.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// The piece of the surface that a marker stands for, carried by its element: its vector
// area, outward, is the cross product of two edges, each a sum over the element's nodes.
// At rest that is the piece's own area; moved, that of Nanson's formula.
struct MarkerArea {
    int marker = 0;
    std::array<double, 8> first{}, second{};  // of each node [-], of dimension length / m
};

// Vector area [m2] at nodal positions (three numbers a node).
Vec3 area_vector(const Marker& marker, const MarkerArea& area, const double* nodal);

struct SlipReport {
    std::int64_t markers = 0, samples = 0;
    double error_m_s = 0;          // the no-slip error
    double largest_error_m_s = 0;  // of one sample's rms over the markers
    double marker_speed_m_s = 0;   // rms of |V|
    double leakage_m3_s = 0;       // mean over the samples
    double surface_m2 = 0;         // that the leakage was measured on, at the last sample
};

class SlipRecord {
  public:
    // areas: of those markers that stand for some of the surface.
    explicit SlipRecord(std::vector<MarkerArea> areas) : areas_(std::move(areas)) {}

    std::span<const MarkerArea> areas() const { return areas_; }

    // One sample: velocities of the fluid and of the markers, at each; positions of the
    // nodes (three numbers a node).
    void add(std::span<const Marker> markers, std::span<const Vec3> fluid_velocity,
             std::span<const Vec3> velocity, const double* position);

    // Of all ranks. Collective.
    SlipReport collect(MPI_Comm comm) const;

  private:
    std::vector<MarkerArea> areas_;
    std::int64_t markers_ = 0;
    std::vector<double> slip2_;  // by sample: sums over this rank's markers [m2/s2]
    double speed2_ = 0, leakage_m3_s_ = 0, surface_m2_ = 0;
};

}  // namespace magfsi::coupler
