// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/body.h"

#include <algorithm>
#include <numeric>

#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

std::vector<Material> materials_of_soft_elements(const Body& body) {
    const std::vector<Material> all = all_materials(body);
    std::vector<bool> soft(all.size(), false);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const int number = body.element_material.empty() ? 0 : body.element_material[e];
        if (is_soft(body, e)) soft[number] = true;
    }
    std::vector<Material> out;
    for (std::size_t m = 0; m < all.size(); ++m)
        if (soft[m]) out.push_back(all[m]);
    return out;
}

std::string name_of_part(const Body& body, int part) {
    const std::string& region = body.rigid_parts[part].name;
    return region.empty() ? "the body" : "the region \"" + region + "\"";
}

// Refuses a rigid part whose elements no chain of common nodes joins: the pieces would
// move as one although nothing holds them together.
void check_in_one_piece(const Body& body, const std::vector<int>& part_of_node) {
    std::vector<int> parent(body.mesh.nodes.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        if (is_soft(body, e)) continue;
        const Hexahedron& element = body.mesh.elements[e];
        for (const int node : element)
            parent[root_of(parent, node)] = root_of(parent, element[0]);
    }
    std::vector<int> root(body.rigid_parts.size(), -1);
    for (std::size_t n = 0; n < part_of_node.size(); ++n) {
        const int part = part_of_node[n];
        if (part < 0) continue;
        const int its_root = root_of(parent, static_cast<int>(n));
        if (root[part] >= 0 && root[part] != its_root)
            refuse(
                "a rigid part in pieces that do not touch, {}; allowed is one piece: "
                "name each piece as a region of its own",
                name_of_part(body, part));
        root[part] = its_root;
    }
    for (std::size_t p = 0; p < root.size(); ++p)
        if (root[p] < 0)
            refuse("{} found as a rigid part of body {}, and it has no element",
                   name_of_part(body, static_cast<int>(p)), body.name);
}

}  // namespace

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

std::vector<Material> pressing_materials(const Body& body, std::span<const Body> all) {
    const auto soft = [](const Body& one) { return !is_all_rigid(one); };
    const bool some_are_soft = std::ranges::any_of(all, soft);
    std::vector<Material> out = used_materials(body);
    if (body.rigid_parts.empty()) return out;
    if (some_are_soft) out = materials_of_soft_elements(body);
    std::erase_if(out, [](const Material& m) { return !(m.shear_modulus_pa > 0); });
    return out;
}

bool is_viscous(const Body& body) {
    return std::ranges::any_of(all_materials(body),
                               [](const Material& m) { return m.viscosity_pa_s != 0; });
}

bool is_viscoelastic(const Body& body) {
    return std::ranges::any_of(all_materials(body),
                               [](const Material& m) { return !m.branches.empty(); });
}

bool is_all_rigid(const Body& body) {
    return !body.element_rigid.empty() &&
           std::ranges::all_of(body.element_rigid, [](int part) { return part >= 0; });
}

bool has_moved_parts(std::span<const Body> bodies) {
    return std::ranges::any_of(bodies, [](const Body& body) {
        return std::ranges::any_of(body.rigid_parts, is_moved);
    });
}

// Checks the numbers of the parts, then gives each node that of its elements.
std::vector<int> rigid_part_of_nodes(const Body& body) {
    const std::size_t elements = body.mesh.elements.size();
    if (body.rigid_parts.empty() && body.element_rigid.empty()) return {};
    if (body.element_rigid.size() != elements)
        refuse(
            "body {} has {} numbers of rigid parts for {} elements, one an element is "
            "needed",
            body.name, body.element_rigid.size(), elements);
    std::vector<int> out(body.mesh.nodes.size(), -1);
    for (std::size_t e = 0; e < elements; ++e) {
        const int part = body.element_rigid[e];
        if (part < 0) continue;
        if (part >= static_cast<int>(body.rigid_parts.size()))
            refuse("element {} of body {} is of rigid part {}, but there are {}", e,
                   body.name, part, body.rigid_parts.size());
        for (const int node : body.mesh.elements[e]) {
            if (out[node] >= 0 && out[node] != part)
                refuse(
                    "rigid parts that touch each other, {} and {}; allowed are parts "
                    "with a soft element between them: make them one region, or "
                    "leave a gap",
                    name_of_part(body, out[node]), name_of_part(body, part));
            out[node] = part;
        }
    }
    check_in_one_piece(body, out);
    return out;
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

void refuse_held_rigid_parts(const Body& body, const std::vector<HeldAxes>& held) {
    const std::vector<int> part = rigid_part_of_nodes(body);
    for (std::size_t n = 0; n < part.size(); ++n) {
        if (part[n] < 0 || held[n] == HeldAxes{}) continue;
        refuse(
            "a rigid part with a node that a clamp, a roller or a prescribed motion "
            "holds, {}; allowed are faces of soft elements only: leave the face out, or "
            "hold the part by a pivot or a hinge, or move it by moved",
            name_of_part(body, part[n]));
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
