// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/sheet.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/fitted/constants.h"
#include "structure/mesh/mesh_check.h"

namespace magfsi::structure {
namespace {

using Neighbours = std::vector<std::array<FaceOfElement, 6>>;

// Elements that follow each other through opposite faces, from surface to surface.
struct Chord {
    std::vector<int> elements;
    FaceOfElement ends[2];  // outer faces; none in a ring
    double length_m = 0;
};

int opposite(int face) {
    return face ^ 1;
}

Eigen::Vector3d face_centre(const Mesh& mesh, int element, int face) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int corner : face_corners(face)) {
        sum += 0.25 * Eigen::Vector3d(mesh.nodes[mesh.elements[element][corner]].data());
    }
    return sum;
}

// Visits the elements from `start`, the face by which the first one is entered, through
// opposite faces. Returns the outer face at the end, or none in a ring.
template <class Visit>
FaceOfElement follow(const Neighbours& behind, const FaceOfElement& start,
                     const Visit& visit) {
    FaceOfElement at = start;
    do {
        visit(at);
        const FaceOfElement out{at.element, opposite(at.face)};
        at = behind[out.element][out.face];
        if (at.element < 0) return out;
    } while (at.element != start.element || at.face != start.face);
    return {};
}

// All chords of a mesh. Each element is on three of them.
struct Chords {
    std::vector<Chord> all;
    // Numbers of the chords, by local direction
    std::vector<std::array<int, 3>> of_element;
};

Chords find_chords(const Mesh& mesh, const Neighbours& behind) {
    Chords out;
    out.of_element.assign(mesh.elements.size(), {-1, -1, -1});
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
        for (int d = 0; d < 3; ++d) {
            if (out.of_element[e][d] >= 0) continue;
            const int number = out.all.size();
            Chord& chord = out.all.emplace_back();
            chord.ends[0] = follow(behind, {e, 2 * d + 1}, [](const FaceOfElement&) {});
            const bool ring = chord.ends[0].element < 0;
            const FaceOfElement start = ring ? FaceOfElement{e, 2 * d} : chord.ends[0];
            chord.ends[1] = follow(behind, start, [&](const FaceOfElement& at) {
                chord.elements.push_back(at.element);
                out.of_element[at.element][at.face / 2] = number;
                chord.length_m += (face_centre(mesh, at.element, opposite(at.face)) -
                                   face_centre(mesh, at.element, at.face))
                                      .norm();
            });
            if (ring) chord.length_m = INFINITY;
        }
    }
    return out;
}

// Numbers of the shortest chords of all elements, if for every element it is shorter than
// the others by the factor sheet_chord, all elements on it agree, and all have the same
// number of elements. Empty otherwise.
std::vector<int> columns_across(const Chords& chords) {
    std::vector<std::size_t> votes(chords.all.size(), 0);
    for (const auto& mine : chords.of_element) {
        std::array<std::pair<double, int>, 3> by_length;
        for (int d = 0; d < 3; ++d)
            by_length[d] = {chords.all[mine[d]].length_m, mine[d]};
        std::ranges::sort(by_length);
        if (!(by_length[0].first < fitted::sheet_chord * by_length[1].first)) return {};
        ++votes[by_length[0].second];
    }
    std::vector<int> columns;
    for (std::size_t c = 0; c < votes.size(); ++c) {
        if (votes[c] == 0) continue;
        const auto& elements = chords.all[c].elements;
        if (votes[c] != elements.size()) return {};
        if (elements.size() !=
            chords.all[columns.empty() ? c : columns[0]].elements.size())
            return {};
        columns.push_back(c);
    }
    return columns;
}

