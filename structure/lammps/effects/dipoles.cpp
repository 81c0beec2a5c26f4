// SPDX-License-Identifier: GPL-2.0-or-later
// Interaction of magnetised bodies as dipoles (structure/magnetics/dipoles.h). fix ID
// group magttice/dipoles [within] [periodic LX LY LZ] gathers the dipoles of all ranks
// before the forces of a step; the keyword `dipoles ID` of fix magttice adds the forces
// to a body.
#include "atom.h"
#include "comm.h"
#include "error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "structure/lammps/effect.h"
#include "structure/magnetics/dipoles.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// The dipoles of one body.
struct Member {
    std::vector<DipoleElement> all;  // all dipoles of the body, the same on every rank
    std::vector<std::size_t> owned;  // indices in `all` of this rank's dipoles
    std::vector<std::array<int, 8>> nodes;  // local or ghost indices, for each of `owned`
    // Present dipoles and the field of the others at them, for each of `owned`
    std::vector<Dipole> dipole;
    std::vector<FieldSample> sample;
    bool changed = true;  // true if `owned` has changed since the last numbering
};

// Every rank evaluates the field of all dipoles at its own ones. Dipoles are numbered
// body by body, in each body by elements. Evaluation is collective.
class FixMagtticeDipoles : public LAMMPS_NS::Fix {
  public:
    FixMagtticeDipoles(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg),
          within_(narg > 3 && std::strcmp(arg[3], "within") == 0) {
        const int words = within_ ? 4 : 3;
        const bool periodic =
            narg == words + 4 && std::strcmp(arg[words], "periodic") == 0;
        for (int d = 0; periodic && d < 3; ++d)
            period_m_[d] = number(arg[words + 1 + d], lmp);
        if ((narg != words && !periodic) || !(std::ranges::min(period_m_) >= 0))
            fail(*error,
                 "fix {} magttice/dipoles takes nothing but the words \"within\" and "
                 "\"periodic\" with three lengths",
                 id);
        scalar_flag = 1;
        extscalar = 1;
        global_freq = 1;
    }
    int setmask() override {
        using namespace LAMMPS_NS::FixConst;
        return PRE_REVERSE | MIN_PRE_REVERSE;
    }
    // Bodies join in their own init(), which comes after this one.
    void init() override { members_.clear(); }
    void join(Member& member) { members_.push_back(&member); }

    void setup_pre_reverse(int, int) override { evaluate(); }
    void pre_reverse(int, int) override { evaluate(); }
    void min_pre_reverse(int, int) override { evaluate(); }

    // Magnetic energy of all pairs and, with `within`, of own fields [J]; each pair
    // counts half at each of its ends. Collective.
    double compute_scalar() override {
        double mine = 0, sum = 0;
        for (const Member* member : members_) {
            for (std::size_t i = 0; i < member->dipole.size(); ++i)
                mine -=
                    0.5 * member->dipole[i].moment_a_m2.dot(member->sample[i].field_t);
        }
        MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
        return sum;
    }

  private:
    // Exchanges the numbers of the ranks' dipoles; collective. Needed after atoms have
    // changed ranks.
    void renumber();
    // Exchanges the present dipoles; collective.
    void gather();
    // Adds to the sample the field of the dipoles from, ..., to - 1 at dipole `at`.
    void add_others(std::size_t at, std::size_t from, std::size_t to,
                    FieldSample& sample) {
        if (period_m_ == Vec3{})
            dipoles_.add_field(at, from, to, sample);
        else
            dipoles_.add_field(at, from, to, period_m_, sample);
    }
    void evaluate();

    bool within_;
    // Period along each axis, across which the nearest image acts; 0 without one
    Vec3 period_m_{};
    std::vector<Member*> members_;
    Dipoles dipoles_;
    std::vector<std::size_t> first_;  // number of each body's first dipole, then the end
    std::vector<int> counts_, starts_;  // per rank: values in all_, and where they start
    // Number of each dipole in the order of all_, rank by rank
    std::vector<int> numbers_;
    // Six values per dipole: centre [m] and moment [A m2]
    std::vector<double> mine_, all_;
};

// Who owns which dipole; after atoms have changed their ranks.
void FixMagtticeDipoles::renumber() {
    first_.assign(1, 0);
    std::vector<int> own;
    for (Member* member : members_) {
        for (const std::size_t i : member->owned) own.push_back(first_.back() + i);
        first_.push_back(first_.back() + member->all.size());
        member->changed = false;
    }
    dipoles_.resize(first_.back());
    for (std::size_t b = 0; b < members_.size(); ++b) {
        for (std::size_t i = 0; i < members_[b]->all.size(); ++i)
            dipoles_.set_radius(first_[b] + i, members_[b]->all[i].radius_m);
    }
    int count = own.size();
    counts_.resize(comm->nprocs);
    starts_.resize(counts_.size());
    MPI_Allgather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, world);
    std::exclusive_scan(counts_.begin(), counts_.end(), starts_.begin(), 0);
    numbers_.resize(first_.back());
    MPI_Allgatherv(own.data(), count, MPI_INT, numbers_.data(), counts_.data(),
                   starts_.data(), MPI_INT, world);
    for (std::size_t r = 0; r < counts_.size(); ++r) {
        counts_[r] *= 6;
        starts_[r] *= 6;
    }
}

