// SPDX-License-Identifier: GPL-2.0-or-later
// Processor time of a step of a refined grid, with all that joins levels (filling,
// overwriting, mass), of the finest patch's cells alone, and of a uniform grid as fine,
// in turn. The box is that of the swimmer's tutorial.
//
//   mpirun -n 1 magfsi-bench-refined --levels 2
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>

#include "base/process/keep_libraries.h"
#include "fluid_lbm/refinement/refined_fluid.h"
#include "tests/bench/lbm/measure.h"

namespace magfsi::bench {
namespace {

using namespace fluid;

constexpr double finest_m = 0.1e-3;

FluidConfig box_of(double spacing_m) {
    FluidConfig config;
    config.cells = {static_cast<int>(std::lround(16e-3 / spacing_m)),
                    static_cast<int>(std::lround(8e-3 / spacing_m)),
                    static_cast<int>(std::lround(16e-3 / spacing_m))};
    config.spacing_m = spacing_m;
    config.time_step_s = 10e-6 * spacing_m / finest_m;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = 1e-6;
    config.collision = Collision::recursive_mrt;
    config.boundaries.fill({.kind = BoundaryKind::no_slip});
    config.initial_velocity = [](const Vec3& at) {
        return Vec3{0.05 * std::sin(400 * at[2]), 0.05 * std::sin(400 * at[0]), 0};
    };
    return config;
}

// Processor seconds of all ranks and threads.
template <class Stepped>
double seconds_of(Stepped& fluid, int steps) {
    const std::clock_t start = std::clock();
    for (int i = 0; i < steps; ++i) fluid.step();
    double seconds = 1.0 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - start);
    MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return seconds / steps;
}

// Of all levels, in a step of the finest.
double updates(const RefinedFluid& fluid) {
    double sum = 0;
    for (int l = 0; l < fluid.levels(); ++l) {
        const auto& n = fluid.level(l).config().cells;
        sum += std::ldexp(1.0 * n[0] * n[1] * n[2], l + 1 - fluid.levels());
    }
    return sum;
}

void run(int levels, int repetitions) {
    const RefinedConfig config{.coarse = box_of(std::ldexp(finest_m, levels)),
                               .rule = {.levels = levels, .margin_cells = 3}};
    const std::vector<BodyBox> robot{
        {Vec3{6.1e-3, 3.2e-3, 7.6e-3}, Vec3{9.9e-3, 4.8e-3, 8.4e-3}}};
    RefinedFluid refined(MPI_COMM_WORLD, config, robot);
    Fluid uniform(MPI_COMM_WORLD, box_of(finest_m));
    const auto& n = uniform.config().cells;
    const double cells = 1.0 * n[0] * n[1] * n[2];
    RefinedFluid other(MPI_COMM_WORLD, config, robot);
    Fluid& patch = other.level(levels);
    const auto& in_patch = patch.config().cells;
    std::vector<double> of_refined, of_patch, of_uniform, gain;
    for (int i = 0; i < repetitions; ++i) {
        of_refined.push_back(seconds_of(refined, 64));
        of_patch.push_back(seconds_of(patch, 64));
        of_uniform.push_back(seconds_of(uniform, 6));
        gain.push_back(of_uniform.back() / of_refined.back());
    }
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank != 0) return;
    const auto print = [](const char* name, const Spread& s, double count) {
        fmt::print(
            "{:8} {:9.0f} updates a step {:7.2f} ms [{:.2f} {:.2f}] {:6.1f} ns each\n",
            name, count, 1e3 * s.median, 1e3 * s.low, 1e3 * s.high,
            1e9 * s.median / count);
    };
    print("refined", spread(of_refined), updates(refined));
    print("patch", spread(of_patch), 1.0 * in_patch[0] * in_patch[1] * in_patch[2]);
    print("uniform", spread(of_uniform), cells);
    const Spread g = spread(gain);
    fmt::print("a refined step takes {:.1f} times less [{:.1f} {:.1f}]\n", g.median,
               g.low, g.high);
}

}  // namespace
}  // namespace magfsi::bench

int main(int argc, char** argv) {
    CLI::App app{"speed of a refined grid beside a uniform one as fine"};
    int levels = 2, repetitions = 7;
    app.add_option("--levels", levels)->check(CLI::Range(1, 3));
    app.add_option("--repetitions", repetitions)->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    MPI_Init(nullptr, nullptr);
    magfsi::bench::run(levels, repetitions);
    magfsi::keep_libraries();
    MPI_Finalize();
}
