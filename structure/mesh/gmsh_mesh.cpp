// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/gmsh_mesh.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "structure/mesh/mesh_check.h"
#include "structure/mesh/mesh_file.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

constexpr int hexahedron_of_8_nodes = 5;  // Gmsh's number of the element type

// key: Gmsh's tag of a node; value: its number here
using NodeNumbers = std::unordered_map<std::size_t, int>;

// Initialised Gmsh library, which has one state for the whole process.
class GmshSession {
  public:
    GmshSession() {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
    }
    ~GmshSession() { gmsh::finalize(); }
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;
};

// Gmsh reads options for mesh.msh from mesh.msh.opt, and runs the commands in them.
void refuse_options(const std::filesystem::path& file) {
    std::filesystem::path options = file;
    options += ".opt";
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::symlink_status(options, none)))
        throw std::runtime_error(
            fmt::format("{} stands beside it, whose commands Gmsh would run; remove it",
                        options.string()));
}

// The library would also accept geometries and scripts, and run them.
void check_header(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error(
            fmt::format("the file cannot be opened: {}", std::strerror(errno)));
    std::string keyword, version;
    stream >> keyword >> version;
    if (keyword != "$MeshFormat") {
        throw std::runtime_error(
            "the file does not begin with $MeshFormat; a mesh that Gmsh saved as .msh is "
            "allowed");
    }
    if (version != "2.2" && version != "4.1") {
        throw std::runtime_error(
            fmt::format("version {} of the format found, 2.2 and 4.1 are allowed; save "
                        "it again with Mesh.MshFileVersion = 4.1",
                        version));
    }
}

// Throws on tags above 31 bits in a text file: the library makes tables as long as the
// largest tag, whose indices are of 31 bits.
void check_tags(const std::filesystem::path& file) {
    constexpr unsigned long long most = 2147483647;
    std::ifstream stream(file, std::ios::binary);
    std::string version, kind, section;
    stream >> section >> version >> kind;
    if (kind != "0") return;  // binary tags have 32 bits in 2.2
    std::string line, number;
    bool tags = false;
    while (std::getline(stream, line)) {
        if (line.starts_with('$'))
            tags = line.starts_with("$Nodes") || line.starts_with("$Elements");
        if (!tags || line.starts_with('$')) continue;
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t begin = line.find_first_not_of(" \t\r", at);
            if (begin == std::string::npos) break;
            at = std::min(line.find_first_of(" \t\r", begin), line.size());
            number = line.substr(begin, at - begin);
            if (number.size() < 10 ||
                number.find_first_not_of("0123456789") != std::string::npos)
                continue;
            if (number.size() > 18 || std::stoull(number) > most)
                throw std::runtime_error(fmt::format(
                    "the number {} found, of a node or an element; at most {} is "
                    "allowed; renumber them in Gmsh (Mesh.Renumber)",
                    number, most));
        }
    }
}

[[noreturn]] void refuse_damaged(int line, const std::string& why) {
    throw std::runtime_error(
        fmt::format("line {}: {}; the file is damaged, save it again", line, why));
}

// Throws on a line of an element in a text file of version 2.2 that does not have the
// numbers of its kind: the library would take what is missing from the next line, read
// kinds and lengths from wrong places, and can crash. A session must be open.
void check_element(std::span<const long long> numbers, std::map<long long, int>& nodes_of,
                   int line) {
    if (numbers.size() < 3)
        refuse_damaged(
            line, fmt::format("{} numbers found, an element has its number, its kind, "
                              "the number of its tags, tags and nodes",
                              numbers.size()));
    const long long kind = numbers[1], tags = numbers[2];
    if (!nodes_of.contains(kind)) {
        std::string name;
        int dimension = 0, order = 0, corners = 0;
        std::vector<double> local;
        if (kind < 1 || kind > 140)
            refuse_damaged(
                line,
                fmt::format("an element of kind {} found, 1 to 140 are known", kind));
        gmsh::model::mesh::getElementProperties(static_cast<int>(kind), name, dimension,
                                                order, nodes_of[kind], local, corners);
    }
    const long long found = static_cast<long long>(numbers.size()) - 3;
    if (tags < 0 || found != tags + nodes_of[kind])
        refuse_damaged(
            line, fmt::format("{} tags and nodes found, {} tags and {} nodes belong to "
                              "this element of kind {}",
                              found, tags, nodes_of[kind], kind));
    // The third tag is a number of partitions, which are the tags after it.
    if (tags > 2 && numbers[5] != tags - 3)
        refuse_damaged(
            line, fmt::format("{} partitions announced in {} tags", numbers[5], tags));
}

