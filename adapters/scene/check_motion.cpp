// Faces that something outside holds and moves.
#include "adapters/scene/check_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

double length(const Vec3& v) {
    return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

double largest_speed_m_s(const PrescribedMotion& motion) {
    constexpr double pi = std::numbers::pi;
    if (const auto* o = std::get_if<Oscillation>(&motion.course))
        return 2 * pi * o->frequency_hz * length(o->amplitude_m);
    const auto& ramp = std::get<DisplacementRamp>(motion.course);
    return pi / 2 * length(ramp.displacement_m) / ramp.duration_s;
}

void check_prescribed_motion(const Scene& scene, const Body& body, const Marks& marks) {
    std::vector<std::string> held = body.clamps;
    for (std::size_t i = 0; i < body.prescribed_motion.size(); ++i) {
        const Origin& here = marks.item({"bodies", body.name, "prescribed_motion"}, i);
        if (scene.time.equilibrium)
            refuse(here, "a prescribed motion on a path of equilibria",
                   "it in runs over time", "leave time.equilibrium out, or the motion");
        for (const std::string& face : body.prescribed_motion[i].faces) {
            check_face(body, face, "prescribed_motion", here);
            if (std::ranges::find(held, face) != held.end())
                refuse(here,
                       fmt::format("the moved face {} held besides", in_quotes(face)),
                       "each face once in clamps or prescribed_motion");
            held.push_back(face);
        }
    }
}

}  // namespace magfsi::scene
