#include "structure/held_nodes.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace magfsi::structure {
namespace {

const std::vector<int>& face_nodes(const Body& body, const std::string& face,
                                   const char* how) {
    const auto found = body.mesh.faces.find(face);
    if (found != body.mesh.faces.end()) return found->second;
    std::string known;
    for (const auto& [name, nodes] : body.mesh.faces)
        known += (known.empty() ? "" : ", ") + name;
    throw std::invalid_argument(
        fmt::format("body {} is {} at {}, but its faces are {}", body.name, how, face,
                    known.empty() ? "none" : known));
}

}  // namespace

std::vector<HeldAxes> held_axes(const Body& body) {
    std::vector<HeldAxes> held(body.mesh.nodes.size());
    for (const std::string& face : body.clamps) {
        for (const int node : face_nodes(body, face, "clamped"))
            held[static_cast<std::size_t>(node)] = {true, true, true};
    }
    for (const Roller& roller : body.rollers) {
        const auto axis = static_cast<std::size_t>(roller.axis);
        for (const std::string& face : roller.faces) {
            for (const int node : face_nodes(body, face, "on rollers"))
                held[static_cast<std::size_t>(node)][axis] = true;
        }
    }
    return held;
}

}  // namespace magfsi::structure
