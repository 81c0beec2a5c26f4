// Bodies that go on beyond their mesh: one that spans a periodic box has no surface at
// its two ends there.
#pragma once

#include <array>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Along which axes of the mesh a body continues.
using Continues = std::array<bool, 3>;

class MeshEnds {
  public:
    MeshEnds(const Mesh& mesh, const Continues& continues);

    // Whether all nodes of the quad lie on one end of an axis along which it continues.
    bool hold(const SurfaceQuad& quad) const;

  private:
    const Mesh& mesh_;
    Continues continues_;
    Vec3 low_m_{}, high_m_{};
    double slack_m_ = 0;
};

}  // namespace magfsi::structure
