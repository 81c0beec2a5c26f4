// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/exchange/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <numeric>

#include "coupler/participants/errors.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

namespace {

using Messages = std::vector<std::vector<double>>;

// Keeps buffers alive until the process ends. MPI copies no long message: the partner may
// read it from here until then, and would otherwise take freed memory for an answer.
void keep_until_exit(Messages& messages) {
    static auto& kept = *new std::vector<Messages>;  // never freed
    kept.push_back(std::move(messages));
}

std::string in_words(const Occasion& when) {
    if (when.iteration == 0) return fmt::format("step {}", when.step);
    return fmt::format("step {}, iteration {}", when.step, when.iteration);
}

using Box = std::array<Vec3, 2>;

// The empty box: any point widens it.
constexpr Box no_box() {
    constexpr double most = std::numeric_limits<double>::max();
    return {Vec3{most, most, most}, Vec3{-most, -most, -most}};
}

void widen(Box& box, const Vec3& low, const Vec3& high) {
    box = {lower(box[0], low), higher(box[1], high)};
}

// Exchanges with every rank of the partner the number of markers that each side will
// send. A new run may take long to start, so the exchange before the first step has no
// time limit.
void exchange_counts(const World& world, const std::vector<int>& mine,
                     std::vector<int>& theirs, std::int64_t step, double timeout_s) {
    MPI_Request request;
    MPI_Ialltoall(mine.data(), 1, MPI_INT, theirs.data(), 1, MPI_INT, world.partner(),
                  &request);
    wait_all({&request, 1}, step < 0 ? no_timeout_s : timeout_s,
             fmt::format("partner table of step {}", step));
}

void start_send(const World& world, int rank, int tag, const std::vector<double>& message,
                std::vector<MPI_Request>& sending) {
    world.send(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, rank, tag,
               &sending.emplace_back());
}

// Receives a message from each of the ranks into its place in `in`, and completes the
// sends in `sending`. An empty buffer takes the size of its message; a filled one must
// have it.
void receive_from(const World& world, const std::vector<int>& ranks, int tag,
                  Messages& in, std::vector<MPI_Request>& sending, double timeout_s,
                  const std::string& what) {
    wait_for_messages(world.partner(), ranks, tag, timeout_s, what);
    std::vector<MPI_Request> requests(sending);
    for (const int rank : ranks) {
        auto& message = in[rank];
        if (message.empty()) {
            MPI_Status status;
            int numbers = 0;
            MPI_Probe(rank, tag, world.partner(), &status);
            MPI_Get_count(&status, MPI_DOUBLE, &numbers);
            message.resize(numbers);
        }
        MPI_Irecv(message.data(), message.size(), MPI_DOUBLE, rank, tag, world.partner(),
                  &requests.emplace_back());
    }
    wait_all(requests, timeout_s, what);
    sending.clear();
}

// The boxes of each rank as a flat list: their number, then six numbers for each.
std::vector<double> to_numbers(const std::vector<std::vector<CellBox>>& by_rank) {
    std::vector<double> numbers;
    for (const auto& boxes : by_rank) {
        numbers.push_back(static_cast<double>(boxes.size()));
        for (const CellBox& box : boxes) {
            numbers.insert(numbers.end(), box.lo.begin(), box.lo.end());
            numbers.insert(numbers.end(), box.hi.begin(), box.hi.end());
        }
    }
    return numbers;
}

void from_numbers(const double* number, std::vector<std::vector<CellBox>>& by_rank) {
    for (auto& boxes : by_rank) {
        boxes.resize(*number++);
        for (CellBox& box : boxes) {
            for (int& low : box.lo) low = *number++;
            for (int& high : box.hi) high = *number++;
        }
    }
}

}  // namespace

void write_header(std::vector<double>& message, const Occasion& when,
                  std::size_t markers) {
    message[0] = static_cast<double>(when.step);
    message[1] = static_cast<double>(when.iteration);
    message[2] = static_cast<double>(markers);
}

void check_header(std::span<const double> message, const Occasion& when,
                  std::size_t markers, const std::string& sender) {
    const Occasion got(static_cast<std::int64_t>(message[0]),
                       static_cast<int>(message[1]));
    const std::size_t got_markers = message[2];
    const bool now = got.step == when.step && got.iteration == when.iteration;
    if (now && got_markers == markers) return;
    throw PartnerLost(
        fmt::format("the two sides are out of step: a message of {} carries {} with {} "
                    "markers, expected {} with {}; start both with the same scene, from "
                    "the same build",
                    sender, in_words(got), got_markers, in_words(when), markers));
}

