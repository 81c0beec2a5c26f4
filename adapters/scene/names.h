// The words of the scene file for the enumerations of scene.h, in their order.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

template <class E>
inline constexpr std::nullptr_t names = nullptr;

template <>
inline constexpr std::array names<EquilibriumMethod> =
    std::to_array<std::string_view>({"newton", "dynamics"});
template <>
inline constexpr std::array names<ElementVariant> =
    std::to_array<std::string_view>({"full", "mean_f", "assumed_strain"});
template <>
inline constexpr std::array names<Face> = std::to_array<std::string_view>(
    {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"});
template <>
inline constexpr std::array names<FluidSolver> =
    std::to_array<std::string_view>({"lbm", "openfoam"});
template <>
inline constexpr std::array names<Collision> =
    std::to_array<std::string_view>({"automatic", "bgk", "trt", "recursive_regularized"});
template <>
inline constexpr std::array names<BoundaryKind> = std::to_array<std::string_view>(
    {"periodic", "no_slip", "free_slip", "velocity_inlet", "pressure_outlet"});
template <>
inline constexpr std::array names<Precision> =
    std::to_array<std::string_view>({"double", "float", "float_double"});
template <>
inline constexpr std::array names<InletProfile> =
    std::to_array<std::string_view>({"uniform", "parabolic", "plug"});
template <>
inline constexpr std::array names<Kernel> =
    std::to_array<std::string_view>({"2-point", "3-point", "4-point"});
template <>
inline constexpr std::array names<Markers> =
    std::to_array<std::string_view>({"mid_surface", "both_faces", "volume"});
template <>
inline constexpr std::array names<Scheme> =
    std::to_array<std::string_view>({"serial", "parallel", "implicit"});
template <>
inline constexpr std::array names<SampledVelocity> =
    std::to_array<std::string_view>({"frozen", "linear"});
template <>
inline constexpr std::array names<Acceleration> =
    std::to_array<std::string_view>({"under_relaxation", "aitken", "iqn_ils"});
template <>
inline constexpr std::array names<ColumnFilter> =
    std::to_array<std::string_view>({"qr1", "qr2"});
template <>
inline constexpr std::array names<FirstGuess> =
    std::to_array<std::string_view>({"constant", "linear"});
template <>
inline constexpr std::array names<Unconverged> =
    std::to_array<std::string_view>({"stop", "go_on"});
template <>
inline constexpr std::array names<OnDivergence> =
    std::to_array<std::string_view>({"stop", "retry"});
template <>
inline constexpr std::array names<BodyQuantity> = std::to_array<std::string_view>(
    {"com", "speed", "shape", "max_displacement", "fluid_force", "energy"});
template <>
inline constexpr std::array names<FluidQuantity> = std::to_array<std::string_view>(
    {"kinetic_energy", "enstrophy", "mass", "max_speed", "obstacle_force"});
template <>
inline constexpr std::array names<FluidField> =
    std::to_array<std::string_view>({"velocity", "density", "vorticity"});

inline constexpr std::array axis_names = std::to_array<std::string_view>({"x", "y", "z"});
// A plane names its first and its second axis; angles run from the first to the second.
inline constexpr std::array plane_names =
    std::to_array<std::string_view>({"xy", "xz", "yz", "yx", "zx", "zy"});

template <class E>
concept Named = std::is_enum_v<E>;

template <Named E>
constexpr std::string_view name_of(E value) {
    return names<E>[static_cast<std::size_t>(value)];
}

}  // namespace magfsi::scene
