// SPDX-License-Identifier: GPL-2.0-or-later
// The order of faces that OpenFOAM requires is made by visiting them in that order: inner
// faces by owner and neighbour, then the sides one after the other. Points, faces, fluxes
// and places all come from the same visits.
#include "adapters/solvers/openfoam/engine/box_mesh.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "DynamicList.H"
#include "cyclicPolyPatch.H"
#include "face.H"
#include "pointField.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

namespace magfsi::openfoam {

const std::array<const char*, 6> side_names = {"x_min", "x_max", "y_min",
                                               "y_max", "z_min", "z_max"};

namespace {

using Index = std::array<int, 3>;

// Number of cells of this rank's slab along each axis.
Index slab_cells(const BoxMesh& box) {
    Index cells{};
    for (std::size_t d = 0; d < 3; ++d)
        cells[d] = static_cast<int>(box.planes_m[d].size()) - 1;
    const std::size_t rank = box.rank;
    cells[box.cut_axis] = box.first_cell[rank + 1] - box.first_cell[rank];
    return cells;
}

// Numbering of cells and points of this rank's slab, x fastest.
class Slab {
  public:
    explicit Slab(const BoxMesh& box) : box_(box), cells_(slab_cells(box)) {
        const std::size_t cut = box.cut_axis;
        first_[cut] = box.first_cell[box.rank];
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

    // The face between cell i and its lower neighbour along the axis. Its normal, by the
    // right-hand rule over its corners, points up or down the axis.
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
        return box_.planes_m[axis][first_[axis] + i];
    }

    const BoxMesh& box_;
    Index cells_{}, first_{};
};

// Callback for a face: the index of the cell above it along its axis (which may lie
// outside the slab), the axis, and whether its normal points up the axis.
using VisitFace = std::function<void(const Index&, int axis, bool upwards)>;

template <class Visit>
void for_each_cell(const Index& lo, const Index& hi, Visit&& visit) {
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) visit(Index{i, j, k});
}

// Visits the inner faces ordered by owner, then by neighbour, as OpenFOAM requires (upper
// triangular order).
void visit_inner(const Index& cells, const VisitFace& visit) {
    for_each_cell({}, cells, [&](const Index& i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Index next = i;
            if (++next[axis] < cells[axis]) visit(next, static_cast<int>(axis), true);
        }
    });
}

// Visits the faces of one side of the slab. Normals point out of the slab.
void visit_side(const Index& cells, int side, const VisitFace& visit) {
    const std::size_t axis = side / 2;
    const bool upper = side % 2 == 1;
    Index lo{}, hi = cells;
    (upper ? lo[axis] : hi[axis]) = upper ? hi[axis] - 1 : 1;
    for_each_cell(lo, hi, [&](const Index& i) {
        Index at = i;
        if (upper) ++at[axis];
        visit(at, side / 2, upper);
    });
}

// Neighbour beyond a side of this rank's slab.
struct Meeting {
    int neighbor = -1;   // rank; -1: none, the side is one of the box
    bool wraps = false;  // the neighbour lies across a periodic side
};

// The box is cut along one axis, so that only the two sides across it can meet other
// ranks.
Meeting meeting(const BoxMesh& box, int side) {
    const int ranks = static_cast<int>(box.first_cell.size()) - 1;
    if (side / 2 != box.cut_axis || ranks == 1) return {};
    const int next = box.rank + (side % 2 == 0 ? -1 : 1);
    if (next >= 0 && next < ranks) return {next, false};
    const bool periodic = box.sides[side] == SideType::periodic;
    return periodic ? Meeting{(next + ranks) % ranks, true} : Meeting{};
}

// Order of the slab's sides in the mesh's list of faces: those of the box first, then
// those towards other ranks. Two ranks on a periodic axis meet at both sides; OpenFOAM
// requires the non-periodic one first.
std::vector<int> side_order(const BoxMesh& box) {
    std::vector<int> order(6);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        const auto rank = [&](int side) {
            const Meeting m = meeting(box, side);
            return m.neighbor < 0 ? 0 : m.wraps ? 2 : 1;
        };
        return rank(a) < rank(b);
    });
    return order;
}

