#include "structure/lammps/node_ids.h"

namespace magfsi::structure {

int first_id(const LammpsInput& input, std::size_t body) {
    std::size_t before = 0;
    for (std::size_t b = 0; b < body; ++b) before += input.bodies[b].mesh.nodes.size();
    return static_cast<int>(before) + 1;
}

std::vector<int> ids_where(const LammpsInput& input,
                           const std::function<bool(const HeldAxes&)>& such) {
    std::vector<int> ids;
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const auto held = held_axes(input.bodies[b]);
        const int first = first_id(input, b);
        for (std::size_t n = 0; n < held.size(); ++n) {
            if (such(held[n])) ids.push_back(first + static_cast<int>(n));
        }
    }
    return ids;
}

}  // namespace magfsi::structure
