// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/body.h"

#include <algorithm>

#include "structure/refuse.h"

namespace magfsi::structure {

const std::vector<int>& face_nodes(const Body& body, const std::string& face,
                                   const char* how) {
    const auto found = body.mesh.faces.find(face);
    if (found != body.mesh.faces.end()) return found->second;
    std::string known;
    for (const auto& [name, nodes] : body.mesh.faces)
        known += (known.empty() ? "" : ", ") + name;
    refuse("body {} is {} at {}, but its faces are {}", body.name, how, face,
           known.empty() ? "none" : known);
}

std::vector<Material> all_materials(const Body& body) {
    std::vector<Material> out{body.material};
    out.insert(out.end(), body.other_materials.begin(), body.other_materials.end());
    return out;
}

std::vector<Material> used_materials(const Body& body) {
    const std::vector<Material> all = all_materials(body);
    if (body.element_material.empty()) return {body.material};
    std::vector<bool> used(all.size(), false);
    for (int number : body.element_material) used[number] = true;
    std::vector<Material> out;
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (used[m]) out.push_back(all[m]);
    }
    return out;
}

bool is_viscous(const Body& body) {
    return std::ranges::any_of(all_materials(body),
                               [](const Material& m) { return m.viscosity_pa_s != 0; });
}

void check_materials(const std::vector<int>& element_material, std::size_t elements,
                     std::size_t others) {
    if (element_material.empty() && others == 0) return;
    if (element_material.size() != elements) {
        refuse(
            "{} material numbers found for {} elements, one an element is needed where "
            "there are {} materials",
            element_material.size(), elements, others + 1);
    }
    for (std::size_t e = 0; e < elements; ++e) {
        const int number = element_material[e];
        if (number >= 0 && static_cast<std::size_t>(number) <= others) continue;
        refuse("element {} is of material {}, but the materials are 0 to {}", e, number,
               others);
    }
}

std::vector<HeldFace> held_faces(const Body& body) {
    std::vector<HeldFace> out;
    std::vector<HeldAxes> taken(body.mesh.nodes.size());
    const auto hold = [&](const std::string& face, std::size_t axis, const char* how) {
        auto found = std::ranges::find(out, face, &HeldFace::name);
        if (found == out.end()) found = out.insert(out.end(), {face, {}});
        for (const int node : face_nodes(body, face, how)) {
            bool& is_taken = taken[node][axis];
            if (!is_taken) found->nodes[axis].push_back(node);
            is_taken = true;
        }
    };
    for (const std::string& face : body.clamps) {
        for (const std::size_t axis : {0, 1, 2}) hold(face, axis, "clamped");
    }
    for (const Roller& roller : body.rollers) {
        for (const std::string& face : roller.faces)
            hold(face, static_cast<std::size_t>(roller.axis), "on rollers");
    }
    return out;
}

std::vector<HeldAxes> held_axes(const Body& body, const std::set<std::string>& moved) {
    std::vector<HeldAxes> held(body.mesh.nodes.size());
    for (const std::string& face : body.clamps) {
        if (moved.contains(face)) continue;
        for (const int node : face_nodes(body, face, "clamped"))
            held[node] = {true, true, true};
    }
    for (const Roller& roller : body.rollers) {
        const std::size_t axis = roller.axis;
        for (const std::string& face : roller.faces) {
            for (const int node : face_nodes(body, face, "on rollers"))
                held[node][axis] = true;
        }
    }
    return held;
}

}  // namespace magfsi::structure
