// SPDX-License-Identifier: GPL-2.0-or-later
// Paths as words of a LAMMPS script, in which blanks, quotes, $, &, # and letters beyond
// ASCII would be changed or cut. Such bytes are written as %20 and so on, as in URLs.
#pragma once

#include <cctype>
#include <charconv>
#include <string>
#include <string_view>

namespace magfsi::words {

// The path as one word of plain ASCII characters.
inline std::string path_word(std::string_view path) {
    constexpr std::string_view plain = "_-./+,:=@~()[]", digits = "0123456789ABCDEF";
    std::string out;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && (std::isalnum(byte) != 0 || plain.find(c) != plain.npos)) {
            out += c;
        } else {
            out += '%';
            out += digits[byte / 16];
            out += digits[byte % 16];
        }
    }
    return out;
}

// The path that a word stands for. A % without two hexadecimal digits behind it stands
// for itself.
inline std::string path_of_word(std::string_view word) {
    std::string out;
    for (std::size_t i = 0; i < word.size(); ++i) {
        unsigned byte = 0;
        const std::string_view digits = word.substr(i).substr(0, 3);
        if (digits.size() == 3 && digits[0] == '%' &&
            std::from_chars(digits.data() + 1, digits.data() + 3, byte, 16).ptr ==
                digits.data() + 3) {
            out += static_cast<char>(byte);
            i += 2;
        } else {
            out += word[i];
        }
    }
    return out;
}

}  // namespace magfsi::words
