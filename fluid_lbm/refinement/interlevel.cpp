#include "fluid_lbm/refinement/interlevel.h"

#include <array>
#include <cmath>

namespace magfsi::fluid {

namespace {

constexpr int points = 4;
constexpr std::size_t first_stress = 4;
constexpr std::size_t numbers = flow_numbers;

// Neighbouring cells and what each counts.
struct Weights {
    int first = 0;
    std::array<double, points> of{};
};

// Lagrange's cubic at a point, through cells first, first + 1, ... which lie in [lo, hi).
Weights cubic_at(double at, int lo, int hi) {
    Weights w;
    w.first = static_cast<int>(std::floor(at)) - 1;
    if (w.first > hi - points) w.first = hi - points;
    if (w.first < lo) w.first = lo;
    const double t = at - w.first;
    for (int i = 0; i < points; ++i) {
        double product = 1;
        for (int j = 0; j < points; ++j)
            if (j != i) product *= (t - j) / (i - j);
        w.of[static_cast<std::size_t>(i)] = product;
    }
    return w;
}

// The coarse cells that a level's cubic may read along an axis: what the level solves,
// unless the axis is periodic.
struct Range {
    int lo, hi;
};
Range readable(const LevelPlace& place, int axis) {
    constexpr int anywhere = 1 << 28;
    if (place.period[axis] > 0) return {-anywhere, anywhere};
    return {place.inside.lo[axis], place.inside.hi[axis]};
}

// Of a fine cell, among the coarse ones: centres of cells lie at whole numbers.
Weights coarse_around(int fine_cell, const LevelPlace& coarse, int axis) {
    const Range range = readable(coarse, axis);
    return cubic_at((2 * fine_cell - 1) / 4.0, range.lo, range.hi);
}

CellBox coarse_beneath(const CellBox& fine, const LevelPlace& coarse) {
    CellBox box;
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = coarse_around(fine.lo[d], coarse, d).first;
        box.hi[d] = coarse_around(fine.hi[d] - 1, coarse, d).first + points;
    }
    return box;
}

std::vector<std::vector<CellBox>> coarse_beneath(
    const std::vector<std::vector<CellBox>>& of_ranks, const LevelPlace& coarse) {
    std::vector<std::vector<CellBox>> beneath(of_ranks.size());
    for (std::size_t r = 0; r < of_ranks.size(); ++r) {
        for (const CellBox& box : of_ranks[r])
            beneath[r].push_back(coarse_beneath(box, coarse));
    }
    return beneath;
}

int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

// From the coarse level's numbers to the fine one's; both have the velocity before half of
// the step's body force, of which the finer one's is half as large.
struct Scales {
    double stress = 1;
    Vec3 velocity{};
};
Scales to_fine(const Level& coarse, const Level& fine) {
    const FluidConfig& c = coarse.fluid.config();
    const FluidConfig& f = fine.fluid.config();
    Scales scales{relaxation_time(f) / (2 * relaxation_time(c)), {}};
    if (!c.body_force_n_m3) return scales;
    for (std::size_t a = 0; a < 3; ++a)
        scales.velocity[a] = (*c.body_force_n_m3)[a] *
                             (1 / units(c).force_n_m3() - 1 / units(f).force_n_m3()) / 2;
    return scales;
}

void apply(const Scales& scales, double sign, double* flow, std::size_t count) {
    const double factor = sign > 0 ? scales.stress : 1 / scales.stress;
    for (std::size_t a = 0; a < 3; ++a) {
        if (scales.velocity[a] == 0) continue;
        double* u = flow + (1 + a) * count;
        for (std::size_t i = 0; i < count; ++i) u[i] += sign * scales.velocity[a];
    }
    double* stress = flow + first_stress * count;
    for (std::size_t i = 0; i < (numbers - first_stress) * count; ++i) stress[i] *= factor;
}

// sum += weight * from
void add_scaled(double weight, const double* from, std::size_t count, double* sum) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += weight * from[i];
}

// lo: the cell that `coarse` begins with.
void expand_row(const double* coarse, const std::vector<Weights>& weights, int lo,
                double* fine) {
    for (std::size_t x = 0; x < weights.size(); ++x) {
        const double* c = coarse + (weights[x].first - lo);
        const auto& w = weights[x].of;
        fine[x] = (w[0] * c[0] + w[1] * c[1]) + (w[2] * c[2] + w[3] * c[3]);
    }
}

}  // namespace

std::vector<std::vector<CellBox>> ring_of(const Level& fine) {
    std::vector<std::vector<CellBox>> rings;
    for (const CellBox& owned : fine.owned_by_rank())
        rings.push_back(without(owned, fine.place.inside));
    return rings;
}

