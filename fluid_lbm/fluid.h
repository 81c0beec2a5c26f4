// SPDX-License-Identifier: GPL-2.0-or-later
// The lattice Boltzmann fluid as its users see it: SI in, SI out. Lattice units stay
// inside fluid_lbm/.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fluid_lbm/config.h"

namespace magfsi::fluid {

using magfsi::CellRow;  // rows given to Fluid lie inside the box that the rank owns

// Number of distribution functions of a cell (D3Q19).
constexpr int populations_per_cell = 19;

// Sums over the fluid cells of all ranks; cells inside obstacles are left out.
struct Totals {
    double kinetic_energy_j = 0, mass_kg = 0, max_speed_m_s = 0;
    Vec3 momentum_kg_m_s{};
    // Energy of compression: sum of p^2 / (2 rho c_s^2) over the volume.
    double sound_energy_j = 0;
};

// Enstrophy of a part of the fluid.
struct Enstrophy {
    double integral_m3_s2 = 0;  // integral of |curl u|^2 / 2 over the volume
    double volume_m3 = 0;       // fluid volume of that integral
};

// Flow through the fluid's part of a plane across the box.
struct PlaneFlow {
    double flow_m3_s = 0;    // flow of mass over the density at rest, along the axis
    Vec3 momentum_flux_n{};  // integral of rho u u_n; pressure not included
    double pressure_pa = 0;  // gauge pressure, mean over the plane
};

// The most likely cause of a divergence; sampling/divergence.cpp has the order in which
// causes are tried.
enum class DivergenceCause { not_finite, force, relaxation_time, speed };

// A diverged cell: its density is not finite or not positive, or its speed is above the
// lattice's limit.
struct Divergence {
    std::array<int, 3> cell{};  // global index
    double lattice_speed = 0;   // cells per step
    Vec3 position_m{};          // centre of the cell [m]
    double density = 0;         // relative to the density at rest
    double lattice_force = 0;  // change of speed in one step by the force, cells per step
    double relaxation_time = 0;  // tau in steps; of the cell's own viscosity
    std::int64_t step = 0;       // steps done when the cell was in this state
    DivergenceCause cause = DivergenceCause::speed;
    std::string remedy;  // the cause in words, and what the configuration allows to do
    std::optional<int> level;  // level of a refined grid that cell and step belong to
};
// One sentence for the user: the place, the values, the likely cause and a remedy.
std::string to_string(const Divergence& divergence);

// One lattice Boltzmann fluid on a uniform grid, shared among the ranks of a
// communicator. Every rank owns a block of whole rows along x. Member functions concern
// the calling rank alone unless they are marked as collective.
class Fluid {
  public:
    // Sets up the fluid in its initial state and duplicates the communicator. Collective.
    // Throws std::invalid_argument on a configuration that cannot run.
    Fluid(MPI_Comm comm, const FluidConfig& config);
    ~Fluid();
    Fluid(const Fluid&) = delete;
    Fluid& operator=(const Fluid&) = delete;

    const FluidConfig& config() const;
    // The box of global cells that this rank, or each rank, owns.
    CellBox owned() const;
    const std::vector<CellBox>& owned_by_rank() const;

    // The cells inside obstacles on all ranks, as rows of global indices. Collective.
    std::vector<CellRow> solid_rows() const;

    // Velocity [m/s] (sum of c f over rho), before the force of the coming step acts.
    // Three values per cell, in the order of the rows. relative_density: empty, or one
    // value per cell, which receives the density relative to that at rest. Throws
    // std::invalid_argument if a row leaves the rank's box or a length does not fit.
    void velocity(std::span<const CellRow> rows, std::span<double> out,
                  std::span<double> relative_density = {}) const;

    // Sets the force density [N/m3] that acts in the next step only (Guo's scheme) and
    // replaces what was set before; three values per cell. The rows must not overlap.
    // Throws as velocity().
    void set_force(std::span<const CellRow> rows, std::span<const double> force);

    // Advances the fluid by one time step. Collective.
    void step();
    // Repetition of a step with other forces: keep() notes the state between two steps,
    // and go_back() returns to it after that step, as often as needed. Between go_back()
    // and step() only velocity() and set_force() may be called, in the same rows as
    // before.
    void keep();
    void go_back();
    // Time [s] that this rank has waited for messages of its neighbours, over all steps.
    double waited_for_neighbours_s() const;

    // One plane of the state between two steps, for a checkpoint: for every cell the 19
    // populations that have arrived there, minus their weights. The numbers do not depend
    // on the decomposition into ranks and are exact in double for every storage
    // precision. plane: global z inside the rank's box; values: [y][x][19] over the box's
    // cells.
    void populations(int plane, std::span<double> values) const;
    // Restores such a state: set_steps_done() first, because the number of steps decides
    // how populations are stored, then every plane of the box. The run then continues bit
    // for bit as the one that the state was taken from.
    void set_steps_done(std::int64_t steps);
    void set_populations(int plane, std::span<const double> values);

    // Totals over the whole box. Collective. The velocities here, in plane_flow() and in
    // macroscopic() include half of the body force, which the stored momentum lacks
    // between two steps. Other forces are left out: those of the coming step are not
    // known yet.
    Totals totals() const;
    // Totals over the cells of disjoint boxes (global indices). Collective.
    Totals totals(std::span<const CellBox> parts) const;
    // Mean of |curl u|^2 / 2 over the fluid. Collective. It holds a copy of the velocity
    // meanwhile: three doubles per cell.
    double enstrophy_1_s2() const;
    // The same over the cells of disjoint boxes (global indices). Collective.
    Enstrophy enstrophy(std::span<const CellBox> parts) const;
    // Flow through the plane across `axis` (0 x, 1 y, 2 z) at the coordinate at_m [m] in
    // the box, interpolated between the two layers of cells beside it. Collective.
    PlaneFlow plane_flow(int axis, double at_m) const;
    // Force [N] of the fluid on each obstacle, mean over the last step, in the order of
    // the configuration; zero before the first step. The pressure in it is gauge
    // pressure, so that an obstacle on a wall feels no rest pressure. Collective.
    std::vector<Vec3> obstacle_forces() const;
    // The first cell of this rank that a step found diverged, if there is one. Every step
    // checks every cell before its collision, with the step's force. A faulty state is
    // thus named by the next step at the latest.
    std::optional<Divergence> diverged() const;
    // Velocity [m/s] (3 per cell) and density [kg/m3] of the owned cells, x fastest.
    // Cells inside obstacles have velocity 0 and the density at rest.
    void macroscopic(std::span<float> velocity, std::span<float> density) const;
    // Gauge pressure [Pa] of the owned cells, x fastest; zero at the density at rest.
    void pressure(std::span<float> out) const;
    // Vorticity curl u [1/s] of the owned cells, 3 per cell, x fastest; 0 inside
    // obstacles. Collective.
    void vorticity(std::span<float> out) const;

    // The state in lattice units (state.h), for the files that implement this class and
    // for refinement/.
    struct State;
    State& state() { return *state_; }
    const State& state() const { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

}  // namespace magfsi::fluid