// Visits all faces of this rank in the order of their numbers.
void visit_faces(const BoxMesh& box, const VisitFace& visit) {
    const Index cells = slab_cells(box);
    visit_inner(cells, visit);
    for (const int side : side_order(box)) visit_side(cells, side, visit);
}

// Points and faces of this rank's slab in OpenFOAM's order.
struct BoxFaces {
    Foam::pointField points;
    Foam::DynamicList<Foam::face> faces;      // inner faces, then side by side
    Foam::DynamicList<Foam::label> owner;     // cell of each face
    Foam::DynamicList<Foam::label> neighbor;  // second cell of each inner face
    Foam::label inner = 0;                    // number of faces between two cells
    Foam::label of_side[6] = {};              // number of faces of each side
};

// The owner of an inner face is the cell below it, which has the smaller number; of a
// boundary face its only cell.
BoxFaces make_faces(const BoxMesh& box) {
    const Slab slab(box);
    BoxFaces out;
    out.points = slab.points();
    visit_faces(box, [&](const Index& i, int axis, bool upwards) {
        const std::size_t d = axis;
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

// OpenFOAM's type of a patch; periodic sides get their own class (cyclicPolyPatch).
const char* type_name(SideType type) {
    switch (type) {
        case SideType::wall:
            return "wall";
        case SideType::symmetry:
            return "symmetryPlane";
        case SideType::open:
        case SideType::periodic:
            break;
    }
    return "patch";
}

// Patches of this rank's mesh: those of the six sides, which every rank has in the same
// order, some of them empty, then those towards other ranks.
class Patches {
  public:
    Patches(const BoxMesh& box, BoxFaces& faces, const Foam::fvMesh& mesh)
        : box_(box), faces_(faces), mesh_(mesh), next_face_(faces.inner) {}

    Foam::List<Foam::polyPatch*> make() {
        for (int side = 0; side < 6; ++side) add_side(side);
        for (const int side : side_order(box_)) add_neighbor(side);
        return Foam::List<Foam::polyPatch*>(made_.begin(), made_.end());
    }

  private:
    // A side that meets another rank leaves an empty patch, since every rank must have
    // the same patches of the box.
    void add_side(int side) {
        const bool here = meeting(box_, side).neighbor < 0;
        const Foam::label size = here ? faces_.of_side[side] : 0;
        const auto type = box_.sides[side];
        const Foam::word name(side_names[side]);
        const auto& boundary = mesh_.boundaryMesh();
        if (type == SideType::periodic) {
            const Foam::word other(side_names[side ^ 1]);
            made_.push_back(new Foam::cyclicPolyPatch(
                name, size, next_face_, index(), boundary, other,
                Foam::coupledPolyPatch::UNKNOWN, Foam::Zero, Foam::Zero, Foam::Zero));
        } else {
            made_.push_back(Foam::polyPatch::New(type_name(type), name, size, next_face_,
                                                 index(), boundary)
                                .ptr());
        }
        next_face_ += size;
    }

    // A neighbour across a periodic side needs a patch that refers to the cyclic patch it
    // belongs to.
    void add_neighbor(int side) {
        const Meeting m = meeting(box_, side);
        if (m.neighbor < 0) return;
        const Foam::label size = faces_.of_side[side];
        const auto& boundary = mesh_.boundaryMesh();
        if (m.wraps) {
            made_.push_back(new Foam::processorCyclicPolyPatch(
                size, next_face_, index(), boundary, box_.rank, m.neighbor,
                side_names[side]));
        } else {
            made_.push_back(new Foam::processorPolyPatch(
                size, next_face_, index(), boundary, box_.rank, m.neighbor));
        }
        next_face_ += size;
    }

    Foam::label index() const { return static_cast<Foam::label>(made_.size()); }

    const BoxMesh& box_;
    const BoxFaces& faces_;
    const Foam::fvMesh& mesh_;
    Foam::label next_face_;
    std::vector<Foam::polyPatch*> made_;
};

}  // namespace

// Patches are added after the mesh is made, since they refer to it.
Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box) {
    BoxFaces faces = make_faces(box);
    // READ_IF_PRESENT makes fvMesh read fvSchemes and fvSolution; mesh files do not
    // exist.
    Foam::autoPtr<Foam::fvMesh> mesh(new Foam::fvMesh(
        Foam::IOobject(Foam::fvMesh::defaultRegion, time.constant(), time,
                       Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE),
        std::move(faces.points), Foam::faceList(std::move(faces.faces)),
        Foam::labelList(std::move(faces.owner)),
        Foam::labelList(std::move(faces.neighbor))));
    Foam::List<Foam::polyPatch*> patches = Patches(box, faces, mesh()).make();
    mesh->addFvPatches(patches);
    return mesh;
}

// The boundary of a mesh that was read is that of its files.
Foam::autoPtr<Foam::fvMesh> read_mesh(const Foam::Time& time) {
    return Foam::autoPtr<Foam::fvMesh>(new Foam::fvMesh(Foam::IOobject(
        Foam::fvMesh::defaultRegion, time.timeName(), time, Foam::IOobject::MUST_READ)));
}

void take_face_flux(const Foam::surfaceScalarField& phi, std::vector<double>& out) {
    out.assign(phi.primitiveField().begin(), phi.primitiveField().end());
    for (Foam::label p = 0; p < phi.boundaryField().size(); ++p)
        out.insert(out.end(), phi.boundaryField()[p].begin(),
                   phi.boundaryField()[p].end());
}

void put_face_flux(const std::vector<double>& from, Foam::surfaceScalarField& phi) {
    auto next = from.begin();
    for (Foam::scalar& value : phi.primitiveFieldRef()) value = *next++;
    for (Foam::label p = 0; p < phi.boundaryField().size(); ++p)
        for (Foam::scalar& value : phi.boundaryFieldRef()[p]) value = *next++;
}

namespace {

// Calls visit(place, value) for the flux through every face of this rank, inner faces
// first. Field is the boundary field of phi, const or not.
template <class Field, class Inside, class Visit>
void for_each_face(Field& phi, Inside& inside, const std::vector<FacePlace>& places,
                   Visit&& visit) {
    for (Foam::label f = 0; f < inside.size(); ++f) visit(places[f], inside[f]);
    for (Foam::label p = 0; p < phi.size(); ++p) {
        auto& values = phi[p];
        const Foam::label first = values.patch().start();
        for (Foam::label f = 0; f < values.size(); ++f)
            visit(places[first + f], values[f]);
    }
}

}  // namespace

// flux[axis] has one layer of faces more than cells along that axis.
std::vector<FacePlace> face_places(const BoxMesh& box) {
    std::vector<FacePlace> places;
    visit_faces(box, [&](const Index& i, int axis, bool upwards) {
        Index layers = slab_cells(box);
        ++layers[axis];
        places.push_back(
            {axis, upwards ? 1 : -1,
             static_cast<std::size_t>(i[0] + layers[0] * (i[1] + layers[1] * i[2]))});
    });
    return places;
}

// Shared faces between ranks are stored on both of them, with the same sign along the
// axis.
void take_flux(const Foam::surfaceScalarField& phi, const std::vector<FacePlace>& places,
               FlowState& out) {
    std::array<std::size_t, 3> size{};
    for (const FacePlace& place : places) {
        auto& most = size[place.axis];
        most = std::max(most, place.index + 1);
    }
    for (std::size_t d = 0; d < 3; ++d) out.flux[d].resize(size[d]);
    for_each_face(phi.boundaryField(), phi.primitiveField(), places,
                  [&](const FacePlace& place, double value) {
                      out.flux[place.axis][place.index] = place.sign * value;
                  });
}

void put_flux(const FlowState& state, const std::vector<FacePlace>& places,
              Foam::surfaceScalarField& phi) {
    for_each_face(phi.boundaryFieldRef(), phi.primitiveFieldRef(), places,
                  [&](const FacePlace& place, double& value) {
                      value = place.sign * state.flux[place.axis][place.index];
                  });
}

}  // namespace magfsi::openfoam
