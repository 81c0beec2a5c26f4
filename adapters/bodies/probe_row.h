// SPDX-License-Identifier: GPL-2.0-or-later
// The bodies' part of probes.csv: columns and their values.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// What the nodes alone do not tell, of one body. Zeros where no probe needs it.
struct BodyLoads {
    Vec3 fluid_force_n{};
    double energy_elastic_j = 0;
    double work_magnetic_j = 0;
    std::vector<Vec3> support_n{};  // by clamps, rollers and motions on each node
    Vec3 fluid_torque_n_m{};        // about the origin; with it the force
};
enum class Load { none, fluid_force, fluid_torque, energies, support };
// Whether a probe of the scene needs it; the torque needs the force as well.
bool needs(const scene::Scene& scene, Load load);

// Which elements have their centre in the part's box. Throws std::invalid_argument where
// none has.
std::vector<bool> elements_of(const scene::BodyPart& part, const structure::Mesh& mesh);

// At one time: loads of each body, in their order; of a scene with a fluid also the
// fluid's force on each part of a body in probes.integrals.
struct ProbeSample {
    double time_s = 0;
    const NodalState& nodes;
    const std::vector<BodyLoads>& loads;
    const std::vector<Vec3>& force_on_parts_n;
};

// Which column probe i of a controller means, named with or without its unit. Throws
// SceneError if it is none of them.
std::size_t column_of(const std::vector<std::string>& columns,
                      const scene::Control& control, std::size_t i);

class ProbeRow {
  public:
    // bodies: those of the scene, in its order; start: step 0.
    ProbeRow(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
             const NodalState& start);
    ProbeRow(const ProbeRow&) = delete;
    ProbeRow& operator=(const ProbeRow&) = delete;

    // Where it is no longer the scene's.
    void set_field(const structure::FieldProgram& field) { field_ = field; }

    std::vector<std::string> columns() const;
    std::vector<double> values(double time_s, const NodalState& nodes,
                               const std::vector<BodyLoads>& loads,
                               const std::vector<Vec3>& force_on_parts_n = {}) const;

  private:
    // Columns beside each other and the function that adds their values to a row.
    struct Group {
        std::vector<std::string> columns;
        std::function<void(const ProbeSample& sample, std::vector<double>& row)> add;
    };
    void add_body(const scene::Scene& scene, std::size_t body,
                  const structure::Body& solid, std::size_t first_node);
    void add_magnetic_load(const scene::MagneticField& field, std::size_t body,
                           const structure::Body& solid, std::size_t first_node);
    void add_reactions(std::size_t body, const structure::Body& solid);
    void add_point(const scene::PointProbe& probe, const scene::Body& body,
                   const structure::Mesh& mesh, std::size_t first_node);
    void add_part(const std::string& name, const scene::BodyPart& part,
                  const structure::Mesh& mesh, std::size_t first_node, bool in_fluid);

    std::vector<Group> groups_;
    structure::FieldProgram field_{};
    std::vector<Vec3> start_m_;
    std::size_t parts_ = 0;
};

}  // namespace magfsi::bodies
