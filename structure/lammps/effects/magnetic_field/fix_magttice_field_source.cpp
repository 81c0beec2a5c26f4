#include "structure/lammps/effects/magnetic_field/fix_magttice_field_source.h"

#include "error.h"
#include "update.h"

#include <exception>
#include <string>
#include <vector>

#include "structure/lammps/failure.h"

namespace magfsi::structure {

FixMagtticeFieldSource::FixMagtticeFieldSource(LAMMPS_NS::LAMMPS* lammps, int narg,
                                               char** arg)
    : Fix(lammps, narg, arg) {
    try {
        program_ = parse_field_arguments(std::vector<std::string>(arg + 3, arg + narg));
    } catch (const std::exception& cause) {
        fail(*error, std::string("fix ") + id + " magttice/field: " + cause.what());
    }
    vector_flag = 1;
    size_vector = 3;
    extvector = 0;
    global_freq = 1;
}

// The time is that of the step number, not a sum of steps: it stays right over restarts.
double FixMagtticeFieldSource::compute_vector(int i) {
    const double time_s = static_cast<double>(update->ntimestep) * update->dt;
    return field_at(program_, time_s)[static_cast<std::size_t>(i)];
}

}  // namespace magfsi::structure
