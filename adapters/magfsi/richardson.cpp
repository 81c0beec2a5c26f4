#include "adapters/magfsi/richardson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "adapters/scene/effective.h"
#include "adapters/scene/split.h"

namespace magfsi::launch {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

// Nearer to each other, the difference of two runs is mostly rounding and luck.
constexpr double least_ratio = 1.2;
constexpr double same = 1e-6;  // edges that differ by rounding only

struct Course {
    double last = 0, largest = 0;  // of the magnitude, with its sign
};

// By column, the time left out.
std::map<std::string, Course> courses(const fs::path& file) {
    std::ifstream in(file);
    std::string line;
    std::map<std::string, Course> found;
    if (!std::getline(in, line)) return found;
    const auto names = scene::split(line, ',');
    while (std::getline(in, line)) {
        const auto cells = scene::split(line, ',');
        for (std::size_t i = 1; i < std::min(cells.size(), names.size()); ++i) {
            Course& course = found[names[i]];
            course.last = std::strtod(cells[i].c_str(), nullptr);
            if (std::abs(course.last) > std::abs(course.largest))
                course.largest = course.last;
        }
    }
    return found;
}

Json read(const fs::path& file) {
    std::ifstream in(file);
    return Json::parse(in, nullptr, false);
}

// Edges of the other over ours, if all that differ do so by about the same.
std::optional<double> common_ratio(const Json& ours, const Json& others) {
    std::optional<double> ratio;
    for (const auto& [name, edge] : ours.items()) {
        if (!others.contains(name)) return std::nullopt;
        const double r = others.at(name).get<double>() / edge.get<double>();
        if (std::abs(r - 1) < same) continue;
        constexpr double about = 1.1;
        if (ratio && (r / *ratio > about || *ratio / r > about)) return std::nullopt;
        ratio = r;
    }
    if (!ratio || std::max(*ratio, 1 / *ratio) < least_ratio) return std::nullopt;
    return ratio;
}

struct Sibling {
    fs::path folder;
    double ratio = 1;  // of its edges over ours
};

// The finest: what is compared with it says most.
std::optional<Sibling> find_sibling(const Json& ours, const fs::path& out) {
    std::optional<Sibling> best;
    std::error_code none;  // an unreadable folder has no siblings
    for (const auto& entry : fs::directory_iterator(
             fs::absolute(out).lexically_normal().parent_path(), none)) {
        const Json other = read(entry.path() / "summary.json");
        if (!other.is_object() || !other.contains("resolution") ||
            other.value("outcome", "") != "completed" ||
            other.at("resolution").at("family") != ours.at("family"))
            continue;
        const auto ratio =
            common_ratio(ours.at("edge_m"), other.at("resolution").at("edge_m"));
        if (ratio && (!best || *ratio < best->ratio)) best = {entry.path(), *ratio};
    }
    return best;
}

void strip_elements(scene::BodyMesh& mesh) {
    if (auto* box = std::get_if<scene::BoxMesh>(&mesh)) box->elements = {};
    if (auto* plate = std::get_if<scene::ObliqueMesh>(&mesh)) plate->elements = {};
}

}  // namespace

std::string family(const scene::Scene& scene) {
    scene::Scene alike = scene;
    for (scene::Body& body : alike.bodies) strip_elements(body.mesh);
    if (alike.fluid) {
        alike.fluid->spacing_m = 0;
        alike.time.step_s.reset();
    }
    alike.output = {};
    alike.checkpoint.reset();
    return fmt::format("{:016x}", scene::scene_hash(alike));
}

Json resolution_of(const scene::Scene& scene) {
    Json json{{"family", family(scene)}, {"edge_m", Json::object()}};
    if (scene.fluid) json["edge_m"]["fluid"] = scene.fluid->spacing_m;
    for (const scene::Body& body : scene.bodies) {
        const auto* box = std::get_if<scene::BoxMesh>(&body.mesh);
        if (!box) continue;
        const auto along = std::ranges::max_element(box->size_m) - box->size_m.begin();
        json["edge_m"][body.name] = box->size_m[static_cast<std::size_t>(along)] /
                                    box->elements[static_cast<std::size_t>(along)];
    }
    return json;
}

Json richardson(const scene::Scene& scene, const fs::path& out) {
    const auto sibling = find_sibling(resolution_of(scene), out);
    if (!sibling) return nullptr;
    const double order = scene.coupling ? 1 : 2;
    // (coarse - fine) = C (r^p - 1) h_fine^p; ours is C h_ours^p.
    const double share = 1 / (std::pow(sibling->ratio, order) - 1);
    Json estimate{{"sibling", sibling->folder.string()},
                  {"edges_over_ours", sibling->ratio},
                  {"assumed_order", order},
                  {"errors", Json::object()}};
    const auto ours = courses(out / "probes.csv");
    const auto theirs = courses(sibling->folder / "probes.csv");
    for (const auto& [name, mine] : ours) {
        const auto other = theirs.find(name);
        if (other == theirs.end() || mine.largest == 0) continue;
        const double scale = share / std::abs(mine.largest);
        estimate["errors"][name] = {
            {"final", scale * std::abs(other->second.last - mine.last)},
            {"largest", scale * std::abs(other->second.largest - mine.largest)}};
        for (auto& error : estimate["errors"][name])
            error = std::abs(error.get<double>());
    }
    return estimate;
}

std::string richardson_line(const Json& estimate) {
    std::vector<std::pair<double, std::string>> finals;
    for (const auto& [name, error] : estimate.at("errors").items())
        finals.emplace_back(error.at("final").get<double>(), name);
    std::ranges::sort(finals, std::ranges::greater{});
    if (finals.size() > 4) finals.resize(4);
    std::string text = fmt::format(
        "by {}, with edges {:.3g} times these and order {:g} assumed, final values are "
        "off by",
        estimate.at("sibling").get<std::string>(),
        estimate.at("edges_over_ours").get<double>(),
        estimate.at("assumed_order").get<double>());
    for (const auto& [error, name] : finals)
        text += fmt::format("{} {:.2g} % ({})", text.ends_with("by") ? "" : ",",
                            100 * error, name);
    return text + " of the largest; all are in summary.json";
}

}  // namespace magfsi::launch
