#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/checks.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double height_m(const Platform& platform, const Vec3& at_m) {
    Vec3 from{};
    for (int i = 0; i < 3; ++i) from[i] = at_m[i] - platform.point_m[i];
    return dot(from, platform.normal);
}

double half_diagonal_m(const Box& box) {
    return 0.5 * std::hypot(box.size_m[0], box.size_m[1], box.size_m[2]);
}

Vec3 centre_m(const Body& body, const Box& box) {
    Vec3 half{};
    for (int i = 0; i < 3; ++i) half[i] = 0.5 * box.size_m[i];
    return body.initial.position_m.value_or(half);
}

// A uniform field turns a body and leaves its centre of mass where it is.
bool can_travel_towards(const Scene& scene, const Platform& platform) {
    const bool falls = scene.gravity && scene.gravity->acceleration_m_s2 > 0 &&
                       dot(scene.gravity->direction, platform.normal) < 0;
    const bool drawn = scene.magnetic_field && scene.magnetic_field->gradient;
    return falls || drawn || scene.fluid || scene.contact;
}

// How far from its centre a body may ever come to be, if it cannot travel. Of a stretch
// to twice its length; a held one may swing to the other side of where it is held.
double reach_m(const Body& body, const Box& box) {
    const bool held = !body.clamps.empty() || !body.rollers.empty();
    return (held ? 4 : 2) * half_diagonal_m(box);
}

bool out_of_reach(const Scene& scene, const Body& body) {
    const auto* box = std::get_if<Box>(&body.mesh);
    if (!box) return false;  // what its extent is, only the mesh tells
    if (body.clamps.empty() && can_travel_towards(scene, *scene.platform)) return false;
    return height_m(*scene.platform, centre_m(body, *box)) > reach_m(body, *box);
}

void check_not_behind(const Scene& scene, const Marks& marks) {
    for (const Body& body : scene.bodies) {
        const auto* box = std::get_if<Box>(&body.mesh);
        if (!box) continue;
        const double height = height_m(*scene.platform, centre_m(body, *box));
        if (height > -half_diagonal_m(*box)) continue;
        refuse(marks.key({"platform"}),
               fmt::format("a platform with \"{}\" {} behind it", body.name,
                           format_si(-height, "m")),
               "bodies on the side that its normal points to",
               "turn platform.normal around, or move the body or platform.point");
    }
}

// Bodies stay in the box of their fluid.
void check_in_box(const Scene& scene, const Marks& marks) {
    if (!scene.fluid) return;
    const Vec3& box = scene.fluid->box_m;
    double lowest = height_m(*scene.platform, {});
    for (int i = 0; i < 3; ++i)
        lowest += std::min(0.0, scene.platform->normal[i] * box[i]);
    if (lowest <= 0) return;
    refuse(marks.key({"platform"}), "a platform outside the fluid box",
           "one that a body in the box can touch",
           "move platform.point into the box or remove the key");
}

}  // namespace

void check_platform(const Scene& scene, const Marks& marks) {
    if (!scene.platform) return;
    if (scene.platform->normal == Vec3{})
        refuse(marks.value({"platform", "normal"}), "a normal of length 0",
               "any other vector such as [0, 0, 1]");
    check_not_behind(scene, marks);
    check_in_box(scene, marks);
    if (!std::ranges::all_of(scene.bodies,
                             [&](const Body& body) { return out_of_reach(scene, body); }))
        return;
    refuse(marks.key({"platform"}), "a platform that no body can touch",
           "one within reach of a body, or bodies that gravity or a field gradient "
           "brings to it",
           "move platform.point, add \"gravity\", or remove the key");
}

}  // namespace magfsi::scene
