#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/scene/checks.h"
#include "coupler/scene/unit.h"

namespace magfsi::scene {

namespace {

void check_has_bodies(const Scene& scene, const Marks& marks, const std::string& effect) {
    if (scene.bodies.empty())
        refuse(marks.key({effect}), fmt::format("{} without bodies", effect),
               "it with bodies only", "add the key \"bodies\" or remove this one");
}

void check_table(const FieldTable& table, const Marks& marks) {
    const std::string field = "magnetic_field", name = "table";
    const std::size_t rows = table.time_s.size();
    for (std::size_t i = 1; i < rows; ++i) {
        if (table.time_s[i] > table.time_s[i - 1]) continue;
        refuse(marks.value({field, name, "time"}),
               fmt::format("the time {} after {}", format_si(table.time_s[i], "s"),
                           format_si(table.time_s[i - 1], "s")),
               "times that ascend");
    }
    if (table.magnitude_t.size() != rows)
        refuse(marks.value({field, name, "magnitude"}),
               fmt::format("{} magnitudes for {} times", table.magnitude_t.size(), rows),
               "one magnitude a time");
    if (table.direction_rad.size() != 1 && table.direction_rad.size() != rows)
        refuse(
            marks.value({field, name, "direction"}),
            fmt::format("{} directions for {} times", table.direction_rad.size(), rows),
            "one direction, or one a time");
    if (table.repeat && rows < 2)
        refuse(marks.value({field, name, "repeat"}), "repeat with one row",
               "it with at least 2 rows");
}

void check_magnetic_field(const Scene& scene, const Marks& marks) {
    if (!scene.magnetic_field) return;
    const auto magnetized = [](const Body& body) {
        return body.magnetization.has_value();
    };
    if (std::ranges::none_of(scene.bodies, magnetized))
        refuse(marks.key({"magnetic_field"}), "magnetic_field without a magnetized body",
               "it with at least one body that has a magnetization",
               "add a magnetization or remove this key");
    if (const auto* table = std::get_if<FieldTable>(&scene.magnetic_field->course))
        check_table(*table, marks);
}

void check_gravity(const Scene& scene, const Marks& marks) {
    if (!scene.gravity) return;
    check_has_bodies(scene, marks, "gravity");
    const Vec3& d = scene.gravity->direction;
    if (d == Vec3{})
        refuse(marks.value({"gravity", "direction"}), "a direction of length 0",
               "any other vector such as [0, 0, -1]");
}

void check_coupling(const Scene& scene, const Marks& marks) {
    if (!scene.coupling) return;
    if (!scene.fluid)
        refuse(marks.key({"coupling"}), "coupling without a fluid",
               "it with a fluid only", "add the key \"fluid\" or remove this one");
    check_has_bodies(scene, marks, "coupling");
}

}  // namespace

void check_loads(const Scene& scene, const Marks& marks) {
    check_magnetic_field(scene, marks);
    check_gravity(scene, marks);
    if (scene.damping) check_has_bodies(scene, marks, "damping");
    check_coupling(scene, marks);
}

}  // namespace magfsi::scene
