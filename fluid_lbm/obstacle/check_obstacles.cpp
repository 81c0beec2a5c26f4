#include "fluid_lbm/obstacle/check_obstacles.h"

#include <cmath>

#include "fluid_lbm/boundary/refuse.h"

namespace magfsi::fluid {

namespace {

void check_size(const std::string& name, const char* what, double size_m) {
    if (!(size_m > 0) || !std::isfinite(size_m)) {
        refuse("fluid obstacle \"", name, "\" has the ", what, " ", size_m,
               " m; it must be above 0");
    }
}

void check_shape(const std::string& name, const Sphere& sphere) {
    check_size(name, "diameter", sphere.diameter_m);
}

void check_shape(const std::string& name, const Cylinder& cylinder) {
    check_size(name, "diameter", cylinder.diameter_m);
    if (cylinder.length_m) check_size(name, "length", *cylinder.length_m);
    if (cylinder.axis < 0 || cylinder.axis > 2) {
        refuse("fluid obstacle \"", name, "\" has the axis ", cylinder.axis,
               "; it must be 0 (x), 1 (y) or 2 (z)");
    }
}

void check_shape(const std::string& name, const Block& block) {
    for (int a = 0; a < 3; ++a) {
        const std::string what = std::string("length along ") + axis_name[a];
        check_size(name, what.c_str(), block.high_m[a] - block.low_m[a]);
    }
}

void check_shape(const std::string& name, const StlSurface& surface) {
    if (!(surface.unit_m > 0) || !std::isfinite(surface.unit_m)) {
        refuse("fluid obstacle \"", name, "\" has the scale ", surface.unit_m,
               " m; it must be above 0");
    }
}

// Written so that a position that is not a number is refused, too.
void check_place(const std::string& name, const Bounds& bounds,
                 const FluidConfig& config) {
    for (int a = 0; a < 3; ++a) {
        if (bounds.high[a] > 0 && bounds.low[a] < config.cells[a]) continue;
        refuse("fluid obstacle \"", name, "\" reaches from ",
               bounds.low[a] * config.spacing_m, " to ",
               bounds.high[a] * config.spacing_m, " m along ", axis_name[a],
               "; it lies outside the box, which reaches from 0 to ",
               config.cells[a] * config.spacing_m, " m");
    }
}

}  // namespace

void check_resolved(MPI_Comm comm, const FluidConfig& config, const SolidMap& map) {
    std::vector<long long> cells = map.cell_counts();
    MPI_Allreduce(MPI_IN_PLACE, cells.data(), static_cast<int>(cells.size()),
                  MPI_LONG_LONG, MPI_SUM, comm);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] > 0) continue;
        refuse("fluid obstacle \"", config.obstacles[i].name,
               "\" holds the centre of no cell; make the spacing, now ", config.spacing_m,
               " m, finer");
    }
}

Solids make_solids(const FluidConfig& config) {
    Solids solids;
    for (std::size_t i = 0; i < config.obstacles.size(); ++i) {
        const Obstacle& obstacle = config.obstacles[i];
        if (obstacle.name.empty()) refuse("fluid obstacle ", i, " has no name");
        for (std::size_t j = 0; j < i; ++j) {
            if (config.obstacles[j].name == obstacle.name) {
                refuse("fluid obstacles ", j, " and ", i, " are both named \"",
                       obstacle.name, "\"; names must differ");
            }
        }
        std::visit([&](const auto& shape) { check_shape(obstacle.name, shape); },
                   obstacle.shape);
        solids.push_back(make_solid(obstacle.shape, config.spacing_m, config.cells));
        check_place(obstacle.name, solids.back()->bounds(), config);
    }
    return solids;
}

}  // namespace magfsi::fluid
