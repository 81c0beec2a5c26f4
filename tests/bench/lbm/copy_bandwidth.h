// What in-place streaming is held against: every number of an array read and written back
// changed, by the same ranks and threads, with the same prefetch.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>

namespace magfsi::bench {

class InPlaceCopy {
  public:
    // bytes: of this rank. Threads touch first what they will change.
    InPlaceCopy(MPI_Comm comm, std::size_t bytes);

    // Bytes read plus bytes written by all ranks, per second; about this long.
    // Collective.
    double bytes_per_second(double seconds);

  private:
    void pass();

    struct Free {
        void operator()(double* memory) const;
    };
    MPI_Comm comm_;
    std::ptrdiff_t lines_;
    std::unique_ptr<double[], Free> memory_;
};

}  // namespace magfsi::bench
