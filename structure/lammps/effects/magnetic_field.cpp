// SPDX-License-Identifier: GPL-2.0-or-later
// The uniform field over time. fix ID group magttice/field PLANE COURSE ... provides it
// as a global vector [T]; fix_modify ID law PLANE COURSE ... replaces the course; the
// keyword `field Bx By Bz` of fix magttice adds the forces q_a B on a body's nodes
// (structure/magnetics/magnetic_forces.h).
#include "atom.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>

#include <exception>

#include "structure/lammps/effect.h"
#include "structure/lammps/field_components.h"
#include "structure/lammps/field_program.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {
namespace {

// Source of the field vector. A course written as a formula of LAMMPS would be slower:
// LAMMPS parses a variable's formula at each evaluation, and for a table that costs more
// than the forces of a small body.
class FixMagtticeFieldSource : public LAMMPS_NS::Fix {
  public:
    FixMagtticeFieldSource(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg) {
        read({arg + 3, arg + narg});
        vector_flag = 1;
        size_vector = 3;
        extvector = 0;
        global_freq = 1;
    }
    int setmask() override { return 0; }
    int modify_param(int count, char** words) override {
        if (std::string(words[0]) != "law") return 0;
        read({words + 1, words + count});
        return count;
    }
    // The time is derived from the step number, not summed over steps, and so is the same
    // after a restart.
    double compute_vector(int i) override {
        const double time_s = 1.0 * update->ntimestep * update->dt;
        try {
            return field_at(program_, time_s)[i];
        } catch (const std::exception& cause) {
            fail(*error, "magnetic field: {}", cause.what());
        }
    }

  private:
    void read(const std::vector<std::string>& words) {
        try {
            program_ = parse_field_arguments(words);
        } catch (const std::exception& cause) {
            fail(*error, "fix {} magttice/field: {}", id, cause.what());
        }
    }

    FieldProgram program_;
};

// Forces of a uniform field on one body, eq. (6): q_a B on node a.
class UniformField : public BodyForce {
  public:
    // components: Bx By Bz, each a number [T] or v_NAME, a variable of LAMMPS.
    UniformField(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** components)
        : BodyForce(lammps),
          field_(lammps, body.who, components),
          range_(body.range),
          charge_a_m_(nodal_charges(body.nodes_m, body.lattice.elements,
                                    body.magnetization_a_m)) {}

    void init() override { field_.init(); }
    void rebuild(const OwnedElements&) override {
        charged_.clear();
        for (int i = 0; i < atom->nlocal; ++i) {
            const int node = range_.node(atom->tag[i]);
            if (node < 0 || charge_a_m_[node] == 0) continue;
            charged_.push_back({i, charge_a_m_[node]});
        }
    }
    void add() override {
        field_.evaluate();
        add_forces();
    }
    // atom->v is the velocity of the half step, (x(n+1) - x(n)) / dt, so that the mean of
    // the field at both ends gives the work of the step: exact for a field linear in
    // time.
    Turnover advance() override {
        const Vec3 before = field_.field_t();
        field_.evaluate();
        const Vec3& now = field_.field_t();
        const Vec3 flow = charge_flow();
        Turnover step;
        for (int d = 0; d < 3; ++d) {
            step.work_j += 0.5 * update->dt * (before[d] + now[d]) * flow[d];
        }
        add_forces();
        return step;
    }
    double energy_j() const override {
        double energy_j = 0;
        const double* const* const x = atom->x;
        for (const ChargedNode& node : charged_) {
            for (int d = 0; d < 3; ++d)
                energy_j -= node.charge_a_m * field_.field_t()[d] * x[node.atom][d];
        }
        return energy_j;
    }

  private:
    struct ChargedNode {
        int atom = 0;  // local index
        double charge_a_m = 0;
    };

    void add_forces() {
        double* const* const f = atom->f;
        const Vec3 field_t = field_.field_t();
        for (const ChargedNode& node : charged_) {
            for (int d = 0; d < 3; ++d) f[node.atom][d] += node.charge_a_m * field_t[d];
        }
    }
    // Sum of q v over this rank's nodes [A m2/s].
    Vec3 charge_flow() const {
        Vec3 sum{};
        const double* const* const v = atom->v;
        for (const ChargedNode& node : charged_)
            sum += node.charge_a_m * vector_at(v[node.atom]);
        return sum;
    }

    FieldComponents field_;
    NodeRange range_;
    std::vector<double> charge_a_m_;    // one per node of the body
    std::vector<ChargedNode> charged_;  // owned by this rank, charge not zero
};

// The components go through variables Bx, By and Bz, which a script may redefine.
void add_field(Lines& lines, const LammpsInput& input) {
    lines.push_back("fix field all magttice/field " + field_arguments(*input.field));
    for (int d = 0; d < 3; ++d) {
        lines.push_back(fmt::format("variable B{} equal f_field[{}]", "xyz"[d], d + 1));
    }
}

}  // namespace

extern const Effect magnetic_field_effect{
    .name = "magnetic_field",
    .asked = [](const LammpsInput& input) { return input.field.has_value(); },
    .before_bodies = add_field,
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        if (body.magnetization_a_m.empty() || is_turned(body)) return "";
        return " field v_Bx v_By v_Bz";
    },
    .force = {"field", 3, make_force<UniformField>},
    .fix = {"magttice/field", make_fix<FixMagtticeFieldSource>}};

}  // namespace magfsi::structure
