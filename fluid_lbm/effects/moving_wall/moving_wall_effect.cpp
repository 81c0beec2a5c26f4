#include "fluid_lbm/boundary/side_effect.h"
#include "fluid_lbm/effects/moving_wall/moving_wall.h"

namespace magfsi::fluid {

namespace {

class MovingWalls final : public SideEffect {
  public:
    explicit MovingWalls(std::vector<MovingWall> walls) : walls_(std::move(walls)) {}
    void enter(const Populations& populations, const RowLayout& layout, double) override {
        move_walls(populations, layout, walls_);
    }

  private:
    std::vector<MovingWall> walls_;
};

}  // namespace

std::unique_ptr<SideEffect> make_moving_wall_effect(const SideContext& in) {
    std::vector<MovingWall> walls;
    for (int side = 0; side < 6; ++side) {
        const bool moves =
            in.is(side, BoundaryKind::no_slip) && in.wall_velocity[side] != Vec3{};
        if (moves && cells_at_side(in.owned(), in.decomposition.cells, side))
            walls.push_back({axis_of(side), side % 2, in.wall_velocity[side]});
    }
    if (walls.empty()) return nullptr;
    return std::make_unique<MovingWalls>(std::move(walls));
}

}  // namespace magfsi::fluid
