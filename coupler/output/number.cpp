#include "coupler/output/number.h"

#include <array>
#include <charconv>
#include <cmath>

namespace magfsi::output {

std::string to_text(double value) {
    if (std::isnan(value)) return "nan";
    std::array<char, 32> text{};  // the longest shortest double has 24 characters
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

}  // namespace magfsi::output
