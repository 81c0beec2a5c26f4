// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid as its users see it: SI in, SI out. Lattice units stay inside fluid_lbm/.
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

using magfsi::CellRow;  // inside the owned box

constexpr int populations_per_cell = 19;

struct Totals {  // over all ranks, without the insides of obstacles
    double kinetic_energy_j = 0, mass_kg = 0, max_speed_m_s = 0;
    Vec3 momentum_kg_m_s{};
    double sound_energy_j = 0;  // of its compression: sum of p^2 / (2 rho c_s^2)
};

struct Enstrophy {
    double integral_m3_s2 = 0;  // of |curl u|^2 / 2
    double volume_m3 = 0;       // of the fluid that it is over
};

struct PlaneFlow {           // through the fluid's part of a plane across the box
    double flow_m3_s = 0;    // along the axis
    Vec3 momentum_flux_n{};  // of density times velocity, without pressure
    double pressure_pa = 0;  // gauge, mean over the plane
};

// What most likely made a cell diverge.
enum class DivergenceCause { not_finite, force, relaxation_time, speed };

// A cell with a density that is not finite or not positive, or a speed above the
// lattice's limit.
struct Divergence {
    std::array<int, 3> cell{};
    double lattice_speed = 0;  // cells a step
    Vec3 position_m{};         // of the cell's centre
    double density = 0;        // over the density at rest
    double lattice_force = 0;  // change of speed in one step by the force, cells a step
    double relaxation_time = 0;
    std::int64_t step = 0;  // steps done when the cell was in this state
    DivergenceCause cause = DivergenceCause::speed;
    std::optional<int> level;  // of a refined grid, with its cell and its steps
};
// One sentence: where, what, the likely cause, and what to change.
std::string to_string(const Divergence& divergence);

class Fluid {
  public:
    // Throws std::invalid_argument on a configuration that cannot run.
    Fluid(MPI_Comm comm, const FluidConfig& config);
    ~Fluid();
    Fluid(const Fluid&) = delete;
    Fluid& operator=(const Fluid&) = delete;

    const FluidConfig& config() const;
    CellBox owned() const;
    const std::vector<CellBox>& owned_by_rank() const;

    // Cells inside obstacles, of all ranks. Collective.
    std::vector<CellRow> solid_rows() const;

    // Velocity before this step's force acts (sum of c f over rho), [m/s], three values
    // per cell, rows one after the other.
    // relative_density: unless it is empty, the density over that at rest, one per cell.
    void velocity(std::span<const CellRow> rows, std::span<double> out,
                  std::span<double> relative_density = {}) const;

    // Force density [N/m3] of the next step only, three values a cell (Guo's scheme).
    // Rows may overlap nowhere. Replaces what was set before.
    void set_force(std::span<const CellRow> rows, std::span<const double> force);

    void step();
    // For a step that is taken again with other forces: notes the state between two
    // steps, and goes back to it from the end of the step, any number of times. Between
    // go_back() and step() only velocity() and set_force() may be called, in
    // the same rows.
    void keep();
    void go_back();
    // Seconds that this rank has waited for its neighbours in steps so far.
    double waited_for_neighbours_s() const;

    // The whole state between steps: its step and, for every cell, the 19 populations
    // that have arrived there, as deviations from rest; the same numbers however the box
    // is divided into ranks, exact in double whatever is stored. plane: global z, of this
    // rank's box; values: [y][x][19] over the box's cells.
    void populations(int plane, std::span<double> values) const;
    // Puts such a state back: first the step, then every plane of the box. Goes on with
    // the very numbers of the run that the state was taken from.
    void set_steps_done(std::int64_t steps);
    void set_populations(int plane, std::span<const double> values);

    // These, plane_flow() and macroscopic() have velocities with half of the body force,
    // which momentum lacks between steps; of other forces the next is not known yet.
    Totals totals() const;  // collective
    // Of disjoint boxes of global cells alone. Collective.
    Totals totals(std::span<const CellBox> parts) const;
    // Mean of |curl u|^2 / 2 over the fluid. Collective; while it runs a copy of the
    // velocity is held, three doubles a cell.
    double enstrophy_1_s2() const;
    Enstrophy enstrophy(std::span<const CellBox> parts) const;
    // Of the plane across `axis` (0 x, 1 y, 2 z) at a coordinate in the box. Collective.
    PlaneFlow plane_flow(int axis, double at_m) const;
    // Force [N] of the fluid on each obstacle during the last step, in the order of the
    // configuration; zero before the first. By gauge pressure: an obstacle that touches a
    // wall feels none of the rest pressure. Collective.
    std::vector<Vec3> obstacle_forces() const;
    // The first cell of this rank that a step found diverged: every step checks every
    // cell in passing, before its collision (with the step's force), so that a state that
    // went wrong is named by the next step at the latest and never spreads values that
    // are not finite.
    std::optional<Divergence> diverged() const;
    // Velocity [m/s] (3 a cell) and density [kg/m3] of the owned cells, x fastest; in
    // obstacles 0 and the density at rest.
    void macroscopic(std::span<float> velocity, std::span<float> density) const;
    // Gauge pressure [Pa] of the owned cells, x fastest: zero at the density at rest.
    void pressure(std::span<float> out) const;
    // curl u [1/s] of the owned cells, 3 a cell, x fastest. Collective.
    void vorticity(std::span<float> out) const;

    struct State;  // state.h: for the files that implement this class, and refinement/
    State& state() { return *state_; }
    const State& state() const { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

}  // namespace magfsi::fluid
