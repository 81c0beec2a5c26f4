// Bodies at rest in the fluid, as users describe them; part of fluid.h. SI, coordinates
// from the box's lowest corner.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace magfsi::fluid {

using Vec3 = std::array<double, 3>;

struct Sphere {
    Vec3 centre_m{};
    double diameter_m = 0;
};

// Along the axis 0 x, 1 y or 2 z; the centre is the middle of its length.
struct Cylinder {
    Vec3 centre_m{};
    double diameter_m = 0;
    int axis = 2;
    std::optional<double> length_m;  // absent: through the box
};

struct Block {
    Vec3 low_m{}, high_m{};  // opposite corners
};

// A closed triangulated surface from an STL file, ASCII or binary. A point x of the file
// comes to shift_m + scale_m * x.
struct StlSurface {
    std::string file;
    double scale_m = 1;  // length of the file's unit
    Vec3 shift_m{};
};

using ObstacleShape = std::variant<Sphere, Cylinder, Block, StlSurface>;

struct Obstacle {
    std::string name;  // for errors and probes
    ObstacleShape shape;
};

// Where bounce-back puts the surface.
enum class ObstacleWall {
    half_way,      // half a cell from the fluid's cells: a staircase
    interpolated,  // at its true distance (Bouzidi, Firdaouss, Lallemand 2001, linear)
};

}  // namespace magfsi::fluid