Prolongation::Prolongation(const Level& coarse,
                           const std::vector<std::vector<CellBox>>& of_ranks)
    : transfer_(coarse.comm(), coarse.owned_by_rank(), coarse.place.period,
                coarse_beneath(of_ranks, coarse.place)) {
    for (const CellBox& box : of_ranks[static_cast<std::size_t>(rank_of(coarse.comm()))]) {
        const CellBox beneath = coarse_beneath(box, coarse.place);
        pieces_.push_back(
            {box, beneath,
             std::vector<double>(numbers * static_cast<std::size_t>(cells_of(beneath)))});
    }
}

void Prolongation::run(const Level& coarse, const Level& fine) {
    const View view = coarse.state().view();
    transfer_.run(
        numbers,
        [&](const CellRow& row, double* flow) { read_flow(view, coarse.local(row), flow); },
        [&](std::size_t box, const CellRow& row, const double* flow) {
            Piece& piece = pieces_[box];
            const CellBox& c = piece.coarse;
            const auto nx = static_cast<std::size_t>(c.hi[0] - c.lo[0]);
            const auto ny = static_cast<std::size_t>(c.hi[1] - c.lo[1]);
            const auto count = static_cast<std::size_t>(row.size());
            double* plane = piece.flow.data() +
                            static_cast<std::size_t>(row.z - c.lo[2]) * numbers * ny * nx;
            for (std::size_t i = 0; i < numbers; ++i)
                std::copy_n(flow + i * count, count,
                            plane + (i * ny + static_cast<std::size_t>(row.y - c.lo[1])) *
                                        nx +
                                static_cast<std::size_t>(row.x_begin - c.lo[0]));
        });
    for (const Piece& piece : pieces_) interpolate(piece, coarse, fine);
}

void Prolongation::interpolate(const Piece& piece, const Level& coarse,
                               const Level& fine) {
    const Scales scales = to_fine(coarse, fine);
    const View view = fine.state().view();
    const CellBox& c = piece.coarse;
    const auto nx = static_cast<std::size_t>(c.hi[0] - c.lo[0]);
    const auto ny = static_cast<std::size_t>(c.hi[1] - c.lo[1]);
    const auto length = static_cast<std::size_t>(piece.fine.hi[0] - piece.fine.lo[0]);
    std::vector<Weights> along_x;
    for (int x = piece.fine.lo[0]; x < piece.fine.hi[0]; ++x)
        along_x.push_back(coarse_around(x, coarse.place, 0));
    std::vector<double> plane(numbers * ny * nx), line(numbers * nx),
        row(numbers * length);
    for (int z = piece.fine.lo[2]; z < piece.fine.hi[2]; ++z) {
        const Weights wz = coarse_around(z, coarse.place, 2);
        std::ranges::fill(plane, 0.0);
        for (std::size_t k = 0; k < points; ++k)
            add_scaled(wz.of[k],
                       piece.flow.data() +
                           (static_cast<std::size_t>(wz.first - c.lo[2]) + k) *
                               plane.size(),
                       plane.size(), plane.data());
        for (int y = piece.fine.lo[1]; y < piece.fine.hi[1]; ++y) {
            const Weights wy = coarse_around(y, coarse.place, 1);
            for (std::size_t i = 0; i < numbers; ++i) {
                const double* at =
                    plane.data() +
                    (i * ny + static_cast<std::size_t>(wy.first - c.lo[1])) * nx;
                double* sum = line.data() + i * nx;
                for (std::size_t x = 0; x < nx; ++x)
                    sum[x] = (wy.of[0] * at[x] + wy.of[1] * at[nx + x]) +
                             (wy.of[2] * at[2 * nx + x] + wy.of[3] * at[3 * nx + x]);
                expand_row(sum, along_x, c.lo[0], row.data() + i * length);
            }
            apply(scales, 1, row.data(), length);
            write_flow(view,
                       fine.local({y, z, piece.fine.lo[0], piece.fine.hi[0]}), row.data());
        }
    }
}

