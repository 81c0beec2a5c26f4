#include "fluid_lbm/obstacle/obstacles.h"

#include <algorithm>

namespace magfsi::fluid {

Obstacles::Obstacles(const Solids& solids, const CellBox& owned,
                     const std::array<int, 3>& box_cells,
                     const std::array<bool, 3>& periodic, const LinkOptions& options,
                     const Populations& populations, const RowLayout& layout)
    : map_(solids, owned, box_cells, periodic),
      links_(cut_links(map_, solids, options, populations, layout)),
      impulses_(solids.size()) {
    find_runs(layout);
}

void Obstacles::find_runs(const RowLayout& layout) {
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            for (int x = 0; x < layout.nx; ++x) {
                if (!map_.solid({x, y, z})) continue;
                const int begin = x;
                while (x < layout.nx && map_.solid({x, y, z})) ++x;
                runs_.push_back({begin, x, y, z});
            }
        }
    }
}

std::size_t Obstacles::bytes() const {
    return (links_.direct.size() + links_.reflected.size()) * sizeof(CutLink) +
           runs_.size() * sizeof(Run) + map_.bytes();
}

// The slots of a reflected link hold the bounced population until free slip is applied.
void Obstacles::look(const Populations& populations, Arrangement arrangement) {
    sent_to_slip_.clear();
    populations.visit([&](const auto& rows) {
        const auto* const base = rows.row(0, 0);
        for (const CutLink& link : links_.reflected) {
            sent_to_slip_.push_back(base[link.from_wall[static_cast<int>(arrangement)]]);
        }
    });
}

void Obstacles::strike(const CutLink& link, double populations) {
    for (int a = 0; a < 3; ++a) {
        impulses_[link.obstacle][a] += link.push[a] * populations;
    }
}

void Obstacles::bounce(const Populations& populations, Arrangement arrangement) {
    const int now = static_cast<int>(arrangement), before = 1 - now;
    std::fill(impulses_.begin(), impulses_.end(), Vec3{});
    populations.visit([&](const auto& rows) {
        auto* const base = rows.row(0, 0);
        using Real = std::remove_reference_t<decltype(*base)>;
        for (const CutLink& link : links_.direct) {
            // The outgoing population is at the opposite's old slot.
            const double sent = base[link.from_wall[before]];
            const double d = link.distance;
            double returned = sent;
            if (d < 0.5) {
                const double arrived = base[link.to_wall[now]];
                returned = 2 * d * sent + (1 - 2 * d) * arrived;
            } else if (d > 0.5) {
                const double sent_back = base[link.to_wall[before]];
                returned = sent / (2 * d) + (1 - 1 / (2 * d)) * sent_back;
            }
            const Real stored = static_cast<Real>(returned);
            base[link.from_wall[now]] = stored;
            strike(link, sent + stored);
        }
        for (std::size_t i = 0; i < links_.reflected.size(); ++i) {
            const CutLink& link = links_.reflected[i];
            base[link.from_wall[now]] = static_cast<Real>(sent_to_slip_[i]);
            strike(link, 2 * sent_to_slip_[i]);
        }
    });
}

void Obstacles::settle(const Populations& populations, const RowLayout& layout,
                       Arrangement arrangement) const {
    populations.visit([&](const auto& rows) {
        auto* const base = rows.row(0, 0);
        for (const Run& run : runs_) {
            const auto p = pointers(rows, layout, arrangement, run.y, run.z);
            // The row's pointers do not hold at its ends.
            const int begin = std::max(run.x_begin, 1);
            const int end = std::min(run.x_end, layout.nx - 1);
            for (int q = 0; q < d3q19::directions && begin < end; ++q) {
                std::fill(p.at[q] + begin, p.at[q] + end, 0);
            }
            for (const int x : {0, layout.nx - 1}) {
                if (x < run.x_begin || x >= run.x_end) continue;
                for (const auto slot :
                     cell_slots(rows, layout, arrangement, {x, run.y, run.z})) {
                    base[slot] = 0;
                }
            }
        }
    });
}

}  // namespace magfsi::fluid
