// SPDX-License-Identifier: GPL-2.0-or-later
// Contact forces on the nodes by themselves, for probes: two fixes magttice/contact_load
// that look at the sum of forces at three places of a step. `begin` stands before the
// bodies and notes the forces of the pair style, then those before platform and walls;
// `end GX GY GZ` stands after these and takes weight and `begin` away. The latter gives
// the forces of all contact at the last evaluation, as extract("contact_force"): three
// values for each of this rank's atoms.
#include "atom.h"
#include "error.h"
#include "modify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>

#include "structure/lammps/effect.h"

namespace magfsi::structure {
namespace {

constexpr const char* begin_id = "contact_load_begin";

class FixContactLoad : public LAMMPS_NS::Fix {
  public:
    FixContactLoad(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg) {
        const std::string word = narg > 3 ? arg[3] : "";
        ends_ = word == "end" && narg == 7;
        if (!ends_ && (word != "begin" || narg != 4))
            fail(*error,
                 "fix {} magttice/contact_load takes begin, or end with the three "
                 "components of gravity",
                 id);
        for (int d = 0; ends_ && d < 3; ++d) gravity_m_s2_[d] = number(arg[4 + d], lmp);
    }
    int setmask() override {
        using namespace LAMMPS_NS::FixConst;
        return ends_ ? POST_FORCE : PRE_REVERSE | POST_FORCE;
    }
    void init() override {
        if (ends_ && modify->find_fix(begin_id) < 0)
            fail(*error, "fix {} magttice/contact_load end needs fix {}", id, begin_id);
    }
    void setup_pre_reverse(int, int) override {
        if (!ends_) note(pairs_n_);
    }
    void pre_reverse(int, int) override { note(pairs_n_); }
    void setup(int) override { post_force(0); }
    void post_force(int) override {
        note(sum_n_);
        if (!ends_) return;
        const auto& begin =
            *static_cast<FixContactLoad*>(modify->fix[modify->find_fix(begin_id)]);
        for (std::size_t q = 0; q < sum_n_.size(); ++q)
            sum_n_[q] += begin.pairs_n_[q] - begin.sum_n_[q] -
                         atom->rmass[q / 3] * gravity_m_s2_[q % 3];
    }
    void* extract(const char* name, int& dimension) override {
        dimension = 1;
        const bool mine = ends_ && std::strcmp(name, "contact_force") == 0;
        return mine ? sum_n_.data() : nullptr;
    }

  private:
    void note(std::vector<double>& forces) const {
        forces.clear();
        if (atom->nlocal == 0) return;  // there may be no array of forces yet
        forces.assign(atom->f[0],
                      atom->f[0] + 3 * static_cast<std::ptrdiff_t>(atom->nlocal));
    }

    bool ends_ = false;
    Vec3 gravity_m_s2_{};
    std::vector<double> pairs_n_, sum_n_;
};

void add_begin(Lines& lines, const LammpsInput&) {
    lines.push_back(fmt::format("fix {} all magttice/contact_load begin", begin_id));
}

void add_end(Lines& lines, const LammpsInput& input) {
    lines.push_back(fmt::format("fix contact_load all magttice/contact_load end {:.17g}",
                                fmt::join(input.gravity_m_s2.value_or(Vec3{}), " ")));
}

}  // namespace

extern const Effect contact_load_effect{
    .name = "contact_load",
    .asked = [](const LammpsInput& input) { return input.contact_load; },
    .before_bodies = add_begin,
    .commands = add_end,
    .fix = {"magttice/contact_load", make_fix<FixContactLoad>}};

}  // namespace magfsi::structure
