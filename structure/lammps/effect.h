// SPDX-License-Identifier: GPL-2.0-or-later
// Interface of the effects in effects.inc. Each is an object of type Effect, called
// NAME_effect, in effects/NAME.cpp or in a folder effects/NAME/. See
// docs/adding_an_effect.md.
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

// Lines of a LAMMPS script.
using Lines = std::vector<std::string>;

// --- forces that need a body's elements

// Atoms of a body: node n is the atom with ID first_id + n.
struct NodeRange {
    int first_id = 1;
    int count = 0;
    // Node number of an atom ID, or -1 if the atom is not of this body.
    int node(int id) const {
        return id >= first_id && id < first_id + count ? id - first_id : -1;
    }
};

// Elements of one body on this rank: those whose first node it owns.
struct OwnedElements {
    std::vector<int> element;              // numbers in Lattice::elements
    std::vector<std::array<int, 8>> atom;  // local or ghost indices of their nodes
    // ID of a node that this rank does not have, even as a ghost; else 0
    int missing_id = 0;
};

// Those of the elements that are soft, in the same order. Elastic and viscous forces are
// theirs; forces of fields act on all elements.
OwnedElements soft_ones(const OwnedElements& owned, const Lattice& lattice);

// Data of a fix magttice's body for the forces of effects. Lattice and positions live as
// long as the forces; the magnetisation must be copied, as it is freed after their
// construction.
struct MagtticeBody {
    std::string who;  // "fix ID magttice", for messages
    NodeRange range;
    const Lattice& lattice;
    const std::vector<Vec3>& nodes_m;            // in the undeformed body
    const std::vector<Vec3>& magnetization_a_m;  // one per element
};

// Forces on the nodes of one body other than the elastic ones. fix magttice adds them at
// the same place of a step, before the reverse communication, so that forces on ghost
// atoms reach their owners.
class BodyForce : protected LAMMPS_NS::Pointers {
  public:
    // Energies of one step, this rank's share.
    struct Turnover {
        double work_j = 0;  // work of the external field on the body
        double lost_j = 0;  // dissipated by viscosity
    };

    explicit BodyForce(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}

    // Called at the start of each run.
    virtual void init() {}
    // Called when elements have changed their rank or atoms their indices.
    virtual void rebuild(const OwnedElements& owned) = 0;
    // Adds the forces to atom->f at the start of a run, where atom->v is at a whole step.
    virtual void add() = 0;
    // Adds the forces within a step, where atom->v is (x(n+1) - x(n)) / dt.
    virtual Turnover advance() = 0;
    // Adds the forces during an energy minimisation.
    virtual void minimize() { add(); }
    // Energy beside the elastic one, this rank's share, at the last forces [J].
    virtual double energy_j() const { return 0; }
};

// A keyword of fix magttice and the forces that it adds. make may throw
// std::invalid_argument.
struct BodyForceStyle {
    const char* keyword = nullptr;
    int values = 0;  // number of words after the keyword
    std::unique_ptr<BodyForce> (*make)(LAMMPS_NS::LAMMPS*, const MagtticeBody&,
                                       char** values) = nullptr;
};

// The usual BodyForceStyle::make: constructs a Force from the same arguments.
template <class Force>
std::unique_ptr<BodyForce> make_force(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body,
                                      char** values) {
    return std::make_unique<Force>(lammps, body, values);
}

// --- the effect

// The words " periodic LX LY LZ" [m] of fixes that need the periods; empty without any.
inline std::string periodic_words(const LammpsInput& input) {
    const Vec3& length = input.period_m;
    if (length == Vec3{}) return "";
    return fmt::format(" periodic {:.17g} {:.17g} {:.17g}", length[0], length[1],
                       length[2]);
}

// A fix style of LAMMPS by its name.
struct FixStyle {
    const char* name = nullptr;
    LAMMPS_NS::Fix* (*make)(LAMMPS_NS::LAMMPS*, int narg, char** arg) = nullptr;
};

// The usual FixStyle::make. LAMMPS owns the fix.
template <class Fix>
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
    return new Fix(lammps, narg, arg);
}

// An effect: its check, its commands in the script, and its LAMMPS styles. The styles
// (force, fix, register_styles) belong to the program and are there in every run; the
// members from check to surface_spring_pa_m are used only if asked(input) is true. Null
// members do nothing.
struct Effect {
    using Commands = void (*)(Lines& lines, const LammpsInput&);

    // Name in effects.inc, for messages
    const char* name;
    // True if this input has the effect.
    bool (*asked)(const LammpsInput&);
    // Throws std::invalid_argument on input that the effect cannot handle.
    void (*check)(const LammpsInput&) = nullptr;

    // Commands that come before the bodies are created.
    Commands before_bodies = nullptr;
    // Words of a body's line of fix magttice: force.keyword and its values.
    std::string (*body_words)(const LammpsInput&, const Body&) = nullptr;
    Commands commands = nullptr;  // after the bodies, before the time integration
    Commands after_integration = nullptr;

    // Group that `commands` make of nodes which the time integration leaves out.
    const char* group_left_out = nullptr;
    // Stiffness with which the effect presses on a body's surface, pressure over
    // displacement [Pa/m], for the stable step.
    double (*surface_spring_pa_m)(const LammpsInput&, const Body&) = nullptr;

    BodyForceStyle force{};
    FixStyle fix{};
    // Registers computes and pair styles of the effect.
    void (*register_styles)(LAMMPS_NS::LAMMPS&) = nullptr;
};

// All effects of this build, in the order of effects.inc.
std::span<const Effect* const> effects();
// The effects that this input asks for, in the same order.
std::vector<const Effect*> asked_effects(const LammpsInput& input);
// Group of the time integration: "all", or "moving" if an effect leaves nodes out.
std::string integrated_group(const LammpsInput& input);

// --- for the LAMMPS styles of effects

// Fails if another fix integrates an atom of this one's group, which would move twice.
void refuse_integrated_twice(LAMMPS_NS::LAMMPS& lammps, const LAMMPS_NS::Fix& self);

// Ends a run that cannot go on. The cause goes to the handler of set_failure_handler
// (register_styles.h), or to LAMMPS's error->one if there is none. One rank may call it
// alone.
[[noreturn]] void fail(LAMMPS_NS::Error& error, const std::string& cause);
template <class First, class... Args>
[[noreturn]] void fail(LAMMPS_NS::Error& error, fmt::format_string<First, Args...> cause,
                       First&& first, Args&&... args) {
    fail(error,
         fmt::format(cause, std::forward<First>(first), std::forward<Args>(args)...));
}

// Number in a word of a command; ends the run with LAMMPS's error if the word is none.
double number(const char* word, LAMMPS_NS::LAMMPS* lammps);

// Surface share of a node, for styles that act on surfaces.
struct SurfaceNode {
    int body = -1;       // number of the body in the order of the script; -1: of no body
    double area_m2 = 0;  // share of surface_areas (mesh/surface.h); 0: inside of the body
    Vec3 at_rest_m{};
};
// The nodes of all bodies by atom ID, the same on all ranks; empty without a fix
// magttice.
std::vector<SurfaceNode> surface_nodes(const LAMMPS_NS::Modify& modify);

}  // namespace magfsi::structure
