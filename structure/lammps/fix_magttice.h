// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS style  fix ID group magttice: elastic forces of one body's lattice, and the
// forces that effects add to them (effect.h). See docs/fix_magttice.md.
#pragma once

#include "structure/lammps/effect.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

// The fix of one body. Each rank computes the elements whose first node it owns. Errors
// end the run by fail() (effect.h). The compute_ functions and write_restart are
// collective.
class FixMagttice : public LAMMPS_NS::Fix {
  public:
    // arg: ID group magttice FILE first_atom_id G K [keyword values] ...
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

    double compute_scalar() override;  // elastic plus magnetic energy [J]
    // i = 0 to 4: elastic energy, magnetic energy, work of the field, smallest J, energy
    // lost to viscosity; [J] except for J
    double compute_vector(int i) override;

    // fix_modify ID work W sets the work of the field [J]
    int modify_param(int narg, char** arg) override;
    void write_restart(FILE* file) override;
    void restart(char* buffer) override;
    double memory_usage() override;
    // What forces keep with the nodes. Without any, the fix takes no part in exchanges.
    void grow_arrays(int) override {}
    void copy_arrays(int, int, int) override {}
    int pack_exchange(int i, double* buffer) override;
    int unpack_exchange(int i, double* buffer) override;
    int pack_restart(int i, double* buffer) override;
    void unpack_restart(int i, int nth) override;
    int size_restart(int i) override;
    int maxsize_restart() override { return 1 + kept_; }
    // "work_share", "lost_share": pointer to this rank's share of the field's work, or of
    // the energy lost to viscosity [J].
    void* extract(const char* name, int& dimension) override;

    const NodeRange& range() const { return range_; }
    const Lattice& lattice() const { return lattice_; }
    const std::vector<Vec3>& nodes_m() const { return nodes_m_; }  // undeformed
    // Adds this rank's elastic forces [N] at the present positions to f, three values per
    // local or ghost atom.
    void add_elastic_forces(double* f) const;

  private:
    // A keyword for the forces of an effect, with its values as they stand in the
    // command.
    struct AskedForce {
        BodyForceStyle style;
        char** values = nullptr;
    };

    // Sets LAMMPS's flags for the scalar, the vector and the restart.
    void declare_output();
    // Reads one keyword and its values from the `left` remaining words; returns their
    // number.
    int parse_keyword(int left, char** arg, std::vector<AskedForce>& asked);
    // Reads the lattice file, builds the lattice and makes the forces.
    void read_body(const std::string& file, const std::vector<AskedForce>& asked);
    // Renews the element tables after a change of the atoms' indices or ranks.
    void rebuild();
    OwnedElements owned_elements() const;
    void add_elastic();
    // Place of an element, for messages.
    std::string place(int element) const;
    // Ends the run with the element, its J, its place and a remedy.
    void refuse_inverted(const KernelResult& result);
    // Ends the run with an element that is stretched beyond its material's limit.
    void refuse_tight(const KernelResult& result);
    std::string remedy() const;
    void compute_energies();

    std::string who_;  // "fix ID magttice", for messages
    NodeRange range_;
    Lattice lattice_;
    std::vector<Vec3> nodes_m_;
    std::vector<std::vector<int>> by_first_;  // elements by their first node
    ElementKernel kernel_;
    std::vector<std::unique_ptr<BodyForce>> forces_;
    int kept_ = 0;  // values that the forces keep with each node

    ElementVariant variant_ = ElementVariant::assumed_strain;
    std::vector<Material> materials_;  // numbered as in the lattice file

    double work_j_ = 0;  // work of the field, this rank's share
    double lost_j_ = 0;  // energy lost to viscosity, this rank's share
    double smallest_j_ = 1;
    bool energies_known_ = false;
    std::array<double, 2> energy_j_{};  // elastic, magnetic
    std::vector<double> scratch_;       // forces that the energy pass computes and drops
};

// The fixes magttice of a run, in the order of the script.
std::vector<const FixMagttice*> bodies_of(const LAMMPS_NS::Modify& modify);

}  // namespace magfsi::structure
