#include "structure/lammps/register_styles.h"

#include "error.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"

#include <cstdlib>
#include <utility>

#include "structure/lammps/compute_magttice_contact.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/fix_magttice_drag.h"
#include "structure/lammps/fix_magttice_field_source.h"
#include "structure/lammps/fix_magttice_motion.h"
#include "structure/lammps/fix_magttice_platform.h"
#include "structure/lammps/fix_magttice_quiet.h"
#include "structure/lammps/pair_magttice_contact.h"

namespace magfsi::structure {
namespace {

std::function<void(const std::string&)>& failure_handler() {
    static std::function<void(const std::string&)> handler;
    return handler;
}

template <typename Style>
LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
    return new Style(lammps, narg, arg);
}

LAMMPS_NS::Pair* create_contact(LAMMPS_NS::LAMMPS* lammps) {
    return new PairMagtticeContact(lammps);
}

LAMMPS_NS::Compute* create_contact_compute(LAMMPS_NS::LAMMPS* lammps, int narg,
                                           char** arg) {
    return new ComputeMagtticeContact(lammps, narg, arg);
}

}  // namespace

void register_styles(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.modify->fix_map)["magttice"] = &create<FixMagttice>;
    (*lammps.modify->fix_map)["magttice/drag"] = &create<FixMagtticeDrag>;
    (*lammps.modify->fix_map)["magttice/field"] = &create<FixMagtticeFieldSource>;
    (*lammps.modify->fix_map)["magttice/motion"] = &create<FixMagtticeMotion>;
    (*lammps.modify->fix_map)["magttice/platform"] = &create<FixMagtticePlatform>;
    (*lammps.modify->fix_map)["magttice/quiet"] = &create<FixMagtticeQuiet>;
    (*lammps.force->pair_map)["magttice/contact"] = &create_contact;
    (*lammps.modify->compute_map)["magttice/contact"] = &create_contact_compute;
}

void set_failure_handler(std::function<void(const std::string& cause)> handler) {
    failure_handler() = std::move(handler);
}

void fail(LAMMPS_NS::Error& error, const std::string& cause) {
    if (failure_handler()) {
        failure_handler()(cause);
        std::abort();  // the handler's contract is not to return
    }
    error.one(FLERR, cause);
}

}  // namespace magfsi::structure
