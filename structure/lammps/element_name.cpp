#include "structure/lammps/element_name.h"

#include <algorithm>
#include <stdexcept>

namespace magfsi::structure {

ElementVariant parse_element_name(const std::string& word) {
    constexpr auto words = words_of(ElementVariant{});
    const auto found = std::ranges::find(words, word);
    if (found != words.end()) return static_cast<ElementVariant>(found - words.begin());
    throw std::invalid_argument("element " + word +
                                " found; full, mean_f and assumed_strain are allowed");
}

}  // namespace magfsi::structure