// Throws where a text file of version 2.2 has nodes or elements twice, in another number
// than it announces, or elements of nodes that it does not have: the library reads on,
// and can crash.
void check_sections(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string section, version, kind, line;
    stream >> section >> version >> kind;
    if (version != "2.2" || kind != "0") return;
    stream.seekg(0);
    std::map<long long, int> nodes_of;
    std::set<std::string> seen;
    std::unordered_set<long long> nodes;
    bool announced = false;  // true once the section has said how many rows it has
    long long rest = 0;      // rows to come
    section.clear();
    for (int number = 1; std::getline(stream, line); ++number) {
        const auto refuse_line = [&](const std::string& what) {
            refuse_damaged(number, what + " in " + section);
        };
        if (line.starts_with('$')) {
            if (rest > 0) refuse_line("too few rows");
            // The library, too, looks at the beginning of the line alone.
            section = line.starts_with("$Nodes")      ? "$Nodes"
                      : line.starts_with("$Elements") ? "$Elements"
                                                      : "";
            if (!section.empty() && !seen.insert(section).second)
                refuse_line("a second section");
            announced = false;
            rest = 0;
            continue;
        }
        if (section.empty()) continue;
        std::istringstream words(line);
        const std::vector<long long> numbers{std::istream_iterator<long long>(words), {}};
        if (numbers.empty()) continue;
        if (!std::exchange(announced, true)) {
            rest = numbers.front();
            continue;
        }
        if (rest-- <= 0) refuse_line("too many rows");
        if (section == "$Nodes") {
            nodes.insert(numbers.front());
            continue;
        }
        check_element(numbers, nodes_of, number);
        for (const long long node : std::span(numbers).subspan(3 + numbers[2]))
            if (!nodes.contains(node))
                refuse_line(fmt::format("node {}, which is not in $Nodes,", node));
    }
}

void refuse_other_elements() {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 3);
    std::string found;
    bool other_order = false, other = types.empty();
    for (const int type : types) {
        std::string name;
        int dimension = 0, order = 0, nodes = 0, corners = 0;
        std::vector<double> local;
        gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes,
                                                local, corners);
        other_order = other_order || order != 1;
        other = other || type != hexahedron_of_8_nodes;
        found += (found.empty() ? "" : ", ") + name;
    }
    if (!other) return;
    throw std::runtime_error(fmt::format(
        "volume elements of the kinds {} found, hexahedra of 8 nodes are allowed; {}",
        found.empty() ? "(none)" : found,
        other_order
            ? "set Mesh.ElementOrder = 1"
            : "extrude a surface meshed with Mesh.RecombineAll = 1 with Layers "
              "and Recombine, or use Transfinite Surface, Transfinite Volume and "
              "Recombine, or Mesh.SubdivisionAlgorithm = 2, and mesh in 3D; or save "
              "the surface as STL and fill it with cubes, mesh: {voxels: ...}"));
}

std::string group_name(int dimension, int tag) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    return name.empty() ? std::to_string(tag) : name;
}

// Nodes are sorted by tag, so that their numbers do not depend on their order in the
// file.
NodeNumbers read_nodes(Mesh& mesh, double metres_per_unit) {
    std::vector<std::size_t> tags;
    std::vector<double> x, unused;
    gmsh::model::mesh::getNodes(tags, x, unused, -1, -1, false, false);
    std::vector<std::size_t> order(tags.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t n) { return tags[n]; });
    NodeNumbers numbers;
    for (const std::size_t n : order) {
        numbers[tags[n]] = mesh.nodes.size();
        mesh.nodes.push_back({metres_per_unit * x[3 * n], metres_per_unit * x[3 * n + 1],
                              metres_per_unit * x[3 * n + 2]});
    }
    return numbers;
}

// Index of the volume's region in region_names, which gets new names.
int region_of(Mesh& mesh, int volume) {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(3, volume, groups);
    if (groups.size() > 1) {
        throw std::runtime_error(fmt::format(
            "volume {} is in the physical groups \"{}\" and \"{}\"; it may be in one",
            volume, group_name(3, groups[0]), group_name(3, groups[1])));
    }
    const std::string name = groups.empty() ? "unnamed" : group_name(3, groups[0]);
    const auto known = std::ranges::find(mesh.region_names, name);
    if (known != mesh.region_names.end()) {
        return known - mesh.region_names.begin();
    }
    mesh.region_names.push_back(name);
    return static_cast<int>(mesh.region_names.size()) - 1;
}

