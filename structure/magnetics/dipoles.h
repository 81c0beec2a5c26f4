// SPDX-License-Identifier: GPL-2.0-or-later
// Field of magnetised bodies on each other and on themselves: each element is a dipole.
//
// An element's moment is m = integral of F M = sum over its nodes of q_a x_a, and its
// place x the mean of its nodes. The energy of all dipoles is that of magnetostatics for
// uniformly magnetised spheres of these centres and moments:
//   E = - sum over pairs of mu0 / (4 pi) m_e . (grad grad phi(x_e - x_f)) m_f,
// where phi is the potential of two uniformly charged spheres. Spheres that do not
// overlap act as points, phi = 1 / r; for overlapping ones, with the mean a of the radii,
//   phi = (6/5 - u^2/2 + 3 u^3/16 - u^5/160) / a,   u = r / a < 2
// (Jackson, Classical Electrodynamics, 3rd ed., sections 1.11 and 5.10, for the parts).
// Its first three derivatives continue those of 1 / r, so that forces have no jump. The
// radius is half of the shortest edge: neighbours at rest are points, and only closer
// dipoles are softened.
//
// Within a body each element adds its own energy, that of a sphere of its volume V,
//   mu0 m^2 / (6 V).
// The sum over a cubic lattice of dipoles lacks just that energy (Lorentz); with it many
// cubes have the energy and the demagnetising factor of the solid.
//
// Forces are the exact derivatives of E: q_a B + (grad B)^T m / 8 on node a, with B the
// field of the others. E does not change if all bodies are moved or turned together, so
// that forces and torques balance.
#pragma once

#include <array>
#include <vector>

#include "base/isa/instruction_set.h"
#include "structure/lattice/hexahedron.h"
#include "structure/magnetics/dipole_sum.h"
#include "structure/magnetics/source_field.h"

namespace magfsi::structure {

// Constants of an element's dipole.
struct DipoleElement {
    int element = 0;  // number in the mesh
    // Part of the nodal charges q_a that comes from this element
    std::array<double, 8> charge_a_m{};
    // Radius of its sphere: half of the shortest edge
    double radius_m = 0;
    double volume_m3 = 0;  // at rest
};

// Constants of the elements that are magnetised, in the mesh's order. magnetization_a_m:
// one vector per element [A/m]; throws std::invalid_argument on another number.
std::vector<DipoleElement> dipole_elements(const std::vector<Vec3>& nodes_m,
                                           const std::vector<Hexahedron>& elements,
                                           const std::vector<Vec3>& magnetization_a_m);

// A dipole at the present positions.
struct Dipole {
    Eigen::Vector3d centre_m, moment_a_m2;
};
// Dipole of an element. nodes: its nodes' indices in x, which has three values per node.
Dipole dipole_of(const DipoleElement& element, const std::array<int, 8>& nodes,
                 const double* x);

// All dipoles of a run, by number.
class Dipoles {
  public:
    // set: instruction set of the sum; the machine must have it.
    explicit Dipoles(InstructionSet set = choose_instruction_set());

    // New dipoles have no moment and no radius.
    void resize(std::size_t count);
    std::size_t size() const { return radius_.size(); }
    void set_radius(std::size_t i, double radius_m) { radius_[i] = radius_m; }
    // Sets centre and moment of a dipole.
    void set(std::size_t i, const Dipole& dipole);
    // Adds the field of the dipoles from, ..., to - 1 at dipole i, without its own.
    void add_field(std::size_t i, std::size_t from, std::size_t to,
                   FieldSample& sample) const;
    // The same with the nearest image of each dipole. period_m: length of the period
    // along each axis, 0 along axes without one.
    void add_field(std::size_t i, std::size_t from, std::size_t to, const Vec3& period_m,
                   FieldSample& sample);

  private:
    void add_sum(const std::array<std::vector<double>, 3>& x, std::size_t i,
                 std::size_t from, std::size_t to, FieldSample& sample) const;

    DipoleSumFunction function_;
    // Centres, moments and nearest images of the centres, each by axis and number
    std::array<std::vector<double>, 3> x_, m_, near_;
    std::vector<double> radius_;
};

// Field of the element's own sphere [T], whose energy within a body is that of the
// element.
Eigen::Vector3d own_field_t(const DipoleElement& element, const Dipole& dipole);

// Adds the forces [N] of an element's dipole in the field `sample` to f; returns its
// share of the energy [J], -1/2 m . B.
double add_dipole_forces(const DipoleElement& element, const std::array<int, 8>& nodes,
                         const Dipole& dipole, const FieldSample& sample, double* f);

}  // namespace magfsi::structure
