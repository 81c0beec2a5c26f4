#include "structure/lattice/stable_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lattice/rest_stiffness.h"

namespace magfsi::structure {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

double largest_frequency_squared(const Positions8& x, const Body& body, int number) {
    const ElementReference reference = element_reference(x, body.element, number);
    Vector24 inverse_root_mass;
    for (int q = 0; q < 24; ++q) {
        const double mass = body.material.density_kg_m3 * reference.node_volume[q / 3];
        inverse_root_mass(q) = 1 / std::sqrt(mass);
    }
    const Matrix24 scaled = inverse_root_mass.asDiagonal() *
                            stiffness_at_rest(reference, body.material, x) *
                            inverse_root_mass.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(scaled, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(23);
}

}  // namespace

double stable_step_s(const Body& body) {
    if (!(body.material.density_kg_m3 > 0)) {
        throw std::invalid_argument(
            fmt::format("body {} has an effective density of {:g} kg/m3, it must be "
                        "positive (explicit "
                        "steps cannot carry a body that is lighter than its fluid)",
                        body.name, body.material.density_kg_m3));
    }
    double largest = 0;
    Positions8 solved = Positions8::Zero();  // shape of the element solved last
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        Positions8 x = gather(body.mesh.nodes, body.mesh.elements[e]);
        x.rowwise() -= x.row(0).eval();
        // Neighbours of one shape, as in a block of bricks, need only one solution.
        if ((x - solved).norm() <= 1e-9 * x.norm()) continue;
        solved = x;
        largest =
            std::max(largest, largest_frequency_squared(x, body, static_cast<int>(e)));
    }
    return 2 / std::sqrt(largest);
}

}  // namespace magfsi::structure
