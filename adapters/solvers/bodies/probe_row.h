// SPDX-License-Identifier: GPL-2.0-or-later
// The columns of probes.csv that belong to the uniform part of the applied field and to
// the bodies, and their values.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/nodal_state.h"
#include "adapters/solvers/bodies/rigid_parts.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Quantities of one body that do not follow from the motion of its nodes. Each is zero or
// empty unless a probe of the scene needs it (needs).
struct BodyLoads {
    Vec3 fluid_force_n{};
    double energy_elastic_j = 0;
    double work_magnetic_j = 0;  // work of the applied field since the start
    // Kinetic energy of its rigid parts beyond that of their nodes' masses.
    double kinetic_beyond_nodes_j = 0;
    // Force of clamps, rollers and prescribed motions on each node of the body [N].
    std::vector<Vec3> support_n{};
    // Force of contact, platform and walls on each node of the body [N].
    std::vector<Vec3> contact_n{};
    // Torque of the fluid about the origin of space; comes with fluid_force_n.
    Vec3 fluid_torque_n_m{};
    // Mean of fluid_force_n since the last row; for probes.mean_forces.
    Vec3 mean_fluid_force_n{};
};
enum class Load { none, fluid_force, fluid_torque, energies, support, contact };
// True if a probe of the scene needs the load. The torque needs the force as well, for it
// is written about the centre of mass.
bool needs(const scene::Scene& scene, Load load);

// One entry for each element of the mesh: true if its centre lies in the box of the part,
// or the part is the whole body. Throws std::invalid_argument if no element has.
std::vector<bool> elements_of(const scene::BodyPart& part, const structure::Mesh& mesh);

// The state of all bodies at one time. loads: one entry for each body, in the order of
// the scene; force_on_parts_n: in a scene with a fluid the fluid's force [N] on each body
// part of probes.integrals, in their order.
struct ProbeSample {
    double time_s = 0;
    const NodalState& nodes;
    const std::vector<BodyLoads>& loads;
    const std::vector<Vec3>& force_on_parts_n;
};

// Index in `columns` of the i-th probe of a controller, which the scene names with or
// without its unit. Throws SceneError if there is no such column.
std::size_t column_of(const std::vector<std::string>& columns,
                      const scene::Control& control, std::size_t i);

// Evaluates the bodies' part of a row of probes.csv. The order of the columns: applied
// field, then each body's quantities, point probes, parts of bodies.
class ProbeRow {
  public:
    // bodies: those of the scene, in its order; start: their state at step 0, to which
    // displacements refer. The object keeps neither.
    ProbeRow(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
             const NodalState& start);
    ProbeRow(const ProbeRow&) = delete;
    ProbeRow& operator=(const ProbeRow&) = delete;

    // Replaces the scene's law of the uniform field, when a controller has set another.
    void set_field(const structure::FieldProgram& field) { field_ = field; }

    // Names of the columns with their units in brackets.
    std::vector<std::string> columns() const;
    // One value for each column. nodes: with the masses that momenta and centres of mass
    // are to be taken with.
    std::vector<double> values(double time_s, const NodalState& nodes,
                               const std::vector<BodyLoads>& loads,
                               const std::vector<Vec3>& force_on_parts_n = {}) const;

  private:
    // Adjacent columns and the function that appends their values to a row.
    struct Group {
        std::vector<std::string> columns;
        std::function<void(const ProbeSample& sample, std::vector<double>& row)> add;
    };
    void add_body(const scene::Scene& scene, std::size_t body,
                  const structure::Body& solid, std::size_t first_node);
    void add_magnetic_load(const scene::MagneticField& field, std::size_t body,
                           const structure::Body& solid, std::size_t first_node);
    void add_rigid_motion(std::size_t part, const std::string& column,
                          const scene::Placement& initial);
    void add_reactions(std::size_t body, const structure::Body& solid);
    void add_point(const scene::PointProbe& probe, const scene::Body& body,
                   const structure::Mesh& mesh, std::size_t first_node);
    void add_part(const std::string& name, const scene::BodyPart& part,
                  const structure::Mesh& mesh, std::size_t first_node, bool in_fluid,
                  bool mean_forces);

    std::vector<Group> groups_;
    structure::FieldProgram field_{};
    std::vector<RigidPartOfScene> rigid_parts_;
    std::vector<Vec3> start_m_;  // nodes of all bodies at step 0
    std::size_t parts_ = 0;      // number of body parts added so far
};

}  // namespace magfsi::bodies
