// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/obstacle/obstacles.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

// The cell that lies `steps` links away along q.
Cell neighbour(const Cell& cell, int q, int steps) {
    return {cell[0] + steps * c[q][0], cell[1] + steps * c[q][1],
            cell[2] + steps * c[q][2]};
}

// Distance of the wall from the fluid cell along q, as a fraction of the link. It is
// measured from the solid cell's place in the box, so that links through a periodic side
// find the body.
double wall_distance(const SolidMap& map, const Solid& solid, const Cell& cell, int q) {
    const Cell end = map.global(neighbour(cell, q, 1));
    Vec3 inside, outside;
    for (int a = 0; a < 3; ++a) {
        inside[a] = end[a] + 0.5;
        outside[a] = inside[a] - c[q][a];
    }
    return solid.entry(outside, inside);
}

// True if the cell behind the fluid cell, which interpolation reads, is fluid, too.
bool has_fluid_behind(const SolidMap& map, const Cell& cell, int q) {
    const Cell behind = neighbour(cell, q, -1);
    return map.in_box(behind) && !map.solid(behind);
}

// True in the four layers beside an inlet, where a wall's links are half-way ones.
// Interpolation does not keep mass where the velocity changes along the wall, as from an
// inlet's profile to the tube's own: in tubes 5 to 16 cells wide it makes up to 2.3 % of
// the flow, half-way links and interpolated ones behind them 0.03 %, where the wall of a
// square tube lies 0.2 cells from half-way 1 %.
bool is_beside_inlet(const FluidConfig& config, const SolidMap& map, const Cell& local) {
    constexpr int layers = 4;
    const Cell cell = map.global(local);
    for (int side = 0; side < 6; ++side) {
        if (config.boundaries[side].kind != BoundaryKind::velocity_inlet) continue;
        const int axis = axis_of(side);
        const int from = side % 2 == 0 ? cell[axis] : config.cells[axis] - 1 - cell[axis];
        if (from < layers) return true;
    }
    return false;
}

// A link of a cell. from_wall: direction of the population that comes from the obstacle.
CutLink cut_link(const Populations& populations, const RowLayout& layout,
                 const Cell& cell, int from_wall, const int (&push)[3], double distance,
                 int obstacle) {
    CutLink link;
    for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
        const auto i = static_cast<int>(a);
        const CellSlots slots = populations.visit(
            [&](const auto& rows) { return cell_slots(rows, layout, a, cell); });
        link.from_wall[i] = slots[from_wall];
        link.to_wall[i] = slots[opposite(from_wall)];
    }
    for (int a = 0; a < 3; ++a) link.push[a] = static_cast<signed char>(push[a]);
    link.distance = distance;
    link.obstacle = link.hit = static_cast<short>(obstacle);
    for (int a = 0; a < 3; ++a) link.cell[a] = static_cast<short>(cell[a]);
    return link;
}

// Calls add(cell, from_wall, push, distance, obstacle) for each link of a cell that ends
// in an obstacle.
template <class Add>
void add_direct(const FluidConfig& config, const SolidMap& map, const Solids& solids,
                const Cell& cell, const Add& add) {
    const bool half_way = is_beside_inlet(config, map, cell);
    for (int q = 1; q < directions; ++q) {
        const int hit = map.obstacle(neighbour(cell, q, 1));
        if (hit == SolidMap::fluid) continue;
        const double distance = !half_way && has_fluid_behind(map, cell, q)
                                    ? wall_distance(map, *solids[hit], cell, q)
                                    : 0.5;
        add(cell, opposite(q), c[q], distance, hit);
    }
}

// The same for links of the cell to a side with free slip that are reflected into an
// obstacle.
template <class Add>
void add_reflected(const FluidConfig& config, const SolidMap& map, const Cell& cell,
                   const Add& add) {
    for (int side = 0; side < 6; ++side) {
        if (config.boundaries[side].kind != BoundaryKind::free_slip) continue;
        const int axis = axis_of(side);
        Cell beyond = cell;
        beyond[axis] -= inward(side);
        if (map.in_box(beyond)) continue;
        for (int q = 1; q < directions; ++q) {
            if (c[q][axis] != inward(side)) continue;
            Cell partner = cell;
            int push[3];
            for (int a = 0; a < 3; ++a) {
                push[a] = a == axis ? c[q][a] : -c[q][a];
                if (a != axis) partner[a] -= c[q][a];
            }
            if (!map.in_box(partner) || !map.solid(partner)) continue;
            add(cell, q, push, 0.5, map.obstacle(partner));
        }
    }
}

