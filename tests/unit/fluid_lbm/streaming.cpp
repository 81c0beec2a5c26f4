// SPDX-License-Identifier: GPL-2.0-or-later
// In-place streaming without collision against streaming from one grid to another: equal
// to the last bit, with periodic sides and with half-way bounce-back, for row lengths
// with and without a vector tail.
#include <gtest/gtest.h>

#include <functional>

#include "fluid_lbm/collision/pairs.h"
#include "fluid_lbm/streaming/row_kernel.h"
#include "fluid_lbm/streaming/sweep.h"

namespace magfsi::fluid {
namespace {

using namespace d3q19;

struct NoCollision {
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&)[3],
                                      const Rates<V>&, CellCheck<V>&) {
        f.write(0, f[0]);
        for_each_pair([&]<int Q>(Pair<Q>) MAGFSI_INLINE_LAMBDA {
            const V first = f[Q], second = f[Q + 1];
            f.write(Q, first);
            f.write(Q + 1, second);
        });
    }
};

// Two lanes, which every x86-64 has; odd lengths leave a tail.
template <class Real>
bool stream_row(Real* const* at, const Real* const* force, std::ptrdiff_t length,
                const CollisionParameters& parameters) {
    using V = typename Simd<Real, 2>::Vector;
    return collide_row<NoCollision, false, V>(at, force, length, parameters);
}

struct Box {
    std::array<int, 3> cells;
    std::array<bool, 3> periodic;
};

class Streaming : public testing::TestWithParam<Box> {
  protected:
    using Field = std::vector<std::array<double, directions>>;

    std::size_t index(const std::array<int, 3>& x) const {
        const auto& n = GetParam().cells;
        return (static_cast<std::size_t>(x[2]) * n[1] + x[1]) * n[0] + x[0];
    }
    void for_each_cell(const std::function<void(std::array<int, 3>)>& visit) const {
        const auto& n = GetParam().cells;
        for (int z = 0; z < n[2]; ++z) {
            for (int y = 0; y < n[1]; ++y) {
                for (int x = 0; x < n[0]; ++x) visit({x, y, z});
            }
        }
    }
    // Pull: f_q(x) comes from x - c_q, or back from the wall.
    Field streamed(const Field& f) const {
        const auto& [n, periodic] = GetParam();
        Field out(f.size());
        for_each_cell([&](std::array<int, 3> cell) {
            for (int q = 0; q < directions; ++q) {
                std::array<int, 3> from = cell;
                bool bounced = false;
                for (int a = 0; a < 3; ++a) {
                    from[a] -= c[q][a];
                    if (from[a] < 0 || from[a] >= n[a]) bounced |= !periodic[a];
                    from[a] = (from[a] + n[a]) % n[a];
                }
                out[index(cell)][q] =
                    bounced ? f[index(cell)][opposite(q)] : f[index(from)][q];
            }
        });
        return out;
    }
    template <class Real>
    void expect_two_grids(Precision precision) const;
};

template <class Real>
void Streaming::expect_two_grids(Precision precision) const {
    const auto& [n, periodic] = GetParam();
    const AnyKernels kernels =
        RowKernels<Real>{stream_row<Real>, stream_row<Real>, nullptr};
    const auto side = [](bool p) { return p ? Beyond::wrap : Beyond::wall; };
    RowLayout layout{n[0], n[1], n[2], side(periodic[0]), {}, {}};
    layout.beyond_y.fill(side(periodic[1]));
    layout.beyond_z.fill(side(periodic[2]));
    const Populations populations(n[0], layout.row_count(), precision);
    Field field(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
    for_each_cell([&](std::array<int, 3> x) {
        for (int q = 0; q < directions; ++q) {
            // Every population its own number, small enough for float.
            const double value = 19.0 * index(x) + q;
            field[index(x)][q] = value;
            Real* row = populations.rows<Real>().row(q, layout.row(x[1], x[2]));
            row[x[0]] = static_cast<Real>(value);
        }
    });
    const CollisionParameters parameters;
    Arrangement arrangement = Arrangement::natural;
    for (int step = 0; step < 7; ++step) {
        const RowBox all{0, n[1], 0, n[2]};
        sweep({populations, layout, arrangement, kernels, parameters}, nullptr, all);
        arrangement = arrangement_after(step + 1);
        field = streamed(field);
        const View view{populations, layout, arrangement, kernels, parameters};
        std::vector<double> plane(static_cast<std::size_t>(directions) * n[0] * n[1]);
        for (int z = 0; z < n[2]; ++z) {
            read_plane(view, z, plane);
            for (std::size_t i = 0; i < plane.size(); ++i) {
                ASSERT_EQ(plane[i],
                          field[index({0, 0, z}) + i / directions][i % directions])
                    << "step " << step << " plane " << z << " value " << i;
            }
        }
    }
}

TEST_P(Streaming, OfDoubleEqualsTwoGrids) {
    expect_two_grids<double>(Precision::double_);
}
TEST_P(Streaming, OfFloatEqualsTwoGrids) {
    expect_two_grids<float>(Precision::float_);
}

INSTANTIATE_TEST_SUITE_P(Boxes, Streaming,
                         testing::Values(Box{{5, 3, 4}, {true, true, true}},
                                         Box{{8, 4, 3}, {true, true, true}},
                                         Box{{13, 2, 2}, {true, true, true}},
                                         Box{{33, 3, 3}, {true, true, true}},
                                         Box{{5, 4, 3}, {false, false, false}},
                                         Box{{8, 3, 4}, {false, true, false}},
                                         Box{{13, 4, 3}, {true, false, true}},
                                         Box{{33, 3, 3}, {true, true, false}},
                                         Box{{2, 2, 2}, {false, false, true}},
                                         Box{{2, 2, 2}, {true, true, true}}));

}  // namespace
}  // namespace magfsi::fluid
