// Numbers as text, the same bytes for the same value on every machine and in every
// locale.
#pragma once

#include <string>

namespace magfsi::output {

// The shortest decimal that reads back to the same double; "nan" whatever its sign,
// "inf",
// "-inf".
std::string to_text(double value);

}  // namespace magfsi::output