// All links of this rank into obstacles, cell by cell.
CutLinks cut_links(const FluidConfig& config, const SolidMap& map, const Solids& solids,
                   const Populations& populations, const RowLayout& layout) {
    CutLinks links;
    const auto into = [&](std::vector<CutLink>& list) {
        return [&](const auto&... link) {
            list.push_back(cut_link(populations, layout, link...));
        };
    };
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            if (!map.near_solid(y, z)) continue;
            for (int x = 0; x < layout.nx; ++x) {
                const Cell cell{x, y, z};
                if (map.solid(cell)) continue;
                add_direct(config, map, solids, cell, into(links.direct));
                add_reflected(config, map, cell, into(links.reflected));
            }
        }
    }
    return links;
}

// Shares of this rank's cells. A cell at a wall and the one behind it may be of two
// ranks, or of the two ends of a periodic axis: each cell takes its own part, wherever
// the other one is.
std::vector<SurfaceShare> find_shares(const FluidConfig& config, const SolidMap& map,
                                      const Solids& solids, const RowLayout& layout) {
    const CellBox owned{{0, 0, 0}, {layout.nx, layout.ny, layout.nz}};
    std::map<Cell, Vec3> of_cell;
    const auto add = [&](const Cell& cell, int axis, double share) {
        for (int a = 0; a < 3; ++a) {
            if (cell[a] < owned.lo[a] || cell[a] >= owned.hi[a]) return;
        }
        of_cell[cell][axis] += share;
    };
    CellBox around = owned;
    for (int a = 0; a < 3; ++a) {
        --around.lo[a];
        ++around.hi[a];
    }
    for_each_cell(around, [&](const Cell& cell) {
        if (!map.near_solid(cell[1], cell[2]) || !map.in_box(cell) || map.solid(cell) ||
            is_beside_inlet(config, map, cell))
            return;
        for (int q = 1; q <= 6; ++q) {  // along the three axes
            const int axis = (q - 1) / 2;
            const int hit = map.obstacle(neighbour(cell, q, 1));
            if (hit == SolidMap::fluid || !has_fluid_behind(map, cell, q)) continue;
            const double d = wall_distance(map, *solids[hit], cell, q);
            const double share = (d - 0.5) * (d - 0.5) / (2 * (1 + 2 * d));
            add(cell, axis, share);
            add(neighbour(cell, q, -1), axis, share);
        }
    });
    std::vector<SurfaceShare> shares;
    for (const auto& [cell, share] : of_cell) shares.push_back({cell, share});
    return shares;
}

}  // namespace

Obstacles::Obstacles(const FluidConfig& config, const Solids& solids,
                     const CellBox& owned, const Populations& populations,
                     const RowLayout& layout)
    : map_(config, solids, owned),
      links_(cut_links(config, map_, solids, populations, layout)),
      impulses_(solids.size() + 1) {
    if (config.measures_planes) shares_ = find_shares(config, map_, solids, layout);
    find_rows(layout);
}

void Obstacles::count_only(const std::function<bool(const Cell& local)>& counts) {
    for (auto* links : {&links_.direct, &links_.reflected}) {
        for (CutLink& link : *links) {
            const Cell cell{link.cell[0], link.cell[1], link.cell[2]};
            link.obstacle = counts(cell) ? link.hit : static_cast<short>(count());
        }
    }
}

void Obstacles::find_rows(const RowLayout& layout) {
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            for (int x = 0; x < layout.nx; ++x) {
                if (!map_.solid({x, y, z})) continue;
                const int begin = x;
                while (x < layout.nx && map_.solid({x, y, z})) ++x;
                rows_.push_back({y, z, begin, x});
            }
        }
    }
}

// The slots of a reflected link hold the bounced population until free slip is applied.
void Obstacles::note_sent(const Populations& populations, Arrangement arrangement) {
    sent_to_slip_.clear();
    populations.visit([&](const auto& rows) {
        const auto* const base = rows.row(0, 0);
        for (const CutLink& link : links_.reflected) {
            sent_to_slip_.push_back(base[link.from_wall[static_cast<int>(arrangement)]]);
        }
    });
}

namespace {

// The population that the wall returns along a link (equation in the header). base: the
// populations; before, now: the arrangements of the step.
template <class Real>
double returned(const CutLink& link, const Real* base, int before, int now) {
    const double d = link.distance;
    // The outgoing population is at the old slot of its opposite.
    const double sent = base[link.from_wall[before]];
    if (d == 0.5) return sent;
    if (d < 0.5) return 2 * d * sent + (1 - 2 * d) * base[link.to_wall[now]];
    return sent / (2 * d) + (1 - 1 / (2 * d)) * base[link.to_wall[before]];
}

}  // namespace

