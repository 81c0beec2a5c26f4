#include "fluid_lbm/obstacle/cut_links.h"

#include <cmath>
#include <utility>

namespace magfsi::fluid {

namespace {

using namespace d3q19;

Cell neighbor(const Cell& cell, int q, int steps) {
    return {cell[0] + steps * c[q][0], cell[1] + steps * c[q][1],
            cell[2] + steps * c[q][2]};
}

// Of the way from the fluid cell along q, one link long. Measured from the solid cell's
// place in the box, so that links through a periodic side find the body.
double wall_distance(const SolidMap& map, const Solid& solid, const Cell& cell, int q) {
    const Cell end = map.global(neighbor(cell, q, 1));
    Vec3 inside, outside;
    for (int a = 0; a < 3; ++a) {
        inside[a] = end[a] + 0.5;
        outside[a] = inside[a] - c[q][a];
    }
    return solid.entry(outside, inside);
}

// Interpolation reads the cell behind the fluid cell.
bool has_fluid_behind(const SolidMap& map, const Cell& cell, int q) {
    const Cell behind = neighbor(cell, q, -1);
    return map.in_box(behind) && !map.solid(behind);
}

class LinkList {
  public:
    LinkList(const Populations& populations, const RowLayout& layout)
        : populations_(populations), layout_(layout) {}

    // from_wall: the population that comes from the obstacle.
    void add(const Cell& cell, int from_wall, const int (&push)[3], double distance,
             int obstacle) {
        CutLink link;
        for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
            const int i = static_cast<int>(a);
            const CellSlots slots = populations_.visit(
                [&](const auto& rows) { return cell_slots(rows, layout_, a, cell); });
            link.from_wall[i] = slots[from_wall];
            link.to_wall[i] = slots[opposite(from_wall)];
        }
        for (int a = 0; a < 3; ++a) link.push[a] = static_cast<signed char>(push[a]);
        link.distance = distance;
        link.obstacle = static_cast<short>(obstacle);
        links_.push_back(link);
    }

    std::vector<CutLink> take() { return std::move(links_); }

  private:
    const Populations& populations_;
    const RowLayout& layout_;
    std::vector<CutLink> links_;
};

void add_direct(const SolidMap& map, const Solids& solids, ObstacleWall wall,
                const Cell& cell, LinkList& links) {
    for (int q = 1; q < directions; ++q) {
        const int hit = map.obstacle(neighbor(cell, q, 1));
        if (hit == SolidMap::fluid) continue;
        const bool interpolate =
            wall == ObstacleWall::interpolated && has_fluid_behind(map, cell, q);
        const double distance =
            interpolate ? wall_distance(map, *solids[hit], cell, q) : 0.5;
        links.add(cell, opposite(q), c[q], distance, hit);
    }
}

// Links to the sides with free slip that are reflected into an obstacle.
void add_reflected(const SolidMap& map, const std::array<bool, 6>& free_slip,
                   const Cell& cell, LinkList& links) {
    for (int side = 0; side < 6; ++side) {
        const int axis = axis_of(side);
        Cell beyond = cell;
        beyond[axis] -= inward(side);
        if (!free_slip[side] || map.in_box(beyond)) continue;
        for (int q = 1; q < directions; ++q) {
            if (c[q][axis] != inward(side)) continue;
            Cell partner = cell;
            int push[3];
            for (int a = 0; a < 3; ++a) {
                push[a] = a == axis ? c[q][a] : -c[q][a];
                if (a != axis) partner[a] -= c[q][a];
            }
            if (!map.in_box(partner) || !map.solid(partner)) continue;
            links.add(cell, q, push, 0.5, map.obstacle(partner));
        }
    }
}

}  // namespace

CutLinks cut_links(const SolidMap& map, const Solids& solids, const LinkOptions& options,
                   const Populations& populations, const RowLayout& layout) {
    LinkList direct(populations, layout), reflected(populations, layout);
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            if (!map.near_solid(y, z)) continue;
            for (int x = 0; x < layout.nx; ++x) {
                const Cell cell{x, y, z};
                if (map.solid(cell)) continue;
                add_direct(map, solids, options.wall, cell, direct);
                add_reflected(map, options.free_slip, cell, reflected);
            }
        }
    }
    return {direct.take(), reflected.take()};
}

}  // namespace magfsi::fluid
