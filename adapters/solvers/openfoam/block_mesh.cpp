// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks between the planes on which a box begins or ends; those inside a box are left
// out, and their faces towards the fluid are the box's patch.
#include "adapters/solvers/openfoam/block_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace magfsi::openfoam {

namespace {

using Index = std::array<int, 3>;

// Corners of a block's faces in blockMesh's numbering, in the order of the sides of the
// box, as seen from outside.
constexpr std::array<std::array<int, 4>, 6> face_corners = {
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

class Blocks {
  public:
    Blocks(const BoxMesh& mesh, const ObstaclePlan& plan) : mesh_(mesh), plan_(plan) {
        for (std::size_t d = 0; d < 3; ++d) {
            auto& planes = planes_[d];
            planes = {0, static_cast<int>(mesh.planes_m[d].size()) - 1};
            for (const CutBox& box : plan.cut) {
                planes.push_back(box.low[d]);
                planes.push_back(box.high[d]);
            }
            std::ranges::sort(planes);
            planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
        }
        for (int k = 0; k < count(2); ++k)
            for (int j = 0; j < count(1); ++j)
                for (int i = 0; i < count(0); ++i) add({i, j, k});
    }

    std::string vertices() const { return vertices_; }
    std::string blocks() const { return blocks_; }
    // Faces of a side (0 to 5), or of an obstacle (6 and its number in the plan).
    std::string faces(std::size_t patch) const {
        const auto found = faces_.find(patch);
        return found == faces_.end() ? "" : found->second;
    }

  private:
    int count(std::size_t d) const { return static_cast<int>(planes_[d].size()) - 1; }

    // Number in the plan of the box that holds a block; -1: fluid.
    int solid(const Index& block) const {
        Index cell{};
        for (std::size_t d = 0; d < 3; ++d) cell[d] = planes_[d][block[d]];
        for (std::size_t i = 0; i < plan_.cut.size(); ++i)
            if (plan_.cut[i].holds(cell)) return static_cast<int>(i);
        return -1;
    }

    // Number of the vertex at a corner of blocks, which is added if it is new.
    int vertex(const Index& at) {
        const auto [found, is_new] =
            numbers_.try_emplace(at, static_cast<int>(numbers_.size()));
        if (is_new) {
            vertices_ += fmt::format("    ({:.17g} {:.17g} {:.17g})\n",
                                     mesh_.planes_m[0][planes_[0][at[0]]],
                                     mesh_.planes_m[1][planes_[1][at[1]]],
                                     mesh_.planes_m[2][planes_[2][at[2]]]);
        }
        return found->second;
    }

    // Widths of a block's cells along an axis as blockMesh's grading: one section per
    // cell, so that any grading can be written.
    std::string widths(const Index& block, std::size_t d) const {
        const auto& planes_m = mesh_.planes_m[d];
        std::string text = "(";
        for (int i = planes_[d][block[d]]; i < planes_[d][block[d] + 1]; ++i)
            text += fmt::format("({:.17g} 1 1)", planes_m[i + 1] - planes_m[i]);
        return text + ")";
    }

    void add(const Index& block) {
        if (solid(block) >= 0) return;
        std::array<int, 8> corner{};
        for (int c = 0; c < 8; ++c)  // around the lower square, then the upper one
            corner[c] = vertex(
                {block[0] + (c + 1) / 2 % 2, block[1] + c / 2 % 2, block[2] + c / 4});
        blocks_ +=
            fmt::format("    hex ({} {} {} {} {} {} {} {}) (", corner[0], corner[1],
                        corner[2], corner[3], corner[4], corner[5], corner[6], corner[7]);
        for (std::size_t d = 0; d < 3; ++d)
            blocks_ += fmt::format("{}{}", d == 0 ? "" : " ",
                                   planes_[d][block[d] + 1] - planes_[d][block[d]]);
        blocks_ += fmt::format(
            ") simpleGrading\n    (\n        {}\n        {}\n        {}\n    )\n",
            widths(block, 0), widths(block, 1), widths(block, 2));
        for (std::size_t side = 0; side < 6; ++side) {
            Index next = block;
            next[side / 2] += side % 2 == 0 ? -1 : 1;
            const bool outside = next[side / 2] < 0 || next[side / 2] == count(side / 2);
            const int box = outside ? -1 : solid(next);
            if (!outside && box < 0) continue;
            const auto& f = face_corners[side];
            faces_[outside ? side : 6 + static_cast<std::size_t>(box)] += fmt::format(
                "({} {} {} {})", corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]);
        }
    }

    const BoxMesh& mesh_;
    const ObstaclePlan& plan_;
    std::array<std::vector<int>, 3> planes_;  // of the mesh, at which blocks end
    std::map<Index, int> numbers_;
    std::string vertices_, blocks_;
    std::map<std::size_t, std::string> faces_;
};

}  // namespace

std::string block_mesh(const scene::Fluid& fluid, const BoxMesh& mesh,
                       const ObstaclePlan& plan,
                       const std::function<std::string(std::size_t side)>& patch) {
    const Blocks blocks(mesh, plan);
    std::string text = fmt::format(
        "scale 1;\nvertices\n(\n{});\nblocks\n(\n{});\nedges ();\nboundary\n(\n",
        blocks.vertices(), blocks.blocks());
    for (std::size_t side = 0; side < 6; ++side)
        text +=
            fmt::format("    {} {{ {} faces ({}); }}\n", scene::names<scene::Face>[side],
                        patch(side), blocks.faces(side));
    for (std::size_t i = 0; i < plan.cut.size(); ++i) {
        text += fmt::format("    {} {{ type wall; faces ({}); }}\n",
                            patch_name(fluid.obstacles[plan.cut[i].obstacle]),
                            blocks.faces(6 + i));
    }
    return text + ");\nmergePatchPairs ();\n";
}

}  // namespace magfsi::openfoam
