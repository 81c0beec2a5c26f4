// Whether bytes are UTF-8, as files of this language must be: their words go on into
// JSON.
#pragma once

#include <cstddef>
#include <string_view>

namespace magfsi::scene {

// Where the first byte stands that begins no well-formed character (RFC 3629: no
// surrogates, no longer forms than needed, nothing above U+10FFFF); npos: none.
std::size_t first_fault_in_utf8(std::string_view bytes);

}  // namespace magfsi::scene
