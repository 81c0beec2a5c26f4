// SPDX-License-Identifier: GPL-2.0-or-later
// Detection of surfaces of moving bodies that come near each other or pass through each
// other, parts of one body included.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// A place where two surfaces are near each other or cross.
struct Proximity {
    std::array<std::size_t, 2> body{};
    std::array<int, 2> element{};  // numbers in the meshes of these bodies
    // a point at the place
    Vec3 at_m{};
    double gap_m = 0;  // 0 if surfaces pass through each other
};

// Result of a search.
struct Proximities {
    std::optional<Proximity> crossing;  // the first one found
    std::vector<Proximity> near;        // the nearest one of each pair of bodies
    // Lower bound of the distance between parts that could meet, at most the range of the
    // search
    double apart_m = 0;
};

// Search on given bodies. Parts of one surface that are close together in the body at
// rest are neighbours that cannot meet: a quad is compared only with quads whose middle
// is farther at rest than twice the sum of both radii. These count as near only if the
// gap is less than half of that at rest, so that the two sides of a thin sheet do not.
class ProximityFinder {
  public:
    // bodies: undeformed meshes. near_m: gap below which places are reported. period_m:
    // length of the period along each axis through whose sides bodies meet each other, 0
    // along axes without one.
    ProximityFinder(std::span<const Mesh* const> bodies, double near_m,
                    const Vec3& period_m = {});

    // nodes_m: present positions of the nodes of all bodies, one body after the other.
    Proximities find(std::span<const Vec3> nodes_m) const;

    // Shortest edge on the surfaces of the undeformed bodies [m].
    double shortest_edge_m() const { return shortest_edge_m_; }

  private:
    // Ball around a quad.
    struct Ball {
        Vec3 centre_m{};
        double radius_m = 0;
    };
    // A quad of a surface.
    struct Patch {
        std::array<int, 4> node{};  // numbers among the nodes of all bodies
        std::size_t body = 0;
        int element = 0;
        // In the undeformed body
        Ball rest;
    };
    static Ball ball_around(const Patch& patch, std::span<const Vec3> nodes_m);
    // Gap at rest between quads of one body, b shifted by image_m; empty if they count as
    // different bodies.
    std::optional<double> rest_gap_m(const Patch& a, const Patch& b,
                                     const Vec3& image_m) const;
    // Examines a pair and adds it to the result.
    void look_at(const Patch& a, const Patch& b, const Vec3& image_m, double gap_m,
                 std::span<const Vec3> nodes_m, Proximities& found) const;

    std::vector<Patch> patches_;
    Vec3 period_m_{};
    // Per body: true along axes on which it continues
    std::vector<std::array<bool, 3>> goes_on_;
    double near_m_ = 0;
    double reach_m_ = 0;  // gap up to which pairs are examined
    double shortest_edge_m_ = INFINITY;
};

}  // namespace magfsi::structure
