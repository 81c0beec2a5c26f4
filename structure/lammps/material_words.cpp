// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/material_words.h"

#include "structure/lammps/effect.h"
#include "structure/lammps/law_words.h"

namespace magfsi::structure {

template <>
constexpr const char* law_name<Gent> = "gent";
template <>
constexpr const char* law_name<Yeoh> = "yeoh";
template <>
constexpr const char* law_name<ArrudaBoyce> = "arruda_boyce";

namespace {

// Number of values of the law of this name; 1 where there is no such law, which read_law
// refuses.
template <class... Laws>
std::size_t values_of(const std::string& name, const std::variant<Laws...>&) {
    std::size_t values = 1;
    const auto look = [&]<class Law>(const Law&) {
        if (name == law_name<Law>) values = typename LawWords<Law>::Numbers{}.size();
    };
    (look(Laws{}), ...);
    return values;
}

}  // namespace

Material read_material(std::span<char*> words, LAMMPS_NS::LAMMPS* lammps) {
    Material material;
    material.shear_modulus_pa = number(words[0], lammps);
    material.lame_lambda_pa = number(words[1], lammps);
    if (words.size() > 2) material.viscosity_pa_s = number(words[2], lammps);
    return material;
}

std::string material_words(const Material& material) {
    std::string out;
    if (material.stiffening) out = " stiffening " + law_words(*material.stiffening);
    for (const MaxwellBranch& branch : material.branches)
        out += fmt::format(" branch {:.17g} {:.17g}", branch.modulus_pa, branch.time_s);
    return out;
}

int read_stiffening(std::span<char*> words, Material& material) {
    if (words.empty()) refuse("\"stiffening\" without a law found");
    Stiffening law;
    const std::size_t count = std::min(words.size(), 1 + values_of(words.front(), law));
    const std::vector<std::string> own(words.begin(), words.begin() + count);
    read_law(law, std::span<const std::string>(own));
    material.stiffening = law;
    return static_cast<int>(count);
}

}  // namespace magfsi::structure
