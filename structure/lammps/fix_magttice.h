// fix ID group magttice: the lattice forces of one body and, with `field` and `gradient`,
// its magnetic forces, with `viscosity` Kelvin-Voigt damping. See docs/fix_magttice.md.
#pragma once

#include "fix.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "structure/lammps/lattice_file.h"
#include "structure/lammps/owned_elements.h"
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/viscosity.h"
#include "structure/magnetics/field_gradient.h"

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
    void read_body(const std::string& file);
    int parse_keyword(int left, char** arg);
    void parse_material(char** arg);
    void parse_field(char** arg);
    void parse_gradient(char** arg);
    void read_gradient(const LatticeFile& read);
    void init_field();
    void rebuild();
    void evaluate_field();
    void add_forces();
    void add_gradient();
    double add_viscous();  // returns the power lost [W]
    std::string place(int element) const;
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

    ElementVariant variant_ = ElementVariant::full;
    std::vector<Material> materials_;  // as the lattice file numbers them
    std::optional<ViscousKernel> viscous_;
    double lost_j_ = 0;  // to viscosity; this rank's share

    std::optional<FieldGradient> gradient_;
    std::vector<GradientElement> gradient_elements_;        // of the body
    std::vector<GradientElement> owned_gradient_elements_;  // and their nodes
    std::vector<std::array<int, 8>> owned_gradient_nodes_;
    double gradient_energy_j_ = 0;  // this rank's share, of the last step

    bool has_field_ = false;
    std::array<FieldComponent, 3> field_;

    double work_j_ = 0;  // this rank's share
    double smallest_j_ = 1;
    bool energies_known_ = false;
    std::array<double, 2> energy_j_{};  // elastic, magnetic; this rank's share
    std::vector<double> scratch_;
};

}  // namespace magfsi::structure
