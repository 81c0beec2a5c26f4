#include "structure/mesh/box_mesh.h"

#include <fmt/format.h>

#include <stdexcept>

#include "structure/mesh/structured.h"

namespace magfsi::structure {
namespace {

void check(const Box& box) {
    for (int d = 0; d < 3; ++d) {
        if (!(box.size_m[d] > 0) || box.elements[d] < 1) {
            throw std::invalid_argument(fmt::format(
                "box mesh of {:g} m in {} elements along {} found, both must be positive",
                box.size_m[d], box.elements[d], "xyz"[d]));
        }
    }
}

}  // namespace

Mesh box_mesh(const Box& box) {
    check(box);
    const auto [nx, ny, nz] = box.elements;
    return structured_mesh(box.elements, [&](int i, int j, int k) {
        return Vec3{box.size_m[0] * i / nx, box.size_m[1] * j / ny,
                    box.size_m[2] * k / nz};
    });
}

MaterialPoint locate(const Box& box, const Vec3& point_m) {
    check(box);
    Vec3 s{};
    for (int d = 0; d < 3; ++d) s[d] = point_m[d] / box.size_m[d] * box.elements[d];
    return structured_point(box.elements, s);
}

}  // namespace magfsi::structure
