#include "adapters/openfoam/engine/box_mesh.h"

#include "adapters/openfoam/engine/box_faces.h"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

namespace magfsi::openfoam {

const std::array<const char*, 6> side_names = {"x_min", "x_max", "y_min",
                                               "y_max", "z_min", "z_max"};

namespace {

// What a side of this rank's slab meets.
struct Meeting {
    int neighbor = -1;  // rank; -1: the box's side itself
    bool wraps = false;
};

Meeting meeting(const BoxMesh& box, int side) {
    const int ranks = static_cast<int>(box.first_cell.size()) - 1;
    if (side / 2 != box.cut_axis || ranks == 1) return {};
    const int next = box.rank + (side % 2 == 0 ? -1 : 1);
    if (next >= 0 && next < ranks) return {next, false};
    const bool periodic = box.sides[static_cast<std::size_t>(side)] == SideType::periodic;
    return periodic ? Meeting{(next + ranks) % ranks, true} : Meeting{};
}

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

// The patches of the box's sides, which every rank has in the same order, then those
// towards other ranks.
class Patches {
  public:
    Patches(const BoxMesh& box, BoxFaces& faces, const Foam::fvMesh& mesh)
        : box_(box), faces_(faces), mesh_(mesh), next_face_(faces.inner) {}

    Foam::List<Foam::polyPatch*> make() {
        for (int side = 0; side < 6; ++side) add_side(side);
        for (const bool wraps : {false, true}) {
            for (int side = 0; side < 6; ++side) add_neighbor(side, wraps);
        }
        return Foam::List<Foam::polyPatch*>(made_.begin(), made_.end());
    }

  private:
    void add_side(int side) {
        const bool here = meeting(box_, side).neighbor < 0;
        const Foam::label size = here ? faces_.of_side[side] : 0;
        const auto type = box_.sides[static_cast<std::size_t>(side)];
        const Foam::word name(side_names[static_cast<std::size_t>(side)]);
        const auto& boundary = mesh_.boundaryMesh();
        if (type == SideType::periodic) {
            const Foam::word other(side_names[static_cast<std::size_t>(side ^ 1)]);
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

    // Two ranks on a periodic axis meet twice; OpenFOAM wants the plain meeting first.
    void add_neighbor(int side, bool wraps) {
        const Meeting m = meeting(box_, side);
        if (m.neighbor < 0 || m.wraps != wraps) return;
        const Foam::label size = faces_.of_side[side];
        const auto& boundary = mesh_.boundaryMesh();
        if (wraps) {
            made_.push_back(new Foam::processorCyclicPolyPatch(
                size, next_face_, index(), boundary, box_.rank, m.neighbor,
                side_names[static_cast<std::size_t>(side)]));
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

// As Patches has them.
std::vector<int> side_order(const BoxMesh& box) {
    std::vector<int> order;
    for (int side = 0; side < 6; ++side)
        if (meeting(box, side).neighbor < 0) order.push_back(side);
    for (const bool wraps : {false, true}) {
        for (int side = 0; side < 6; ++side) {
            const Meeting m = meeting(box, side);
            if (m.neighbor >= 0 && m.wraps == wraps) order.push_back(side);
        }
    }
    return order;
}

Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box) {
    BoxFaces faces = make_faces(box, side_order(box));
    // Read if present: so that fvSchemes and fvSolution are; there are no files of a
    // mesh.
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

}  // namespace magfsi::openfoam
