// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-design: answers questions about the equilibria of one body of a scene and their
// derivatives, for the search in Python (adapters/python/magfsi/design).
//    magfsi-design SCENE [--body NAME] [--set KEY=VALUE]
//
// Standard input and output carry messages. Each is a line of JSON and the doubles that
// it announces, in the machine's own bytes. The first output describes the body; then
// each request has one answer. An answer {"error": ...} has no doubles. A design is 3
// values per element (magnetisation), 3 of the field, and as many factors of stiffness
// and of thickness as the request says under "stiffness" and "thickness" (0 or the number
// of regions). Requests:
//   {"do": "move", "halvings": n}    x, design from, design to -> {"share", ...}, x
//   {"do": "rise"}                   design                    -> {"share", ...}, x
//   {"do": "release"}                x, design                 -> {"share", ...}, x
//   {"do": "sensitivity", "rows": m, "entries": k}
//        x, design, k times (row, coordinate, weight, of support)
//        -> derivatives by magnetisation, field, stiffness, thickness, row by row
//   {"do": "support"}                x, design                 -> forces on the nodes
//   {"do": "locate", "points": n}    n points  -> n times 8 nodes, 8 weights
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>

#include "adapters/scene/fault.h"
#include "adapters/scene/reader.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "adapters/solvers/bodies/surroundings.h"
#include "coupler/participants/errors.h"
#include "structure/design/design_problem.h"
#include "structure/lattice/lattice.h"

