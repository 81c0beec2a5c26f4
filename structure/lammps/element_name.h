// The words of `fix magttice ... element WORD`.
#pragma once

#include <string>

#include "structure/body.h"

namespace magfsi::structure {

// Throws std::invalid_argument on another word than those of ElementVariant.
ElementVariant parse_element_name(const std::string& word);

}  // namespace magfsi::structure
