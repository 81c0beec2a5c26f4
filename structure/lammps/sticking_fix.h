// SPDX-License-Identifier: GPL-2.0-or-later
// Base class of fixes with friction: stick points of each atom, which move with the atom
// between ranks and are part of LAMMPS's restart files.
#pragma once

#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/platform_law.h"

namespace magfsi::structure {

// Each atom has the same number of stick points. Without keep_sticks it has none, and the
// fix takes no part in exchanges and restarts.
class StickingFix : public LAMMPS_NS::Fix {
  public:
    using Fix::Fix;
    ~StickingFix() override;

    void grow_arrays(int count) override;
    void copy_arrays(int from, int to, int deleted) override;
    void set_arrays(int atom_index) override;
    int pack_exchange(int i, double* buffer) override;
    int unpack_exchange(int i, double* buffer) override;
    int pack_restart(int i, double* buffer) override;
    void unpack_restart(int i, int nth) override;
    int size_restart(int i) override;
    int maxsize_restart() override;
    double memory_usage() override;

  protected:
    // Creates `each` stick points per atom. Call it once, in the constructor of the fix,
    // and only if something can stick.
    void keep_sticks(int each);
    // A stick point of an atom by its local index.
    StickPoint& stick(int atom_index, int number) {
        return sticks_[each_ * atom_index + number];
    }

  private:
    // Number of stick points per atom
    int each_ = 0;
    // Stick points of atom 0, then of atom 1, ...
    std::vector<StickPoint> sticks_;
};

}  // namespace magfsi::structure