namespace {

// Of a coarse cell, among the fine ones within the level's stored cells.
Weights fine_in(int coarse_cell, const LevelPlace& fine, int axis) {
    const bool wraps = fine.period[axis] > 0;
    const int lo = wraps ? -points : fine.stored.lo[axis];
    const int hi = wraps ? fine.domain[axis] + points : fine.stored.hi[axis];
    return cubic_at(2 * coarse_cell + 0.5, lo, hi);
}

// The stress is the mean of the cell's own two.
constexpr std::array<int, 2> halves{0, 1};

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
        box.hi[d] = std::max(fine_in(share.hi[d] - 1, place, d).first + points,
                             2 * share.hi[d]);
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

// Along a periodic x axis a row's cubic reads beyond its ends: two cells more on both.
const double* Restriction::fine_row(const Level& fine, int y, int z,
                                    RestrictedMass& mass) {
    const auto count = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    for (std::size_t b = 0; b < halo_.size(); ++b) {
        const CellBox& box = halo_[b];
        if (y < box.lo[1] || y >= box.hi[1] || z < box.lo[2] || z >= box.hi[2]) continue;
        const auto row =
            static_cast<std::size_t>((z - box.lo[2]) * (box.hi[1] - box.lo[1]) + y -
                                     box.lo[1]);
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

// One plane of fine cells, averaged along x and y: [y][number][x] of mine_.
void Restriction::average_plane(const Level& fine, int z, std::vector<double>& plane,
                                RestrictedMass& mass) {
    const LevelPlace& place = fine.place;
    const int nx = mine_.hi[0] - mine_.lo[0];
    const auto width = static_cast<std::size_t>(nx);
    const auto count = static_cast<std::size_t>(needed_.hi[0] - needed_.lo[0]);
    const int period = place.period[0];
    std::vector<Weights> along_x;
    for (int x = mine_.lo[0]; x < mine_.hi[0]; ++x)
        along_x.push_back(fine_in(x, place, 0));
    std::vector<Weights> along_y;
    for (int y = mine_.lo[1]; y < mine_.hi[1]; ++y)
        along_y.push_back(fine_in(y, place, 1));
    std::ranges::fill(plane, 0.0);
    std::vector<double> line(numbers * width);
    const auto at = [&](const double* of, int x) {
        if (period > 0) x = (x + period) % period;
        return of[x - needed_.lo[0]];
    };
    for (int y = needed_.lo[1]; y < needed_.hi[1]; ++y) {
        const double* row = fine_row(fine, y, z, mass);
        for (std::size_t i = 0; i < numbers; ++i) {
            const double* of = row + i * count;
            double* sum = line.data() + i * width;
            for (std::size_t x = 0; x < width; ++x) {
                const Weights& w = along_x[x];
                if (i >= first_stress) {
                    const int first = 2 * (mine_.lo[0] + static_cast<int>(x));
                    sum[x] = 0.5 * (at(of, first) + at(of, first + 1));
                    continue;
                }
                sum[x] = 0;
                for (int k = 0; k < points; ++k)
                    sum[x] += w.of[static_cast<std::size_t>(k)] * at(of, w.first + k);
            }
        }
        for (std::size_t j = 0; j < along_y.size(); ++j) {
            double* to = plane.data() + j * numbers * width;
            const int k = y - along_y[j].first;
            if (k >= 0 && k < points)
                add_scaled(along_y[j].of[static_cast<std::size_t>(k)], line.data(),
                           first_stress * width, to);
            if (const int half = y - 2 * (mine_.lo[1] + static_cast<int>(j));
                half == halves[0] || half == halves[1])
                add_scaled(0.5, line.data() + first_stress * width,
                           (numbers - first_stress) * width, to + first_stress * width);
        }
    }
}

void Restriction::average(const Level& fine, RestrictedMass& mass) {
    std::ranges::fill(averaged_, 0.0);
    if (is_empty(mine_)) return;
    const auto width = static_cast<std::size_t>(mine_.hi[0] - mine_.lo[0]);
    const auto rows = static_cast<std::size_t>(mine_.hi[1] - mine_.lo[1]);
    std::vector<double> plane(rows * numbers * width);
    for (int z = needed_.lo[2]; z < needed_.hi[2]; ++z) {
        average_plane(fine, z, plane, mass);
        for (int c = mine_.lo[2]; c < mine_.hi[2]; ++c) {
            const Weights w = fine_in(c, fine.place, 2);
            const int k = z - w.first, half = z - 2 * c;
            const double cubic =
                k >= 0 && k < points ? w.of[static_cast<std::size_t>(k)] : 0;
            const double mean = half == halves[0] || half == halves[1] ? 0.5 : 0;
            if (cubic == 0 && mean == 0) continue;
            double* to = averaged_.data() +
                         static_cast<std::size_t>(c - mine_.lo[2]) * plane.size();
            for (std::size_t j = 0; j < rows; ++j) {
                const std::size_t first = j * numbers * width;
                add_scaled(cubic, plane.data() + first, first_stress * width, to + first);
                const std::size_t stress = first + first_stress * width;
                add_scaled(mean, plane.data() + stress, (numbers - first_stress) * width,
                           to + stress);
            }
        }
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
