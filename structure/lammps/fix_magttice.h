// fix ID group magttice: the lattice forces of one body and, with `field`, its magnetic
// forces. See docs/fix_magttice.md.
#pragma once

#include "fix.h"

#include <array>
#include <string>
#include <vector>

#include "structure/lammps/owned_elements.h"
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
    double compute_vector(int i) override;  // elastic, magnetic, work, smallest J

    int modify_param(int narg, char** arg) override;  // fix_modify ID work W
    void write_restart(FILE* file) override;
    void restart(char* buffer) override;
    double memory_usage() override;

    const NodeRange& range() const { return range_; }
    const Lattice& lattice() const { return lattice_; }
    const std::vector<Vec3>& nodes_m() const { return nodes_m_; }  // at rest
    // Adds this rank's elastic forces at the present positions to f, three values a local
    // or ghost atom.
    void add_elastic_forces(double* f) const;

  private:
    struct FieldComponent {
        std::string name;  // of the LAMMPS variable; empty: constant
        int variable = -1;
        double value_t = 0;
    };

    void declare_output();
    void read_body(const std::string& file, const Material& material,
                   ElementVariant variant);
    void parse_field(char** arg);
    void init_field();
    void rebuild();
    void evaluate_field();
    void add_forces();
    void refuse_inverted(const KernelResult& result);
    std::array<double, 3> charge_flow() const;  // sum of q v, this rank [A m2/s]
    void advance_field();
    void compute_energies();

    NodeRange range_;
    Lattice lattice_;
    std::vector<Vec3> nodes_m_;
    std::vector<double> charge_a_m_;          // by node of the body
    std::vector<std::vector<int>> by_first_;  // elements by their first node
    ElementKernel kernel_;
    std::vector<ChargedNode> charged_;  // owned by this rank

    bool has_field_ = false;
    std::array<FieldComponent, 3> field_;

    double work_j_ = 0;  // this rank's share
    double smallest_j_ = 1;
    bool energies_known_ = false;
    std::array<double, 2> energy_j_{};  // elastic, magnetic; this rank's share
    std::vector<double> scratch_;
};

}  // namespace magfsi::structure
