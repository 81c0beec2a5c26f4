// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/boundary/boundaries.h"

#include <algorithm>
#include <string>

#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

#define MAGFSI_BOUNDARY(name) MAGFSI_EFFECT(name)
#define MAGFSI_EFFECT(name) \
    std::unique_ptr<SideEffect> make_##name##_effect(const SideContext&, int side);
#include "fluid_lbm/effects.inc"
#undef MAGFSI_EFFECT

namespace {

// An effect of effects.inc and the function that makes it.
struct Registered {
    std::string name;
    MakeSideEffect make;
};

// Name of the effect that a side asks for; "" if the sweep alone treats the side.
std::string effect_of(const Boundary& side) {
    if (side.kind == BoundaryKind::periodic) return "";
    if (side.kind != BoundaryKind::no_slip) return std::string(name_of(side.kind));
    return side.wall_velocity_m_s == Vec3{} ? "" : "moving_wall";
}

}  // namespace

std::vector<std::unique_ptr<SideEffect>> make_side_effects(const SideContext& context) {
#define MAGFSI_EFFECT(name) {#name, make_##name##_effect},
    const std::vector<Registered> registered = {
#include "fluid_lbm/effects.inc"
    };
#undef MAGFSI_EFFECT
#undef MAGFSI_BOUNDARY
    const auto& sides = context.config.boundaries;
    for (int side = 0; side < 6; ++side) {
        const std::string name = effect_of(sides[side]);
        if (!name.empty() && !std::ranges::count(registered, name, &Registered::name))
            refuse("fluid side ", side_name[side], " asks for ", name,
                   ", and this program was built without it; give the side another "
                   "kind, or build the program with it");
    }
    std::vector<std::unique_ptr<SideEffect>> effects;
    for (const Registered& effect : registered) {
        for (int side = 0; side < 6; ++side) {
            if (effect_of(sides[side]) != effect.name) continue;
            if (auto made = effect.make(context, side))
                effects.push_back(std::move(made));
        }
    }
    return effects;
}

}  // namespace magfsi::fluid
