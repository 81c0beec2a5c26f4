// SPDX-License-Identifier: GPL-2.0-or-later
// Stick points that a fix keeps with its atoms, over ranks and restarts.
#pragma once

#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/platform_law.h"

namespace magfsi::structure {

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
    // Once, when the fix is made, and only where something can stick: so many an atom.
    void keep_sticks(int each);
    StickPoint& stick(int atom_index, int number) {
        return sticks_[static_cast<std::size_t>(each_ * atom_index + number)];
    }

  private:
    int each_ = 0;
    std::vector<StickPoint> sticks_;
};

}  // namespace magfsi::structure
