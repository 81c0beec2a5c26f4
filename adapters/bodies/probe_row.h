// The bodies' part of a row of probes.csv.
#pragma once

#include <optional>
#include <vector>

#include "adapters/bodies/body_probes.h"
#include "adapters/scene/scene.h"
#include "structure/body.h"
#include "structure/lammps/field_program.h"

namespace magfsi::bodies {

// What the nodes alone do not tell, of one body. Zeros where the scene does not ask.
struct BodyLoads {
    Vec3 fluid_force_n{};
    double energy_elastic_j = 0;
    double work_magnetic_j = 0;
};

class ProbeRow {
  public:
    // bodies: those of the scene, in its order; start: step 0.
    ProbeRow(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
             const NodalState& start);

    // Whether the scene has this column for its bodies.
    static bool wants(const scene::Scene& scene, scene::BodyQuantity quantity);

    // In the order of scene::body_columns. force_on_parts_n: the fluid's, in the order
    // of probes.integrals, of a scene with a fluid.
    std::vector<double> values(double time_s, const NodalState& state,
                               const std::vector<BodyLoads>& loads,
                               const std::vector<Vec3>& force_on_parts_n = {}) const;

  private:
    struct Point {
        structure::MaterialPoint at;
        std::size_t first_node = 0;
        Vec3 start_m{};
    };
    struct Part {
        std::size_t first_node = 0;
        std::vector<double> share;  // of each node's mass
        std::vector<Vec3> start_m;
    };
    void add_parts(std::vector<double>& row, const NodalState& state,
                   const std::vector<Vec3>& force_n) const;

    const scene::Scene& scene_;
    std::optional<structure::FieldProgram> field_;
    std::vector<BodyNodes> bodies_;
    std::vector<Point> points_;
    std::vector<Part> parts_;
};

}  // namespace magfsi::bodies
