// SPDX-License-Identifier: GPL-2.0-or-later
// Errors about input that a user can correct.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace magfsi::structure {

// Throws std::invalid_argument. sentence: a format string of fmt that says what was found
// and what is allowed.
template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> sentence, Args&&... args) {
    throw std::invalid_argument(fmt::format(sentence, std::forward<Args>(args)...));
}

}  // namespace magfsi::structure
