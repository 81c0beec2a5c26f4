#include "adapters/openfoam/engine/box_faces.h"

namespace magfsi::openfoam {

namespace {

using Index = std::array<int, 3>;

// Cells and points of this rank's slab.
class Slab {
  public:
    explicit Slab(const BoxMesh& box) : box_(box), cells_(slab_cells(box)) {
        const auto cut = static_cast<std::size_t>(box.cut_axis);
        first_[cut] = box.first_cell[static_cast<std::size_t>(box.rank)];
    }

    const Index& cells() const { return cells_; }
    Foam::label cell(const Index& i) const {
        return i[0] + cells_[0] * (i[1] + cells_[1] * i[2]);
    }
    Foam::label point(const Index& i) const {
        return i[0] + (cells_[0] + 1) * (i[1] + (cells_[1] + 1) * i[2]);
    }

    Foam::pointField points() const {
        Foam::pointField points((cells_[0] + 1) * (cells_[1] + 1) * (cells_[2] + 1));
        for (int k = 0; k <= cells_[2]; ++k)
            for (int j = 0; j <= cells_[1]; ++j)
                for (int i = 0; i <= cells_[0]; ++i)
                    points[point({i, j, k})] = {place(0, i), place(1, j), place(2, k)};
        return points;
    }

    // The face below cell i along an axis, its normal upwards or downwards.
    Foam::face face(Index i, std::size_t axis, bool upwards) const {
        const std::size_t a = (axis + 1) % 3;
        const std::size_t b = (axis + 2) % 3;
        Foam::face corners(4);
        corners[0] = point(i);
        ++i[a];
        corners[upwards ? 1 : 3] = point(i);
        ++i[b];
        corners[2] = point(i);
        --i[a];
        corners[upwards ? 3 : 1] = point(i);
        return corners;
    }

  private:
    double place(std::size_t axis, int i) const {
        return box_.planes_m[axis][static_cast<std::size_t>(first_[axis] + i)];
    }

    const BoxMesh& box_;
    Index cells_{}, first_{};
};

template <class Visit>
void for_each_cell(const Index& lo, const Index& hi, Visit&& visit) {
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) visit(Index{i, j, k});
}

// By owner, then by neighbour: the upper triangle, row by row.
void visit_inner(const Index& cells, const VisitFace& visit) {
    for_each_cell({}, cells, [&](const Index& i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Index next = i;
            if (++next[axis] < cells[axis]) visit(next, static_cast<int>(axis), true);
        }
    });
}

void visit_side(const Index& cells, int side, const VisitFace& visit) {
    const auto axis = static_cast<std::size_t>(side / 2);
    const bool upper = side % 2 == 1;
    Index lo{}, hi = cells;
    (upper ? lo[axis] : hi[axis]) = upper ? hi[axis] - 1 : 1;
    for_each_cell(lo, hi, [&](const Index& i) {
        Index at = i;
        if (upper) ++at[axis];
        visit(at, side / 2, upper);
    });
}

}  // namespace

std::array<int, 3> slab_cells(const BoxMesh& box) {
    std::array<int, 3> cells{};
    for (std::size_t d = 0; d < 3; ++d)
        cells[d] = static_cast<int>(box.planes_m[d].size()) - 1;
    const auto rank = static_cast<std::size_t>(box.rank);
    cells[static_cast<std::size_t>(box.cut_axis)] =
        box.first_cell[rank + 1] - box.first_cell[rank];
    return cells;
}

void visit_faces(const BoxMesh& box, const std::vector<int>& side_order,
                 const VisitFace& visit) {
    const Index cells = slab_cells(box);
    visit_inner(cells, visit);
    for (const int side : side_order) visit_side(cells, side, visit);
}

BoxFaces make_faces(const BoxMesh& box, const std::vector<int>& side_order) {
    const Slab slab(box);
    BoxFaces out;
    out.points = slab.points();
    visit_faces(box, side_order, [&](const Index& i, int axis, bool upwards) {
        const auto d = static_cast<std::size_t>(axis);
        const bool inner = i[d] > 0 && i[d] < slab.cells()[d];
        Index below = i;
        --below[d];
        out.faces.append(slab.face(i, d, upwards));
        out.owner.append(slab.cell(upwards ? below : i));
        if (inner)
            out.neighbor.append(slab.cell(i));
        else
            ++out.of_side[2 * axis + (upwards ? 1 : 0)];
    });
    out.inner = out.neighbor.size();
    return out;
}

}  // namespace magfsi::openfoam