void Obstacles::add_impulse(const CutLink& link, double populations) {
    for (int a = 0; a < 3; ++a) {
        impulses_[link.obstacle][a] += link.push[a] * populations;
    }
}

void Obstacles::bounce(const Populations& populations, Arrangement arrangement) {
    const int now = static_cast<int>(arrangement), before = 1 - now;
    std::fill(impulses_.begin(), impulses_.end(), Vec3{});
    populations.visit([&](const auto& rows) {
        auto* const base = rows.row(0, 0);
        using Real = std::remove_reference_t<decltype(*base)>;
        for (const CutLink& link : links_.direct) {
            const double sent = base[link.from_wall[before]];
            const Real stored = static_cast<Real>(returned(link, base, before, now));
            base[link.from_wall[now]] = stored;
            add_impulse(link, sent + stored);
        }
        for (std::size_t i = 0; i < links_.reflected.size(); ++i) {
            const CutLink& link = links_.reflected[i];
            base[link.from_wall[now]] = static_cast<Real>(sent_to_slip_[i]);
            add_impulse(link, 2 * sent_to_slip_[i]);
        }
    });
}

void Obstacles::reset_solid_cells(const Populations& populations, const RowLayout& layout,
                                  Arrangement arrangement) const {
    populations.visit([&](const auto& rows) {
        auto* const base = rows.row(0, 0);
        for (const CellRow& run : rows_) {
            const auto p = pointers(rows, layout, arrangement, run.y, run.z);
            // The row's pointers are not valid at the ends of the row.
            const int begin = std::max(run.x_begin, 1);
            const int end = std::min(run.x_end, layout.nx - 1);
            for (int q = 0; q < d3q19::directions && begin < end; ++q) {
                std::fill(p.at[q] + begin, p.at[q] + end, 0);
            }
            for (const int x : {0, layout.nx - 1}) {
                if (x < run.x_begin || x >= run.x_end) continue;
                for (const auto slot :
                     cell_slots(rows, layout, arrangement, {x, run.y, run.z})) {
                    base[slot] = 0;
                }
            }
        }
    });
}

namespace {

void check_counts(const FluidConfig& config, const std::vector<long long>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] > 0) continue;
        refuse("fluid obstacle \"", config.obstacles[i].name,
               "\" holds the centre of no cell that is not an earlier obstacle's; make "
               "the spacing, now ",
               config.spacing_m, " m, finer, or leave out what is there twice");
    }
    const auto& [nx, ny, nz] = config.cells;
    if (std::reduce(cells.begin(), cells.end()) == 1LL * nx * ny * nz)
        refuse(
            "fluid obstacles fill the whole box and leave no cell of fluid; make them "
            "smaller or the box larger");
}

}  // namespace

void check_resolved(MPI_Comm comm, const FluidConfig& config, const SolidMap& map) {
    std::vector<long long> cells = map.cell_counts();
    MPI_Allreduce(MPI_IN_PLACE, cells.data(), cells.size(), MPI_LONG_LONG, MPI_SUM, comm);
    check_counts(config, cells);
}

void check_obstacles(const FluidConfig& config) {
    if (config.obstacles.empty()) return;
    const SolidMap map(config, make_solids(config), {{0, 0, 0}, config.cells});
    check_counts(config, map.cell_counts());
    for (int side = 0; side < 6; ++side) {
        if (inflow_m3_s(config, side) != 0 &&
            share_past_obstacles(config, map, side) <= 0)
            refuse("fluid inlet at ", side_name[side],
                   " lies behind fluid.obstacles, which let none of its flow into the "
                   "box; move them, or give the inlet an opening beside them");
    }
}

// Of the cells in obstacles, those at the rim of an opening pass their flow on to the
// others (effects/velocity_inlet.cpp); what enters the rest is lost.
double share_past_obstacles(const FluidConfig& config, const SolidMap& map, int side) {
    const auto velocity = inlet_velocity(config, side);
    double open = 0, lost = 0;
    for_each_cell(*cells_at_side({{0, 0, 0}, config.cells}, config.cells, side),
                  [&](const Cell& cell) {
                      if (!is_open(config, side, cell)) return;
                      const double flow = std::abs(velocity(cell)[axis_of(side)]);
                      const bool solid = map.solid(cell);
                      if (solid && !holds_centre(config, side, cell)) return;
                      open += flow;
                      if (solid) lost += flow;
                  });
    return open > 0 ? 1 - lost / open : 0;
}

}  // namespace magfsi::fluid
