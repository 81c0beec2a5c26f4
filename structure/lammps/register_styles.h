// SPDX-License-Identifier: GPL-2.0-or-later
// Registration of our styles with the unmodified LAMMPS library.
#pragma once

#include <functional>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace magfsi::structure {

// Adds our styles to a LAMMPS instance; call it after the constructor and before the
// first input line:
//   fix ID group magttice FILE first_atom_id G K [element VARIANT] [field Bx By Bz] ...
//   fix ID group magttice/field PLANE COURSE ...
//   fix ID group magttice/sources "SOURCES"
//   fix ID group magttice/dipoles [within] [periodic LX LY LZ]
//   fix ID group magttice/drag RATE
//   fix ID group magttice/motion COURSE ...
//   fix ID group magttice/platform PX PY PZ NX NY NZ STIFFNESS [friction MU] [damping C]
//   fix ID group magttice/solid SHAPE ... STIFFNESS [friction MU] [periodic LX LY LZ]
//   fix ID group magttice/rigid [drag RATE] part MASS ... nodes RANGE ... [part ...]
//   fix ID group magttice/contact_load begin | end GX GY GZ
//   fix ID group magttice/quiet
//   pair_style magttice/contact DISTANCE STIFFNESS [excluded FACTOR] [friction MU]
//              [periodic LX LY LZ]
//   compute ID group magttice/contact
// (see docs/fix_magttice.md).
void register_styles(LAMMPS_NS::LAMMPS& lammps);

// Sets the function that a failing style calls in place of LAMMPS's own error exit, which
// ends the process through MPI_Finalize and would leave a partner waiting. The handler
// must not return. Without one, LAMMPS's error->one is called. advice: what to do where
// the bodies become unstable, in the words of the program; if empty that of a LAMMPS
// script.
void set_failure_handler(std::function<void(const std::string& cause)> handler,
                         const std::string& advice = "");

// "take a smaller time step, ...": what is told of bodies that become unstable.
const std::string& advice_if_unstable();

}  // namespace magfsi::structure
