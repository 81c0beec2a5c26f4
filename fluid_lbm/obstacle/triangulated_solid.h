// A body bounded by triangles.
#pragma once

#include <filesystem>
#include <unordered_map>
#include <vector>

#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/obstacle/stl.h"

namespace magfsi::fluid {

class TriangulatedSolid final : public Solid {
  public:
    // A point x of the file comes to shift + scale * x. Throws std::invalid_argument if
    // the surface is not closed.
    TriangulatedSolid(const std::filesystem::path& file, double scale, const Vec3& shift);

    Bounds bounds() const override { return bounds_; }

    // By the parity of crossings of the ray along x. Each edge is intersected in one
    // order of its ends, so that triangles that share it agree and a ray through an edge
    // or a vertex is counted once.
    void mark_row(double y, double z, int x_begin, std::span<char> inside) const override;

    double entry(const Vec3& outside, const Vec3& inside) const override;

  private:
    using Bin = std::array<int, 3>;
    struct BinHash {
        std::size_t operator()(const Bin& bin) const;
    };

    void sort_into_bins();
    void check_closed(const std::filesystem::path& file) const;

    std::vector<Triangle> triangles_;
    Bounds bounds_;
    // Triangles by the unit cubes and by the unit squares of (y, z) that they may meet.
    std::unordered_map<Bin, std::vector<int>, BinHash> cubes_, columns_;
};

}  // namespace magfsi::fluid
