// SPDX-License-Identifier: GPL-2.0-or-later
// Where planes of markers put their wall, by the linear theory of the lattice: a shear
// flow is a sum of shear waves exp(i k z), each of which responds alone to the force that
// moves it; markers spread their forces by the kernel and hold what the kernel gives them
// (tests/validation/no_slip/lattice_response.py, sheet.py). How far the wall stands
// outside of the outer planes depends on how many there are and on their distance: 0.55
// spacings for two planes, 0.90 for three, 0.74 for four (3-point kernel, a spacing
// apart).
//
// Lengths are in grid spacings here.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "coupler/options.h"

namespace magfsi::bodies {

struct EvenPlanes {
    int count = 1;
    double apart = 1;  // of neighbours
};

// Wider rows leak.
constexpr double widest_apart = 1.2;

class WallOfPlanes {
  public:
    // Of a fluid with this relaxation time and magic number.
    WallOfPlanes(coupler::Kernel kernel, double relaxation_time, double magic_number,
                 double stokes_layer = 2);

    // Thickness of what moves with planes that swing along themselves: a body of that
    // thickness would have the same inertia. Mean over their places in the grid (thicker
    // Stokes layers: up to 0.1 less).
    double thickness(const EvenPlanes& planes) const;

    // Planes that are as thick as a body: the fewest, since closer ones make the marker
    // system nearly singular. One plane stands for all bodies thinner than two can be.
    EvenPlanes for_body(double thickness) const;

    // How deep the outer ones of many planes lie in their body.
    double depth(double apart) const;

  private:
    static constexpr int cells = 64;  // of a periodic box: 32 Stokes layers
    coupler::Kernel kernel_;
    double viscosity_, frequency_;                   // per step
    std::array<std::complex<double>, cells> waves_;  // what a force of 1 moves

    std::complex<double> wave(double k, double relaxation_time,
                              double magic_number) const;
    std::complex<double> moved(const std::vector<double>& places) const;
};

}  // namespace magfsi::bodies
