#include "structure/lammps/body_force.h"

#include <map>
#include <stdexcept>

namespace magfsi::structure {
namespace {

std::map<std::string, BodyForceStyle>& styles() {
    static std::map<std::string, BodyForceStyle> registered;
    return registered;
}

}  // namespace

void register_body_force(const std::string& word, const BodyForceStyle& style) {
    styles()[word] = style;
}

const BodyForceStyle& body_force(const std::string& word) {
    const auto found = styles().find(word);
    if (found != styles().end()) return found->second;
    std::string allowed = "element, material";
    for (const auto& [known, style] : styles()) allowed += ", " + known;
    throw std::invalid_argument("\"" + word + "\" found; allowed are " + allowed);
}

}  // namespace magfsi::structure
