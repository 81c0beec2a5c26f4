#include "coupler/exchange/fluid_exchange.h"

#include <fmt/format.h>

#include <exception>
#include <numeric>

#include "coupler/exchange/kept_messages.h"
#include "coupler/exchange/message.h"
#include "coupler/exchange/partner_table.h"
#include "coupler/participants/wait.h"

namespace magfsi::coupler {

FluidExchange::FluidExchange(const World& world, double timeout_s)
    : world_(world), timeout_s_(timeout_s) {
    const auto ranks = static_cast<std::size_t>(world.partner_size());
    count_.assign(ranks, 0);
    in_.resize(ranks);
    out_.resize(ranks);
}

FluidExchange::~FluidExchange() {
    if (std::uncaught_exceptions() > 0) {
        if (!sending_.empty()) keep_until_exit(out_);
        return;
    }
    try {
        wait_all(sending_, timeout_s_, "receiver of the last velocities");
    } catch (const std::exception&) {
        // The structure waits for these velocities no more; it has said why.
    }
}

void FluidExchange::renew(std::int64_t step) {
    const std::vector<int> nothing(count_.size(), 0);
    MPI_Request request;
    MPI_Ialltoall(nothing.data(), 1, MPI_INT, count_.data(), 1, MPI_INT, world_.partner(),
                  &request);
    wait_all({&request, 1}, step < 0 ? startup_timeout_s : timeout_s_,
             fmt::format("partner table of step {}", step));
    const auto total =
        static_cast<std::size_t>(std::accumulate(count_.begin(), count_.end(), 0));
    senders_.clear();
    for (std::size_t s = 0; s < count_.size(); ++s) {
        if (count_[s] > 0) senders_.push_back(static_cast<int>(s));
    }
    batch_.before_m.resize(total);
    batch_.impulse.resize(total);
    batch_.now_m.resize(total);
}

const MarkerBatch& FluidExchange::receive(const Occasion& when) {
    if (renews_partners(when)) renew(when.step);
    return receive_more(when);
}

const MarkerBatch& FluidExchange::receive_more(const Occasion& when) {
    const std::int64_t step = when.step;
    const double limit_s = step < 0 ? startup_timeout_s : timeout_s_;
    const std::string what = fmt::format("structure markers of step {}", step);
    wait_for_messages(world_.partner(), senders_, marker_tag, limit_s, what);
    std::vector<MPI_Request> requests(sending_);
    for (const int sender : senders_) {
        const auto s = static_cast<std::size_t>(sender);
        in_[s].resize(marker_message_size(static_cast<std::size_t>(count_[s])));
        MPI_Request& request = requests.emplace_back();
        MPI_Irecv(in_[s].data(), static_cast<int>(in_[s].size()), MPI_DOUBLE, sender,
                  marker_tag, world_.partner(), &request);
    }
    wait_all(requests, limit_s, what);
    sending_.clear();
    unpack(when);
    return batch_;
}

void FluidExchange::unpack(const Occasion& when) {
    std::size_t m = 0;
    for (std::size_t s = 0; s < count_.size(); ++s) {
        if (count_[s] == 0) continue;
        const auto count = static_cast<std::size_t>(count_[s]);
        check_header(in_[s], when, count, fmt::format("structure rank {}", s));
        const double* at = in_[s].data() + message_header;
        for (std::size_t i = 0; i < count; ++i, ++m, at += marker_values) {
            batch_.before_m[m] = get(at);
            batch_.impulse[m] = get(at + 3);
            batch_.now_m[m] = get(at + 6);
        }
    }
}

void FluidExchange::send(const Occasion& when, std::span<const Vec3> velocity) {
    std::size_t m = 0;
    for (std::size_t s = 0; s < count_.size(); ++s) {
        if (count_[s] == 0) continue;
        const auto count = static_cast<std::size_t>(count_[s]);
        out_[s].resize(velocity_message_size(count));
        write_header(out_[s], when, count);
        double* at = out_[s].data() + message_header;
        for (std::size_t i = 0; i < count; ++i, ++m, at += velocity_values)
            put(at, velocity[m]);
        MPI_Request& request = sending_.emplace_back();
        MPI_Isend(out_[s].data(), static_cast<int>(out_[s].size()), MPI_DOUBLE,
                  static_cast<int>(s), velocity_tag, world_.partner(), &request);
    }
}

void FluidExchange::finish_sending() {
    wait_all(sending_, timeout_s_, "receiver of the velocities");
    sending_.clear();
}

}  // namespace magfsi::coupler
