// SPDX-License-Identifier: GPL-2.0-or-later
// Refined boxes with walls in which bodies circle and push the fluid, and comparisons of
// two of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refinement/refined_fluid.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {

inline RefinedConfig stirred_box(int levels, Precision precision = Precision::double_) {
    RefinedConfig config;
    config.coarse = lattice_fluid({28, 26, 24}, 0.52, Collision::recursive_regularized);
    for (int axis = 0; axis < 3; ++axis) set_walls(config.coarse, axis);
    config.coarse.initial_velocity = [](const Vec3& x) {
        return Vec3{0.03 * std::sin(x[1] / 3), 0.03 * std::cos(x[2] / 4), 0.02};
    };
    config.coarse.precision = precision;
    config.rule = {.levels = levels, .margin_cells = 1};
    return config;
}

using BodiesAt = std::function<std::vector<BodyBox>(double time)>;

inline std::vector<BodyBox> body_at(double time) {
    const double x = 13 + 4 * std::sin(time / 7), y = 12 + 4 * std::cos(time / 7);
    return {{Vec3{x - 1.5, y - 1.2, 10}, Vec3{x + 1.5, y + 1.2, 12}}};
}

// Pushes in cells of the patches at the bodies, then steps.
inline void push_and_step(RefinedFluid& fluid, MPI_Comm comm,
                          const std::vector<BodyBox>& bodies) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const double h = fluid.level(fluid.levels() - 1).config().spacing_m;
    std::vector<CellRow> rows;
    const auto owned = fluid.owned_by_rank();
    for (const CellBox& own : owned[static_cast<std::size_t>(rank)]) {
        for_each_row(own, [&](const CellRow& row) {
            for (const BodyBox& body : bodies) {
                if (row.z * h < body[0][2] || row.z * h > body[1][2]) continue;
                if (row.y * h < body[0][1] || row.y * h > body[1][1]) continue;
                const int x = static_cast<int>(body[0][0] / h);
                if (x >= row.x_begin && x + 2 <= row.x_end)
                    rows.push_back({row.y, row.z, x, x + 2});
            }
        });
    }
    std::vector<double> force(6 * rows.size(), 1e-4);
    fluid.set_force(rows, force);
    fluid.step();
}

inline void run(RefinedFluid& fluid, MPI_Comm comm, int first, int last,
                const BodiesAt& bodies = body_at) {
    const int steps = 1 << (fluid.levels() - 1);
    for (int i = first; i < last; ++i) {
        if (fluid.levels_are_level()) fluid.follow(bodies(i / steps));
        push_and_step(fluid, comm, bodies(i / steps));
    }
}

// All populations of this rank's cells of a patch; those of a fluid on one rank in the
// same cells.
inline std::vector<double> populations_in(const Fluid& fluid, const CellBox& box) {
    std::vector<double> values;
    const auto nx = static_cast<std::size_t>(fluid.config().cells[0]);
    const CellBox own = fluid.owned();
    std::vector<double> plane(populations_per_cell * nx *
                              static_cast<std::size_t>(own.hi[1] - own.lo[1]));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        fluid.populations(z, plane);
        const auto row = static_cast<std::ptrdiff_t>(populations_per_cell * nx);
        values.insert(values.end(), plane.begin() + (box.lo[1] - own.lo[1]) * row,
                      plane.begin() + (box.hi[1] - own.lo[1]) * row);
    }
    return values;
}

inline void expect_same(const RefinedFluid& a, const RefinedFluid& b, double within) {
    ASSERT_EQ(a.levels(), b.levels());
    ASSERT_EQ(a.places(), b.places());
    for (int nest = 0; nest < a.nests(); ++nest) {
        for (int l = 0; l < a.levels(); ++l) {
            const CellBox own = a.level(l, nest).owned();
            const auto mine = populations_in(a.level(l, nest), own);
            const auto theirs = populations_in(b.level(l, nest), own);
            ASSERT_EQ(mine.size(), theirs.size());
            double largest = 0;
            for (std::size_t i = 0; i < mine.size(); ++i)
                largest = std::max(largest, std::abs(mine[i] - theirs[i]));
            EXPECT_LE(largest, within) << "level " << l << ", nest " << nest;
        }
    }
}

// From the one into the other, which has the same places.
inline void copy_populations(const RefinedFluid& from, RefinedFluid& to) {
    for (int nest = 0; nest < from.nests(); ++nest) {
        for (int l = 0; l < from.levels(); ++l) {
            const Fluid& level = from.level(l, nest);
            const CellBox own = level.owned();
            std::vector<double> plane(populations_per_cell *
                                      static_cast<std::size_t>(level.config().cells[0]) *
                                      static_cast<std::size_t>(own.hi[1] - own.lo[1]));
            for (int z = own.lo[2]; z < own.hi[2]; ++z) {
                level.populations(z, plane);
                to.level(l, nest).set_populations(z, plane);
            }
        }
    }
}

// A fluid that goes on from the state of another one ends as that does, to the bit.
inline void expect_it_goes_on(const RefinedConfig& config, const BodiesAt& bodies,
                              int middle, int last) {
    RefinedFluid whole(MPI_COMM_WORLD, config, bodies(0));
    run(whole, MPI_COMM_WORLD, 0, middle, bodies);
    RefinedFluid part(MPI_COMM_WORLD, config, bodies(0));
    part.restore(whole.steps_done(), whole.places(), whole.kept_mass());
    copy_populations(whole, part);
    run(whole, MPI_COMM_WORLD, middle, last, bodies);
    run(part, MPI_COMM_WORLD, middle, last, bodies);
    expect_same(whole, part, 0);
}

// A step that is taken again with other forces ends as if the first had not been, but for
// the rounding of what keeps the mass, which it does twice.
inline void expect_steps_taken_again(const RefinedConfig& config,
                                     const std::vector<BodyBox>& bodies, int steps) {
    RefinedFluid once(MPI_COMM_WORLD, config, bodies);
    RefinedFluid again(MPI_COMM_WORLD, config, bodies);
    for (int i = 0; i < steps; ++i) {
        push_and_step(once, MPI_COMM_WORLD, bodies);
        again.keep();
        again.set_force({}, {});
        push_and_step(again, MPI_COMM_WORLD, bodies);
        again.go_back();
        push_and_step(again, MPI_COMM_WORLD, bodies);
    }
    expect_same(once, again, 1e-16);
}

}  // namespace magfsi::fluid