StructureExchange::StructureExchange(const World& world, Grid grid, Kernel kernel,
                                     double timeout_s, Forcing forcing,
                                     std::size_t bodies, std::vector<int> body_of)
    : world_(world),
      grid_(std::move(grid)),
      kernel_(kernel),
      timeout_s_(timeout_s),
      forcing_(forcing),
      bodies_(bodies),
      body_of_(std::move(body_of)),
      out_(world.partner_size()),
      in_(out_.size()) {}

StructureExchange::~StructureExchange() {
    if (!sending_.empty()) keep_until_exit(out_);
}

void StructureExchange::let_follow(std::int64_t step, std::span<const Vec3> points_m) {
    std::vector<Box> mine(bodies_, no_box());
    for (std::size_t m = 0; m < points_m.size(); ++m) {
        const std::size_t body = body_of_.empty() ? 0 : body_of_[m];
        widen(mine[body], points_m[m], points_m[m]);
    }
    std::vector<MPI_Request> sending;
    for (int f = 0; f < world_.partner_size(); ++f)
        world_.send(mine.front().front().data(), static_cast<int>(6 * mine.size()),
                    MPI_DOUBLE, f, place_tag, &sending.emplace_back());
    Messages in(1);
    receive_from(world_, {0}, place_tag, in, sending,
                 step < 0 ? no_timeout_s : timeout_s_,
                 fmt::format("position of the fluid's grid at step {}", step));
    from_numbers(in.front().data(), grid_.owned_by_rank);
}

void StructureExchange::renew(std::int64_t step, std::span<const Vec3> points_m) {
    if (grid_.follows) let_follow(step, points_m);
    table_ = partner_table(grid_, kernel_, points_m);
    renewed_at_.assign(points_m.begin(), points_m.end());
    std::vector<int> mine(table_.size());
    std::vector<int> theirs(table_.size());  // filled with the fluid's zeros
    partners_.clear();
    for (std::size_t f = 0; f < table_.size(); ++f) {
        const std::size_t markers = table_[f].size();
        mine[f] = markers;
        if (markers == 0) continue;
        partners_.push_back(f);
        out_[f].resize(message_header + marker_values_of(forcing_) * markers);
        in_[f].resize(message_header + velocity_values_of(forcing_) * markers);
    }
    exchange_counts(world_, mine, theirs, step, timeout_s_);
}

void StructureExchange::send(const Occasion& when, std::span<const Vec3> before_m,
                             std::span<const Vec3> impulse, std::span<const Vec3> now_m,
                             std::span<const double> volume_m3) {
    if (renews_partners(when, grid_.renewal))
        renew(when.step, when.step < 0 ? now_m : before_m);
    check_margin(grid_, renewed_at_, now_m, when.step);
    sending_.clear();
    for (const int partner : partners_) {
        const std::size_t f = partner;
        write_header(out_[f], when, table_[f].size());
        double* at = out_[f].data() + message_header;
        for (const int marker : table_[f]) {
            const std::size_t m = marker;
            put(at, before_m[m]);
            put(at + 3, impulse[m]);
            put(at + 6, now_m[m]);
            if (!volume_m3.empty()) at[9] = volume_m3[m];
            at += marker_values_of(forcing_);
        }
        start_send(world_, partner, marker_tag, out_[f], sending_);
    }
}

void StructureExchange::receive(const Occasion& when, std::span<Vec3> velocity,
                                NoSlipAnswer* more) {
    receive_from(world_, partners_, velocity_tag, in_, sending_, timeout_s_,
                 fmt::format("fluid velocities of step {}", when.step));
    std::ranges::fill(velocity, Vec3{});
    if (more)
        *more = {std::vector<double>(velocity.size()),
                 std::vector<Vec3>(velocity.size())};
    for (const int partner : partners_) {
        const std::size_t f = partner;
        check_header(in_[f], when, table_[f].size(), fmt::format("fluid rank {}", f));
        const double* at = in_[f].data() + message_header;
        for (const int marker : table_[f]) {
            const std::size_t m = marker;
            velocity[m] += vector_at(at);
            if (more) {
                more->row_sum[m] += at[3];
                more->passed[m] += vector_at(at + 4);
            }
            at += velocity_values_of(forcing_);
        }
    }
}

