// SPDX-License-Identifier: GPL-2.0-or-later
// fix ID group magttice: the lattice forces of one body and those that effects add to
// them (effect.h). See docs/fix_magttice.md.
#pragma once

#include "structure/lammps/effect.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

class FixMagttice : public LAMMPS_NS::Fix {
  public:
    FixMagttice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~FixMagttice() override;

    int setmask() override;
    void init() override;
    void setup_post_neighbor() override { rebuild(); }
    void post_neighbor() override { rebuild(); }
    void min_post_neighbor() override { rebuild(); }
    void setup_pre_reverse(int eflag, int vflag) override;
    void pre_reverse(int eflag, int vflag) override;
    void min_pre_reverse(int eflag, int vflag) override;

    double compute_scalar() override;       // elastic + magnetic energy
    double compute_vector(int i) override;  // elastic, magnetic, work, smallest J, lost

    int modify_param(int narg, char** arg) override;  // fix_modify ID work W
    void write_restart(FILE* file) override;
    void restart(char* buffer) override;
    double memory_usage() override;
    // "work_share", "lost_share": this rank's share of the work of the field and of what
    // viscosity took [J].
    void* extract(const char* name, int& dimension) override;

    const NodeRange& range() const { return range_; }
    const Lattice& lattice() const { return lattice_; }
    const std::vector<Vec3>& nodes_m() const { return nodes_m_; }  // at rest
    // Adds this rank's elastic forces at the present positions to f, three values per
    // local or ghost atom.
    void add_elastic_forces(double* f) const;

  private:
    // A keyword that stands for the forces of an effect, and its values.
    struct AskedForce {
        BodyForceStyle style;
        char** values = nullptr;
    };

    void declare_output();
    int parse_keyword(int left, char** arg, std::vector<AskedForce>& asked);
    Material parse_material(char** arg, int values);
    void read_body(const std::string& file, const std::vector<AskedForce>& asked);
    void rebuild();
    OwnedElements owned_elements() const;
    void add_elastic();
    std::string place(int element) const;
    void refuse_inverted(const KernelResult& result);
    void compute_energies();

    std::string who_;  // "fix ID magttice", for messages
    NodeRange range_;
    Lattice lattice_;
    std::vector<Vec3> nodes_m_;
    std::vector<std::vector<int>> by_first_;  // elements by their first node
    ElementKernel kernel_;
    std::vector<std::unique_ptr<BodyForce>> forces_;

    ElementVariant variant_ = ElementVariant::assumed_strain;
    std::vector<Material> materials_;  // as the lattice file numbers them

    double work_j_ = 0;  // of the field; this rank's share, as those below
    double lost_j_ = 0;  // to viscosity
    double smallest_j_ = 1;
    bool energies_known_ = false;
    std::array<double, 2> energy_j_{};  // elastic, magnetic
    std::vector<double> scratch_;
};

// The bodies of a run, in the order of the script.
std::vector<const FixMagttice*> bodies_of(const LAMMPS_NS::Modify& modify);

}  // namespace magfsi::structure
