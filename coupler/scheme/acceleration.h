// A step of an implicit scheme is a fixed point x = H(x): H answers to a guess of the
// fluid's velocities at the step's end with those that follow from it. An acceleration
// makes the next guess from what was answered so far. Vectors may be spread over the
// ranks of a communicator, each rank holding its part in the same order throughout.
#pragma once

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::coupler {

class Acceleration {
  public:
    virtual ~Acceleration() = default;

    // The next guess in the place of the last one. Collective.
    virtual void improve(std::span<double> guess, std::span<const double> answer) = 0;

    // The step ends with this pair, converged or not: what was learnt goes on to the next
    // step as far as the method reuses it.
    virtual void end_step(std::span<const double> guess,
                          std::span<const double> answer) = 0;

    // Between steps, for checkpoints: numbers that are the same on all ranks, and vectors
    // (this rank's parts). Given the numbers, a fresh object of the same settings and
    // `size` makes room for the vectors, which are then filled.
    virtual std::vector<double> numbers() const = 0;
    virtual std::vector<std::span<double>> vectors() = 0;
    virtual void make_room(std::span<const double> numbers, std::size_t size) = 0;
};

// The scene's.
std::unique_ptr<Acceleration> make_acceleration(MPI_Comm comm,
                                                const scene::Iteration& wanted);

}  // namespace magfsi::coupler
