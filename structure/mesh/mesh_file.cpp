// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/mesh_file.h"

#include <fmt/ranges.h>
#include <cerrno>
#include <cstring>

#include <algorithm>
#include <utility>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// A node's number; fails unless it is below `nodes`, their count.
int read_node(std::istream& fields, const NumberedLines& lines, std::size_t nodes) {
    int node = -1;
    if (!(fields >> node) || node < 0 || static_cast<std::size_t>(node) >= nodes) {
        lines.fail("numbers of nodes, from 0 and below their count");
    }
    return node;
}

void read_elements(NumberedLines& lines, Mesh& mesh) {
    mesh.elements.resize(lines.count("elements", 0));
    const int regions = mesh.region_names.size();
    for (Hexahedron& element : mesh.elements) {
        const char* expected = "eight node numbers and the region of an element";
        std::istringstream fields = lines.next(expected);
        for (int& node : element) node = read_node(fields, lines, mesh.nodes.size());
        int region = -1;
        if (!(fields >> region) || region < (regions > 0 ? 0 : -1) || region >= regions) {
            lines.fail(expected);
        }
        if (regions > 0) mesh.region.push_back(region);
    }
}

std::map<std::string, std::vector<int>> read_groups(NumberedLines& lines,
                                                    const char* keyword,
                                                    std::size_t nodes) {
    std::map<std::string, std::vector<int>> groups;
    for (std::size_t left = lines.count(keyword, 0); left > 0; --left) {
        const char* expected = "the count of nodes and the name of a group";
        std::istringstream title = lines.next(expected);
        long long count = -1;
        std::string name;
        if (!(title >> count) || count < 0 || title.get() != ' ' ||
            !std::getline(title, name)) {
            lines.fail(expected);
        }
        std::vector<int>& nodes_of_group = groups[name];
        if (count == 0) continue;
        std::istringstream fields = lines.next("the node numbers of a group");
        for (long long n = 0; n < count; ++n) {
            nodes_of_group.push_back(read_node(fields, lines, nodes));
        }
    }
    return groups;
}

void write_groups(fmt::ostream& out, const char* keyword,
                  const std::map<std::string, std::vector<int>>& groups) {
    out.print("{} {}\n", keyword, groups.size());
    for (const auto& [name, nodes] : groups) {
        out.print("{} {}\n{}\n", nodes.size(), name, fmt::join(nodes, " "));
    }
}

}  // namespace

void write_nodes(fmt::ostream& out, const std::vector<Vec3>& nodes_m) {
    out.print("nodes {}\n", nodes_m.size());
    for (const Vec3& x : nodes_m) out.print("{:.17g}\n", fmt::join(x, " "));
}

void write_mesh_file(const Mesh& mesh, const std::filesystem::path& file) {
    write_text_file("mesh file", file, [&](fmt::ostream& out) {
        out.print("# magfsi mesh [m]\n");
        write_nodes(out, mesh.nodes);
        out.print("regions {}\n", mesh.region_names.size());
        for (const std::string& name : mesh.region_names) out.print("{}\n", name);
        out.print("elements {}\n", mesh.elements.size());
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            out.print("{} {}\n", fmt::join(mesh.elements[e], " "),
                      mesh.region.empty() ? -1 : mesh.region[e]);
        }
        write_groups(out, "faces", mesh.faces);
        write_groups(out, "points", mesh.points);
    });
}

Mesh read_mesh_file(const std::filesystem::path& file) {
    NumberedLines lines("mesh file", file);
    Mesh mesh;
    mesh.nodes = lines.nodes(0);
    mesh.region_names.resize(lines.count("regions", 0));
    for (std::string& name : mesh.region_names) name = lines.verbatim("a region's name");
    read_elements(lines, mesh);
    mesh.faces = read_groups(lines, "faces", mesh.nodes.size());
    mesh.points = read_groups(lines, "points", mesh.nodes.size());
    if (const auto line = mesh.points.find("centre_line"); line != mesh.points.end()) {
        mesh.centre_line = line_through(mesh, line->second);
    }
    return mesh;
}

std::vector<MaterialPoint> line_through(const Mesh& mesh, std::span<const int> nodes) {
    const Vec3 extent_m = bounds(mesh.nodes, nodes).extent_m();
    const auto along = std::ranges::max_element(extent_m) - extent_m.begin();
    std::vector<MaterialPoint> of_node(mesh.nodes.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int a = 0; a < 8; ++a) {
            MaterialPoint& point = of_node[mesh.elements[e][a]];
            if (point.element >= 0) continue;
            point.node = mesh.elements[e];
            point.weight[a] = 1;
            point.element = e;
        }
    }
    std::vector<int> ordered(nodes.begin(), nodes.end());
    std::ranges::stable_sort(ordered, {},
                             [&](int node) { return mesh.nodes[node][along]; });
    std::vector<MaterialPoint> line;
    for (const int node : ordered) {
        if (of_node[node].element < 0) {
            refuse(
                "node {} of a line belongs to no element; a line runs through the body",
                node);
        }
        line.push_back(of_node[node]);
    }
    return line;
}

NumberedLines::NumberedLines(std::string kind, const std::filesystem::path& file)
    : kind_(std::move(kind)), file_(file), stream_(file) {
    if (!stream_) {
        throw std::runtime_error(fmt::format("cannot open the {} {}: {}", kind_,
                                             file.string(), std::strerror(errno)));
    }
}

std::istringstream NumberedLines::next(const std::string& expected) {
    while (std::getline(stream_, last_)) {
        ++number_;
        const auto first = last_.find_first_not_of(" \t\r");
        if (first != std::string::npos && last_[first] != '#') {
            return std::istringstream(last_);
        }
    }
    last_ = "the end of the file";
    fail(expected);
}

std::string NumberedLines::verbatim(const std::string& expected) {
    if (!std::getline(stream_, last_)) {
        last_ = "the end of the file";
        fail(expected);
    }
    ++number_;
    return last_;
}

std::size_t NumberedLines::count(const std::string& keyword, std::size_t least) {
    const std::string expected =
        fmt::format("\"{} N\" with N of at least {}", keyword, least);
    std::istringstream fields = next(expected);
    std::string found;
    long long value = -1;
    if (!(fields >> found >> value) || found != keyword || value < 0 ||
        static_cast<std::size_t>(value) < least) {
        fail(expected);
    }
    return value;
}

std::vector<Vec3> NumberedLines::nodes(std::size_t least) {
    std::vector<Vec3> nodes_m(count("nodes", least));
    const char* expected = "three coordinates of a node";
    for (Vec3& x : nodes_m) {
        std::istringstream fields = next(expected);
        if (!(fields >> x[0] >> x[1] >> x[2])) fail(expected);
    }
    return nodes_m;
}

void NumberedLines::fail(const std::string& expected) const {
    constexpr std::size_t shown = 60;
    throw std::runtime_error(fmt::format(
        "{} {}, line {}: expected {}; found {}{}", kind_, file_.string(), number_,
        expected, last_.substr(0, shown), last_.size() > shown ? "..." : ""));
}

}  // namespace magfsi::structure
