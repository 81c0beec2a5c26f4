#include "structure/lammps/effects/platform/fix_magttice_platform.h"

#include "atom.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "structure/lammps/bodies.h"
#include "structure/lammps/contact_area.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {
namespace {

// ID group style, then point, normal and stiffness.
constexpr int first_keyword = 10;

}  // namespace

FixMagtticePlatform::FixMagtticePlatform(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg < first_keyword) {
        fail(*error, std::string("fix ") + id +
                         " magttice/platform needs a point, a normal and a stiffness: "
                         "seven numbers");
    }
    parse_plane(arg);
    parse_keywords(narg, arg);
    add_forces_ = &FixMagtticePlatform::add_frictionless_forces;
    if (platform_.friction > 0)
        add_forces_ = &FixMagtticePlatform::add_forces_with_friction;
    declare_output();
    FixMagtticePlatform::grow_arrays(atom->nmax);
    atom->add_callback(LAMMPS_NS::Atom::GROW);
    atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

FixMagtticePlatform::~FixMagtticePlatform() {
    atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
    atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
    delete[] extlist;
}

void FixMagtticePlatform::parse_plane(char** arg) {
    double length = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        platform_.point_m[d] = LAMMPS_NS::utils::numeric(FLERR, arg[3 + d], false, lmp);
        platform_.normal[d] = LAMMPS_NS::utils::numeric(FLERR, arg[6 + d], false, lmp);
        length = std::hypot(length, platform_.normal[d]);
    }
    platform_.stiffness_pa_m = LAMMPS_NS::utils::numeric(FLERR, arg[9], false, lmp);
    if (!(length > 0) || !(platform_.stiffness_pa_m > 0)) {
        fail(*error, std::string("fix ") + id +
                         " magttice/platform: a normal of length " +
                         std::to_string(length) + " and the stiffness " + arg[9] +
                         " found, both must be positive");
    }
    for (double& component : platform_.normal) component /= length;
}

void FixMagtticePlatform::parse_keywords(int narg, char** arg) {
    for (int i = first_keyword; i < narg; i += 2) {
        const std::string keyword = arg[i];
        double* value = keyword == "friction"  ? &platform_.friction
                        : keyword == "damping" ? &platform_.damping_pa_s_m
                                               : nullptr;
        if (value != nullptr && i + 1 < narg) {
            *value = LAMMPS_NS::utils::numeric(FLERR, arg[i + 1], false, lmp);
        }
        if (value == nullptr || i + 1 >= narg || !(*value >= 0)) {
            fail(*error, std::string("fix ") + id + " magttice/platform: \"" + keyword +
                             "\" found; \"friction\" and \"damping\" with one value, "
                             "not negative, are allowed");
        }
    }
}

void FixMagtticePlatform::declare_output() {
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 8;
    extvector = -1;
    extlist = new int[8]{1, 1, 1, 0, 1, 1, 1, 1};
    global_freq = 1;
    energy_global_flag = 1;
    thermo_energy = 1;
    restart_peratom = 1;
}

void FixMagtticePlatform::post_force(int) {
    (this->*add_forces_)(update->dt);
}

int FixMagtticePlatform::setmask() {
    using namespace LAMMPS_NS::FixConst;
    return POST_FORCE | MIN_POST_FORCE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

void FixMagtticePlatform::init() {
    const auto bodies = bodies_of(*modify);
    if (bodies.empty()) {
        fail(*error, std::string("fix ") + id +
                         " magttice/platform found no fix magttice, it needs the "
                         "surface of at least one");
    }
    area_m2_.clear();
    for (const FixMagttice* body : bodies) {
        const auto areas = contact_areas(body->nodes_m(), body->lattice().elements);
        const auto first = static_cast<std::size_t>(body->range().first_id);
        area_m2_.resize(std::max(area_m2_.size(), first + areas.size()), 0.0);
        std::ranges::copy(areas, area_m2_.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

void FixMagtticePlatform::rebuild() {
    surface_.clear();
    for (int i = 0; i < atom->nlocal; ++i) {
        const auto tag = static_cast<std::size_t>(atom->tag[i]);
        if ((atom->mask[i] & groupbit) == 0 || tag >= area_m2_.size()) continue;
        if (area_m2_[tag] > 0) surface_.push_back({i, area_m2_[tag]});
    }
}

// Velocities, which only the damping looks at, are those of the half step.
template <class ContactOf>
void FixMagtticePlatform::add_forces(ContactOf&& contact_of) {
    normal_n_ = 0;
    energy_j_ = 0;
    smallest_gap_m_ = INFINITY;
    force_n_ = {};
    const double* const* const x = atom->x;
    const double* const* const v = atom->v;
    double* const* const f = atom->f;
    for (const SurfaceNode& node : surface_) {
        const int i = node.atom;
        const PlatformContact contact = contact_of(node, x[i], v[i]);
        smallest_gap_m_ = std::min(smallest_gap_m_, contact.gap_m);
        if (!(contact.gap_m < 0)) continue;
        normal_n_ += contact.normal_n;
        energy_j_ += contact.energy_j;
        slid_j_ += contact.slid_j;
        for (std::size_t d = 0; d < 3; ++d) {
            f[i][d] += contact.force_n[d];
            force_n_[d] += contact.force_n[d];
        }
    }
}

void FixMagtticePlatform::add_frictionless_forces(double) {
    add_forces([&](const SurfaceNode& node, const double* x, const double* v) {
        return frictionless_contact(platform_, node.area_m2, x, v);
    });
}

void FixMagtticePlatform::add_forces_with_friction(double dt_s) {
    add_forces([&](const SurfaceNode& node, const double* x, const double* v) {
        return platform_contact(platform_, node.area_m2, x, v, dt_s,
                                stick_[static_cast<std::size_t>(node.atom)]);
    });
}

}  // namespace magfsi::structure
