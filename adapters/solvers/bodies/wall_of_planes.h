// SPDX-License-Identifier: GPL-2.0-or-later
// Position of the wall that parallel planes of markers form in the fluid, by the linear
// theory of the lattice: a shear flow is a sum of shear waves exp(i k z), each of which
// responds alone to the force that drives it; markers spread their forces by the kernel
// and hold the velocity that the kernel interpolates to them
// (tests/validation/no_slip/lattice_response.py, sheet.py). The wall stands outside of
// the outer planes at a distance that depends on their number and their spacing: 0.55
// grid spacings for two planes, 0.90 for three, 0.74 for four (3-point kernel, planes a
// grid spacing apart).
//
// All lengths are in grid spacings and all times in fluid steps.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "base/fitted/constants.h"
#include "coupler/options.h"

namespace magfsi::bodies {

// Parallel planes of markers at equal distances.
struct EvenPlanes {
    int count = 1;
    double apart = 1;  // distance of neighbouring planes
};

class WallOfPlanes {
  public:
    // The response in a fluid with this relaxation time and magic number, to planes that
    // oscillate at the frequency whose Stokes layer sqrt(2 nu / omega) is stokes_layer.
    WallOfPlanes(coupler::Kernel kernel, double relaxation_time, double magic_number,
                 double stokes_layer = fitted::stokes_layer_of_planes);

    // The same in a fluid of finite volumes with central differences and steps that are
    // short against the oscillation.
    static WallOfPlanes of_finite_volumes(
        coupler::Kernel kernel, double stokes_layer = fitted::stokes_layer_of_planes);

    // Effective thickness of planes that oscillate along themselves: a body of that
    // thickness has the same inertia. Mean over ten positions of the planes relative to
    // the grid (thicker Stokes layers: up to 0.1 less).
    double thickness(const EvenPlanes& planes) const;

    // Planes whose effective thickness is that of a body. The fewest possible, since
    // closer ones make the marker system nearly singular; one plane for every body that
    // is thinner than two planes can be.
    EvenPlanes for_body(double thickness) const;

    // Depth of the outer planes below the surface of their body, for many planes.
    double depth(double apart) const;

  private:
    // Cells of the periodic box in which the response is evaluated: 32 of the default
    // Stokes layers.
    static constexpr int cells = 64;
    // Leaves the response to the caller.
    WallOfPlanes(double viscosity, coupler::Kernel kernel, double stokes_layer);

    coupler::Kernel kernel_;
    double viscosity_, frequency_;  // in lattice units; frequency_ is angular
    // Amplitude of the velocity in each shear wave for a force of amplitude 1.
    std::array<std::complex<double>, cells> waves_;

    std::complex<double> wave(double k, double relaxation_time,
                              double magic_number) const;
    std::complex<double> moved(const std::vector<double>& places) const;
};

}  // namespace magfsi::bodies
