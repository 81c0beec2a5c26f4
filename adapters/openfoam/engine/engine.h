// SPDX-License-Identifier: GPL-2.0-or-later
// The wall between the coupler's C++20 and OpenFOAM's C++17: what one side needs to know
// of the other, in plain types. The engine is a shared library of its own, so that a
// program starts and says what is missing on a machine without OpenFOAM.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace magfsi::openfoam {

enum class SideType { periodic, wall, open, symmetry };

// A box of hexahedra between planes, cut into slabs across one axis, one slab a rank.
struct BoxMesh {
    std::array<std::vector<double>, 3> planes_m;  // of the whole box, ascending
    std::array<SideType, 6> sides{};              // x_min, x_max, y_min ...
    int cut_axis = 2;
    std::vector<int> first_cell;  // of each rank along that axis, and the end of the last
    int rank = 0;
};

struct EngineSetup {
    std::string case_folder;  // absolute, with system/, constant/ and 0/
    BoxMesh mesh;
};

// What the next step depends on, of this rank's slab.
struct FlowState {
    // [m/s], three a cell: now, and a step ago, of which the backward scheme knows.
    std::vector<double> velocity, old_velocity;
    std::vector<double> pressure;  // over density [m2/s2]
    // [m3/s] along each axis, x fastest; one layer of faces more than of cells there.
    std::array<std::vector<double>, 3> flux;
};

// pimpleFoam's equations on this rank's cells. Values are three a cell with x fastest,
// then y, then z. What OpenFOAM refuses is thrown as std::runtime_error with its message.
class Engine {
  public:
    virtual ~Engine() = default;

    // [m/s]; until the next step, which moves it in memory.
    virtual const double* velocity() const = 0;

    // Starts anew from these; boundaries and fluxes follow. Collective.
    virtual void set_velocity(const double* velocity) = 0;

    // Force over mass in the coming step [m/s2], zero at first; stays where it is. The
    // first call makes the source of momentum: a flow without forces has none.
    virtual double* acceleration() = 0;

    // Given velocity of a side [m/s], three a face of this rank with the first axis of
    // the plane fastest; null where this rank has none of it.
    virtual double* side_velocity(int side) = 0;

    // One time step. Collective.
    virtual void advance() = 0;

    // Between two steps.
    virtual void keep(FlowState& state) const = 0;
    // As after this many steps. Collective.
    virtual void go_back(const FlowState& state, long step) = 0;

    // curl u [1/s], three a cell. Collective.
    virtual void vorticity(double* out) = 0;

    virtual std::string version() const = 0;  // of the libraries
};

}  // namespace magfsi::openfoam

// The library's only symbol. Collective over MPI_COMM_WORLD as the library sees it.
extern "C" magfsi::openfoam::Engine* magfsi_openfoam_engine(
    const magfsi::openfoam::EngineSetup& setup);
