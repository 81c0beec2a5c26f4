#include "fluid_lbm/collision/choice.h"

#include <sstream>

#include "fluid_lbm/collision/registered.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

// Two-relaxation-time collision had the lowest error of the three at moderate relaxation
// times; near 1/2 its odd rate vanishes (0.008 at 0.5015 with Lambda = 3/16) and it
// diverged within 23 to 52 ms of a swimming robot, where the recursive-regularised one
// and even BGK ran; at 0.5035 (odd rate 0.018) it diverged in a Taylor-Green vortex at
// Reynolds number 1600. At 0.55 the odd rate is 0.24: perturbations decay within four
// steps.
constexpr double trt_from = 0.55;

template <class... Kinds>
const char* name_of(Collision collision, CollisionList<Kinds...>) {
    const char* name = "automatic";
    ((Kinds::kind == collision ? void(name = Kinds::name) : void()), ...);
    return name;
}

}  // namespace

std::string to_string(Collision collision) {
    return name_of(collision, RegisteredCollisions{});
}

Collision choose_collision(const FluidConfig& config) {
    if (config.collision != Collision::automatic) return config.collision;
    return relaxation_time(config) < trt_from ? Collision::recursive_regularized
                                              : Collision::trt;
}

std::string collision_reason(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    const double even = 1 / tau;
    const double odd = odd_rate(even, config.magic_number);
    std::ostringstream text;
    text.precision(4);
    text << to_string(choose_collision(config)) << ": ";
    if (config.collision != Collision::automatic) {
        text << "asked for";
    } else if (tau < trt_from) {
        text << "relaxation time " << tau << " is below " << trt_from
             << ", where the odd rate of two-relaxation-time collision falls to " << odd
             << " and it tends to diverge";
    } else {
        text << "relaxation time " << tau << " is at least " << trt_from
             << ", where two-relaxation-time collision is stable and has the lowest "
                "error";
    }
    return text.str();
}

}  // namespace magfsi::fluid