// Dipoles are stored by number, so that sums have the same order on any number of ranks.
void FixMagtticeDipoles::gather() {
    mine_.clear();
    for (Member* member : members_) {
        for (std::size_t i = 0; i < member->owned.size(); ++i) {
            const Dipole& one = member->dipole[i] =
                dipole_of(member->all[member->owned[i]], member->nodes[i], atom->x[0]);
            mine_.insert(mine_.end(), one.centre_m.begin(), one.centre_m.end());
            mine_.insert(mine_.end(), one.moment_a_m2.begin(), one.moment_a_m2.end());
        }
    }
    all_.resize(6 * dipoles_.size());
    MPI_Allgatherv(mine_.data(), mine_.size(), MPI_DOUBLE, all_.data(), counts_.data(),
                   starts_.data(), MPI_DOUBLE, world);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const double* row = all_.data() + 6 * i;
        dipoles_.set(static_cast<std::size_t>(numbers_[i]),
                     {Eigen::Vector3d(row), Eigen::Vector3d(row + 3)});
    }
}

void FixMagtticeDipoles::evaluate() {
    if (members_.empty())
        fail(*error,
             "fix {0} magttice/dipoles found no fix magttice with the words \"dipoles "
             "{0}\"; it needs at least one",
             id);
    const auto changed = [](const Member* member) { return member->changed; };
    if (std::ranges::any_of(members_, changed)) renumber();
    gather();
    for (std::size_t b = 0; b < members_.size(); ++b) {
        Member& member = *members_[b];
        for (std::size_t i = 0; i < member.owned.size(); ++i) {
            const std::size_t at = first_[b] + member.owned[i];
            FieldSample& sample = member.sample[i] = {};
            add_others(at, 0, first_[b], sample);
            if (within_) {
                dipoles_.add_field(at, first_[b], first_[b + 1], sample);
                sample.field_t +=
                    own_field_t(member.all[member.owned[i]], member.dipole[i]);
            }
            add_others(at, first_[b + 1], dipoles_.size(), sample);
        }
    }
}

// Forces of the dipoles' field on one body: the body's part of fix magttice/dipoles.
class DipoleForce : public BodyForce {
  public:
    DipoleForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** words)
        : BodyForce(lammps), who_(body.who), fix_id_(words[0]) {
        member_.all =
            dipole_elements(body.nodes_m, body.lattice.elements, body.magnetization_a_m);
        of_element_.assign(body.lattice.elements.size(), none);
        for (std::size_t i = 0; i < member_.all.size(); ++i)
            of_element_[member_.all[i].element] = i;
    }

    // The fix comes before the bodies in the script, so that its fields are evaluated
    // before the forces of each step.
    void init() override {
        const int at = modify->find_fix(fix_id_);
        if (at < 0 || std::strcmp(modify->fix[at]->style, "magttice/dipoles") != 0)
            fail(*error,
                 "{}: there is no fix {} of the style magttice/dipoles; it must come "
                 "before",
                 who_, fix_id_);
        static_cast<FixMagtticeDipoles*>(modify->fix[at])->join(member_);
    }
    void rebuild(const OwnedElements& owned) override {
        member_.owned.clear();
        member_.nodes.clear();
        for (std::size_t i = 0; i < owned.element.size(); ++i) {
            const std::size_t dipole = of_element_[owned.element[i]];
            if (dipole == none) continue;
            member_.owned.push_back(dipole);
            member_.nodes.push_back(owned.atom[i]);
        }
        member_.dipole.resize(member_.owned.size());
        member_.sample.resize(member_.owned.size());
        member_.changed = true;
    }
    void add() override {
        energy_j_ = 0;
        for (std::size_t i = 0; i < member_.owned.size(); ++i)
            energy_j_ +=
                add_dipole_forces(member_.all[member_.owned[i]], member_.nodes[i],
                                  member_.dipole[i], member_.sample[i], atom->f[0]);
    }
    // No energy comes from outside: energy_j() covers the work.
    Turnover advance() override {
        add();
        return {};
    }
    double energy_j() const override { return energy_j_; }

  private:
    static constexpr std::size_t none = -1;
    std::string who_, fix_id_;
    Member member_;
    std::vector<std::size_t> of_element_;  // index in member_.all, or `none`
    double energy_j_ = 0;
};

// Largest ratio of edges for dipoles within a body: a dipole in the middle of a long
// element is too far from the field of that element at its neighbours.
constexpr double max_ratio_within = 2;

void check_dipoles(const LammpsInput& input) {
    if (!input.dipoles->within_bodies) return;
    for (const Body& body : input.bodies) {
        if (body.magnetization_a_m.empty()) continue;
        for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            const auto edge =
                element_edges(gather(body.mesh.nodes, body.mesh.elements[e])).length_m;
            const auto [least, most] = std::ranges::minmax(edge);
            if (most <= max_ratio_within * least * (1 + 1e-9)) continue;
            refuse(
                "body {} has elements {:.3g} times longer than thin (element {}), and "
                "dipoles.within_bodies takes at most {}: take more elements along the "
                "long edges, or leave within_bodies out",
                body.name, most / least, e, max_ratio_within);
        }
    }
}

}  // namespace

extern const Effect dipoles_effect{
    .name = "dipoles",
    .asked = [](const LammpsInput& input) { return input.dipoles.has_value(); },
    .check = check_dipoles,
    .before_bodies =
        [](Lines& lines, const LammpsInput& input) {
            lines.push_back(fmt::format("fix dipoles all magttice/dipoles{}{}",
                                        input.dipoles->within_bodies ? " within" : "",
                                        periodic_words(input)));
        },
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        return body.magnetization_a_m.empty() ? "" : " dipoles dipoles";
    },
    .force = {"dipoles", 1, make_force<DipoleForce>},
    .fix = {"magttice/dipoles", make_fix<FixMagtticeDipoles>}};

}  // namespace magfsi::structure
