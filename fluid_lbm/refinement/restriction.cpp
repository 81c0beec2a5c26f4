#include "fluid_lbm/refinement/restriction.h"

#include <algorithm>
#include <map>

#include "fluid_lbm/refinement/interlevel.h"

namespace magfsi::fluid {

namespace {

constexpr int points = cubic_points;
constexpr std::size_t numbers = numbers_between_levels;

// Of a coarse cell, among the fine ones within the level's stored cells.
Weights fine_in(int coarse_cell, const LevelPlace& fine, int axis) {
    const bool wraps = fine.period[axis] > 0;
    const int lo = wraps ? -points : fine.stored.lo[axis];
    const int hi = wraps ? fine.domain[axis] + points : fine.stored.hi[axis];
    return cubic_at(2 * coarse_cell + 0.5, lo, hi);
}

CellBox coarse_share(const CellBox& owned, const LevelPlace& place) {
    const CellBox covered = place.covered();
    CellBox share = covered;
    for (int d = 1; d < 3; ++d) {
        share.lo[d] = std::max(covered.lo[d], (owned.lo[d] + 1) / 2);
        share.hi[d] = std::min(covered.hi[d], (owned.hi[d] + 1) / 2);
    }
    return share;
}

std::vector<CellBox> coarse_shares(const Level& fine) {
    std::vector<CellBox> shares;
    for (const CellBox& owned : fine.owned_by_rank())
        shares.push_back(coarse_share(owned, fine.place));
    return shares;
}

// Whole rows of those that a share is made of.
CellBox fine_beneath(const CellBox& share, const LevelPlace& place) {
    CellBox box = place.stored;
    if (is_empty(share)) return {};
    for (int d = 1; d < 3; ++d) {
        box.lo[d] = std::min(fine_in(share.lo[d], place, d).first, 2 * share.lo[d]);
        box.hi[d] =
            std::max(fine_in(share.hi[d] - 1, place, d).first + points, 2 * share.hi[d]);
    }
    return box;
}

std::vector<std::vector<CellBox>> halos_of(const Level& fine) {
    std::vector<std::vector<CellBox>> halos;
    for (const CellBox& owned : fine.owned_by_rank())
        halos.push_back(
            without(fine_beneath(coarse_share(owned, fine.place), fine.place), owned));
    return halos;
}

std::vector<std::vector<CellBox>> one_each(const std::vector<CellBox>& boxes) {
    std::vector<std::vector<CellBox>> all;
    for (const CellBox& box : boxes) all.push_back({box});
    return all;
}

double sum_of(const double* values, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += values[i];
    return sum;
}

}  // namespace

Restriction::Restriction(const Level& coarse, const Level& fine)
    : mine_(coarse_share(fine.owned(), fine.place)),
      needed_(fine_beneath(mine_, fine.place)),
      halo_(without(needed_, fine.owned())),
      to_halo_(coarse.comm(), fine.owned_by_rank(), fine.place.period, halos_of(fine)),
      to_coarse_(coarse.comm(), coarse_shares(fine), coarse.place.period,
                 one_each(coarse.owned_by_rank())),
      averaged_(numbers * static_cast<std::size_t>(cells_of(mine_))) {
    for (const CellBox& box : halo_)
        halo_flow_.emplace_back(numbers * static_cast<std::size_t>(cells_of(box)));
}

const double* Restriction::fine_row(const Level& fine, int y, int z,
                                    RestrictedMass& mass) {
    const auto count = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    for (std::size_t b = 0; b < halo_.size(); ++b) {
        const CellBox& box = halo_[b];
        if (y < box.lo[1] || y >= box.hi[1] || z < box.lo[2] || z >= box.hi[2]) continue;
        const auto row = static_cast<std::size_t>(
            (z - box.lo[2]) * (box.hi[1] - box.lo[1]) + y - box.lo[1]);
        return halo_flow_[b].data() + row * numbers * count;
    }
    row_.resize(numbers * count);
    read_flow(fine.state().view(), fine.local({y, z, needed_.lo[0], needed_.hi[0]}),
              row_.data());
    const CellBox& inside = fine.place.inside;
    if (y >= inside.lo[1] && y < inside.hi[1] && z >= inside.lo[2] && z < inside.hi[2])
        mass.fine += sum_of(row_.data() + (inside.lo[0] - needed_.lo[0]),
                            static_cast<std::size_t>(inside.hi[0] - inside.lo[0]));
    return row_.data();
}

namespace {

// What a fine row or plane counts in a coarse one: density and velocity, and stress.
struct Share {
    double cubic = 0, mean = 0;
};
Share share_of(int fine, int coarse, const Weights& w) {
    const int k = fine - w.first, half = fine - 2 * coarse;
    return {k >= 0 && k < points ? w.of[static_cast<std::size_t>(k)] : 0,
            half == 0 || half == 1 ? 0.5 : 0};
}

// Of rows of so many cells.
void add_share(const Share& share, const double* flow, std::size_t cells, double* sum) {
    if (share.cubic != 0) add_scaled(share.cubic, flow, first_stress * cells, sum);
    const std::size_t stress = first_stress * cells;
    if (share.mean != 0)
        add_scaled(share.mean, flow + stress, (numbers - first_stress) * cells,
                   sum + stress);
}

}  // namespace

// One plane of fine cells, averaged along y: [y of mine_][number][x of needed_].
void Restriction::average_plane(const Level& fine, int z, std::vector<double>& plane,
                                RestrictedMass& mass) {
    const auto width = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    std::ranges::fill(plane, 0.0);
    for (int y = needed_.lo[1]; y < needed_.hi[1]; ++y) {
        const double* row = fine_row(fine, y, z, mass);
        const int middle = y >> 1;  // of the up to four coarse rows that it counts in
        const int first = std::max(middle - 2, mine_.lo[1]);
        for (int c = first; c < std::min(middle + 3, mine_.hi[1]); ++c)
            add_share(share_of(y, c, fine_in(c, fine.place, 1)), row, width,
                      plane.data() +
                          static_cast<std::size_t>(c - mine_.lo[1]) * numbers * width);
    }
}

// The last average, along x, of a row of which the others are done.
void Restriction::average_row(const Level& fine, const double* row, double* to) const {
    const auto width = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    const int period = fine.place.period[0];
    for (int x = mine_.lo[0]; x < mine_.hi[0]; ++x, ++to) {
        const Weights w = fine_in(x, fine.place, 0);
        const auto at = [&](std::size_t i, int fine_x) {
            if (period > 0) fine_x = (fine_x + period) % period;
            return row[i * width + static_cast<std::size_t>(fine_x - needed_.lo[0])];
        };
        const auto coarse_width = static_cast<std::size_t>(mine_.hi[0] - mine_.lo[0]);
        for (std::size_t i = 0; i < first_stress; ++i)
            to[i * coarse_width] =
                (w.of[0] * at(i, w.first) + w.of[1] * at(i, w.first + 1)) +
                (w.of[2] * at(i, w.first + 2) + w.of[3] * at(i, w.first + 3));
        for (std::size_t i = first_stress; i < numbers; ++i)
            to[i * coarse_width] = 0.5 * (at(i, 2 * x) + at(i, 2 * x + 1));
    }
}

void Restriction::average(const Level& fine, RestrictedMass& mass) {
    if (is_empty(mine_)) return;
    const auto width = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    const auto rows = static_cast<std::size_t>(mine_.hi[1] - mine_.lo[1]);
    const std::size_t plane_size = rows * numbers * width;
    // Coarse planes under way, of up to five that a fine one counts in.
    std::vector<double> plane(plane_size);
    std::map<int, std::vector<double>> under_way;
    for (int z = needed_.lo[2]; z < needed_.hi[2]; ++z) {
        average_plane(fine, z, plane, mass);
        for (int c = mine_.lo[2]; c < mine_.hi[2]; ++c) {
            const Weights w = fine_in(c, fine.place, 2);
            const Share share = share_of(z, c, w);
            if (share.cubic == 0 && share.mean == 0) continue;
            auto& sum = under_way[c];
            sum.resize(plane_size);
            for (std::size_t j = 0; j < rows; ++j) {
                const std::size_t first = j * numbers * width;
                add_share(share, plane.data() + first, width, sum.data() + first);
            }
            if (z + 1 < std::max(w.first + points, 2 * c + 2)) continue;
            finish_plane(fine, c, sum);
            under_way.erase(c);
        }
    }
}

void Restriction::finish_plane(const Level& fine, int z, const std::vector<double>& sum) {
    const auto width = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    const auto coarse_width = static_cast<std::size_t>(mine_.hi[0] - mine_.lo[0]);
    const auto rows = static_cast<std::size_t>(mine_.hi[1] - mine_.lo[1]);
    for (std::size_t j = 0; j < rows; ++j) {
        const auto row = static_cast<std::size_t>(z - mine_.lo[2]) * rows + j;
        average_row(fine, sum.data() + j * numbers * width,
                    averaged_.data() + row * numbers * coarse_width);
    }
}

RestrictedMass Restriction::run(const Level& coarse, const Level& fine) {
    RestrictedMass mass;
    const View fine_view = fine.state().view();
    to_halo_.run(
        numbers,
        [&](const CellRow& row, double* flow) {
            read_flow(fine_view, fine.local(row), flow);
        },
        [&](std::size_t b, const CellRow& row, const double* flow) {
            const CellBox& box = halo_[b];
            const auto at = static_cast<std::size_t>(
                (row.z - box.lo[2]) * (box.hi[1] - box.lo[1]) + row.y - box.lo[1]);
            const std::size_t count = numbers * static_cast<std::size_t>(row.size());
            std::copy_n(flow, count, halo_flow_[b].data() + at * count);
        });
    average(fine, mass);
    const Scales scales = to_fine(coarse, fine);
    const View view = coarse.state().view();
    const auto width = static_cast<std::size_t>(mine_.hi[0] - mine_.lo[0]);
    const auto rows = static_cast<std::size_t>(mine_.hi[1] - mine_.lo[1]);
    std::vector<double> own;
    to_coarse_.run(
        numbers,
        [&](const CellRow& row, double* flow) {
            const auto r = static_cast<std::size_t>(row.z - mine_.lo[2]) * rows +
                           static_cast<std::size_t>(row.y - mine_.lo[1]);
            const auto count = static_cast<std::size_t>(row.size());
            const double* from = averaged_.data() + r * numbers * width +
                                 static_cast<std::size_t>(row.x_begin - mine_.lo[0]);
            for (std::size_t i = 0; i < numbers; ++i)
                std::copy_n(from + i * width, count, flow + i * count);
        },
        [&](std::size_t, const CellRow& row, const double* flow) {
            const auto count = static_cast<std::size_t>(row.size());
            own.resize(numbers * count);
            const CellRow at = coarse.local(row);
            read_flow(view, at, own.data());
            mass.before += sum_of(own.data(), count);
            mass.after += sum_of(flow, count);
            std::copy_n(flow, numbers * count, own.data());
            apply(scales, -1, own.data(), count);
            write_flow(view, at, own.data());
        });
    return mass;
}

namespace {

// use(row) for each row of this rank's coarse cells beside the covered box.
template <class Use>
void each_row_beside(const Level& coarse, const LevelPlace& fine, Use&& use) {
    const CellBox covered = fine.covered();
    CellBox around = covered;
    for (int d = 0; d < 3; ++d) {
        if (fine.period[d] > 0) continue;
        around.lo[d] -= 1;
        around.hi[d] += 1;
    }
    for (const CellBox& box : without(around, covered)) {
        for_each_image(coarse.place.period, [&](const std::array<int, 3>& image) {
            for_each_row(shared(shifted(box, image), coarse.owned()), use);
        });
    }
}

}  // namespace

std::int64_t cells_beside(const Level& coarse, const LevelPlace& fine) {
    std::int64_t cells = 0;
    each_row_beside(coarse, fine, [&](const CellRow& row) { cells += row.size(); });
    return cells;
}

void add_density_beside(const Level& coarse, const LevelPlace& fine, double excess) {
    const View view = coarse.state().view();
    each_row_beside(coarse, fine, [&](const CellRow& row) {
        add_density(view, coarse.local(row), excess);
    });
}

}  // namespace magfsi::fluid
