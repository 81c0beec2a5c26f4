#include "structure/lammps/element_name.h"

#include <array>
#include <stdexcept>

namespace magfsi::structure {
namespace {

struct Named {
    ElementVariant variant;
    const char* name;
};
constexpr std::array<Named, 3> variants{
    {{ElementVariant::full, "full"},
     {ElementVariant::mean_f, "mean_f"},
     {ElementVariant::assumed_strain, "assumed_strain"}}};

}  // namespace

const char* element_name(ElementVariant variant) {
    for (const Named& known : variants) {
        if (known.variant == variant) return known.name;
    }
    throw std::invalid_argument("an element variant without a name");
}

ElementVariant parse_element_name(const std::string& word) {
    for (const Named& known : variants) {
        if (word == known.name) return known.variant;
    }
    throw std::invalid_argument("element " + word +
                                " found; full, mean_f and assumed_strain are allowed");
}

}  // namespace magfsi::structure
