// SPDX-License-Identifier: GPL-2.0-or-later
// Where surfaces of moving bodies come near each other or pass through each other, those
// of one body included.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

struct Proximity {
    std::array<std::size_t, 2> body{};
    std::array<int, 2> element{};  // of that body
    Vec3 at_m{};
    double gap_m = 0;  // 0 where surfaces pass through each other
};

struct Proximities {
    std::optional<Proximity> crossing;  // the first that is found
    std::vector<Proximity> near;        // of each pair of bodies the nearest
    double apart_m =
        0;  // all that could meet is at least so far apart, as far as is looked
};

// Parts of one surface that lie close together in the body at rest are neighbours, which
// cannot meet: a quadrilateral looks at those that are further away than twice the sum of
// both radii. They count as near where they have come closer than half of that distance,
// so that a thin sheet's two sides do not.
class ProximityFinder {
  public:
    // bodies: undeformed. near_m: what is closer is reported. period_m: of axes through
    // whose sides bodies see each other, else 0.
    ProximityFinder(std::span<const Mesh* const> bodies, double near_m,
                    const Vec3& period_m = {});

    // nodes_m: of all bodies, one after the other.
    Proximities find(std::span<const Vec3> nodes_m) const;

    // Of elements' edges on the surfaces at rest.
    double shortest_edge_m() const { return shortest_edge_m_; }

  private:
    // A quadrilateral's middle, and how far it reaches from there.
    struct Ball {
        Vec3 centre_m{};
        double radius_m = 0;
    };
    struct Patch {
        std::array<int, 4> node{};  // among those of all bodies
        std::size_t body = 0;
        int element = 0;
        Ball rest;
    };
    static Ball ball_around(const Patch& patch, std::span<const Vec3> nodes_m);
    // Of one body at rest, b image_m away; absent where they are no parts of one.
    std::optional<double> rest_gap_m(const Patch& a, const Patch& b,
                                     const Vec3& image_m) const;
    void look_at(const Patch& a, const Patch& b, const Vec3& image_m, double gap_m,
                 std::span<const Vec3> nodes_m, Proximities& found) const;

    std::vector<Patch> patches_;
    Vec3 period_m_{};
    std::vector<std::array<bool, 3>> goes_on_;  // of each body, through periodic sides
    double near_m_ = 0;
    double reach_m_ = 0;  // how far apart pairs are looked at
    double shortest_edge_m_ = INFINITY;
};

}  // namespace magfsi::structure
