// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/equilibrium/mesh_error.h"

#include <algorithm>
#include <map>

#include "structure/equilibrium/iteration.h"

namespace magfsi::structure {
namespace {

// Adds the nodes of a refined mesh: each is the mean of one, two, four or eight parents
// and is made once.
class Middles {
  public:
    explicit Middles(std::vector<Vec3>& nodes) : nodes_(nodes) {}

    // Number of the node in the middle of these nodes.
    int of(std::vector<int> parents) {
        std::ranges::sort(parents);
        if (parents.size() == 1) return parents.front();
        const auto [place, first] =
            number_.try_emplace(parents, static_cast<int>(nodes_.size()));
        if (!first) return place->second;
        Vec3 middle{};
        for (const int node : parents)
            middle += nodes_[node] / static_cast<double>(parents.size());
        nodes_.push_back(middle);
        return place->second;
    }

    // Adds the new nodes all of whose parents are in the group.
    void extend(std::vector<int>& group) const {
        std::ranges::sort(group);
        const std::vector<int> old = group;
        for (const auto& [parents, node] : number_) {
            if (std::ranges::includes(old, parents)) group.push_back(node);
        }
        std::ranges::sort(group);
    }

  private:
    // Nodes of the refined mesh, owned by the caller
    std::vector<Vec3>& nodes_;
    // Number of the node by its parents, ascending
    std::map<std::vector<int>, int> number_;
};

// Parents of a node of the refined element: those corners whose mean is the point that
// lies `halves` (0, 1 or 2) half edges along each local direction.
std::vector<int> parents(const Hexahedron& element, const std::array<int, 3>& halves) {
    std::vector<int> out;
    for (int a = 0; a < 8; ++a) {
        bool near = true;
        for (int d = 0; d < 3; ++d)
            near = near && (halves[d] == 1 || halves[d] == 2 * ((a >> d) & 1));
        if (near) out.push_back(element[a]);
    }
    return out;
}

}  // namespace

Mesh refined(const Mesh& mesh) {
    Mesh out;
    out.nodes = mesh.nodes;
    out.region_names = mesh.region_names;
    Middles middles(out.nodes);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int child = 0; child < 8; ++child) {
            Hexahedron& nodes = out.elements.emplace_back();
            for (int a = 0; a < 8; ++a) {
                std::array<int, 3> halves{};
                for (int d = 0; d < 3; ++d)
                    halves[d] = ((child >> d) & 1) + ((a >> d) & 1);
                nodes[a] = middles.of(parents(mesh.elements[e], halves));
            }
            if (!mesh.region.empty()) out.region.push_back(mesh.region[e]);
            if (!mesh.solid_share.empty()) out.solid_share.push_back(mesh.solid_share[e]);
        }
    }
    out.centre_line = mesh.centre_line;
    for (MaterialPoint& point : out.centre_line) point.element *= 8;
    out.faces = mesh.faces;
    out.points = mesh.points;
    for (auto& [name, group] : out.faces) middles.extend(group);
    for (auto& [name, group] : out.points) middles.extend(group);
    return out;
}

std::vector<Vec3> linear_response(const Body& body, const StaticLoads& loads) {
    StaticProblem problem(body);
    StaticLoads borne = loads;
    for (std::size_t d = 0; d < 3; ++d) {
        if (!problem.held_along()[d]) borne.gravity_m_s2[d] = 0;
    }
    const Eigen::VectorXd x = flat_positions(body.mesh.nodes);
    problem.assemble(x);
    problem.matrix().raise_foundation(problem.rigid_foundation());
    if (!problem.matrix().factorize())
        throw std::runtime_error("body " + body.name + ": not stable without loads");
    return nodes_from(deformation(
        problem, x,
        problem.matrix().solve(problem.surrounding_n(x, problem.load(borne)))));
}

double displacement_error(const Vec3& here_m, const Vec3& on_refined_m) {
    const double along = dot(here_m, on_refined_m);
    const double refined = dot(on_refined_m, on_refined_m);
    return refined > 0 ? std::max(along / refined - 1, -1.0) : 0;
}

}  // namespace magfsi::structure
