// Forces on the nodes of one body beside the elastic ones, which fix magttice adds at the
// same place of a step: an effect of effects.inc brings them with a word of the fix.
#pragma once

#include "pointers.h"

#include <memory>
#include <string>
#include <vector>

#include "structure/lammps/owned_elements.h"
#include "structure/lattice/lattice.h"

namespace magfsi::structure {

// What a fix magttice knows of its body. The lattice and the places of its nodes live as
// long as the forces, the magnetisation only while they are made.
struct MagtticeBody {
    std::string who;  // "fix ID magttice", for messages
    NodeRange range;
    const Lattice& lattice;
    const std::vector<Vec3>& nodes_m;            // at rest
    const std::vector<Vec3>& magnetization_a_m;  // one an element
};

class BodyForce : protected LAMMPS_NS::Pointers {
  public:
    // Of one step, this rank's share.
    struct Turnover {
        double work_j = 0;  // done on the body by the field
        double lost_j = 0;  // to viscosity
    };

    explicit BodyForce(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}

    virtual void init() {}  // of a run
    // The body's elements have changed their rank or their atoms their places.
    virtual void rebuild(const OwnedElements& owned) = 0;
    // Adds the forces to atom->f at the start of a run, where v is that of a whole step.
    virtual void add() = 0;
    // Adds them within a step, where v is (x(n+1) - x(n)) / dt.
    virtual Turnover advance() = 0;
    virtual void minimize() { add(); }
    // Beside the elastic energy; this rank's share, of the last forces.
    virtual double energy_j() const { return 0; }
};

// values: the words after that of the style. Throws std::invalid_argument on what the
// force cannot be made from.
using MakeBodyForce = std::unique_ptr<BodyForce> (*)(LAMMPS_NS::LAMMPS*,
                                                     const MagtticeBody&, char** values);

struct BodyForceStyle {
    int values = 0;  // words after its own
    MakeBodyForce make = nullptr;
};

// Under one word each; an effect adds its own in register_NAME.
void register_body_force(const std::string& word, const BodyForceStyle& style);
// Throws std::invalid_argument, naming what is allowed, where no effect of this build has
// the word.
const BodyForceStyle& body_force(const std::string& word);

}  // namespace magfsi::structure
