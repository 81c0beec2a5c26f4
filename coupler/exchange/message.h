// The two messages of a coupled step. Everything is doubles; step numbers and counts are
// exact in them. Each message carries its step, and a receiver refuses any other.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

constexpr int marker_tag = 81;    // structure -> fluid
constexpr int velocity_tag = 82;  // fluid -> structure

constexpr std::size_t message_header = 3;  // step, iteration, number of markers
constexpr std::size_t marker_values = 9;   // position now, impulse, position next
constexpr std::size_t velocity_values = 3;

inline std::size_t marker_message_size(std::size_t markers) {
    return message_header + marker_values * markers;
}
inline std::size_t velocity_message_size(std::size_t markers) {
    return message_header + velocity_values * markers;
}

// Which exchange a message belongs to: the coupled step, -1 before the first, and how
// often an implicit scheme has repeated it.
struct Occasion {
    std::int64_t step = 0;
    int iteration = 0;
    Occasion(std::int64_t step_number, int repeated = 0)
        : step(step_number), iteration(repeated) {}
};

void write_header(std::vector<double>& message, const Occasion& when,
                  std::size_t markers);

// Throws PartnerLost when the message is of another step or iteration, or of another
// number of markers.
void check_header(std::span<const double> message, const Occasion& when,
                  std::size_t markers, const std::string& sender);

inline void put(double* at, const Vec3& v) {
    at[0] = v[0];
    at[1] = v[1];
    at[2] = v[2];
}
inline Vec3 get(const double* at) {
    return {at[0], at[1], at[2]};
}

}  // namespace magfsi::coupler
