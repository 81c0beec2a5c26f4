// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/sampling/moments.h"

#include <algorithm>

namespace magfsi::fluid {

namespace {

// True if the row includes an end cell, some populations of which are stored elsewhere.
bool has_ends(const View& view, const CellRow& row) {
    return view.arrangement == Arrangement::swapped &&
           (row.x_begin == 0 || row.x_end == view.layout.nx);
}

// Pointers of a row; its ghost elements are filled if the row includes an end cell.
template <class Real>
RowPointers<Real> readable_row(const View& view, const CellRow& row) {
    const auto p = pointers(view.populations.rows<Real>(), view.layout, view.arrangement,
                            row.y, row.z);
    if (has_ends(view, row)) open_x_ends(p, view.layout);
    return p;
}

// Calls use(p, first) for each row of a plane: its pointers, and the index of its first
// value in [y][x][19].
template <class Real, class Use>
void each_row(const View& view, const PopulationRows<Real>& rows, int z, Use&& use) {
    const std::size_t row_values = d3q19::directions * view.layout.nx;
    for (int y = 0; y < view.layout.ny; ++y)
        use(pointers(rows, view.layout, view.arrangement, y, z), y * row_values);
}

// Calls use(at, count): pointers to the row's first cell, by direction, and its length.
template <class Real, class Use>
void read_row(const View& view, const CellRow& row, Use&& use) {
    const RowPointers<Real> p = readable_row<Real>(view, row);
    const Real* at[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) at[q] = p.at[q] + row.x_begin;
    use(at, row.size());
}

// Number of rows to prefetch ahead. Rows along y are read one after the other, and a
// short one is finished before the next one has arrived.
int rows_ahead(const CellRow& row) {
    constexpr int few_cells = 8;
    return row.size() <= few_cells ? 3 : 1;
}

// The same for a use that changes the populations.
template <class Real, class Use>
void change_row(const View& view, const CellRow& row, Use&& use) {
    const RowPointers<Real> p = readable_row<Real>(view, row);
    Real* at[d3q19::directions];
    const std::ptrdiff_t ahead = rows_ahead(row) * view.populations.row_stride();
    for (int q = 0; q < d3q19::directions; ++q) {
        at[q] = p.at[q] + row.x_begin;
        __builtin_prefetch(at[q] + ahead, 1, 3);
    }
    use(at, row.size());
    if (has_ends(view, row)) close_x_ends(p, view.layout);
}

// Pointers to `Numbers` arrays of `count` values that follow each other.
template <std::size_t Numbers, class T>
std::array<T*, Numbers> arrays(T* first, int count) {
    std::array<T*, Numbers> all;
    for (std::size_t i = 0; i < Numbers; ++i) all[i] = first + i * count;
    return all;
}

}  // namespace

void row_moments(const View& view, int y, int z, int x_begin, int x_end,
                 RowMoments& moments) {
    const int count = x_end - x_begin;
    moments.excess.resize(count);
    for (auto& component : moments.j) component.resize(count);
    double* const out[4] = {moments.excess.data(), moments.j[0].data(),
                            moments.j[1].data(), moments.j[2].data()};
    std::visit(
        [&]<class Real>(const RowKernels<Real>& kernels) {
            const RowPointers<Real> p = readable_row<Real>(view, {y, z, x_begin, x_end});
            const Real* at[d3q19::directions];
            for (int q = 0; q < d3q19::directions; ++q) at[q] = p.at[q] + x_begin;
            kernels.moments(at, count, out);
        },
        view.kernels);
}

void read_flow(const View& view, const CellRow& row,
               const std::array<double*, flow_numbers>& flow) {
    const std::ptrdiff_t ahead = rows_ahead(row) * view.populations.row_stride();
    std::visit(
        [&]<class Real>(const RowKernels<Real>& kernels) {
            read_row<Real>(view, row, [&](const Real* const* at, int count) {
                kernels.flow(at, count, flow.data(), ahead);
            });
        },
        view.kernels);
}

void read_flow(const View& view, const CellRow& row, double* flow) {
    read_flow(view, row, arrays<flow_numbers>(flow, row.size()));
}

void write_flow(const View& view, const CellRow& row, const double* flow) {
    std::visit(
        [&]<class Real>(const RowKernels<Real>& kernels) {
            change_row<Real>(view, row, [&](Real* const* at, int count) {
                kernels.rebuild(arrays<flow_numbers>(flow, count).data(), count, at);
            });
        },
        view.kernels);
}

void write_flow_along_y(const View& view, const CellBox& plane, const double* flow) {
    std::visit(
        [&]<class Real>(const RowKernels<Real>& kernels) {
            const int count = plane.hi[1] - plane.lo[1],
                      width = plane.hi[0] - plane.lo[0];
            const std::size_t n = count;
            thread_local std::vector<Real> columns;
            columns.resize(d3q19::directions * n * width);
            for (int x = 0; x < width; ++x) {
                const auto first = static_cast<std::size_t>(x) * n;
                const auto at = arrays<d3q19::directions>(
                    columns.data() + d3q19::directions * first, count);
                kernels.rebuild(
                    arrays<flow_numbers>(flow + flow_numbers * first, count).data(),
                    count, at.data());
            }
            const auto rows = view.populations.rows<Real>();
            const int row = view.layout.row(plane.lo[1], plane.lo[2]);
            const std::ptrdiff_t stride = view.populations.row_stride();
            const std::size_t apart = d3q19::directions * n;
            constexpr int rows_ahead = 8;  // each row is another cache line
            for (int q = 0; q < d3q19::directions; ++q) {
                Real* to = rows.row(q, row) + plane.lo[0];
                const Real* from = columns.data() + static_cast<std::size_t>(q) * n;
                for (int y = 0; y < count; ++y, to += stride, ++from) {
                    __builtin_prefetch(to + rows_ahead * stride, 1, 3);
                    for (int x = 0; x < width; ++x) to[x] = from[x * apart];
                }
            }
        },
        view.kernels);
}

void add_density(const View& view, const CellRow& row, double excess) {
    view.populations.visit([&]<class Real>(const PopulationRows<Real>&) {
        change_row<Real>(view, row, [&](Real* const* at, int count) {
            for (int q = 0; q < d3q19::directions; ++q) {
                for (int x = 0; x < count; ++x)
                    at[q][x] = static_cast<Real>(at[q][x] + d3q19::weight(q) * excess);
            }
        });
    });
}

void read_populations(const View& view, const CellRow& row, double* values) {
    view.populations.visit([&]<class Real>(const PopulationRows<Real>&) {
        read_row<Real>(view, row, [&](const Real* const* at, int count) {
            for (int q = 0; q < d3q19::directions; ++q)
                values = std::copy_n(at[q], count, values);
        });
    });
}

void write_populations(const View& view, const CellRow& row, const double* values) {
    view.populations.visit([&]<class Real>(const PopulationRows<Real>&) {
        change_row<Real>(view, row, [&](Real* const* at, int count) {
            for (int q = 0; q < d3q19::directions; ++q, values += count) {
                for (int x = 0; x < count; ++x) at[q][x] = static_cast<Real>(values[x]);
            }
        });
    });
}

void read_plane(const View& view, int z, std::span<double> values) {
    const bool swapped = view.arrangement == Arrangement::swapped;
    view.populations.visit([&](const auto& rows) {
        each_row(view, rows, z, [&](const auto& p, std::size_t at) {
            if (swapped) open_x_ends(p, view.layout);
            for (int x = 0; x < view.layout.nx; ++x) {
                for (int q = 0; q < d3q19::directions; ++q) values[at++] = p.at[q][x];
            }
        });
    });
}

void write_plane(const View& view, int z, std::span<const double> values) {
    const bool swapped = view.arrangement == Arrangement::swapped;
    view.populations.visit([&]<class Real>(const PopulationRows<Real>& rows) {
        each_row(view, rows, z, [&](const auto& p, std::size_t at) {
            for (int x = 0; x < view.layout.nx; ++x) {
                for (int q = 0; q < d3q19::directions; ++q)
                    p.at[q][x] = static_cast<Real>(values[at++]);
            }
            if (swapped) close_x_ends(p, view.layout);
        });
    });
}

}  // namespace magfsi::fluid
