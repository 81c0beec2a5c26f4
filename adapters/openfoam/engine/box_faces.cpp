#include "adapters/openfoam/engine/box_faces.h"

namespace magfsi::openfoam {

namespace {

using Index = std::array<int, 3>;

// Cells and points of this rank's slab.
class Slab {
  public:
    explicit Slab(const BoxMesh& box) : box_(box) {
        for (std::size_t d = 0; d < 3; ++d)
            cells_[d] = static_cast<int>(box.planes_m[d].size()) - 1;
        const auto cut = static_cast<std::size_t>(box.cut_axis);
        const auto rank = static_cast<std::size_t>(box.rank);
        first_[cut] = box.first_cell[rank];
        cells_[cut] = box.first_cell[rank + 1] - first_[cut];
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
void add_inner(const Slab& slab, BoxFaces& out) {
    for_each_cell({}, slab.cells(), [&](const Index& i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Index next = i;
            if (++next[axis] == slab.cells()[axis]) continue;
            out.faces.append(slab.face(next, axis, true));
            out.owner.append(slab.cell(i));
            out.neighbor.append(slab.cell(next));
        }
    });
    out.inner = out.faces.size();
}

void add_side(const Slab& slab, int side, BoxFaces& out) {
    const auto axis = static_cast<std::size_t>(side / 2);
    const bool upper = side % 2 == 1;
    Index lo{}, hi = slab.cells();
    (upper ? lo[axis] : hi[axis]) = upper ? hi[axis] - 1 : 1;
    const Foam::label before = out.faces.size();
    for_each_cell(lo, hi, [&](const Index& i) {
        Index at = i;
        if (upper) ++at[axis];
        out.faces.append(slab.face(at, axis, upper));
        out.owner.append(slab.cell(i));
    });
    out.of_side[side] = out.faces.size() - before;
}

}  // namespace

BoxFaces make_faces(const BoxMesh& box, const std::vector<int>& side_order) {
    const Slab slab(box);
    BoxFaces out;
    out.points = slab.points();
    add_inner(slab, out);
    for (const int side : side_order) add_side(slab, side, out);
    return out;
}

}  // namespace magfsi::openfoam
