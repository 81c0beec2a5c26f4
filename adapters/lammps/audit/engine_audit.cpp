// What only the energy audit asks of LAMMPS.
#include <iomanip>
#include <sstream>

#include "adapters/lammps/audit/fix_audit.h"
#include "adapters/lammps/engine.h"
#include "compute.h"
#include "lammps.h"
#include "modify.h"

namespace magfsi::lammps {

void Engine::attach_audit(double drag_rate_1_s, const std::vector<std::string>& moved) {
    (*lammps_->modify->fix_map)["magfsi/audit"] = &FixAudit::create;
    std::ostringstream line;
    line << std::setprecision(17) << "fix audit all magfsi/audit " << drag_rate_1_s;
    for (const std::string& group : moved) line << ' ' << group;
    command(line.str());
    lammps_->init();  // fixes added between two runs are taken into the step's lists here
}

double Engine::compute_scalar(const std::string& compute_id) const {
    const int at = lammps_->modify->find_compute(compute_id);
    return lammps_->modify->compute[at]->compute_scalar();
}

}  // namespace magfsi::lammps
