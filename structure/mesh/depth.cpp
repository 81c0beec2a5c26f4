#include "structure/mesh/depth.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "structure/mesh/surface_points.h"

namespace magfsi::structure {
namespace {

using Bin = std::array<int, 3>;

// Surface points by cubes of edge `size`: the nearest within `size` is in one of 27.
class Bins {
  public:
    Bins(const Mesh& mesh, std::span<const SurfaceQuad> surface, double spacing_m,
         double size_m)
        : size_m_(size_m) {
        for (const auto& p : surface_points(mesh, surface, spacing_m)) {
            const Vec3 x = position(mesh, p.point);
            bins_[bin(x)].push_back(x);
        }
    }

    double distance_to(const Vec3& x) const {
        double least = size_m_ * size_m_;
        const Bin middle = bin(x);
        for (int i = 0; i < 27; ++i) {
            const auto found =
                bins_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1,
                            middle[2] + i / 9 - 1});
            if (found == bins_.end()) continue;
            for (const Vec3& y : found->second) {
                const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
                least = std::min(least, dx * dx + dy * dy + dz * dz);
            }
        }
        return std::sqrt(least);
    }

  private:
    Bin bin(const Vec3& x) const {
        Bin b;
        for (std::size_t d = 0; d < 3; ++d)
            b[d] = static_cast<int>(std::floor(x[d] / size_m_));
        return b;
    }
    double size_m_;
    std::map<Bin, std::vector<Vec3>> bins_;
};

}  // namespace

std::vector<double> depths(const Mesh& mesh, std::span<const SurfaceQuad> surface,
                           std::span<const MaterialPoint> points, double spacing_m,
                           double limit_m) {
    const Bins bins(mesh, surface, spacing_m, limit_m);
    std::vector<double> found;
    found.reserve(points.size());
    for (const MaterialPoint& p : points)
        found.push_back(bins.distance_to(position(mesh, p)));
    return found;
}

}  // namespace magfsi::structure
