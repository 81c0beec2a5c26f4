// SPDX-License-Identifier: GPL-2.0-or-later
// Between coupling and engine: cells of the uniform grid to cells of the mesh, forces per
// volume to accelerations, inlets over time.
#include "adapters/solvers/openfoam/foam_fluid.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "adapters/solvers/openfoam/case.h"
#include "adapters/solvers/openfoam/engine_library.h"
#include "adapters/solvers/openfoam/flow.h"
#include "adapters/solvers/openfoam/inlet.h"
#include "adapters/solvers/openfoam/mesh.h"
#include "adapters/solvers/openfoam/obstacles.h"
#include "adapters/solvers/openfoam/world_of_openfoam.h"
#include "base/words/path_word.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/participants/errors.h"

namespace magfsi::openfoam {

namespace {

int rank_in(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

int size_of(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

// Returns a path that OpenFOAM can use. It removes blanks and non-ASCII letters from
// paths; such a folder is opened and addressed through its file descriptor, which stays
// open as long as the process.
std::string way_for_openfoam(const std::filesystem::path& folder) {
    std::string way = std::filesystem::absolute(folder).string();
    if (words::path_word(way) == way) return way;
    const int descriptor = open(way.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        throw std::runtime_error(
            fmt::format("the folder {} cannot be opened: {}", way, std::strerror(errno)));
    return fmt::format("/proc/self/fd/{}", descriptor);
}

// Courant number above which a run counts as diverged; the explicit force is unstable far
// below it.
constexpr double max_courant = 10;

}  // namespace

// Rank 0 writes the case; between the two barriers all ranks read it. The communicator
// replaces MPI_COMM_WORLD before OpenFOAM is loaded, since its start-up uses it.
FoamFluid::FoamFluid(MPI_Comm comm, const scene::Fluid& fluid, const CaseTimes& times,
                     const std::filesystem::path& case_folder, bool finds_force)
    : comm_(comm),
      fluid_(fluid),
      step_s_(times.step_s),
      mesh_(to_mesh(fluid, rank_in(comm), size_of(comm))),
      cells_(mesh_cells(mesh_)),
      grid_(to_grid(fluid, mesh_)) {
    const std::size_t cut = mesh_.cut_axis;
    const std::size_t rank = mesh_.rank;
    first_[cut] = mesh_.first_cell[rank];
    cells_[cut] = mesh_.first_cell[rank + 1] - first_[cut];
    for (std::size_t d = 0; d < 3; ++d) {
        cell_of_[d] = cell_of_uniform(mesh_.planes_m[d], fluid.spacing_m);
        const double* plane = mesh_.planes_m[d].data() + first_[d];
        for (int i = 0; i < cells_[d]; ++i)
            width_m_[d].push_back(plane[i + 1] - plane[i]);
    }
    const ObstaclePlan plan = plan_obstacles(fluid, mesh_);
    CaseTimes with_plan = times;
    with_plan.snapped = !plan.snapped.empty();
    if (mesh_.rank == 0) {
        write_case(case_folder, fluid, with_plan, size_of(comm));
        if (!fluid.obstacles.empty()) make_obstacle_mesh(case_folder, fluid, mesh_, plan);
    }
    MPI_Barrier(comm);
    set_world(comm);
    const scene::OpenFoam own = fluid.openfoam.value_or(scene::OpenFoam{});
    engine_ =
        load_engine({way_for_openfoam(case_folder), mesh_, !fluid.obstacles.empty(),
                     own.functions.has_value(), own.write.has_value(), !finds_force});
    if (!fluid.obstacles.empty()) take_cells();
    if (fluid.body_force_n_m3) begin_force();
    for (int side = 0; side < 6; ++side) {
        if (fluid.boundaries[side].kind != fluid::BoundaryKind::velocity_inlet) continue;
        if (double* faces = engine_->side_velocity(side))
            inlets_.push_back(
                {side, faces,
                 fluid.obstacles.empty()
                     ? slab_shape(fluid_, mesh_, side)
                     : shape_at_faces(fluid_, mesh_, side, engine_->side_faces(side))});
    }
    MPI_Barrier(comm);  // all ranks have read the case
    if (mesh_.rank == 0) complete_case(case_folder, fluid, with_plan, mesh_);
    set_inlets(0);
}

// The cells of a mesh with obstacles are a list: a row along x with the volumes as
// widths. A cell of the uniform grid without one is solid.
void FoamFluid::take_cells() {
    ReadCells cells = engine_->cells();
    width_m_ = {std::move(cells.volume_m3), {1}, {1}};
    centre_m_ = std::move(cells.centre_m);
    std::vector<std::array<double, 3>> points;
    for (int z = 0; z < grid_.cells[2]; ++z)
        for (int y = 0; y < grid_.cells[1]; ++y)
            for (int x = 0; x < grid_.cells[0]; ++x)
                points.push_back({(x + 0.5) * grid_.spacing_m,
                                  (y + 0.5) * grid_.spacing_m,
                                  (z + 0.5) * grid_.spacing_m});
    listed_cell_ = engine_->find(points);
}

// Adds the momentum source and fills it with the body force.
void FoamFluid::begin_force() {
    acceleration_ = engine_->acceleration();
    for (std::size_t cell = 0; cell < cell_count(width_m_); ++cell)
        std::ranges::copy(everywhere(), acceleration_ + 3 * cell);
}

// (x, y, z) must be a cell of the uniform grid that this rank owns.
std::size_t FoamFluid::cell_at(int x, int y, int z) const {
    if (!listed_cell_.empty()) {
        const auto n = static_cast<std::size_t>(grid_.cells[0]);
        const auto rows = static_cast<std::size_t>(grid_.cells[1]);
        const int cell = listed_cell_[static_cast<std::size_t>(x) +
                                      n * (static_cast<std::size_t>(y) +
                                           rows * static_cast<std::size_t>(z))];
        return cell < 0 ? solid : static_cast<std::size_t>(cell);
    }
    const std::array<int, 3> at{x, y, z};
    std::array<int, 3> i{};
    for (std::size_t d = 0; d < 3; ++d) i[d] = cell_of_[d][at[d]] - first_[d];
    return static_cast<std::size_t>(i[0]) +
           static_cast<std::size_t>(cells_[0]) *
               (static_cast<std::size_t>(i[1]) +
                static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(i[2]));
}

// The fluid is incompressible: its density relative to the mean is 1 everywhere.
void FoamFluid::velocity(std::span<const coupler::GridRow> rows, std::span<double> out,
                         std::span<double> relative_density) {
    std::ranges::fill(relative_density, 1.0);
    const double* from = again_ ? kept_.velocity.data() : engine_->velocity();
    double* to = out.data();
    for (const coupler::GridRow& row : rows) {
        for (int x = row.x_begin; x < row.x_end; ++x, to += 3) {
            const std::size_t cell = cell_at(x, row.y, row.z);
            if (cell == solid)
                std::fill_n(to, 3, 0.0);
            else
                std::copy_n(from + 3 * cell, 3, to);
        }
    }
}

// The force of each uniform cell goes to the mesh cell that holds its centre, weighted by
// the ratio of volumes: the total force on the fluid equals what the bodies gave.
void FoamFluid::set_force(std::span<const coupler::GridRow> rows,
                          std::span<const double> density) {
    if (acceleration_ == nullptr) begin_force();
    clear_force();
    const double h = grid_.spacing_m;
    const double* from = density.data();
    for (const coupler::GridRow& row : rows) {
        for (int x = row.x_begin; x < row.x_end; ++x, from += 3) {
            const std::size_t cell = cell_at(x, row.y, row.z);
            if (cell == solid) continue;  // an obstacle takes the force
            const double share = h * h * h / volume(width_m_, cell);
            for (std::size_t d = 0; d < 3; ++d)
                acceleration_[3 * cell + d] += from[d] * share / fluid_.density_kg_m3;
            forced_.push_back(cell);
        }
    }
}

scene::Vec3 FoamFluid::everywhere() const {
    scene::Vec3 acceleration{};
    if (fluid_.body_force_n_m3) acceleration = *fluid_.body_force_n_m3;
    for (double& a : acceleration) a /= fluid_.density_kg_m3;
    return acceleration;
}

// Resets only the cells with a coupling force to the body force.
void FoamFluid::clear_force() {
    for (const std::size_t cell : forced_)
        std::ranges::copy(everywhere(), acceleration_ + 3 * cell);
    forced_.clear();
}

// Sets the inlets' faces to the velocity at this time; OpenFOAM's own condition there is
// a fixed value.
void FoamFluid::set_inlets(double time_s) {
    for (const Inlet& inlet : inlets_) {
        const auto& side = fluid_.boundaries[inlet.side];
        const double ramp = inlet_ramp(side, time_s);
        for (std::size_t i = 0; i < 3 * inlet.shape.size(); ++i)
            inlet.velocity[i] =
                ramp * inlet.shape[i / 3] * side.inlet.velocity_m_s[i % 3];
    }
}

// Inlets have the values of the step's end, as the implicit time scheme needs. Forces
// hold for one step.
void FoamFluid::advance() {
    if (again_) {
        engine_->answer_again();
    } else {
        ++steps_;
        set_inlets(1.0 * steps_ * step_s_);
        engine_->advance(std::exchange(may_repeat_, false));
    }
    again_ = false;
    clear_force();
}

void FoamFluid::start_from(Flow flow) {
    std::vector<double> velocity(3 * cell_count(width_m_));
    for (std::size_t cell = 0; cell < cell_count(width_m_); ++cell)
        std::ranges::copy(flow(centre(cell)), velocity.data() + 3 * cell);
    engine_->set_velocity(velocity.data());
}

// Centre [m] of a cell of this rank, in the box's frame.
scene::Vec3 FoamFluid::centre(std::size_t cell) const {
    if (!centre_m_.empty()) return scene::Vec3{centre_m_[cell]};
    const auto i = index_of(width_m_, cell);
    scene::Vec3 at{};
    for (std::size_t d = 0; d < 3; ++d) {
        const auto plane = static_cast<std::size_t>(first_[d]) + i[d];
        at[d] = (mesh_.planes_m[d][plane] + mesh_.planes_m[d][plane + 1]) / 2;
    }
    return at;
}

std::string FoamFluid::headline() const {
    const auto n = mesh_cells(mesh_);
    return fmt::format(
        "{} x {} x {} cells of {:.4g} mm{}, step {:.4g} us, pimpleFoam of OpenFOAM {}",
        n[0], n[1], n[2], fluid_.spacing_m * 1e3, fluid_.grading ? " and larger" : "",
        step_s_ * 1e6, versions().front().second);
}

// Kinetic energy [J], mass [kg], largest speed [m/s] and momentum [kg m/s] of the whole
// box. Collective.
fluids::FluidTotals FoamFluid::totals() {
    const FlowSums sums = flow_sums(comm_, width_m_, engine_->velocity(), {});
    fluids::FluidTotals all{fluid_.density_kg_m3 * sums.half_square_m5_s2,
                            fluid_.density_kg_m3 * sums.volume_m3, sums.max_speed_m_s};
    all.momentum_kg_m_s = fluid_.density_kg_m3 * sums.flow_m4_s;
    return all;
}

std::vector<scene::Vec3> FoamFluid::obstacle_forces() {
    std::vector<scene::Vec3> forces;
    for (const scene::Obstacle& obstacle : fluid_.obstacles)
        forces.push_back(fluid_.density_kg_m3 *
                         scene::Vec3{engine_->force_on(patch_name(obstacle))});
    return forces;
}

// The mean enstrophy density, |curl u|^2 / 2 [1/s2], is the only quantity beyond
// totals(). Collective.
double FoamFluid::quantity(scene::FluidQuantity quantity) {
    if (quantity != scene::FluidQuantity::enstrophy)
        throw std::logic_error("no probe of OpenFOAM");
    std::vector<double> vorticity(3 * cell_count(width_m_));
    engine_->vorticity(vorticity.data());
    return flow_sums(comm_, width_m_, engine_->velocity(), vorticity).enstrophy_1_s2;
}

// OpenFOAM's pressure is that over the density.
fluids::PlaneFlow FoamFluid::plane_flow(int axis, double at_m) {
    const PlaneSums sums = engine_->plane(axis, at_m);
    const double density = fluid_.density_kg_m3;
    return {sums.flow, density * scene::Vec3{sums.momentum},
            sums.area > 0 ? density * sums.pressure / sums.area : 0};
}

// Values in the order of the uniform cells of this rank, x fastest, also on graded
// meshes; pressure is gauge pressure [Pa].
void FoamFluid::field(scene::FluidField field, std::size_t, std::span<float> out) {
    if (field == scene::FluidField::density) {
        std::ranges::fill(out, static_cast<float>(fluid_.density_kg_m3));
        return;
    }
    std::vector<double> made;
    const double* values = engine_->velocity();
    const float in_solid = field == scene::FluidField::obstacle ? 1 : 0;
    if (field == scene::FluidField::obstacle) {
        made.assign(cell_count(width_m_), 0.0);
        values = made.data();
    }
    if (field == scene::FluidField::vorticity) {
        made.resize(3 * cell_count(width_m_));
        engine_->vorticity(made.data());
        values = made.data();
    } else if (field == scene::FluidField::pressure) {
        FlowState state;
        engine_->keep(state);
        made = std::move(state.pressure);
        for (double& value : made) value *= fluid_.density_kg_m3;
        values = made.data();
    }
    const std::size_t components = scene::components_of(field);
    const coupler::CellBox& box = grid_.owned_by_rank[mesh_.rank].front();
    float* to = out.data();
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x) {
                const std::size_t cell = cell_at(x, y, z);
                for (std::size_t d = 0; d < components; ++d)
                    *to++ = cell == solid
                                ? in_solid
                                : static_cast<float>(values[components * cell + d]);
            }
        }
    }
}

// Checks this rank's cells; the run ends if any rank throws.
void FoamFluid::check_divergence() {
    const FastestCell fastest = fastest_cell(cell_count(width_m_), engine_->velocity());
    const double courant = fastest.speed_m_s * step_s_ / grid_.spacing_m;
    if (courant < max_courant) return;  // false for NaN
    const scene::Vec3 at = centre(fastest.cell);
    throw coupler::Diverged(
        fmt::format("the fluid diverged at ({:.4g}, {:.4g}, {:.4g}) m: speed {:.4g} m/s, "
                    "{:.3g} cells per step; take a smaller time.step",
                    at[0], at[1], at[2], fastest.speed_m_s, courant));
}

// Counts the cells of the whole mesh, which on graded meshes are fewer than those of the
// uniform grid.
output::FluidSummary FoamFluid::summary() const {
    const auto n = mesh_cells(mesh_);
    output::FluidSummary summary;
    summary.cells = centre_m_.empty() ? static_cast<std::int64_t>(n[0]) * n[1] * n[2]
                                      : static_cast<std::int64_t>(centre_m_.size());
    summary.spacing_m = fluid_.spacing_m;
    summary.kernel = "pimpleFoam";
    return summary;
}

output::Named<std::string> FoamFluid::versions() const {
    return {{"OpenFOAM", engine_->version()}};
}

// Stores the state at the start of a step that the implicit scheme may repeat.
void FoamFluid::keep() {
    engine_->keep(kept_);
    kept_steps_ = steps_;
    may_repeat_ = true;
}

// The next advance goes on from the step's momentum equation if that was kept; until then
// velocity() is the kept one.
void FoamFluid::go_back() {
    again_ = engine_->can_answer_again();
    if (again_) return;
    engine_->go_back(kept_, kept_steps_);
    steps_ = kept_steps_;
    may_repeat_ = true;
}

// Collective; `file` is null except on the root.
void FoamFluid::save(coupler::StateWriter* file) {
    FlowState state;
    engine_->keep(state);
    if (centre_m_.empty())
        save_flow(comm_, mesh_, state, file);
    else
        save_listed_flow(state, file);
}

// Boundary values of inlets are not part of the state and are set for the checkpoint's
// time first.
void FoamFluid::restore(const coupler::StateReader& file) {
    steps_ = file.header().step;
    set_inlets(1.0 * steps_ * step_s_);
    engine_->go_back(centre_m_.empty() ? load_flow(mesh_, file)
                                       : load_listed_flow(engine_.get(), file),
                     steps_);
}

}  // namespace magfsi::openfoam
