// SPDX-License-Identifier: GPL-2.0-or-later
// The words of a rigid part in the command of fix magttice/rigid:
//   part MASS CX CY CZ IXX IYY IZZ IXY IXZ IYZ [velocity VX VY VZ WX WY WZ]
//        [pivot PX PY PZ | hinge PX PY PZ AX AY AZ | moved N COURSE [moved N COURSE]]
//        nodes RANGE ...
// Mass, centre of mass and inertia about it are those at the start; a RANGE of atom IDs
// is N, N:M or N:M:STEP. A COURSE has N words, those of fix magttice/motion
// (motion_law.h): a displacement, a turn, or one of each.
#pragma once

#include <string>
#include <vector>

#include "structure/lammps/effect.h"
#include "structure/refuse.h"
#include "structure/rigid_motion.h"

namespace magfsi::structure {

// A part as the command describes it.
struct PartWords {
    RigidInertia inertia;
    Vec3 velocity_m_s{}, angular_velocity_rad_s{};
    std::vector<int> ids;  // of its atoms
};

std::string words_of_part(const PartWords& part);

// Reads the words of the command one after the other.
class WordReader {
  public:
    WordReader(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
        : lammps_(lammps), words_(words, words + count) {}

    bool done() const { return at_ == words_.size(); }
    bool next_is(const char* word) const { return !done() && words_[at_] == word; }
    bool take(const char* word) {
        if (!next_is(word)) return false;
        ++at_;
        return true;
    }
    const std::string& word() {
        if (done()) refuse("\"{}\" at the end found, more words are needed", last());
        return words_[at_++];
    }
    double value() { return number(word().c_str(), lammps_); }
    Vec3 vector() {
        Vec3 out{};
        for (double& x : out) x = value();
        return out;
    }

  private:
    std::string last() const { return words_.empty() ? "" : words_.back(); }

    LAMMPS_NS::LAMMPS* lammps_;
    std::vector<std::string> words_;
    std::size_t at_ = 0;
};

// Reads the words after "part". Throws std::invalid_argument.
PartWords read_part(WordReader& words);

}  // namespace magfsi::structure
