// SPDX-License-Identifier: GPL-2.0-or-later
// Refusal of what a user has given.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace magfsi::structure {

// sentence: what was found and what is allowed, as fmt::format takes it.
template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> sentence, Args&&... args) {
    throw std::invalid_argument(fmt::format(sentence, std::forward<Args>(args)...));
}

}  // namespace magfsi::structure
