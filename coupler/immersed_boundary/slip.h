// SPDX-License-Identifier: GPL-2.0-or-later
// Quality of the immersed boundary: the no-slip error and the leakage, measured at the
// markers at the end of coupled steps.
//
//   no-slip error  rms over markers and samples of |U - V|, with U the fluid's velocity
//                  sampled after its step, before the next force acts, and V the
//                  marker's velocity; in forcing no_slip U is the velocity q that
//                  carried mass in the step and V the marker's mean velocity in it
//   leakage        half of the integral of |(U - V) . n| over the surface: what flows
//                  into the body on one side and out on the other [m3/s]
//
// The net flux says nothing: it vanishes in every incompressible flow.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"

namespace magfsi::coupler {

// The piece of the surface that a marker stands for, carried by its element. Its outward
// vector area is the cross product of two edge vectors, each a sum over the element's
// nodes. It equals the piece's area at rest and follows Nanson's formula when the element
// deforms.
struct MarkerArea {
    int marker = 0;  // index of the marker on this rank
    // Weights [-] of the element's nodes in the two edge vectors.
    std::array<double, 8> first{}, second{};
};

// Vector area [m2] at the nodal positions [m], three numbers per node.
Vec3 area_vector(const Marker& marker, const MarkerArea& area, const double* nodal);

// Results over all ranks and samples.
struct SlipReport {
    std::int64_t markers = 0, samples = 0;
    double error_m_s = 0;  // the no-slip error
    // Largest rms over the markers of one sample.
    double largest_error_m_s = 0;
    double marker_speed_m_s = 0;  // rms of |V| over markers and samples
    double leakage_m3_s = 0;      // mean over the samples
    double surface_m2 = 0;        // measured surface, at the last sample
};

// Collects the sums for a SlipReport on one structure rank.
class SlipRecord {
  public:
    // areas: one for each marker that stands for a piece of the surface.
    explicit SlipRecord(std::vector<MarkerArea> areas) : areas_(std::move(areas)) {}

    std::span<const MarkerArea> areas() const { return areas_; }

    // Adds a sample: velocities of the fluid and of the markers [m/s], by marker, and the
    // nodal positions [m], three numbers per node.
    void add(std::span<const Marker> markers, std::span<const Vec3> fluid_velocity,
             std::span<const Vec3> velocity, const double* position);

    // The results over all ranks, the same on each. Collective.
    SlipReport collect(MPI_Comm comm) const;

  private:
    std::vector<MarkerArea> areas_;
    std::int64_t markers_ = 0;
    // For each sample the sum of |U - V|^2 over this rank's markers [m2/s2].
    std::vector<double> slip2_;
    // Sums over this rank's markers: |V|^2 and leakage over all samples, surface of the
    // last.
    double speed2_ = 0, leakage_m3_s_ = 0, surface_m2_ = 0;
};

}  // namespace magfsi::coupler
