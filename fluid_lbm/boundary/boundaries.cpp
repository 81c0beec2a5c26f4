#include "fluid_lbm/boundary/boundaries.h"

#include <algorithm>
#include <string_view>

#include "fluid_lbm/boundary/refuse.h"

namespace magfsi::fluid {

#define MAGFSI_EFFECT(name) \
    std::unique_ptr<SideEffect> make_##name##_effect(const SideContext&);
#include "fluid_lbm/effects.inc"
#undef MAGFSI_EFFECT

namespace {

struct Registered {
    std::string_view name;
    MakeSideEffect make;
};

#define MAGFSI_EFFECT(name) {#name, make_##name##_effect},
constexpr Registered registered[] = {
#include "fluid_lbm/effects.inc"
    {"", nullptr}};
#undef MAGFSI_EFFECT

void check(int side, bool asked, std::string_view name) {
    if (!asked ||
        std::ranges::find(registered, name, &Registered::name) != std::end(registered))
        return;
    refuse(side_name[side], " asks for ", name,
           ", and this program was built without it");
}

// Side by side, so that what is refused is the same on all ranks.
void check_registered(const SideContext& in) {
    for (int side = 0; side < 6; ++side) {
        check(side, in.is(side, BoundaryKind::free_slip), "free_slip");
        check(side,
              in.is(side, BoundaryKind::no_slip) && in.wall_velocity[side] != Vec3{},
              "moving_wall");
        check(side, in.is(side, BoundaryKind::velocity_inlet), "velocity_inlet");
        check(side, in.is(side, BoundaryKind::pressure_outlet), "pressure_outlet");
    }
}

}  // namespace

Boundaries::Boundaries(const SideContext& in) {
    check_registered(in);
    for (const Registered& effect : registered) {
        if (!effect.make) continue;
        if (auto made = effect.make(in)) effects_.push_back(std::move(made));
    }
}

void Boundaries::before_sweep(const Populations& populations, Arrangement arrangement) {
    for (const auto& effect : effects_) effect->before_sweep(populations, arrangement);
}

void Boundaries::enter(const Populations& populations, const RowLayout& layout,
                       double time) {
    for (const auto& effect : effects_) effect->enter(populations, layout, time);
}

void Boundaries::end_step(const Populations& populations, Arrangement arrangement) {
    for (const auto& effect : effects_) effect->end_step(populations, arrangement);
}

}  // namespace magfsi::fluid
