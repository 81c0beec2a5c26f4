#include "adapters/openfoam/engine/flow_state.h"

#include <algorithm>

#include "adapters/openfoam/engine/box_faces.h"

namespace magfsi::openfoam {

namespace {

// Calls visit(face, place, value) for every face of this rank; Field is phi or const phi.
template <class Field, class Inside, class Visit>
void for_each_face(Field& phi, Inside& inside, const std::vector<FacePlace>& places,
                   Visit&& visit) {
    for (Foam::label f = 0; f < inside.size(); ++f)
        visit(places[static_cast<std::size_t>(f)], inside[f]);
    for (Foam::label p = 0; p < phi.size(); ++p) {
        auto& values = phi[p];
        const Foam::label first = values.patch().start();
        for (Foam::label f = 0; f < values.size(); ++f)
            visit(places[static_cast<std::size_t>(first + f)], values[f]);
    }
}

}  // namespace

std::vector<FacePlace> face_places(const BoxMesh& box,
                                   const std::vector<int>& side_order) {
    const std::array<int, 3> n = slab_cells(box);
    std::vector<FacePlace> places;
    visit_faces(
        box, side_order, [&](const std::array<int, 3>& i, int axis, bool upwards) {
            const auto d = static_cast<std::size_t>(axis);
            std::array<std::size_t, 3> layers{};
            for (std::size_t a = 0; a < 3; ++a)
                layers[a] = static_cast<std::size_t>(n[a]) + (a == d ? 1 : 0);
            const auto at = [&](std::size_t a) { return static_cast<std::size_t>(i[a]); };
            places.push_back({axis, upwards ? 1 : -1,
                              at(0) + layers[0] * (at(1) + layers[1] * at(2))});
        });
    return places;
}

void take_flux(const Foam::surfaceScalarField& phi, const std::vector<FacePlace>& places,
               FlowState& out) {
    std::array<std::size_t, 3> size{};
    for (const FacePlace& place : places) {
        auto& most = size[static_cast<std::size_t>(place.axis)];
        most = std::max(most, place.index + 1);
    }
    for (std::size_t d = 0; d < 3; ++d) out.flux[d].resize(size[d]);
    for_each_face(phi.boundaryField(), phi.primitiveField(), places,
                  [&](const FacePlace& place, double value) {
                      out.flux[static_cast<std::size_t>(place.axis)][place.index] =
                          place.sign * value;
                  });
}

void put_flux(const FlowState& state, const std::vector<FacePlace>& places,
              Foam::surfaceScalarField& phi) {
    for_each_face(phi.boundaryFieldRef(), phi.primitiveFieldRef(), places,
                  [&](const FacePlace& place, double& value) {
                      value =
                          place.sign *
                          state.flux[static_cast<std::size_t>(place.axis)][place.index];
                  });
}

}  // namespace magfsi::openfoam
