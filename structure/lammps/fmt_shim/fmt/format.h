// LAMMPS's headers include the {fmt} 7 that it bundles and Debian does not ship. This
// adds to Debian's {fmt} the one name that they miss. It is declared only: their variadic
// templates must not be instantiated from our code; call the overloads that take a
// std::string, as in error->all(FLERR, fmt::format(...)).
#pragma once

#include_next <fmt/format.h>

namespace fmt {
template <typename... Args, typename S>
format_args make_args_checked(const S&, const Args&...);
}  // namespace fmt