// Side (0 or 1) of each quad, where quads that share an edge are on the same side. Empty
// unless there are two sides and quads 2 c and 2 c + 1 are on different ones.
std::vector<int> sides_of(const std::vector<SurfaceQuad>& ends) {
    std::vector<int> parent(ends.size());
    std::iota(parent.begin(), parent.end(), 0);
    std::map<std::pair<int, int>, int> quad_of_edge;
    for (std::size_t q = 0; q < ends.size(); ++q) {
        for (int a = 0; a < 4; ++a) {
            const std::pair<int, int> edge =
                std::minmax(ends[q].node[a], ends[q].node[(a + 1) % 4]);
            const auto [first, added] =
                quad_of_edge.try_emplace(edge, static_cast<int>(q));
            if (!added) {
                parent[root_of(parent, static_cast<int>(q))] =
                    root_of(parent, first->second);
            }
        }
    }
    std::vector<int> side;
    for (std::size_t q = 0; q < ends.size(); ++q) {
        const int root = root_of(parent, static_cast<int>(q));
        side.push_back(root == root_of(parent, 0) ? 0 : 1);
        if (side[q] == 1 && root != root_of(parent, 1)) return {};  // a third side
    }
    for (std::size_t c = 0; c < ends.size(); c += 2) {
        if (side[c] == side[c + 1]) return {};
    }
    return side;
}

// True if side 0 is the top.
bool first_is_top(const Mesh& mesh, const std::vector<SurfaceQuad>& ends,
                  const std::vector<int>& side) {
    Vec3 vector{};
    double area[2] = {0, 0};
    for (std::size_t q = 0; q < ends.size(); ++q) {
        area[side[q]] += quad_area(corners(mesh.nodes, ends[q].node));
        if (side[q] == 1) continue;
        vector += quad_area_vector(corners(mesh.nodes, ends[q].node));
    }
    for (int d = 2; d >= 0; --d) {
        if (std::abs(vector[d]) > 1e-9 * area[0]) return vector[d] > 0;
    }
    return area[0] >= area[1];
}

// Follows the column from the bottom; a level's nodes are across the element from those
// below.
SheetColumn build_column(const Mesh& mesh, const Neighbours& behind,
                         const SurfaceQuad& bottom, const SurfaceQuad& top) {
    SheetColumn column{{}, {}, bottom, top};
    const auto& b = bottom.node;
    // Reversed, so that it is counter-clockwise as seen from the top
    column.levels.push_back({b[0], b[3], b[2], b[1]});
    follow(behind, {bottom.element, bottom.face}, [&](const FaceOfElement& at) {
        column.elements.push_back(at.element);
        const Hexahedron& nodes = mesh.elements[at.element];
        std::array<int, 4> next{};
        for (int a = 0; a < 4; ++a) {
            const auto corner = std::ranges::find(nodes, column.levels.back()[a]);
            next[a] = nodes[(corner - nodes.begin()) ^ (1 << (at.face / 2))];
        }
        column.levels.push_back(next);
    });
    return column;
}

// Position at a place of a level.
Eigen::Vector3d on_level(const Mesh& mesh, const std::array<int, 4>& level,
                         const std::array<double, 4>& shape) {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    for (int a = 0; a < 4; ++a) {
        out += shape[a] * Eigen::Vector3d(mesh.nodes[level[a]].data());
    }
    return out;
}

// Height in a column: the layer, and the share of its thickness below.
struct Height {
    std::size_t layer = 0;
    double share = 0;
};

// Height depth_m away from one end of the column, but no deeper than half of the way,
// along the line through one place of all levels.
Height height_at(const Mesh& mesh, const SheetColumn& column, SheetSide side,
                 double depth_m, const std::array<double, 4>& shape) {
    std::vector<double> up{0};
    for (std::size_t l = 0; l + 1 < column.levels.size(); ++l) {
        up.push_back(up.back() + (on_level(mesh, column.levels[l + 1], shape) -
                                  on_level(mesh, column.levels[l], shape))
                                     .norm());
    }
    const double depth = std::min(depth_m, 0.5 * up.back());
    const double height = side == SheetSide::bottom ? depth : up.back() - depth;
    // A height on a level, up to rounding, belongs to the layer above, as in locate.
    const auto above =
        std::upper_bound(up.begin() + 1, up.end() - 1, height * (1 + 1e-12));
    const auto layer = static_cast<std::size_t>(above - up.begin()) - 1;
    return {layer, std::max(0.0, (height - up[layer]) / (*above - up[layer]))};
}

