// SPDX-License-Identifier: GPL-2.0-or-later
// All numbers of the models that were found by trial or by measurement: value, unit, and
// the runs that they were fitted to. A number that follows from an equation stands where
// the equation is used.
//
// "Test" names the CTest that measures what the number was fitted to: it fails once the
// number moves further than the tolerance of the test allows. "Test: none" says that no
// test would tell. tests/house/fitted.py checks that each number names tests that exist
// and is used.
#pragma once

#include <array>

namespace magfsi::fitted {

// --- places of markers, forcing no_slip; lengths in grid spacings ---------------------

// Largest distance of neighbouring rows and planes: fluid leaks through wider ones. The
// swimmer was run with rows 0.85, 1.0 and 1.14 apart; against the last its first rise
// changes by -3 and +6 %. Test: none.
inline constexpr double widest_apart = 1.2;

// Admissible distances of neighbouring planes. The forces of closer ones work against
// each other, and wider ones do not carry the fluid between them; two planes carry it up
// to a larger distance. Fitted to the linear theory of the lattice for bodies 0.1 to 12
// thick, both kernels: the planes found are as thick as the body within 0.2. The test has
// no lower bound of closest_of_two. Test: bodies.
inline constexpr double closest_of_two = 0.9, widest_of_two = 2.0;
inline constexpr double closest_of_more = 0.75;

// Lack of thickness up to which one plane has a smaller error than two that are close
// together. Fitted to plates 1.85 and 2 thick, 3-point kernel. The test fails if it
// grows. Test: bodies.
inline constexpr double thinner_is_better = 0.4;

// Stokes layer in which the layers of a body get their distances. It was chosen; in
// thicker ones planes move up to 0.1 less. Test: bodies.
inline constexpr double stokes_layer_of_planes = 2;

// Stokes layer at which the inertia of a single layer is made exact. With it sheets 0.3
// and 1.34 thick have the force of a wall within 1 % and a degree in Stokes layers of 4
// to 16, at relaxation times of 0.51 to 1. Test: no_slip_sheet.
inline constexpr double resolved_stokes_layer = 4;

// Reach of a single layer beyond the edge of its markers, by the magic number of the
// grid, for the 2-point and the 3-point kernel. Fitted to the exact added mass of plates
// and disks that oscillate broadside in Stokes layers of 0.6, 0.9, 1.2 and 2.4, by row;
// the last row also to a disk in a creeping stream, which then has equal errors broadside
// and edgewise. No test has the 2-point kernel. Test: no_slip_plate, no_slip_disk.
struct EdgeAt {
    double magic_number, two_point, three_point;
};
inline constexpr std::array<EdgeAt, 4> known_edges{
    {{0.005, 0.64, 0.99}, {0.01, 0.64, 0.93}, {0.016, 0.61, 0.90}, {0.03, 0.48, 0.75}}};

// The same in finite volumes, for both kernels. Fitted to the exact added mass of a plate
// 7.5 wide and 0.9 thick that oscillates broadside, 3-point kernel. Test:
// openfoam_no_slip.
inline constexpr double edge_in_finite_volumes = 0.4;

// Extension of a sheet without thickness, in thicknesses t, that replaces a sheet with
// square edges. Those move as much fluid as 0.31 to 0.35 t more of the thin sheet
// (boundary elements; t up to a tenth of the width), and the fluid that they displace
// counts as another tenth of t. Test: no_slip_plate, no_slip_disk.
inline constexpr double square_edge = 0.44;

// Least and mean distance of markers that are thinned out from dense points. The least
// was chosen, the mean measured on the markers that it leaves. Test: none.
inline constexpr double thinned_to = 1.0, thinned_apart = 1.1;

// Distance from a thinned-out outer row to the edge of the area that it stands for.
// Fitted to the exact added mass of disks 12 and 16 wide that oscillate broadside; holds
// from 8 to 32. Test: no_slip_disk.
inline constexpr double beyond_row = 0.4;

// Depth that the outer rows of two thinned-out layers lack against those of a plane.
// Fitted to disks 3 thick, 16 and 32 wide. Test: none.
inline constexpr double thinned_two = 0.02;

// The same of more layers. Fitted to disks 4 thick, 16 and 32 wide. Test: no_slip_disk.
inline constexpr double thinned_more = 0.08;

// Additional depth of an even shell, and of the rows along the rims of a block of several
// layers, against a plane. Fitted to Hasimoto's drag on balls 6 to 12 wide in a creeping
// stream, 3-point kernel: 0.01 changes the drag by 0.5 %, the speed of settling balls by
// 0.35 %. With it bars 2 to 6 thick hold a creeping stream as obstacles on a fine grid
// do, and plates 2.5 to 4.5 thick that oscillate have their exact added mass within 3 %,
// with both kernels. Test: no_slip_ball, rigid_in_fluid, no_slip_bars, no_slip_plate.
inline constexpr double beyond_edge = 0.07;

// --- places of markers, forcing penalty; lengths in grid spacings ---------------------

// Largest distance of markers; beyond about 1 the surface leaks. Test: none.
inline constexpr double marker_spacing = 0.5;

// Depth below the surface. At 0.4 a sphere of 6 or 12 cells settles at the same speed,
// that of the experiment. Test: sphere_of_markers_drag.
inline constexpr double retraction = 0.4;

// Depth below the rim of a sheet. At 0.9 a plate of the swimmer's shape falls alike at 15
// and 7 cells a width. Test: none.
inline constexpr double rim_retraction = 0.9;

// --- forces on markers, forcing no_slip -----------------------------------------------

// Factor s of the force (coupler/immersed_boundary/no_slip.h). At 1 the slip of markers
// that fill a volume would change sign in every step and not decay, by the linear model;
// at 3/4 it decays to 0.4 of itself. 1 was not run. Test: none.
inline constexpr double no_slip_strength = 0.75;

// Smallest row sum that forces are divided by. Isolated markers, at a rim or beside an
// obstacle, have small row sums, and their kappa would need too many substeps. Test:
// none.
inline constexpr double least_row_sum = 0.25;

// Largest gain of the slip's memory per coupled step, and the viscosity nu dt / h^2 up to
// which it is taken; beyond it the gain falls with the inverse. Fitted to settling balls
// of 6 to 12 cells at relaxation times of 0.94 to 1.88: with a constant 1/4 one of 9
// cells diverges at 1.19, with 1/2 one of 6 cells from 1.16 on.
// Test: coupler_immersed_boundary, sphere_settling.
inline constexpr double most_gain = 0.25, fully_gains_until = 0.1;

// Leak over gain of the memory, times nu dt / h^2 + leak_per_speed u dt / h. Fitted to
// the flow past an array of held balls (an eighth of the space) at relaxation times of
// 0.575 to 1.4, and to a leak of 0.02 for sheets at 0.05 cells a step.
// Test: coupler_immersed_boundary, no_slip_ball.
inline constexpr double leak_over_gain = 0.008, leak_per_speed = 2;

// Factor of the leak in the core of thick sheets. A strip of seven layers, which diverged
// with the 2-point kernel, then runs; in the middle of balls it would take 1 % off their
// drag. Test: none.
inline constexpr double core_leak = 4;

// Weight of the last step in the running mean by which the fluid gets the momentum of a
// single layer. At once sheets of half a cell diverge, and at lattice speeds of 0.025 the
// swimmer does. The test fails if the weight falls. Test: coupler_immersed_boundary.
inline constexpr double layer_weight = 0.1;

// --- the enclosed fluid, and the implicit scheme --------------------------------------

// Share of a change of dU/dt that the enclosed fluid's acceleration takes on per coupled
// step, at least. With the whole change runs diverge below a density ratio of 0.4, with a
// fifth below 0.05; with a tenth a sheet of 0.01 runs. Test: coupler_immersed_boundary.
inline constexpr double enclosed_part = 0.1;

// The share for light bodies without lag grows with the density ratio by this factor, up
// to the limit of the kernel. Fitted to the energy of sheets of a tenth of the fluid's
// density: shares of 0.1 to 0.39 gain at most 2 % with the 3-point kernel, of 0.2 already
// 4.5 % with the 2-point kernel. The test has the limit of the 2-point kernel, and a
// factor above 1.5. Test: coupler_immersed_boundary.
inline constexpr double enclosed_part_per_ratio = 3;
inline constexpr double enclosed_most_two_point = 0.15, enclosed_most = 0.3;

// Share of bodies from this density ratio on, whose acceleration lags. A ball of ratio
// 1.1 vibrates with it on cells of 0.1 mm and, with 0.1, on those of 0.2 mm: no value is
// good at every step. Test: none.
inline constexpr double enclosed_part_of_dense = 0.3, dense_from_ratio = 0.5;

// Part of the second difference by which both ends of an implicit step's velocity are
// drawn back, with the penalty. The largest strength of the scheme, 1 / (4 parts),
// follows from it; at a strength of 1 without it the small swimmer's alternating velocity
// grows by 4 % a step. The test fails below 0.1. Test: unit_scene.
inline constexpr double drawn_back_penalty = 0.125;

// The same in forcing no_slip. With an eighth the swimmer at 0.2 mm diverged after 1560
// steps of 20 us, and 11 of 12 folding sheets gained energy; with a fifth all run.
// Test: none.
inline constexpr double drawn_back_no_slip = 0.2;

// Smallest density ratio of body to fluid at which the serial scheme was seen to be
// stable (tests/stability/map/density.yaml). Below it the inertia of the enclosed fluid,
// which that scheme follows one step late, may have to be implicit: so says the advice.
// Test: none.
inline constexpr double min_serial_ratio = 0.01;

// Density ratio of body to fluid below which bodies in contact rattle in the serial
// scheme: the force of the enclosed fluid, late by some steps, drives a body that bounces
// off. Balls of 0.4 are driven by 1 % of the work of their weight, of 0.3 by 18 %; 0.5 is
// right (tests/stability/map/rigid_contact.yaml). Test: unit_scene.
inline constexpr double least_serial_contact_ratio = 0.5;

// --- the fluid ------------------------------------------------------------------------

// Relaxation time from which the automatic collision is trt with the magic number 3/16.
// Closer to 1/2 the odd rate nearly vanishes if Lambda stays 3/16 (0.24 at tau = 0.55,
// 0.018 at 0.5035, 0.008 at 0.5015): a swimming robot and a Taylor-Green vortex diverged.
// Test: fluid_kernels.
inline constexpr double trt_from = 0.55;

// Magic number of recursive_mrt times the Reynolds number of a cell, that number from
// which on it falls with the square, and its least value. Fitted to the swimmer at 0.2
// mm, whose cells have 100: there 0.0025 to 0.0075 run for three periods, 0.01 for two
// and 0.05 for a fifth of one. Test: fluid_kernels.
inline constexpr double magic_times_reynolds = 0.75, steep_from_reynolds = 60;
inline constexpr double least_magic_number = 0.001;

// Speed [cells per step] that is taken where no speed is expected: usual in the scenes
// here. The test fails if it falls. Test: coupler_immersed_boundary.
inline constexpr double usual_lattice_speed = 0.05;

// Least relaxation rate of the trace of the stress, which bounds the bulk viscosity. In
// uniform flows of up to 0.15 cells a step no wave grows from 0.005 on
// (collision/bulk_viscosity.h). The test fails if it grows twofold.
// Test: fluid_sound_1.
inline constexpr double least_trace_rate = 0.01;

// Factor of the pull of a pressure outlet. From 0.1 to 0.58 sound of a wave length L
// reflects by a few per cent, and the mean pressure settles in about 4 L / cs steps. The
// test fails if it is more than doubled. Test: fluid_laws_1.
inline constexpr double pull_strength = 0.25;

// Largest Reynolds number of a cell at which viscosity still smooths velocity differences
// from cell to cell; above it `explain` warns, for both fluids. Test: none.
inline constexpr double max_cell_reynolds = 50;

// --- bodies ---------------------------------------------------------------------------

// Default distance of contact, in the longest diagonal of a surface's quads. From 0.5 on
// a node in the middle of four others feels all four; below 0.75 nodes slip through
// between nodes. Test: none.
inline constexpr double contact_distance = 0.75;

// Default stiffness of contact times its distance, over lambda + 2 G of the softest
// material. Surfaces pass through each other under a pressure of 0.22 (lambda + 2 G),
// which is five shear moduli for lambda = 20 G. Test: none.
inline constexpr double contact_stiffness = 0.25;

// Default stiffness of a platform times the body's thickness, over lambda + 2 G: half of
// that of a layer of the material under a rigid plate. Sheets sink in by less than 1 % of
// their thickness up to a pressure of 0.11 G (lambda = 20 G). Test: golden_scripts.
inline constexpr double platform_stiffness = 0.5;

// Length of an element's chord through the body, over that of the next longer one, below
// which the body is a sheet there. Test: none.
inline constexpr double sheet_chord = 0.75;

// Largest share of an element's mass that moves inwards for right moments of inertia. Two
// elements along an axis need 1/6; a node loses at most twice the share along a
// direction. The test fails below 1/6. Test: structure_lattice.
inline constexpr double most_moved_mass = 0.2;

// Parts of the limits of stability that the step at the start uses: the lattice stiffens
// by a few per cent when it is compressed. Test: golden_scripts.
inline constexpr double elastic_margin = 0.9;

// Angle by which a rigid part may swing or turn in a step where nothing soft sets the
// step [rad]: velocity Verlet then has an error of 0.01^2 / 24 = 4e-6 in a frequency.
// Test: structure_rigid_parts.
inline constexpr double rigid_turn_of_a_step = 0.01;

// Part of the limit of stability of the drag (explicit, limit 2 / rate), which then
// decays without overshoot. Test: none.
inline constexpr double drag_margin = 0.5;

// While bodies deform: the largest part of the present limit that a step may be, which
// moderate strains do not reach from 0.9 at rest, and the part that a new step is set to.
// Test: none.
inline constexpr double allowed_part = 0.95, chosen_part = 0.9;

// Range of the volume ratio of an element within which Newton's iteration still
// converges; the energy is not convex above e^(1 + G/K). Test: none.
inline constexpr double smallest_volume_ratio = 0.1, largest_volume_ratio = 2.5;

// Largest gain of energy that is no fault, over the largest work. A penalty force that
// begins within a step gains 1.2 %, unstable steps gain many times all works.
// Test: stability_map_in_parts.
inline constexpr double max_gain_of_work = 0.1;

// --- the cost model -------------------------------------------------------------------

// Cost of a cell update on a finer level, with its share of the exchange between levels,
// over that of a plain update. Measured on the tutorial swimmer: 3.3 with two levels;
// with one level 4.1 on a busy machine, 3.1 on an idle one. Test: none.
inline constexpr double finer_cell_cost = 3.2;

// Usual number of iterations of iqn_ils at its default tolerance; 2 to 4 were measured.
// Test: none.
inline constexpr double usual_iterations = 2.5;

// Time [s] of one element's dipole acting on another, measured with AVX2
// (docs/lab/effects.md). Test: none.
inline constexpr double s_per_dipole = 4e-9;

// Cells of the fluid for each rank or thread that is worth its messages. Test: none.
inline constexpr double cells_worth_a_rank = 20000;

// Rows of cells along x that are touched, per marker. Sheets with some markers per cell
// touch a thirtieth of a row per marker where they lie along x, and a fifth where they
// have bent across it. The fluid's memory hardly depends on it. Test: none.
inline constexpr double rows_per_marker = 0.1;

// Memory per cell [bytes] of OpenFOAM: fields, matrices and multigrid levels of
// pimpleFoam. Test: none.
inline constexpr double openfoam_bytes_per_cell = 1500;

}  // namespace magfsi::fitted
