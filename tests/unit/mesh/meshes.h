// Meshes and measures that the tests of meshes share.
#pragma once

#include <cmath>
#include <random>

#include "structure/lattice/hexahedron.h"
#include "structure/mesh/block_mesh.h"

namespace magfsi::structure::test {

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double within(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }

  private:
    std::mt19937 engine_;
};

// A block all of whose coordinates are moved by up to `amplitude_m`.
inline Mesh distorted_block(const Box& box, double amplitude_m, unsigned seed) {
    Mesh mesh = box_mesh(box);
    Random random(seed);
    for (Vec3& node : mesh.nodes) {
        for (double& x : node) x += random.within(-amplitude_m, amplitude_m);
    }
    return mesh;
}

inline double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Throws where an element is inverted.
inline double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        sum += integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]),
                                    static_cast<int>(e))
                   .volume;
    }
    return sum;
}

}  // namespace magfsi::structure::test
