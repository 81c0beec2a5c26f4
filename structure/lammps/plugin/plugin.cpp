// SPDX-License-Identifier: GPL-2.0-or-later
// Entry point for LAMMPS's command `plugin load magtticeplugin.so`. LAMMPS passes a
// function that registers one style from a description of it. Our styles register
// themselves in the same maps, as they do in the unmodified library, so that no header of
// the package PLUGIN is needed.
#include "lammps.h"
#include "structure/lammps/register_styles.h"

extern "C" void lammpsplugin_init(void* lammps, void* /*handle*/, void* /*register*/) {
    magfsi::structure::register_styles(*static_cast<LAMMPS_NS::LAMMPS*>(lammps));
}
