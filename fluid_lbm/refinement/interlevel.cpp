#include "fluid_lbm/refinement/interlevel.h"

#include <array>
#include <cmath>
#include <map>

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

// From the coarse level's numbers to the fine one's; both have the velocity before half
// of the step's body force, of which the finer one's is half as large.
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
    for (std::size_t i = 0; i < (numbers - first_stress) * count; ++i)
        stress[i] *= factor;
}

// The loops below are compiled for AVX2, too, and chosen when the program starts.
#define MAGFSI_ROW_LOOP __attribute__((target_clones("avx2", "default")))

MAGFSI_ROW_LOOP void add_scaled(double weight, const double* from, std::size_t count,
                                double* sum) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += weight * from[i];
}

// Of four rows that lie `apart` from each other.
MAGFSI_ROW_LOOP void combine(const std::array<double, points>& w, const double* rows,
                             std::size_t apart, std::size_t count, double* sum) {
    const double *a = rows, *b = a + apart, *c = b + apart, *d = c + apart;
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = (w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]);
}

// Weights of the fine cells of a row; lo: the first coarse cell that is there.
struct Expansion {
    std::vector<Weights> of;
    int lo = 0;
    bool regular = true;  // as away from sides: pairs of cells alike

    Expansion(const CellBox& fine, const CellBox& beneath, const LevelPlace& coarse)
        : lo(beneath.lo[0]) {
        for (int x = fine.lo[0]; x < fine.hi[0]; ++x) {
            of.push_back(coarse_around(x, coarse, 0));
            const auto n = of.size();
            regular = regular && (n < 3 || (of[n - 1].of == of[n - 3].of &&
                                            of[n - 1].first == of[n - 3].first + 1));
        }
    }
};

// Every other cell of a regular row, from the one that w belongs to.
MAGFSI_ROW_LOOP void expand_half(const std::array<double, points>& w,
                                 const double* coarse, std::size_t count, double* fine) {
    for (std::size_t m = 0; m < count; ++m)
        fine[2 * m] = (w[0] * coarse[m] + w[1] * coarse[m + 1]) +
                      (w[2] * coarse[m + 2] + w[3] * coarse[m + 3]);
}

void expand_row(const double* coarse, const Expansion& along_x, double* fine) {
    const std::size_t count = along_x.of.size();
    if (along_x.regular && count > 8) {
        for (std::size_t half = 0; half < 2; ++half) {
            const Weights& w = along_x.of[half];
            expand_half(w.of, coarse + (w.first - along_x.lo), (count + 1 - half) / 2,
                        fine + half);
        }
        return;
    }
    for (std::size_t x = 0; x < count; ++x) {
        const double* c = coarse + (along_x.of[x].first - along_x.lo);
        const auto& w = along_x.of[x].of;
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
    for (const CellBox& box :
         of_ranks[static_cast<std::size_t>(rank_of(coarse.comm()))]) {
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
        [&](const CellRow& row, double* flow) {
            read_flow(view, coarse.local(row), flow);
        },
        [&](std::size_t box, const CellRow& row, const double* flow) {
            Piece& piece = pieces_[box];
            const CellBox& c = piece.coarse;
            const auto nx = static_cast<std::size_t>(c.hi[0] - c.lo[0]);
            const auto ny = static_cast<std::size_t>(c.hi[1] - c.lo[1]);
            const auto count = static_cast<std::size_t>(row.size());
            double* to = piece.flow.data() +
                         (static_cast<std::size_t>(row.z - c.lo[2]) * ny +
                          static_cast<std::size_t>(row.y - c.lo[1])) *
                             numbers * nx +
                         static_cast<std::size_t>(row.x_begin - c.lo[0]);
            for (std::size_t i = 0; i < numbers; ++i)
                std::copy_n(flow + i * count, count, to + i * nx);
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
    const Expansion along_x(piece.fine, c, coarse.place);
    std::vector<double> plane(ny * numbers * nx), line(numbers * nx),
        row(numbers * length);
    for (int z = piece.fine.lo[2]; z < piece.fine.hi[2]; ++z) {
        const Weights wz = coarse_around(z, coarse.place, 2);
        const auto k = static_cast<std::size_t>(wz.first - c.lo[2]);
        combine(wz.of, piece.flow.data() + k * plane.size(), plane.size(), plane.size(),
                plane.data());
        for (int y = piece.fine.lo[1]; y < piece.fine.hi[1]; ++y) {
            const Weights wy = coarse_around(y, coarse.place, 1);
            const auto j = static_cast<std::size_t>(wy.first - c.lo[1]);
            combine(wy.of, plane.data() + j * line.size(), line.size(), line.size(),
                    line.data());
            for (std::size_t i = 0; i < numbers; ++i)
                expand_row(line.data() + i * nx, along_x, row.data() + i * length);
            apply(scales, 1, row.data(), length);
            write_flow(view, fine.local({y, z, piece.fine.lo[0], piece.fine.hi[0]}),
                       row.data());
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
