// SPDX-License-Identifier: GPL-2.0-or-later
// Platform: fix ID group magttice/platform PX PY PZ NX NY NZ STIFFNESS [friction MU]
// [damping C], a plane that pushes the surfaces of bodies back. See docs/fix_magttice.md.
#include "atom.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "structure/lammps/platform_law.h"
#include "structure/lammps/sticking_fix.h"

namespace magfsi::structure {
namespace {

// Number of the first keyword: after ID, group, style, point, normal and stiffness.
constexpr int first_keyword = 10;

class FixMagtticePlatform : public StickingFix {
  public:
    FixMagtticePlatform(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~FixMagtticePlatform() override;

    int setmask() override;
    void init() override;
    void setup_post_neighbor() override { rebuild(); }
    void post_neighbor() override { rebuild(); }
    void min_post_neighbor() override { rebuild(); }
    void setup(int) override { (this->*add_forces_)(0); }
    void min_setup(int) override { (this->*add_forces_)(0); }
    void post_force(int vflag) override;
    void min_post_force(int) override { (this->*add_forces_)(0); }

    double compute_scalar() override;  // energy of the springs [J], collective
    // i = 0 to 7: normal force [N], force along the plane [N], energy [J], smallest gap
    // [m], force x, y, z [N], energy lost to friction [J]; collective
    double compute_vector(int i) override;
    void* extract(const char* name, int& dimension) override;

  private:
    // A surface node of this rank.
    struct PressedNode {
        int atom = 0;  // local index
        double area_m2 = 0;
    };
    void parse_plane(char** arg);
    void parse_keywords(int narg, char** arg);
    void declare_output();
    void rebuild();
    void add_frictionless_forces(double dt_s);
    void add_forces_with_friction(double dt_s);
    template <class ContactOf>
    void add_forces(ContactOf&& contact_of);

    Platform platform_;
    // The function for this platform, chosen once, so that no node tests for friction.
    void (FixMagtticePlatform::*add_forces_)(double) = nullptr;
    std::vector<SurfaceNode> node_;  // one per atom, by atom ID
    // Surface nodes of this rank that are in the group
    std::vector<PressedNode> surface_;

    // This rank's share at the last evaluation.
    double normal_n_ = 0, energy_j_ = 0, smallest_gap_m_ = 0;
    Vec3 force_n_{};
    double slid_j_ = 0;  // energy lost since the start
};

// arg: ID group magttice/platform, the seven numbers, then keywords.
FixMagtticePlatform::FixMagtticePlatform(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : StickingFix(lammps, narg, arg) {
    if (narg < first_keyword) {
        fail(*error,
             "fix {} magttice/platform needs a point, a normal and a stiffness: seven "
             "numbers",
             id);
    }
    parse_plane(arg);
    parse_keywords(narg, arg);
    add_forces_ = &FixMagtticePlatform::add_frictionless_forces;
    if (platform_.friction > 0) {
        add_forces_ = &FixMagtticePlatform::add_forces_with_friction;
        keep_sticks(1);
    }
    declare_output();
}

FixMagtticePlatform::~FixMagtticePlatform() {
    delete[] extlist;
}

void FixMagtticePlatform::parse_plane(char** arg) {
    double length = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        platform_.point_m[d] = number(arg[3 + d], lmp);
        platform_.normal[d] = number(arg[6 + d], lmp);
        length = std::hypot(length, platform_.normal[d]);
    }
    platform_.stiffness_pa_m = number(arg[9], lmp);
    if (!(length > 0) || !(platform_.stiffness_pa_m > 0)) {
        fail(*error,
             "fix {} magttice/platform: a normal of length {} and the stiffness {} "
             "found, both must be positive",
             id, length, arg[9]);
    }
    platform_.normal /= length;
}

void FixMagtticePlatform::parse_keywords(int narg, char** arg) {
    for (int i = first_keyword; i < narg; i += 2) {
        const std::string keyword = arg[i];
        double* value = keyword == "friction"  ? &platform_.friction
                        : keyword == "damping" ? &platform_.damping_pa_s_m
                                               : nullptr;
        if (value != nullptr && i + 1 < narg) {
            *value = number(arg[i + 1], lmp);
        }
        if (value == nullptr || i + 1 >= narg || !(*value >= 0)) {
            fail(*error,
                 "fix {} magttice/platform: \"{}\" found; \"friction\" and \"damping\" "
                 "with one value, not negative, are allowed",
                 id, keyword);
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
}

void FixMagtticePlatform::post_force(int) {
    (this->*add_forces_)(update->dt);
}

int FixMagtticePlatform::setmask() {
    using namespace LAMMPS_NS::FixConst;
    return POST_FORCE | MIN_POST_FORCE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

void FixMagtticePlatform::init() {
    node_ = surface_nodes(*modify);
    if (node_.empty()) {
        fail(*error,
             "fix {} magttice/platform found no fix magttice, it needs the surface of at "
             "least one",
             id);
    }
}

void FixMagtticePlatform::rebuild() {
    surface_.clear();
    for (int i = 0; i < atom->nlocal; ++i) {
        const std::size_t tag = atom->tag[i];
        if ((atom->mask[i] & groupbit) == 0 || tag >= node_.size()) continue;
        if (node_[tag].area_m2 > 0) surface_.push_back({i, node_[tag].area_m2});
    }
}

// Velocities are those of the half step. They enter the damping and, for a node that has
// just touched, the stick point.
template <class ContactOf>
void FixMagtticePlatform::add_forces(ContactOf&& contact_of) {
    normal_n_ = 0;
    energy_j_ = 0;
    smallest_gap_m_ = INFINITY;
    force_n_ = {};
    const double* const* const x = atom->x;
    const double* const* const v = atom->v;
    double* const* const f = atom->f;
    for (const PressedNode& node : surface_) {
        const int i = node.atom;
        const PlatformContact contact = contact_of(node, x[i], v[i]);
        smallest_gap_m_ = std::min(smallest_gap_m_, contact.gap_m);
        if (!(contact.gap_m < 0)) continue;
        normal_n_ += contact.normal_n;
        energy_j_ += contact.energy_j;
        slid_j_ += contact.slid_j;
        add_to(f[i], contact.force_n);
        force_n_ += contact.force_n;
    }
}

void FixMagtticePlatform::add_frictionless_forces(double) {
    add_forces([&](const PressedNode& node, const double* x, const double* v) {
        return frictionless_contact(platform_, node.area_m2, x, v);
    });
}

void FixMagtticePlatform::add_forces_with_friction(double dt_s) {
    add_forces([&](const PressedNode& node, const double* x, const double* v) {
        return platform_contact(platform_, node.area_m2, x, v, dt_s, stick(node.atom, 0));
    });
}

double FixMagtticePlatform::compute_scalar() {
    double all = 0;
    MPI_Allreduce(&energy_j_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

double FixMagtticePlatform::compute_vector(int i) {
    double all[8];
    if (i == 3) {
        MPI_Allreduce(&smallest_gap_m_, all, 1, MPI_DOUBLE, MPI_MIN, world);
        return all[0];
    }
    // The entries stand at their i. The force along the plane (1) is derived from the
    // others, as the norm of a sum over ranks is not a sum.
    const double mine[8] = {normal_n_,   0,           energy_j_,   0,
                            force_n_[0], force_n_[1], force_n_[2], slid_j_};
    MPI_Allreduce(mine, all, 8, MPI_DOUBLE, MPI_SUM, world);
    if (i != 1) return all[i];
    const Vec3 along = vector_at(all + 4) - all[0] * platform_.normal;
    return std::sqrt(dot(along, along));
}

void* FixMagtticePlatform::extract(const char* name, int& dimension) {
    dimension = 0;
    return std::strcmp(name, "lost_share") == 0 ? &slid_j_ : nullptr;
}

void add_platform(Lines& lines, const LammpsInput& input) {
    const Platform platform = with_stiffness(*input.platform, input.bodies);
    std::string line =
        fmt::format("fix platform all magttice/platform {:.17g} {:.17g} {:.17g}",
                    fmt::join(platform.point_m, " "), fmt::join(platform.normal, " "),
                    platform.stiffness_pa_m);
    if (platform.friction > 0)
        line += fmt::format(" friction {:.17g}", platform.friction);
    if (platform.damping_pa_s_m > 0)
        line += fmt::format(" damping {:.17g}", platform.damping_pa_s_m);
    lines.push_back(line);
}

}  // namespace

extern const Effect platform_effect{
    .name = "platform",
    .asked = [](const LammpsInput& input) { return input.platform.has_value(); },
    .commands = add_platform,
    .surface_spring_pa_m =
        [](const LammpsInput& input, const Body&) {
            return with_stiffness(*input.platform, input.bodies).stiffness_pa_m;
        },
    .fix = {"magttice/platform", make_fix<FixMagtticePlatform>}};

}  // namespace magfsi::structure
