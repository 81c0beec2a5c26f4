// Sides with a prescribed velocity: half-way bounce-back gains 6 w rho0 c.u on each
// population that enters (Ladd 1994), rho0 = 1. The sum over a face is rho0 u.n exactly:
// the mass flux is the prescribed one.
#pragma once

#include <vector>

#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

class VelocityInlet {
  public:
    // side_cells: this rank's cells at the side, local indices; periodic: of the box.
    VelocityInlet(const LatticeSide& side, int side_index, const CellBox& side_cells,
                  const CellBox& owned, const std::array<int, 3>& box_cells,
                  const std::array<bool, 3>& periodic);

    // After the exchange; the velocity is that at the given time (steps).
    void apply(const Populations& populations, const RowLayout& layout, double time);

  private:
    int index(const Cell& local) const;
    void find_open();
    void follow_course(double time);
    Vec3 slope(const Cell& local, int axis) const;
    template <class Real>
    void add(const PopulationRows<Real>& rows, const RowLayout& layout,
             double factor) const;

    LatticeSide side_;
    int side_index_;
    CellBox cells_;
    std::array<int, 3> origin_, box_cells_;
    std::array<bool, 3> periodic_;
    std::array<int, 2> in_plane_;  // axes
    int stride_ = 0;
    // With a margin of one cell around the rank's part of the side.
    std::vector<Vec3> velocity_;
    std::vector<char> open_;
    struct Sampled {
        int at;       // in velocity_
        Cell global;  // where it is
    };
    std::vector<Sampled> sampled_;  // all that are open
    std::vector<Cell> open_cells_;  // this rank's, local indices
};

}  // namespace magfsi::fluid
