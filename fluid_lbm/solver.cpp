#include "fluid_lbm/solver.h"

#include "fluid_lbm/streaming/sweep.h"

namespace magfsi::fluid {

namespace {

int comm_rank(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

int comm_size(MPI_Comm comm) {
    int size = 1;
    MPI_Comm_size(comm, &size);
    return size;
}

Storage storage(const AnyKernels& kernels) {
    return std::holds_alternative<ChosenKernels<float>>(kernels) ? Storage::float_
                                                                 : Storage::double_;
}

std::optional<Obstacles> make_obstacles(const SolverConfig& config, const CellBox& box,
                                        const Populations& populations,
                                        const RowLayout& layout) {
    if (config.solids.empty()) return {};
    LinkOptions options;
    options.wall = config.obstacle_wall;
    for (int side = 0; side < 6; ++side) {
        options.free_slip[side] = config.sides[side].kind == BoundaryKind::free_slip;
    }
    return std::optional<Obstacles>(std::in_place, config.solids, box, config.cells,
                                    config.periodic, options, populations, layout);
}

// Whether nothing else changes populations in a step.
bool sweep_is_all(const SolverConfig& config) {
    for (int side = 0; side < 6; ++side) {
        const BoundaryKind kind = config.sides[side].kind;
        const bool plain = config.periodic[side / 2] ||
                           (kind == BoundaryKind::no_slip &&
                            config.wall_velocity[side] == std::array<double, 3>{});
        if (!plain) return false;
    }
    return config.solids.empty() && !config.body_force;
}

}  // namespace

Solver::Solver(MPI_Comm comm, const SolverConfig& config)
    : decomposition_(decompose(config.cells, config.periodic, comm_size(comm))),
      rank_(comm_rank(comm)),
      layout_(decomposition_.layout(rank_)),
      populations_(layout_.nx, layout_.row_count(), storage(config.kernels)),
      halo_(comm, decomposition_, rank_, populations_),
      rows_at_cuts_(fluid::rows_at_cuts(layout_)),
      inner_rows_(fluid::inner_rows(layout_)),
      obstacles_(
          make_obstacles(config, decomposition_.boxes[rank_], populations_, layout_)),
      boundaries_({comm, decomposition_, rank_, config.sides, config.wall_velocity,
                   populations_, layout_, obstacles_ ? &obstacles_->map() : nullptr}),
      kernels_(config.kernels),
      collision_(config.collision),
      sweep_is_all_(sweep_is_all(config)) {
    if (config.body_force) make_forces(config.body_force);
    for (int side = 0; side < 6; ++side) {
        open_sides_[side] = config.sides[side].kind != BoundaryKind::periodic &&
                            config.sides[side].kind != BoundaryKind::no_slip;
    }
}

void Solver::make_forces(const std::optional<std::array<double, 3>>& body_force) {
    forces_ = std::make_unique<ForcedRows>(layout_.nx, layout_.ny, layout_.nz, body_force,
                                           populations_.storage());
}

void Solver::sweep_boxes(std::span<const RowBox> boxes) {
    const SweepInput in{populations_,  layout_,  arrangement_,
                        forces_.get(), kernels_, collision_};
    for (const RowBox& box : boxes) {
        const auto found = sweep(in, box);
        if (!found) continue;
        const bool first =
            !unsound_ || (unsound_->step == steps_done_ && found->before(unsound_->cell));
        if (first) unsound_ = Unsound{*found, steps_done_};
    }
}

// A link crosses a side or a wall in the middle of the step.
void Solver::apply_boundaries() {
    if (obstacles_) obstacles_->look(populations_, arrangement_);
    boundaries_.enter(populations_, layout_, static_cast<double>(steps_done_) + 0.5);
    if (obstacles_) obstacles_->bounce(populations_, arrangement_);
    settle_obstacles();  // an outlet may look into them
    boundaries_.end_step(populations_, arrangement_);
}

void Solver::settle_obstacles() {
    if (obstacles_) obstacles_->settle(populations_, layout_, arrangement_);
}

void Solver::keep() {
    if (!kept_) kept_ = std::make_unique<KeptState>(sweep_is_all_);
    kept_->keep(view());
}

void Solver::go_back() {
    set_steps_done(steps_done_ - 1);
    kept_->put_back(view());
    again_ = true;
    // What the forces of that time have done is undone.
    const bool undone =
        unsound_ && (!kept_->by_rows() || kept_->has(unsound_->cell.y, unsound_->cell.z));
    if (undone) unsound_.reset();
}

void Solver::sweep_and_exchange(Exchange exchange) {
    if (again_ && kept_->by_rows()) {
        // The other rows stand at the step's end already, and what travelled for them is
        // sent once more as it was.
        sweep_boxes(kept_->rows());
        halo_.start(exchange);
        halo_.advance();
        halo_.finish();
        return;
    }
    const std::span<const RowBox> inner = inner_rows_;
    const std::size_t half = inner.size() / 2;
    sweep_boxes(rows_at_cuts_);
    halo_.start(exchange);
    sweep_boxes(inner.first(half));
    halo_.advance();
    sweep_boxes(inner.subspan(half));
    halo_.finish();
}

void Solver::step() {
    const bool natural = arrangement_ == Arrangement::natural;
    if (kept_) kept_->note_rows(view(), forces().claimed_rows());
    boundaries_.before_sweep(populations_, arrangement_);
    sweep_and_exchange(natural ? Exchange::fill : Exchange::give_back);
    again_ = false;
    arrangement_ = natural ? Arrangement::swapped : Arrangement::natural;
    apply_boundaries();
    if (forces_) forces_->clear();
    ++steps_done_;
}

}  // namespace magfsi::fluid