// Material point at (u, v) of the column's section, depth_m below the side.
MaterialPoint point_in(const Mesh& mesh, const SheetColumn& column, SheetSide side,
                       double depth_m, double u, double v) {
    const auto shape = quad_shape(u, v);
    const auto [layer, share] = height_at(mesh, column, side, depth_m, shape);
    MaterialPoint out;
    out.element = column.elements[layer];
    out.node = mesh.elements[out.element];
    for (int a = 0; a < 4; ++a) {
        const auto place = [&](std::size_t level) {
            return std::ranges::find(out.node, column.levels[level][a]) -
                   out.node.begin();
        };
        out.weight[place(layer)] = shape[a] * (1 - share);
        out.weight[place(layer + 1)] = shape[a] * share;
    }
    return out;
}

}  // namespace

MeshEnds::MeshEnds(const Mesh& mesh, const Continues& continues)
    : mesh_(mesh), continues_(continues), box_(bounds(mesh.nodes)) {}

bool MeshEnds::hold(const SurfaceQuad& quad) const {
    const double slack_m = 1e-9 * box_.diagonal_m();  // rounding of nodes
    const auto all_at = [&](std::size_t d, double plane_m) {
        return std::ranges::all_of(quad.node, [&](int node) {
            const Vec3& x = mesh_.nodes[node];
            return std::abs(x[d] - plane_m) <= slack_m;
        });
    };
    for (std::size_t d = 0; d < 3; ++d) {
        if (continues_[d] && (all_at(d, box_.low_m[d]) || all_at(d, box_.high_m[d])))
            return true;
    }
    return false;
}

std::optional<Sheet> find_sheet(const Mesh& mesh, const Continues& continues) {
    const Neighbours behind = face_neighbours(mesh);
    Chords chords = find_chords(mesh, behind);
    const MeshEnds ends_of_mesh(mesh, continues);
    for (Chord& chord : chords.all) {
        const bool ring = chord.ends[0].element < 0;
        if (!ring && ends_of_mesh.hold(outer_quad(mesh, chord.ends[0])) &&
            ends_of_mesh.hold(outer_quad(mesh, chord.ends[1])))
            chord.length_m = INFINITY;
    }
    const std::vector<int> across = columns_across(chords);
    if (across.empty()) return std::nullopt;
    std::vector<SurfaceQuad> ends;
    for (const int c : across) {
        for (const FaceOfElement& end : chords.all[c].ends) {
            ends.push_back(outer_quad(mesh, end));
        }
    }
    const std::vector<int> side = sides_of(ends);
    if (side.empty()) return std::nullopt;
    const int top = first_is_top(mesh, ends, side) ? 0 : 1;
    Sheet sheet;
    sheet.layers = chords.all[across[0]].elements.size();
    for (std::size_t c = 0; c < ends.size(); c += 2) {
        const std::size_t upper = side[c] == top ? c : c + 1;
        sheet.columns.push_back(
            build_column(mesh, behind, ends[c + c + 1 - upper], ends[upper]));
    }
    return sheet;
}

std::vector<SurfaceQuad> rim_of(const Mesh& mesh, const Sheet& sheet) {
    // Element and face of each quad of the two sides
    std::set<std::pair<int, int>> sides;
    for (const SheetColumn& column : sheet.columns) {
        sides.emplace(column.bottom.element, column.bottom.face);
        sides.emplace(column.top.element, column.top.face);
    }
    std::vector<SurfaceQuad> rim = boundary_quads(mesh);
    std::erase_if(rim, [&](const SurfaceQuad& quad) {
        return sides.contains({quad.element, quad.face});
    });
    return rim;
}

std::vector<SurfacePoint> points_below_face(const Mesh& mesh, const Sheet& sheet,
                                            SheetSide side, double depth_m,
                                            double spacing_m) {
    std::vector<SurfacePoint> points;
    for (const SheetColumn& column : sheet.columns) {
        const auto at = [&](double u, double v) {
            return point_in(mesh, column, side, depth_m, u, v);
        };
        const std::array<Vec3, 4> corners_m{
            position(mesh, at(0, 0)), position(mesh, at(1, 0)), position(mesh, at(1, 1)),
            position(mesh, at(0, 1))};
        for (const QuadCell& cell : cut_quad(corners_m, spacing_m))
            points.push_back({at(cell.u, cell.v), cell.area_m2, cell.normal});
    }
    return points;
}

}  // namespace magfsi::structure