namespace magfsi::design {
namespace {

using nlohmann::json;
using structure::Design;
using structure::Vec3;
using Numbers = std::vector<double>;

Numbers read_numbers(std::size_t count) {
    Numbers out(count);
    std::cin.read(reinterpret_cast<char*>(out.data()),
                  static_cast<std::streamsize>(count * sizeof(double)));
    if (!std::cin) throw std::runtime_error("a request ended before its numbers did");
    return out;
}

// Throws std::runtime_error if nobody reads any more.
void answer(const json& head, const std::vector<std::span<const double>>& parts) {
    std::cout << head.dump() << '\n';
    for (const auto part : parts)
        std::cout.write(reinterpret_cast<const char*>(part.data()),
                        static_cast<std::streamsize>(part.size_bytes()));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("the answer could not be written");
}

std::span<const double> span_of(const Eigen::VectorXd& v) {
    return {v.data(), static_cast<std::size_t>(v.size())};
}

std::span<const double> span_of(const std::vector<Vec3>& v) {
    if (v.empty()) return {};
    return {v.front().data(), 3 * v.size()};
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::span<const double> span_of(const RowMajor& m) {
    return {m.data(), static_cast<std::size_t>(m.size())};
}

// The body of the scene that is designed: the one of this name, or the only one. Throws
// std::invalid_argument.
std::size_t body_number(const scene::Scene& scene, const std::string& name) {
    if (scene.bodies.empty())
        throw std::invalid_argument("the scene has no bodies; a design needs one");
    if (name.empty() && scene.bodies.size() == 1) return 0;
    std::vector<std::string> names;
    for (const scene::Body& body : scene.bodies) names.push_back(body.name);
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return found - names.begin();
    throw std::invalid_argument(fmt::format(
        "body: found {}; allowed is one of {}",
        name.empty() ? "none" : scene::in_quotes(name), fmt::join(names, ", ")));
}

class Server {
  public:
    Server(scene::Scene scene, const std::string& body)
        : scene_(std::move(scene)),
          number_(body_number(scene_, body)),
          body_(designed()) {
        base_loads_ = bodies::loads_at(scene_, scene_.bodies[number_], 0);
        base_loads_.field_t = {};
    }

    void describe() const;
    // Answers requests until the input ends.
    void serve();

  private:
    // The body with a magnetisation of zero in place of the scene's, and its problem.
    structure::Body designed();
    void serve_one(const json& request);
    Design read_design(const json& request) const;
    Eigen::VectorXd read_positions() const;
    void answer_found(const structure::DesignProblem::Found& found) const;
    void sensitivity(const json& request);
    void locate(const json& request) const;

    scene::Scene scene_;
    std::size_t number_;
    std::unique_ptr<structure::DesignProblem> problem_;
    structure::Body body_;
    structure::StaticLoads base_loads_;
    std::chrono::steady_clock::time_point began_;
};

// Refuses what the derivatives do not know of.
void refuse_unknown(const scene::Body& body) {
    if (!body.rigid.empty())
        throw std::invalid_argument(fmt::format(
            "bodies.{}.rigid: found rigid parts; a design needs a body that is soft all "
            "over: remove this key, or take a stiff material",
            body.name));
    if (body.magnetization &&
        body.magnetization->follows == structure::MagnetizationFollows::rotation)
        throw std::invalid_argument(fmt::format(
            "bodies.{}.magnetization.follows: found rotation; a design needs the "
            "default, deformation",
            body.name));
    const auto stiffens = [](const structure::Material& material) {
        return material.stiffening.has_value();
    };
    if (stiffens(body.material) ||
        std::ranges::any_of(body.material_regions, stiffens,
                            &structure::RegionMaterial::material))
        throw std::invalid_argument(fmt::format(
            "bodies.{}.material: found strain stiffening; a design needs a neo-Hookean "
            "material",
            body.name));
}

structure::Body Server::designed() {
    refuse_unknown(scene_.bodies[number_]);
    scene_.bodies[number_].magnetization = structure::UniformMagnetization{};
    const bodies::Solids solids = bodies::to_bodies(scene_);
    const auto surroundings = bodies::to_surroundings(scene_, solids);
    problem_ = std::make_unique<structure::DesignProblem>(solids[number_],
                                                          surroundings[number_]);
    return solids[number_];
}

void Server::describe() const {
    const structure::Mesh& mesh = body_.mesh;
    const structure::Lattice lattice = structure::build_lattice(body_);
    json head{{"body", body_.name},
              {"name", scene_.name},
              {"nodes", mesh.nodes.size()},
              {"elements", mesh.elements.size()},
              {"faces", mesh.faces},
              {"regions", mesh.region_names},
              {"region", mesh.region},
              {"element_nodes", mesh.elements},
              {"field_of_scene", scene_.magnetic_field.has_value()}};
    json& line = head["centre_line"] = json::array();
    for (const structure::MaterialPoint& point : mesh.centre_line)
        line.push_back({{"node", point.node}, {"weight", point.weight}});
    json& held = head["held"] = json::array();
    for (const structure::HeldAxes& axes : structure::held_axes(body_))
        held.push_back(axes[0] + 2 * axes[1] + 4 * axes[2]);
    std::vector<Vec3> centres;
    Numbers volumes;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        centres.push_back(structure::element_centre(mesh, e));
        volumes.push_back(lattice.modes[e].volume);
    }
    answer(head, {span_of(mesh.nodes), span_of(centres), volumes});
}

Eigen::VectorXd Server::read_positions() const {
    const Numbers x = read_numbers(3 * body_.mesh.nodes.size());
    return Eigen::Map<const Eigen::VectorXd>(x.data(),
                                             static_cast<Eigen::Index>(x.size()));
}

Design Server::read_design(const json& request) const {
    Design out;
    const Numbers m = read_numbers(3 * body_.mesh.elements.size());
    for (std::size_t i = 0; i < m.size(); i += 3)
        out.magnetization_a_m.push_back({m[i], m[i + 1], m[i + 2]});
    out.loads = base_loads_;
    const Numbers field = read_numbers(3);
    out.loads.field_t = {field[0], field[1], field[2]};
    out.stiffness = read_numbers(request.value("stiffness", std::size_t{0}));
    out.thickness = read_numbers(request.value("thickness", std::size_t{0}));
    return out;
}

void Server::answer_found(const structure::DesignProblem::Found& found) const {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_;
    answer(
        {{"share", found.share}, {"iterations", found.iterations}, {"s", took.count()}},
        {span_of(found.x)});
}

void Server::sensitivity(const json& request) {
    const Eigen::VectorXd x = read_positions();
    const Design at = read_design(request);
    const Numbers numbers = read_numbers(4 * request.at("entries").get<std::size_t>());
    std::vector<structure::FunctionalEntry> entries;
    for (std::size_t i = 0; i < numbers.size(); i += 4)
        entries.push_back({static_cast<int>(numbers[i]), static_cast<int>(numbers[i + 1]),
                           numbers[i + 2], numbers[i + 3] != 0});
    const structure::Sensitivity found =
        problem_->sensitivity(x, at, entries, request.at("rows").get<int>());
    const RowMajor m = found.magnetization, b = found.field, g = found.stiffness,
                   t = found.thickness;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_;
    answer({{"s", took.count()}}, {span_of(m), span_of(b), span_of(g), span_of(t)});
}

void Server::locate(const json& request) const {
    const Numbers points = read_numbers(3 * request.at("points").get<std::size_t>());
    const structure::Bounds box = structure::bounds(body_.mesh.nodes);
    Numbers out;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Vec3 at{points[i], points[i + 1], points[i + 2]};
        // A block takes any point to the nearest of its own.
        for (std::size_t d = 0; d < 3; ++d) {
            const double slack = 1e-3 * (box.high_m[d] - box.low_m[d]);
            if (at[d] < box.low_m[d] - slack || at[d] > box.high_m[d] + slack)
                throw std::invalid_argument(fmt::format(
                    "the point ({:.6g}, {:.6g}, {:.6g}) mm, which is outside of the body",
                    at[0] * 1e3, at[1] * 1e3, at[2] * 1e3));
        }
        const structure::MaterialPoint found =
            bodies::locate(scene_.bodies[number_], body_.mesh, at);
        out.insert(out.end(), found.node.begin(), found.node.end());
        out.insert(out.end(), found.weight.begin(), found.weight.end());
    }
    answer(json::object(), {out});
}

void Server::serve_one(const json& request) {
    began_ = std::chrono::steady_clock::now();
    const std::string what = request.at("do");
    if (what == "sensitivity") return sensitivity(request);
    if (what == "locate") return locate(request);
    if (what == "rise") return answer_found(problem_->rise(read_design(request)));
    const Eigen::VectorXd x = read_positions();
    const Design first = read_design(request);
    if (what == "move") {
        const Design to = read_design(request);
        answer_found(problem_->move(x, first, to, request.value("halvings", 3)));
    } else if (what == "release") {
        answer_found(problem_->release(x, first));
    } else if (what == "support") {
        answer(json::object(), {span_of(problem_->support_n(x, first))});
    } else {
        throw std::runtime_error(fmt::format("unknown request {}", what));
    }
}

void Server::serve() {
    for (std::string line; std::getline(std::cin, line);) {
        try {
            serve_one(json::parse(line));
        } catch (const std::invalid_argument& fault) {
            answer({{"error", fault.what()}, {"input", true}}, {});
        } catch (const std::exception& fault) {
            answer({{"error", fault.what()}}, {});
        }
    }
}

}  // namespace
}  // namespace magfsi::design

int main(int argc, char** argv) {
    using namespace magfsi;
    CLI::App app{
        "Equilibria of a body of a scene and their derivatives, for magfsi design",
        "magfsi-design"};
    std::string path, body;
    std::vector<std::string> overrides;
    app.add_option("scene", path, "Scene file")->required();
    app.add_option("--body", body, "Name of the body (default: the only one)");
    app.add_option("--set", overrides, "Override a value of the scene")
        ->allow_extra_args(false);
    std::ios::sync_with_stdio(false);
    try {
        app.parse(argc, argv);
        design::Server server(scene::read_scene(path, overrides), body);
        server.describe();
        server.serve();
        return coupler::exit_done;
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? coupler::exit_done : coupler::exit_input;
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "{}\n", scene::printable(error.what()));
        return coupler::exit_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "magfsi-design: {}\n", scene::printable(error.what()));
        return coupler::exit_error;
    }
}
