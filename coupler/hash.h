// SPDX-License-Identifier: GPL-2.0-or-later
// FNV-1a (Fowler, Noll and Vo), a hash that gives the same number in every build and
// language: it identifies scenes and states in messages and files. controller.py
// implements it, too.
#pragma once

#include <cstdint>
#include <string_view>

namespace magfsi::coupler {

// 64-bit FNV-1a hash of the bytes.
constexpr std::uint64_t hash_of(std::string_view bytes) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : bytes) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 1099511628211ULL;
    }
    return hash;
}

}  // namespace magfsi::coupler
