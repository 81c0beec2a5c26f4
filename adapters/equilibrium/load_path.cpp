#include "adapters/equilibrium/load_path.h"

#include "adapters/bodies/scene_to_body.h"
#include "structure/lammps/placement.h"
#include "structure/lattice/lattice.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::equilibrium {

namespace {

structure::EquilibriumOptions to_options(const scene::Equilibrium& wanted) {
    structure::EquilibriumOptions options;
    options.force_tolerance = wanted.tolerance;
    options.leave_unstable = true;  // what is reported is what a body would rest in
    return options;
}

bool loaded(const structure::StaticLoads& loads) {
    return loads.field_t != structure::Vec3{} || loads.gravity_m_s2 != structure::Vec3{};
}

}  // namespace

LoadPath::LoadPath(const scene::Scene& scene, const scene::Body& body)
    : body_(bodies::to_body(body)),
      gravity_m_s2_(bodies::to_gravity(scene)),
      solver_(body_, to_options(*scene.time.equilibrium)) {
    field_ = scene.magnetic_field;
    const std::array<int, 2> plane = field_ ? field_->plane : std::array<int, 2>{0, 2};
    placed_m_ = structure::placed_nodes(body_, body.initial, plane);
    mass_kg_ = structure::build_lattice(body_).node_mass_kg;
    charge_a_m_ = structure::nodal_charges(body_.mesh.nodes, body_.mesh.elements,
                                           body_.magnetization_a_m);
    const structure::StaticLoads start = loads_at(0);
    now_.nodes_m = placed_m_;
    // A clamped body takes its first load step by step; a free one is let go.
    const bool free = body_.clamps.empty() && body_.rollers.empty();
    const bool at_rest = free || body.initial.relaxed;
    if (loaded(start)) {
        now_ = at_rest ? solver_.release(placed_m_, start)
                       : solver_.follow(placed_m_, {}, {&start, 1}).front();
        if (at_rest) now_.releases = 0;  // meant, not met on the way
    }
    // Let go, the body moves in the field at full strength.
    add_work(at_rest ? start : structure::StaticLoads{}, start, placed_m_);
}

structure::StaticLoads LoadPath::loads_at(double time_s) const {
    structure::StaticLoads loads;
    if (field_ && !body_.magnetization_a_m.empty())
        loads.field_t = structure::field_at(*field_, time_s);
    if (gravity_m_s2_) loads.gravity_m_s2 = *gravity_m_s2_;
    return loads;
}

void LoadPath::advance(double to_s) {
    const structure::StaticLoads before = loads_at(time_s_), after = loads_at(to_s);
    const auto from_m = now_.nodes_m;
    now_ = solver_.follow(from_m, before, {&after, 1}).front();
    add_work(before, after, from_m);
    time_s_ = to_s;
}

// Trapezium rule: sum q_a (B_before + B_after)/2 . (x_after - x_before).
void LoadPath::add_work(const structure::StaticLoads& before,
                        const structure::StaticLoads& after,
                        const std::vector<structure::Vec3>& from_m) {
    for (std::size_t n = 0; n < from_m.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            work_magnetic_j_ += 0.5 * charge_a_m_[n] *
                                (before.field_t[d] + after.field_t[d]) *
                                (now_.nodes_m[n][d] - from_m[n][d]);
        }
    }
}

bodies::BodyLoads LoadPath::loads() const {
    bodies::BodyLoads loads;
    loads.energy_elastic_j = now_.energy_elastic_j;
    loads.work_magnetic_j = work_magnetic_j_;
    return loads;
}

}  // namespace magfsi::equilibrium
