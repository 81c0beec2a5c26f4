// SPDX-License-Identifier: GPL-2.0-or-later
// Differences between the versions of LAMMPS (29 Sep 2021 and later) and their bridges.
// Every source that includes LAMMPS's headers is compiled with `-include` of this file
// (magfsi_find_lammps in cmake/Dependencies.cmake). Debian's headers carry no version
// number, so versions are recognised by what they declare.
#pragma once

// LAMMPS's headers include "fmt/format.h" of a bundled {fmt}: version 7, which Debian 12
// does not ship; later versions have it beside their headers, in a namespace of its own.
// The system's {fmt} has the same include guard and is included first, so that a source
// sees one {fmt}. LAMMPS's variadic templates must then not be instantiated from our
// code, as their symbols are those of the bundled one: call the overloads that take a
// std::string, as in error->all(FLERR, fmt::format(...)).
#include <fmt/ranges.h>

namespace fmt {
// The one name of {fmt} 7 that LAMMPS's headers of 2021 use and {fmt} 9 lacks. It is
// declared but never called.
template <typename... Args, typename S>
format_args make_args_checked(const S&, const Args&...);
}  // namespace fmt

namespace magfsi::structure {

// Adds the values of this rank's ghost atoms to their owners on other ranks. Collective.
// LAMMPS's function is Comm::reverse_comm_fix until 2022, later an overload of
// Comm::reverse_comm.
template <typename Comm, typename Fix>
void sum_ghosts_onto_owners(Comm& comm, Fix* fix) {
    if constexpr (requires { comm.reverse_comm_fix(fix); }) {
        comm.reverse_comm_fix(fix);
    } else {
        comm.reverse_comm(fix);
    }
}

}  // namespace magfsi::structure
