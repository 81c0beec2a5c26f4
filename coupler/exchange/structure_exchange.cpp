#include "coupler/exchange/structure_exchange.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/exchange/kept_messages.h"
#include "coupler/exchange/message.h"
#include "coupler/participants/wait.h"

namespace magfsi::coupler {

StructureExchange::StructureExchange(const World& world, const Grid& grid, Kernel kernel,
                                     double timeout_s)
    : world_(world), grid_(grid), kernel_(kernel), timeout_s_(timeout_s) {
    const auto ranks = static_cast<std::size_t>(world.partner_size());
    out_.resize(ranks);
    in_.resize(ranks);
}

StructureExchange::~StructureExchange() {
    if (!sending_.empty()) keep_until_exit(out_);
}

int StructureExchange::partners() const {
    return static_cast<int>(std::count_if(table_.begin(), table_.end(),
                                          [](const auto& m) { return !m.empty(); }));
}

void StructureExchange::renew(std::int64_t step, std::span<const Vec3> points_m) {
    table_ = partner_table(grid_, kernel_, points_m);
    renewed_at_.assign(points_m.begin(), points_m.end());
    std::vector<int> mine(table_.size());
    std::vector<int> theirs(table_.size());  // the fluid sends zeros
    for (std::size_t f = 0; f < table_.size(); ++f)
        mine[f] = static_cast<int>(table_[f].size());
    MPI_Request request;
    MPI_Ialltoall(mine.data(), 1, MPI_INT, theirs.data(), 1, MPI_INT, world_.partner(),
                  &request);
    wait_all({&request, 1}, step < 0 ? startup_timeout_s : timeout_s_,
             fmt::format("partner table of step {}", step));
}

void StructureExchange::post(const Occasion& when, std::span<const Vec3> before_m,
                             std::span<const Vec3> impulse, std::span<const Vec3> now_m) {
    sending_.clear();
    for (std::size_t f = 0; f < table_.size(); ++f) {
        if (table_[f].empty()) continue;
        out_[f].resize(marker_message_size(table_[f].size()));
        write_header(out_[f], when, table_[f].size());
        double* at = out_[f].data() + message_header;
        for (const int marker : table_[f]) {
            const auto m = static_cast<std::size_t>(marker);
            put(at, before_m[m]);
            put(at + 3, impulse[m]);
            put(at + 6, now_m[m]);
            at += marker_values;
        }
        MPI_Request& request = sending_.emplace_back();
        MPI_Isend(out_[f].data(), static_cast<int>(out_[f].size()), MPI_DOUBLE,
                  static_cast<int>(f), marker_tag, world_.partner(), &request);
    }
}

void StructureExchange::send_first(std::span<const Vec3> points_m) {
    const std::vector<Vec3> nothing(points_m.size());
    send_first(points_m, nothing, points_m);
}

void StructureExchange::send_first(std::span<const Vec3> before_m,
                                   std::span<const Vec3> impulse,
                                   std::span<const Vec3> now_m) {
    renew(-1, now_m);
    post(-1, before_m, impulse, now_m);
}

void StructureExchange::send(const Occasion& when, std::span<const Vec3> before_m,
                             std::span<const Vec3> impulse, std::span<const Vec3> now_m) {
    if (renews_partners(when)) renew(when.step, before_m);
    check_margin(grid_, renewed_at_, now_m, when.step);
    post(when, before_m, impulse, now_m);
}

void StructureExchange::receive(const Occasion& when, std::span<Vec3> velocity) {
    std::vector<int> ranks;
    for (std::size_t f = 0; f < table_.size(); ++f) {
        if (!table_[f].empty()) ranks.push_back(static_cast<int>(f));
    }
    const std::string what = fmt::format("fluid velocities of step {}", when.step);
    wait_for_messages(world_.partner(), ranks, velocity_tag, timeout_s_, what);
    std::vector<MPI_Request> requests(sending_);
    for (std::size_t f = 0; f < table_.size(); ++f) {
        if (table_[f].empty()) continue;
        in_[f].resize(velocity_message_size(table_[f].size()));
        MPI_Request& request = requests.emplace_back();
        MPI_Irecv(in_[f].data(), static_cast<int>(in_[f].size()), MPI_DOUBLE,
                  static_cast<int>(f), velocity_tag, world_.partner(), &request);
    }
    wait_all(requests, timeout_s_, what);
    sending_.clear();

    std::fill(velocity.begin(), velocity.end(), Vec3{});
    for (std::size_t f = 0; f < table_.size(); ++f) {
        if (table_[f].empty()) continue;
        check_header(in_[f], when, table_[f].size(), fmt::format("fluid rank {}", f));
        const double* at = in_[f].data() + message_header;
        for (const int marker : table_[f]) {
            for (std::size_t d = 0; d < 3; ++d)
                velocity[static_cast<std::size_t>(marker)][d] += at[d];
            at += velocity_values;
        }
    }
}

}  // namespace magfsi::coupler
