#include "adapters/bodies/body_probes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace magfsi::bodies {

namespace {

double total_mass(const BodyNodes& body, const NodalState& state) {
    double mass = 0;
    for (std::size_t i = 0; i < body.count; ++i) mass += state.mass_kg[body.first + i];
    return mass;
}

template <typename Field>
Vec3 mass_weighted_mean(const BodyNodes& body, const NodalState& state,
                        const Field& field) {
    Vec3 sum{};
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        for (std::size_t d = 0; d < 3; ++d) sum[d] += state.mass_kg[i] * field[i][d];
    }
    const double mass = total_mass(body, state);
    for (double& s : sum) s /= mass;
    return sum;
}

double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Angle of the way from a to b in the x-z plane, from x towards z.
double heading(const Vec3& a, const Vec3& b) {
    return std::atan2(b[2] - a[2], b[0] - a[0]);
}

// Signed turn from one heading to the next, within half a turn.
double turn(double from, double to) {
    return std::remainder(to - from, 2 * std::numbers::pi);
}

}  // namespace

Vec3 position(const structure::MaterialPoint& point, const NodalState& state,
              std::size_t first_node) {
    Vec3 at{};
    for (std::size_t a = 0; a < 8; ++a) {
        const Vec3& node =
            state.position_m[first_node + static_cast<std::size_t>(point.node[a])];
        for (std::size_t d = 0; d < 3; ++d) at[d] += point.weight[a] * node[d];
    }
    return at;
}

Vec3 centre_of_mass(const BodyNodes& body, const NodalState& state) {
    return mass_weighted_mean(body, state, state.position_m);
}

Vec3 mean_velocity(const BodyNodes& body, const NodalState& state) {
    return mass_weighted_mean(body, state, state.velocity_m_s);
}

double kinetic_energy_j(const BodyNodes& body, const NodalState& state) {
    double energy = 0;
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        const Vec3& v = state.velocity_m_s[i];
        energy += 0.5 * state.mass_kg[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return energy;
}

double max_displacement_m(const BodyNodes& body, const NodalState& state) {
    double largest = 0;
    for (std::size_t i = 0; i < body.count; ++i) {
        largest = std::max(largest,
                           distance(state.position_m[body.first + i], body.start_m[i]));
    }
    return largest;
}

Shape shape(const BodyNodes& body, const NodalState& state) {
    std::vector<Vec3> line;
    for (const auto& point : body.centre_line) {
        line.push_back(position(point, state, body.first));
    }
    Shape s;
    if (line.size() < 4) return s;
    const Vec3& left = line.front();
    const Vec3& right = line.back();
    const std::size_t middle = line.size() / 2;
    s.end_to_end_m = distance(left, right);

    const double tangent =
        heading(line[middle - 1], line[middle + 1 < line.size() ? middle + 1 : middle]);
    const double dx = line[middle][0] - 0.5 * (left[0] + right[0]);
    const double dz = line[middle][2] - 0.5 * (left[2] + right[2]);
    s.mid_rise_m = -std::sin(tangent) * dx + std::cos(tangent) * dz;

    double before = heading(line[0], line[1]);
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double now = heading(line[i], line[i + 1]);
        s.bend_rad += turn(before, now);
        before = now;
    }
    return s;
}

}  // namespace magfsi::bodies
