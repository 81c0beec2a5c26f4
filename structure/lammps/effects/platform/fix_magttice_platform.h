// fix ID group magttice/platform PX PY PZ NX NY NZ STIFFNESS [friction MU] [damping C]:
// a plane that pushes the surface of the bodies back. See docs/fix_magttice.md.
#pragma once

#include "fix.h"

#include <array>
#include <vector>

#include "structure/lammps/effects/platform/platform_law.h"

namespace magfsi::structure {

class FixMagtticePlatform : public LAMMPS_NS::Fix {
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

    double compute_scalar() override;       // energy of the springs
    double compute_vector(int i) override;  // see the documentation
    void* extract(const char* name, int& dimension) override;

    // The stick points go with their atoms, over ranks and restarts.
    void grow_arrays(int count) override;
    void copy_arrays(int from, int to, int deleted) override;
    void set_arrays(int atom_index) override;
    int pack_exchange(int i, double* buffer) override;
    int unpack_exchange(int i, double* buffer) override;
    int pack_restart(int i, double* buffer) override;
    void unpack_restart(int i, int nth) override;
    int size_restart(int i) override;
    int maxsize_restart() override;
    double memory_usage() override;

  private:
    struct SurfaceNode {
        int atom = 0;
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
    // The loop of the scene's platform: no node asks whether there is friction.
    void (FixMagtticePlatform::*add_forces_)(double) = nullptr;
    std::vector<double> area_m2_;  // by atom ID
    std::vector<SurfaceNode> surface_;
    std::vector<StickPoint> stick_;  // by local atom

    // This rank's share, of the last evaluation.
    double normal_n_ = 0, energy_j_ = 0, smallest_gap_m_ = 0;
    Vec3 force_n_{};
    double slid_j_ = 0;  // since the start
};

}  // namespace magfsi::structure
