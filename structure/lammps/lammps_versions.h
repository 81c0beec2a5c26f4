// SPDX-License-Identifier: GPL-2.0-or-later
// What differs between the versions of LAMMPS (29 Sep 2021 and later) and how it is
// bridged. Every source that includes LAMMPS's headers is compiled with `-include` of
// this file (magfsi_find_lammps in cmake/Dependencies.cmake). Debian's headers carry no
// version number, so the differences are told by what is declared.
#pragma once

// LAMMPS's headers include "fmt/format.h" of a {fmt} that it bundles: version 7, which
// Debian 12 does not ship; later ones, in a namespace of their own, beside the headers.
// The system's {fmt} has the same include guard and comes first, so that a source sees
// one {fmt}. LAMMPS's variadic templates must then not be instantiated from our code, as
// their symbols are those of the bundled one: call the overloads that take a std::string,
// as in error->all(FLERR, fmt::format(...)).
#include <fmt/ranges.h>

namespace fmt {
// The one name of {fmt} 7 that LAMMPS's headers of 2021 use and {fmt} 9 lacks.
template <typename... Args, typename S>
format_args make_args_checked(const S&, const Args&...);
}  // namespace fmt

namespace magfsi::structure {

// Adds what this rank's ghost atoms hold to their owners on other ranks.
// Comm::reverse_comm_fix until 2022, an overload of Comm::reverse_comm since.
template <typename Comm, typename Fix>
void sum_ghosts_onto_owners(Comm& comm, Fix* fix) {
    if constexpr (requires { comm.reverse_comm_fix(fix); }) {
        comm.reverse_comm_fix(fix);
    } else {
        comm.reverse_comm(fix);
    }
}

}  // namespace magfsi::structure
