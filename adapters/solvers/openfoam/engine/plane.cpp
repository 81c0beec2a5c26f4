// SPDX-License-Identifier: GPL-2.0-or-later
// The flow is that through the faces between cells with their centres on either side of
// the plane: by continuity it is the same through every such surface, and through the
// plane, to the tolerance of the pressure. Momentum and pressure are sums over the cells
// that the plane cuts, from their centres along the axis by the gradients, of second
// order.
#include "adapters/solvers/openfoam/engine/plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "PstreamReduceOps.H"
#include "fvcGrad.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

namespace magfsi::openfoam {

namespace {

// Part of a face's area vector [m2] along `axis` that lies at or below `at`. Its polygon
// is clipped edge by edge, and the shoelace formula is taken in the plane of the two
// other axes, right-handed.
double area_below(const Foam::face& corners, const Foam::pointField& points,
                  Foam::direction axis, double at) {
    const Foam::direction a = (axis + 1) % 3;
    const Foam::direction b = (axis + 2) % 3;
    double twice = 0;
    Foam::point first, last;
    bool begun = false;
    const auto add = [&](const Foam::point& p) {
        if (begun)
            twice += last[a] * p[b] - p[a] * last[b];
        else
            first = p;
        last = p;
        begun = true;
    };
    for (Foam::label i = 0; i < corners.size(); ++i) {
        const Foam::point& here = points[corners[i]];
        const Foam::point& next = points[corners.nextLabel(i)];
        if (here[axis] <= at) add(here);
        if ((here[axis] <= at) == (next[axis] <= at)) continue;
        const double s = (at - here[axis]) / (next[axis] - here[axis]);
        add(here + s * (next - here));
    }
    if (begun) add(first);
    return twice / 2;
}

// Area [m2] of each cell's cut with the plane: what closes the part of its surface below.
std::vector<double> cuts(const Foam::fvMesh& mesh, Foam::direction axis, double at) {
    std::vector<double> area(mesh.nCells(), 0.0);
    const Foam::faceList& faces = mesh.faces();
    for (Foam::label f = 0; f < faces.size(); ++f) {
        const double below = area_below(faces[f], mesh.points(), axis, at);
        area[mesh.faceOwner()[f]] -= below;
        if (f < mesh.nInternalFaces()) area[mesh.faceNeighbour()[f]] += below;
    }
    return area;
}

// Faces between two ranks within the box, not across a periodic side.
bool is_between_ranks(const Foam::polyPatch& patch) {
    return Foam::isA<Foam::processorPolyPatch>(patch) &&
           !Foam::isA<Foam::processorCyclicPolyPatch>(patch);
}

// Flow [m3/s] of this rank through the faces between cells below and above the plane.
// `below` has 1 in cells below, else 0, and the neighbours' values between ranks.
double flow_between(const Foam::volScalarField& below,
                    const Foam::surfaceScalarField& flux) {
    const Foam::fvMesh& mesh = below.mesh();
    double flow = 0;
    for (Foam::label f = 0; f < mesh.nInternalFaces(); ++f)
        flow += flux[f] * (below[mesh.faceOwner()[f]] - below[mesh.faceNeighbour()[f]]);
    for (Foam::label p = 0; p < mesh.boundary().size(); ++p) {
        const Foam::fvPatch& patch = mesh.boundary()[p];
        if (!is_between_ranks(patch.patch())) continue;
        const Foam::scalarField mine(below.boundaryField()[p].patchInternalField());
        const Foam::scalarField other(below.boundaryField()[p].patchNeighbourField());
        // Both ranks have the face; the one that is below counts it.
        for (Foam::label f = 0; f < patch.size(); ++f)
            flow += flux.boundaryField()[p][f] * mine[f] * (1 - other[f]);
    }
    return flow;
}

// Flow [m3/s] of this rank along the axis through the faces in the box's side at `end_m`.
double flow_through_side(const Foam::surfaceScalarField& flux, Foam::direction axis,
                         double end_m, double length_m) {
    constexpr double rounding = 1e-9;  // of the box's length
    double flow = 0;
    for (Foam::label p = 0; p < flux.boundaryField().size(); ++p) {
        const Foam::fvPatch& patch = flux.mesh().boundary()[p];
        if (is_between_ranks(patch.patch())) continue;
        for (Foam::label f = 0; f < patch.size(); ++f) {
            if (std::abs(patch.Cf()[f][axis] - end_m) > rounding * length_m) continue;
            flow += flux.boundaryField()[p][f];  // out of the box
        }
    }
    return end_m > 0 ? flow : -flow;
}

double sum_over_ranks(double value) {
    Foam::reduce(value, Foam::sumOp<Foam::scalar>());
    return value;
}

}  // namespace

PlaneSums plane_sums(const Foam::volVectorField& velocity,
                     const Foam::volScalarField& pressure,
                     const Foam::surfaceScalarField& flux, int axis_number, double at_m,
                     double length_m) {
    const Foam::fvMesh& mesh = velocity.mesh();
    const auto axis = static_cast<Foam::direction>(axis_number);
    // In the side itself the plane would cut no cell.
    const double at = std::min(at_m, length_m * (1 - 1e-9));
    Foam::volScalarField below(Foam::IOobject("belowPlane", mesh.time().timeName(), mesh),
                               mesh, Foam::dimensionedScalar(Foam::dimless, Foam::Zero));
    for (Foam::label c = 0; c < mesh.nCells(); ++c) below[c] = mesh.C()[c][axis] <= at;
    below.correctBoundaryConditions();
    const double lower = sum_over_ranks(Foam::sum(below.primitiveField()));
    const double upper = sum_over_ranks(mesh.nCells()) - lower;
    PlaneSums sums;
    sums.flow =
        sum_over_ranks(lower == 0   ? flow_through_side(flux, axis, 0, length_m)
                       : upper == 0 ? flow_through_side(flux, axis, length_m, length_m)
                                    : flow_between(below, flux));

    const Foam::tmp<Foam::volTensorField> slopes = Foam::fvc::grad(velocity);
    const Foam::tmp<Foam::volVectorField> slope = Foam::fvc::grad(pressure);
    const std::vector<double> area = cuts(mesh, axis, at);
    for (Foam::label c = 0; c < mesh.nCells(); ++c) {
        const double cut = area[c];
        if (cut == 0) continue;
        const double away = at - mesh.C()[c][axis];
        Foam::vector along(Foam::Zero);
        along[axis] = away;
        const Foam::vector u = velocity[c] + (along & slopes()[c]);
        for (Foam::direction d = 0; d < 3; ++d) sums.momentum[d] += cut * u[axis] * u[d];
        sums.pressure += cut * (pressure[c] + (along & slope()[c]));
        sums.area += cut;
    }
    for (double* value : {&sums.momentum[0], &sums.momentum[1], &sums.momentum[2],
                          &sums.pressure, &sums.area})
        *value = sum_over_ranks(*value);
    return sums;
}

}  // namespace magfsi::openfoam
