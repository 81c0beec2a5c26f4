// SPDX-License-Identifier: GPL-2.0-or-later
// What an effect of effects.inc is: an object of type Effect, called NAME_effect, in
// effects/NAME.cpp or in a folder effects/NAME/. See docs/adding_an_effect.md.
#pragma once

#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "pointers.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "structure/lammps/script.h"
#include "structure/lattice/lattice.h"

namespace magfsi::structure {

using Lines = std::vector<std::string>;

// --- forces that need a body's elements

// Node n of a body is the atom with ID first_id + n.
struct NodeRange {
    int first_id = 1;
    int count = 0;
    // Node number of an atom ID, or -1 if the atom is not of this body.
    int node(int id) const {
        return id >= first_id && id < first_id + count ? id - first_id : -1;
    }
};

// This rank's elements: those whose first node it owns.
struct OwnedElements {
    std::vector<int> element;
    std::vector<std::array<int, 8>> atom;  // local or ghost indices
    int missing_id = 0;                    // an atom that this rank cannot see, or 0
};

// What a fix magttice knows of its body. The lattice and the positions of its nodes live
// as long as the forces, the magnetisation only while they are made.
struct MagtticeBody {
    std::string who;  // "fix ID magttice", for messages
    NodeRange range;
    const Lattice& lattice;
    const std::vector<Vec3>& nodes_m;            // at rest
    const std::vector<Vec3>& magnetization_a_m;  // one per element
};

// Forces on the nodes of one body beside the elastic ones, which fix magttice adds at the
// same place of a step.
class BodyForce : protected LAMMPS_NS::Pointers {
  public:
    // Of one step, this rank's share.
    struct Turnover {
        double work_j = 0;  // done on the body by the field
        double lost_j = 0;  // to viscosity
    };

    explicit BodyForce(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}

    virtual void init() {}  // of a run
    // The body's elements have changed their rank, or its atoms their indices.
    virtual void rebuild(const OwnedElements& owned) = 0;
    // Adds the forces to atom->f at the start of a run, where v is that of a whole step.
    virtual void add() = 0;
    // Adds them within a step, where v is (x(n+1) - x(n)) / dt.
    virtual Turnover advance() = 0;
    virtual void minimize() { add(); }
    // Beside the elastic energy; this rank's share, of the last forces.
    virtual double energy_j() const { return 0; }
};

// A keyword of fix magttice that stands for such forces. make may throw
// std::invalid_argument.
struct BodyForceStyle {
    const char* keyword = nullptr;
    int values = 0;  // words after the keyword
    std::unique_ptr<BodyForce> (*make)(LAMMPS_NS::LAMMPS*, const MagtticeBody&,
                                       char** values) = nullptr;
};

template <class Force>
std::unique_ptr<BodyForce> make_force(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body,
                                      char** values) {
    return std::make_unique<Force>(lammps, body, values);
}

// --- the effect

// " periodic LX LY LZ" where there is a period along an axis.
inline std::string periodic_words(const LammpsInput& input) {
    const Vec3& length = input.period_m;
    if (length == Vec3{}) return "";
    return fmt::format(" periodic {:.17g} {:.17g} {:.17g}", length[0], length[1],
                       length[2]);
}

// A fix of LAMMPS.
struct FixStyle {
    const char* name = nullptr;
    LAMMPS_NS::Fix* (*make)(LAMMPS_NS::LAMMPS*, int narg, char** arg) = nullptr;
};

template <class Fix>
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
    return new Fix(lammps, narg, arg);
}

// All but the first two and the last two members are used only where the effect is asked
// for. Null: nothing.
struct Effect {
    using Commands = void (*)(Lines& lines, const LammpsInput&);

    const char* name;
    bool (*asked)(const LammpsInput&);
    // Throws std::invalid_argument on what it cannot do.
    void (*check)(const LammpsInput&) = nullptr;

    // Its commands, in the order of the script:
    Commands before_bodies = nullptr;
    // Words of the body's fix magttice: `force.keyword` and its values.
    std::string (*body_words)(const LammpsInput&, const Body&) = nullptr;
    Commands commands = nullptr;  // after the bodies, before the time integration
    Commands after_integration = nullptr;

    // The group that is integrated in place of all atoms.
    const char* integrated_group = nullptr;
    // Pressure over displacement [Pa/m] of what it presses on a body's surface with, for
    // the stable step.
    double (*surface_spring_pa_m)(const LammpsInput&, const Body&) = nullptr;

    BodyForceStyle force{};
    FixStyle fix{};
    // Makes its computes and pair styles known.
    void (*register_styles)(LAMMPS_NS::LAMMPS&) = nullptr;
};

// Those of this build.
std::span<const Effect* const> effects();
// Of these, in their order, those that are asked for.
std::vector<const Effect*> asked_effects(const LammpsInput& input);
// "all", or that of the effect that names another.
std::string integrated_group(const LammpsInput& input);

// --- for the LAMMPS styles of effects

// Ends a run that cannot go on: hands the cause to the handler of register_styles.h, or
// to LAMMPS's error->one. One rank is enough.
[[noreturn]] void fail(LAMMPS_NS::Error& error, const std::string& cause);
template <class First, class... Args>
[[noreturn]] void fail(LAMMPS_NS::Error& error, fmt::format_string<First, Args...> cause,
                       First&& first, Args&&... args) {
    fail(error,
         fmt::format(cause, std::forward<First>(first), std::forward<Args>(args)...));
}

// A word of a command as a number; ends the run where it is none.
double number(const char* word, LAMMPS_NS::LAMMPS* lammps);

// A node of the surface of a body, for styles that push on surfaces.
struct SurfaceNode {
    int body = -1;
    double area_m2 = 0;  // surface_areas; 0: not on a surface
    Vec3 at_rest_m{};
};
// By atom ID, of all bodies of a run; empty without a fix magttice.
std::vector<SurfaceNode> surface_nodes(const LAMMPS_NS::Modify& modify);

}  // namespace magfsi::structure
