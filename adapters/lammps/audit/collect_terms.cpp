#include "adapters/lammps/audit/collect_terms.h"

#include <array>

#include "structure/lammps/names.h"

namespace magfsi::lammps {

void attach_audit(Engine& engine, const structure::LammpsInput& input) {
    std::vector<std::string> moved;
    for (std::size_t m = 0; m < input.motions.size(); ++m)
        moved.push_back(structure::moved_group(m));
    engine.attach_audit(input.drag ? input.drag->rate_1_s : 0, moved);
}

EnergyTerms collect_terms(const Engine& engine, const scene::Scene& scene,
                          const std::vector<std::string>& magttice_fixes,
                          const coupler::MarkerWork* markers, MPI_Comm comm) {
    EnergyTerms terms;
    for (const std::string& fix : magttice_fixes) {
        terms.elastic += engine.fix_vector(fix, 1);
        terms.work_field += engine.fix_vector(fix, 3);
        terms.lost_viscosity += engine.fix_vector(fix, 5);
    }
    terms.of_moved = engine.fix_vector("audit", 1);
    terms.lost_drag = engine.fix_vector("audit", 2);
    if (scene.platform) {
        terms.platform = engine.fix_scalar("platform");
        terms.lost_friction = engine.fix_vector("platform", 8);
    }
    if (scene.contact) terms.contact = engine.compute_scalar("contact");
    if (!markers) return terms;
    std::array<double, 2> works{markers->by_fluid_j(), markers->by_enclosed_j()};
    MPI_Allreduce(MPI_IN_PLACE, works.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
    terms.by_fluid = works[0];
    terms.by_enclosed = works[1];
    return terms;
}

}  // namespace magfsi::lammps
