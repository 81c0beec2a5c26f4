// The lattice links from fluid cells into obstacles.
#pragma once

#include <vector>

#include "fluid_lbm/boundary/slots.h"
#include "fluid_lbm/obstacle/solid_map.h"

namespace magfsi::fluid {

struct CutLink {
    // By arrangement: slots of the fluid cell for the population that comes from the
    // obstacle and for its opposite.
    std::ptrdiff_t from_wall[2] = {}, to_wall[2] = {};
    // Distance of the wall from the cell over the link's length; exactly 1/2 where the
    // interpolation lacks its second fluid cell.
    double distance = 0.5;
    signed char push[3] = {};  // direction in which the population strikes
    short obstacle = 0;
};

struct LinkOptions {
    ObstacleWall wall = ObstacleWall::interpolated;
    std::array<bool, 6> free_slip{};  // by side
};

struct CutLinks {
    std::vector<CutLink> direct;
    // Those that strike an obstacle after their reflection by a side with free slip: the
    // population that a cell sent to the side comes back, half-way. It strikes along its
    // mirror image.
    std::vector<CutLink> reflected;
};

CutLinks cut_links(const SolidMap& map, const Solids& solids, const LinkOptions& options,
                   const Populations& populations, const RowLayout& layout);

}  // namespace magfsi::fluid
