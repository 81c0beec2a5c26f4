// One body on a path of loads: its equilibrium at each point.
#pragma once

#include "adapters/bodies/nodal_state.h"
#include "adapters/bodies/probe_row.h"
#include "adapters/scene/scene.h"
#include "structure/equilibrium/newton.h"
#include "structure/lammps/field_program.h"

namespace magfsi::equilibrium {

class LoadPath {
  public:
    // Finds the equilibrium at the start of the path. Throws std::invalid_argument on
    // what cannot be in equilibrium (a free body with weight).
    LoadPath(const scene::Scene& scene, const scene::Body& body);

    const structure::Body& body() const { return body_; }
    // Where the body is before any load: flat, relaxed, turned, as the scene says.
    const std::vector<structure::Vec3>& placed_m() const { return placed_m_; }
    const structure::Equilibrium& now() const { return now_; }
    const std::vector<double>& masses_kg() const { return mass_kg_; }
    bodies::BodyLoads loads() const;

    void advance(double to_s);  // along the path, from where it is

  private:
    structure::StaticLoads loads_at(double time_s) const;
    void add_work(const structure::StaticLoads& before,
                  const structure::StaticLoads& after,
                  const std::vector<structure::Vec3>& from_m);

    structure::Body body_;
    std::optional<structure::FieldProgram> field_;
    std::optional<structure::Vec3> gravity_m_s2_;
    std::vector<structure::Vec3> placed_m_;
    std::vector<double> charge_a_m_, mass_kg_;
    structure::NewtonSolver solver_;
    structure::Equilibrium now_;
    double time_s_ = 0;
    double work_magnetic_j_ = 0;
};

}  // namespace magfsi::equilibrium
