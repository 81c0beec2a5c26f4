#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapters/magfsi/accuracy/cover.h"
#include "adapters/magfsi/accuracy/study_rows.h"

namespace magfsi::launch {

namespace {

constexpr const char* study = "beam";
// Its reference is good to 0.1 to 0.4 %: errors near that say nothing.
constexpr double reference_error = 0.005;
// Four elements are too few for the law where the beam is more slender than the studied.
constexpr double fewest_elements = 6;
constexpr double least_slenderness = 10, most_slenderness = 30;  // length by thickness
constexpr double widest = 0.5;                                   // width by length
constexpr double most_load = 0.0401;  // gamma = M B / G, with room for rounding

// The axes of a block from its longest to its shortest side.
std::array<int, 3> by_length(const scene::Vec3& size) {
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::sort(axes, [&](int a, int b) { return size[a] > size[b]; });
    return axes;
}

double strongest_t(const scene::MagneticField& field) {
    if (const auto* still = std::get_if<scene::ConstantField>(&field.course))
        return std::abs(still->magnitude_t);
    if (const auto* turning = std::get_if<scene::RotatingField>(&field.course))
        return std::abs(turning->magnitude_t);
    double most = 0;
    for (const double b : std::get<scene::FieldTable>(field.course).magnitude_t)
        most = std::max(most, std::abs(b));
    return most;
}

[[noreturn]] void not_covered(const scene::Body& body, const std::string& found,
                              const std::string& allowed) {
    throw NotCovered{study, fmt::format("body '{}' with {}", body.name, found), allowed};
}

void check_shape(const scene::Body& body, const scene::Vec3& size) {
    const auto [along, across, thick] = by_length(size);
    const double slenderness = size[along] / size[thick];
    if (slenderness < least_slenderness || slenderness > most_slenderness) {
        not_covered(body, fmt::format("a length of {:.3g} thicknesses", slenderness),
                    fmt::format("{} to {}", least_slenderness, most_slenderness));
    }
    if (size[across] > widest * size[along]) {
        not_covered(body,
                    fmt::format("a width of {:.3g} lengths", size[across] / size[along]),
                    fmt::format("at most {}", widest));
    }
    const bool clamped_at_an_end =
        body.clamps.size() == 1 && body.clamps[0].size() == 5 &&
        body.clamps[0][0] == "xyz"[along] && body.rollers.empty();
    if (!clamped_at_an_end)
        not_covered(body, "other holds than a clamp at one end", "a cantilever");
}

void check_load(const scene::Scene& scene, const scene::Body& body) {
    if (body.element != scene::ElementVariant::assumed_strain)
        not_covered(body, "another element", "element: assumed_strain");
    if (!body.magnetization) return;
    const auto* uniform = std::get_if<scene::UniformMagnetization>(&*body.magnetization);
    if (!uniform)
        not_covered(body, "a magnetization that varies", "magnetization: uniform");
    if (!scene.magnetic_field) return;
    const scene::Vec3& m = uniform->vector_a_m;
    const double gamma = std::hypot(m[0], m[1], m[2]) *
                         strongest_t(*scene.magnetic_field) /
                         body.material.shear_modulus_pa;
    if (gamma > most_load) {
        not_covered(body, fmt::format("a load M B / G of {:.3g}", gamma),
                    fmt::format("at most {:.2g}", most_load));
    }
}

double along(const StudyRow& row) {
    return number_in(row, "along[1]");
}

// From the first run that is as good as the reference on, errors are the reference's.
void keep_telling(std::vector<StudiedRun>& runs) {
    double as_good = std::numeric_limits<double>::infinity();
    for (const StudiedRun& run : runs) {
        if (run.error < reference_error) as_good = std::min(as_good, run.resolution);
    }
    std::erase_if(runs, [&](const StudiedRun& run) {
        return run.resolution >= as_good || run.resolution < fewest_elements;
    });
}

// Square elements in the plane, one layer.
std::string elements_setting(const scene::Body& body, double n) {
    const scene::Vec3& size = std::get<scene::BoxMesh>(body.mesh).size_m;
    const auto axes = by_length(size);
    std::array<int, 3> elements{1, 1, 1};
    elements[axes[0]] = static_cast<int>(n);
    elements[axes[1]] =
        std::max(1, static_cast<int>(std::lround(n * size[axes[1]] / size[axes[0]])));
    return fmt::format("bodies.{}.mesh.box.elements=[{}]", body.name,
                       fmt::join(elements, ", "));
}

}  // namespace

std::optional<Cover> cover_beams(const scene::Unresolved& unresolved) {
    const scene::Scene& scene = unresolved.scene;
    if (scene.fluid || unresolved.meshes.empty()) return std::nullopt;
    std::vector<scene::Body> beams;
    double longest = least_slenderness;  // by thickness, over all bodies
    for (const scene::Body& body : scene.bodies) {
        if (std::ranges::find(unresolved.meshes, body.name) == unresolved.meshes.end())
            continue;
        const scene::Vec3& size = std::get<scene::BoxMesh>(body.mesh).size_m;
        check_shape(body, size);
        check_load(scene, body);
        longest = std::max(
            longest, *std::ranges::max_element(size) / *std::ranges::min_element(size));
        beams.push_back(body);
    }
    Cover cover;
    cover.study = study;
    cover.because = "cantilevers in a field, of assumed_strain elements";
    cover.error_of = "the tip's displacement across the beam, the largest over the loads";
    cover.resolution = "elements along the beam";
    auto runs = runs_where(study_rows(study),
                           {{"element", "assumed_strain"}, {"layers[1]", "1"}}, along);
    keep_telling(runs);
    cover.law = fit_law(runs);
    cover.least_error = reference_error;
    // Elements shorter than half the thickness see the beam's ends in three dimensions,
    // which one layer cannot.
    const double most = std::min(cover.law.resolution(reference_error), 2 * longest);
    for (double n = fewest_elements; n <= most; ++n) cover.resolutions.push_back(n);
    cover.settings = [beams](double n) {
        std::vector<std::string> settings;
        for (const scene::Body& body : beams)
            settings.push_back(elements_setting(body, n));
        return settings;
    };
    return cover;
}

}  // namespace magfsi::launch