FluidExchange::FluidExchange(const World& world, double timeout_s, Forcing forcing,
                             GridFluid* follower)
    : world_(world),
      timeout_s_(timeout_s),
      forcing_(forcing),
      follower_(follower),
      count_(world.partner_size()),
      in_(count_.size()),
      out_(count_.size()) {}

FluidExchange::~FluidExchange() {
    if (std::uncaught_exceptions() > 0) {
        if (!sending_.empty()) keep_until_exit(out_);
        return;
    }
    try {
        wait_all(sending_, timeout_s_, "receiver of the last velocities");
    } catch (const std::exception&) {
        // The structure has ended without these velocities and has reported why.
    }
}

void FluidExchange::renew(std::int64_t step) {
    const std::vector<int> nothing(count_.size(), 0);
    exchange_counts(world_, nothing, count_, step, timeout_s_);
    partners_.clear();
    for (std::size_t s = 0; s < count_.size(); ++s) {
        if (count_[s] == 0) continue;
        partners_.push_back(s);
        const std::size_t markers = count_[s];
        in_[s].resize(message_header + marker_values_of(forcing_) * markers);
    }
    const std::size_t total = std::accumulate(count_.begin(), count_.end(), 0);
    batch_.before_m.resize(total);
    batch_.impulse.resize(total);
    batch_.now_m.resize(total);
    if (forcing_ == Forcing::no_slip) batch_.volume_m3.resize(total);
}

void FluidExchange::follow(std::int64_t step, bool stays) {
    std::vector<int> all(count_.size());
    std::iota(all.begin(), all.end(), 0);
    Messages in(count_.size());
    std::vector<MPI_Request> sending;
    receive_from(world_, all, place_tag, in, sending,
                 step < 0 ? no_timeout_s : timeout_s_,
                 fmt::format("position of the bodies at step {}", step));
    std::vector<Box> bodies(in.front().size() / 6, no_box());
    for (const auto& message : in) {
        for (std::size_t b = 0; b < bodies.size(); ++b)
            widen(bodies[b], vector_at(message.data() + 6 * b),
                  vector_at(message.data() + 6 * b + 3));
    }
    // Bodies without markers have empty boxes.
    std::erase_if(bodies, [](const Box& box) { return box[0][0] > box[1][0]; });
    if (!stays) follower_->follow(bodies);
    if (world_.rank() != 0) return;
    const std::vector<double> boxes = to_numbers(follower_->grid().owned_by_rank);
    for (const int rank : all) start_send(world_, rank, place_tag, boxes, sending);
    wait_all(sending, timeout_s_, "receiver of the grid's position");
}

const MarkerBatch& FluidExchange::receive(const Occasion& when, bool stays) {
    if (renews_partners(when, follower_ ? follower_->grid().renewal : Renewal{})) {
        if (follower_) follow(when.step, stays);
        renew(when.step);
    }
    receive_from(world_, partners_, marker_tag, in_, sending_,
                 when.step < 0 ? no_timeout_s : timeout_s_,
                 fmt::format("structure markers of step {}", when.step));
    std::size_t m = 0;
    for (const int partner : partners_) {
        const std::size_t s = partner;
        const std::size_t count = count_[s];
        check_header(in_[s], when, count, fmt::format("structure rank {}", s));
        const double* at = in_[s].data() + message_header;
        for (std::size_t i = 0; i < count; ++i, ++m, at += marker_values_of(forcing_)) {
            batch_.before_m[m] = vector_at(at);
            batch_.impulse[m] = vector_at(at + 3);
            batch_.now_m[m] = vector_at(at + 6);
            if (!batch_.volume_m3.empty()) batch_.volume_m3[m] = at[9];
        }
    }
    return batch_;
}

void FluidExchange::send(const Occasion& when, std::span<const Vec3> velocity,
                         const NoSlipAnswer* more) {
    std::size_t m = 0;
    for (const int partner : partners_) {
        const std::size_t s = partner;
        const std::size_t count = count_[s];
        // Sized here and not in renew(), since MPI may still read the last velocities
        // then.
        out_[s].resize(message_header + velocity_values_of(forcing_) * count);
        write_header(out_[s], when, count);
        double* at = out_[s].data() + message_header;
        for (std::size_t i = 0; i < count; ++i, ++m, at += velocity_values_of(forcing_)) {
            put(at, velocity[m]);
            if (!more) continue;
            at[3] = more->row_sum[m];
            put(at + 4, more->passed[m]);
        }
        start_send(world_, partner, velocity_tag, out_[s], sending_);
    }
}

}  // namespace magfsi::coupler
