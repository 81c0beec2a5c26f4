// SPDX-License-Identifier: GPL-2.0-or-later
// name_of(value): the word of a value of an enumeration, whose words_of() lists the words
// in the order of the enumerators from 0 on.
#pragma once

#include <cstddef>
#include <string_view>

namespace magfsi {

inline constexpr auto name_of = [](auto value) {
    return std::string_view(words_of(value)[static_cast<std::size_t>(value)]);
};

}  // namespace magfsi
