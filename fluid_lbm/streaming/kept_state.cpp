// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/streaming/kept_state.h"

#include <algorithm>

namespace magfsi::fluid {

namespace {

// The rows (numbers z * ny + y) as boxes, one for each run of neighbours along y.
std::vector<RowBox> boxes_of(std::span<const int> rows, int ny) {
    std::vector<int> sorted(rows.begin(), rows.end());
    std::ranges::sort(sorted);
    std::vector<RowBox> boxes;
    for (const int row : sorted) {
        const int y = row % ny, z = row / ny;
        const bool next =
            !boxes.empty() && boxes.back().z_begin == z && boxes.back().y_end == y;
        if (next)
            ++boxes.back().y_end;
        else
            boxes.push_back({y, y + 1, z, z + 1});
    }
    return boxes;
}

// Calls use(pointers) for each row of boxes of a single z.
template <class Use>
void each_row(const View& view, std::span<const RowBox> boxes, Use&& use) {
    view.populations.visit([&](const auto& rows) {
        for (const RowBox& box : boxes) {
            for (int y = box.y_begin; y < box.y_end; ++y)
                use(pointers(rows, view.layout, view.arrangement, y, box.z_begin));
        }
    });
}

}  // namespace

void KeptState::keep(const View& now) {
    if (rows_suffice_) {
        waiting_ = true;
        return;
    }
    const auto all = now.populations.all_bytes();
    whole_.assign(all.begin(), all.end());
}

void KeptState::note_rows(const View& now, std::span<const int> forced_rows) {
    if (!waiting_) return;
    waiting_ = false;
    const int nx = now.layout.nx;
    rows_ = boxes_of(forced_rows, now.layout.ny);
    values_.resize(forced_rows.size() * d3q19::directions * static_cast<std::size_t>(nx));
    double* to = values_.data();
    each_row(now, rows_, [&](const auto& p) {
        if (now.arrangement == Arrangement::swapped) open_x_ends(p, now.layout);
        for (int q = 0; q < d3q19::directions; ++q) to = std::copy_n(p.at[q], nx, to);
    });
}

void KeptState::put_back(const View& before) const {
    if (!rows_suffice_) {
        std::ranges::copy(whole_, before.populations.all_bytes().begin());
        return;
    }
    const int nx = before.layout.nx;
    const double* from = values_.data();
    each_row(before, rows_, [&]<class Real>(const RowPointers<Real>& p) {
        for (int q = 0; q < d3q19::directions; ++q, from += nx) {
            std::transform(from, from + nx, p.at[q],
                           [](double f) { return static_cast<Real>(f); });
        }
        if (before.arrangement == Arrangement::swapped) close_x_ends(p, before.layout);
    });
}

bool KeptState::has(int y, int z) const {
    return std::ranges::any_of(rows_, [&](const RowBox& box) {
        return box.z_begin == z && y >= box.y_begin && y < box.y_end;
    });
}

}  // namespace magfsi::fluid
