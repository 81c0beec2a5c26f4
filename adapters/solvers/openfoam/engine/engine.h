// SPDX-License-Identifier: GPL-2.0-or-later
// Interface between the coupler (C++20) and OpenFOAM (C++17), in plain types. The engine
// is a shared library of its own, loaded at run time, so that a program without OpenFOAM
// starts and says what is missing.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace magfsi::openfoam {

// Kind of a side of the box; `open` stands for inlets and outlets, `symmetry` for free
// slip.
enum class SideType { periodic, wall, open, symmetry };

// A box of hexahedra between planes, cut into slabs across one axis, one slab a rank.
struct BoxMesh {
    std::array<std::vector<double>, 3> planes_m;  // whole box, ascending
    std::array<SideType, 6> sides{};              // x_min, x_max, y_min ...
    int cut_axis = 2;                             // axis across which the box is cut
    // First layer of cells of each rank along cut_axis, and the end of the last rank:
    // ranks + 1 numbers.
    std::vector<int> first_cell;
    int rank = 0;  // this rank
};

// Start-up data of the engine.
struct EngineSetup {
    std::string case_folder;  // absolute, with system/, constant/ and 0/
    // The mesh of this rank; boundary files of the case name its sides x_min to z_max.
    BoxMesh mesh;
    // The mesh is read from the case, on one rank, because it is no plain box: `mesh` is
    // the box around it.
    bool reads_mesh = false;
    // The case's function objects run along, and time folders are written. With either,
    // each of several ranks has its own folder in the case, processorN.
    bool runs_functions = false, writes_fields = false;
    // The force of each step is known before it; else it is found with the pressure.
    bool balances_force = true;
};

// State of the flow in this rank's slab, all that the next step depends on.
struct FlowState {
    // Velocity [m/s] at this step and the one before (used by the backward time scheme),
    // three numbers a cell.
    std::vector<double> velocity, old_velocity;
    std::vector<double> pressure;  // pressure over density [m2/s2]
    // Fluxes [m3/s] through the faces across each axis, x fastest; along that axis there
    // is one layer of faces more than of cells.
    std::array<std::vector<double>, 3> flux;
    // In place of `flux` on a mesh that was read: fluxes out of the cells through all
    // faces in their order.
    std::vector<double> face_flux;
};

// Cells of a mesh that was read, in their order.
struct ReadCells {
    std::vector<double> volume_m3;
    std::vector<std::array<double, 3>> centre_m;
};

// Integrals over the fluid's part of a plane across the box.
struct PlaneSums {
    double flow = 0;                   // [m3/s], along the axis
    std::array<double, 3> momentum{};  // of u u_n [m4/s2]
    double pressure = 0;               // of pressure over density [m4/s2]
    double area = 0;                   // [m2]
};

// pimpleFoam's equations on this rank's cells. Vector fields have three numbers a cell;
// cells are numbered with x fastest, then y, then z. Errors of OpenFOAM are thrown as
// std::runtime_error with its message.
class Engine {
  public:
    virtual ~Engine() = default;

    // Velocity in the cells [m/s]. The pointer is valid until the next step, which moves
    // the field in memory.
    virtual const double* velocity() const = 0;

    // Sets the velocity in the cells [m/s]; boundary values and fluxes follow from it.
    // Collective.
    virtual void set_velocity(const double* velocity) = 0;

    // Force over mass in the coming step [m/s2], three numbers a cell, initially zero;
    // the pointer stays valid. The first call adds the momentum source: a flow without
    // forces has none.
    virtual double* acceleration() = 0;

    // Prescribed velocity of a side [m/s], three numbers a face of this rank with the
    // first axis of the plane fastest; null if this rank has no face of that side or the
    // side prescribes none.
    virtual double* side_velocity(int side) = 0;

    // The next three are for meshes that were read. Cells of this rank:
    virtual ReadCells cells() const = 0;
    // Number of the cell that holds each point; -1 where there is none.
    virtual std::vector<int> find(const std::vector<std::array<double, 3>>& points_m) = 0;
    // Centres of the faces of a side, in the order of side_velocity().
    virtual std::vector<std::array<double, 3>> side_faces(int side) const = 0;

    // Force of the fluid on a patch over its density [m4/s2]: pressure and viscous
    // stress. Collective.
    virtual std::array<double, 3> force_on(const std::string& patch) = 0;

    // Advances the flow by one time step. may_repeat: answer_again() may follow.
    // Collective.
    virtual void advance(bool may_repeat) = 0;

    // Repeats the last step under the present acceleration, from its own momentum
    // equation: the pressure and the velocities follow anew. The equation must have been
    // kept (can_answer_again). Collective.
    virtual void answer_again() = 0;
    virtual bool can_answer_again() const = 0;

    // Copies the state of the flow; must be called between two steps.
    virtual void keep(FlowState& state) const = 0;
    // Restores a state as it was after `step` steps. Collective.
    virtual void go_back(const FlowState& state, long step) = 0;

    // Writes curl u [1/s], three numbers a cell. Collective.
    virtual void vorticity(double* out) = 0;

    // Integrals over the plane across `axis` at the coordinate at_m, over all ranks.
    // Collective.
    virtual PlaneSums plane(int axis, double at_m) = 0;

    // Writes a time folder, if it is time for one or `last`, and runs the function
    // objects; does nothing unless the setup asks for it. Called once after every step
    // that will not be repeated. Collective.
    virtual void record(bool last) = 0;

    // Version of OpenFOAM's libraries.
    virtual std::string version() const = 0;
};

}  // namespace magfsi::openfoam

// Makes an engine; the library's only exported symbol. The caller owns the result.
// Collective over MPI_COMM_WORLD as the library sees it (world_of_openfoam.h).
extern "C" magfsi::openfoam::Engine* magfsi_openfoam_engine(
    const magfsi::openfoam::EngineSetup& setup);
