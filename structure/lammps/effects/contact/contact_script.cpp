#include <fmt/format.h>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/contact/contact_law.h"

namespace magfsi::structure {

namespace {

void add_contact(std::vector<std::string>& lines, const LammpsInput& input) {
    const ContactLaw law = contact_law(input);
    lines.push_back(
        fmt::format("pair_style magttice/contact {:.17g} {:.17g} excluded {:.17g}",
                    law.distance_m, law.stiffness_pa_m, law.excluded));
    lines.push_back("pair_coeff * *");
    lines.push_back("compute contact all magttice/contact");
}

}  // namespace

ContactLaw contact_law(const LammpsInput& input) {
    ContactLaw law = *input.contact;
    if (!(law.distance_m > 0)) law.distance_m = contact_distance_m(input.bodies);
    if (!(law.stiffness_pa_m > 0)) {
        law.stiffness_pa_m = contact_stiffness_pa_m(input.bodies, law.distance_m);
    }
    return law;
}

// The nodes that may touch are looked for within the distance and half of it, and again
// when a node has moved a quarter of the distance.
extern const ScriptEffect contact_effect{
    .name = "contact",
    .asked = [](const LammpsInput& input) { return input.contact.has_value(); },
    .commands = add_contact,
    .surface_spring_pa_m =
        [](const LammpsInput& input, const Body& body) {
            return contact_spring_pa_m(body, contact_law(input));
        },
    .neighbor_skin_m =
        [](const LammpsInput& input) { return 0.5 * contact_law(input).distance_m; }};

}  // namespace magfsi::structure
