// Stand-in for the {fmt} 7 header that LAMMPS bundles and Debian does not ship: LAMMPS's
// own headers mention these names. They are declared only. Its variadic templates must
// not be instantiated from our code: call the overloads that take a std::string, as in
// error->all(FLERR, std::string(...)).
#pragma once

#include <cstddef>
#include <string>

namespace fmt {
inline namespace v7_lmp {

template <typename Char>
class basic_string_view {
  public:
    basic_string_view(const Char* text)
        : data_(text), size_(std::char_traits<Char>::length(text)) {}
    basic_string_view(const std::basic_string<Char>& text)
        : data_(text.data()), size_(text.size()) {}

  private:
    const Char* data_;
    std::size_t size_;
};
using string_view = basic_string_view<char>;

struct format_args;
template <typename... Args, typename S>
const format_args& make_args_checked(const S&, const Args&...);
template <typename S, typename... Args>
std::string format(const S&, Args&&...);

}  // namespace v7_lmp
}  // namespace fmt
