// The words of the scene file for the enumerations of scene.h, in their order.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

using namespace structure;
using coupler::AccelerationMethod, coupler::ColumnFilter, coupler::Coupling;
using coupler::ImmersedBoundary, coupler::InitialGuess, coupler::Iteration;
using coupler::Kernel, coupler::Markers, coupler::OnNoConvergence,
    coupler::SampledVelocity;
using coupler::Scheme;
using fluid::Block, fluid::Boundary, fluid::BoundaryKind, fluid::Collision;
using fluid::Cylinder, fluid::Disc, fluid::InletProfile, fluid::Obstacle;
using fluid::Precision, fluid::Rectangle, fluid::Sphere, fluid::StlSurface;

template <class E>
inline constexpr auto names = words_of(E{});

inline constexpr std::array axis_names = std::to_array<std::string_view>({"x", "y", "z"});
// A plane names its first and its second axis; angles run from the first to the second.
inline constexpr std::array plane_names =
    std::to_array<std::string_view>({"xy", "xz", "yz", "yx", "zx", "zy"});

template <class E>
concept Named = std::is_enum_v<E>;

}  // namespace magfsi::scene