// Reads the hexahedra; returns Gmsh's tags of the elements, for messages.
std::vector<std::size_t> read_elements(Mesh& mesh, const NodeNumbers& numbers) {
    std::vector<std::size_t> all;
    gmsh::vectorpair volumes, groups;
    gmsh::model::getEntities(volumes, 3);
    gmsh::model::getPhysicalGroups(groups, 3);
    for (const auto& [dimension, volume] : volumes) {
        std::vector<std::size_t> tags, nodes;
        gmsh::model::mesh::getElementsByType(hexahedron_of_8_nodes, tags, nodes, volume);
        if (tags.empty()) continue;
        const int region = groups.empty() ? -1 : region_of(mesh, volume);
        for (std::size_t e = 0; e < tags.size(); ++e) {
            Hexahedron element{};
            for (int a = 0; a < 8; ++a) element[a] = numbers.at(nodes[8 * e + a]);
            mesh.elements.push_back(oriented(mesh.nodes, lexicographic(element)));
            if (region >= 0) mesh.region.push_back(region);
            all.push_back(tags[e]);
        }
    }
    return all;
}

// Adds the physical groups of one dimension, each with its nodes in ascending order.
void read_groups(std::map<std::string, std::vector<int>>& out, int dimension,
                 const NodeNumbers& numbers) {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, dimension);
    for (const auto& [unused, tag] : groups) {
        std::vector<std::size_t> tags;
        std::vector<double> x;
        gmsh::model::mesh::getNodesForPhysicalGroup(dimension, tag, tags, x);
        std::vector<int>& nodes = out[group_name(dimension, tag)];
        for (const std::size_t node : tags) nodes.push_back(numbers.at(node));
        std::ranges::sort(nodes);
        const auto doubled = std::ranges::unique(nodes);
        nodes.erase(doubled.begin(), doubled.end());
    }
}

void refuse_empty_groups(const Mesh& mesh) {
    for (const auto* groups : {&mesh.faces, &mesh.points}) {
        for (const auto& [name, nodes] : *groups) {
            if (!nodes.empty()) continue;
            throw std::runtime_error(
                fmt::format("the physical group \"{}\" has no node of a hexahedron; "
                            "embed its points in the volume's mesh or leave it out",
                            name));
        }
    }
}

GmshMesh read(const std::filesystem::path& file, double metres_per_unit) {
    refuse_options(file);
    check_header(file);
    check_tags(file);
    const GmshSession session;
    check_sections(file);
    gmsh::open(file.string());
    refuse_other_elements();
    GmshMesh out;
    const NodeNumbers numbers = read_nodes(out.mesh, metres_per_unit);
    const std::vector<std::size_t> tags = read_elements(out.mesh, numbers);
    read_groups(out.mesh.faces, 2, numbers);
    read_groups(out.mesh.points, 1, numbers);
    read_groups(out.mesh.points, 0, numbers);
    out.unused_nodes = drop_unused_nodes(out.mesh);
    refuse_empty_groups(out.mesh);
    refuse_broken_mesh(out.mesh, tags);
    for (const int part : connected_parts(out.mesh)) {
        out.part_elements.resize(
            std::max(out.part_elements.size(), static_cast<std::size_t>(part) + 1));
        ++out.part_elements[part];
    }
    if (const auto line = out.mesh.points.find("centre_line");
        line != out.mesh.points.end()) {
        out.mesh.centre_line = line_through(out.mesh, line->second);
    }
    return out;
}

}  // namespace

GmshMesh read_gmsh_mesh(const std::filesystem::path& file, double metres_per_unit) {
    if (!(metres_per_unit > 0)) {
        refuse("a mesh unit of {:g} m found, it must be positive", metres_per_unit);
    }
    const auto refused = [&](const std::string& why) {
        return std::runtime_error(fmt::format("mesh {}: {}", file.string(), why));
    };
    try {
        return read(file, metres_per_unit);
    } catch (const std::exception& error) {
        throw refused(error.what());
    } catch (const std::string& error) {  // one of the types that the library throws
        throw refused("Gmsh's library says: " + error);
    } catch (const char* error) {
        throw refused(fmt::format("Gmsh's library says: {}", error));
    } catch (int) {
        throw refused("Gmsh's library cannot read it");
    }
}

}  // namespace magfsi::structure
