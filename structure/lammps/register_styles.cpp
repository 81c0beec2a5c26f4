#include "structure/lammps/register_styles.h"

#include "error.h"
#include "lammps.h"
#include "modify.h"

#include <cstdlib>
#include <utility>

#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/fix_magttice_quiet.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {
namespace {

std::function<void(const std::string&)>& failure_handler() {
    static std::function<void(const std::string&)> handler;
    return handler;
}

}  // namespace

#define MAGFSI_EFFECT(name) void register_##name(LAMMPS_NS::LAMMPS& lammps);
#include "structure/lammps/effects.inc"
#undef MAGFSI_EFFECT

void register_styles(LAMMPS_NS::LAMMPS& lammps) {
    using LAMMPS_NS::Fix;
    auto& fixes = *lammps.modify->fix_map;
    fixes["magttice"] = &create<FixMagttice, Fix>;
    fixes["magttice/quiet"] = &create<FixMagtticeQuiet, Fix>;
#define MAGFSI_EFFECT(name) register_##name(lammps);
#include "structure/lammps/effects.inc"
#undef MAGFSI_EFFECT
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
