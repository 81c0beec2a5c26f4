// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/dipoles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

constexpr std::array<DipoleSumFunction, 3> sum_functions{
    &sse2::add_dipoles, &avx2::add_dipoles, &avx512::add_dipoles};

using Eigen::Vector3d;

}  // namespace

std::vector<DipoleElement> dipole_elements(const std::vector<Vec3>& nodes_m,
                                           const std::vector<Hexahedron>& elements,
                                           const std::vector<Vec3>& magnetization_a_m) {
    if (magnetization_a_m.size() != elements.size())
        refuse(
            "{} magnetisation vectors for {} elements found, one per element is needed",
            magnetization_a_m.size(), elements.size());
    std::vector<DipoleElement> out;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Vector3d magnetization(magnetization_a_m[e].data());
        if (magnetization.isZero(0)) continue;
        const Positions8 nodes = gather(nodes_m, elements[e]);
        const auto integrals = integrate_hexahedron(nodes, e);
        DipoleElement& one = out.emplace_back();
        one.element = e;
        for (int a = 0; a < 8; ++a)
            one.charge_a_m[a] = integrals.gradient.row(a).dot(magnetization);
        one.radius_m = 0.5 * std::ranges::min(element_edges(nodes).length_m);
        one.volume_m3 = integrals.volume;
    }
    return out;
}

Dipole dipole_of(const DipoleElement& element, const std::array<int, 8>& nodes,
                 const double* x) {
    // The charges sum to zero, so that the moment does not depend on the origin; the
    // first node as the origin avoids a loss of digits.
    const Eigen::Map<const Vector3d> first(x + 3L * nodes[0]);
    Dipole out{Vector3d::Zero(), Vector3d::Zero()};
    for (std::size_t a = 0; a < 8; ++a) {
        const Vector3d way = Eigen::Map<const Vector3d>(x + 3L * nodes[a]) - first;
        out.centre_m += 0.125 * way;
        out.moment_a_m2 += element.charge_a_m[a] * way;
    }
    out.centre_m += first;
    return out;
}

Dipoles::Dipoles(InstructionSet set) : function_(sum_functions[static_cast<int>(set)]) {}

void Dipoles::resize(std::size_t count) {
    for (std::size_t d = 0; d < 3; ++d) {
        x_[d].resize(count);
        m_[d].resize(count);
    }
    radius_.resize(count);
}

void Dipoles::set(std::size_t i, const Dipole& dipole) {
    for (std::size_t d = 0; d < 3; ++d) {
        x_[d][i] = dipole.centre_m[d];
        m_[d][i] = dipole.moment_a_m2[d];
    }
}

void Dipoles::add_field(std::size_t i, std::size_t from, std::size_t to,
                        FieldSample& sample) const {
    add_sum(x_, i, from, to, sample);
}

void Dipoles::add_field(std::size_t i, std::size_t from, std::size_t to,
                        const Vec3& period_m, FieldSample& sample) {
    for (std::size_t d = 0; d < 3; ++d) {
        near_[d] = x_[d];
        if (period_m[d] == 0) continue;
        const double here = x_[d][i];
        for (std::size_t j = from; j < to; ++j)
            near_[d][j] -= period_m[d] * std::nearbyint((x_[d][j] - here) / period_m[d]);
    }
    add_sum(near_, i, from, to, sample);
}

void Dipoles::add_sum(const std::array<std::vector<double>, 3>& x, std::size_t i,
                      std::size_t from, std::size_t to, FieldSample& sample) const {
    DipoleArrays arrays;
    for (std::size_t d = 0; d < 3; ++d) {
        arrays.x[d] = x[d].data();
        arrays.m[d] = m_[d].data();
    }
    arrays.radius = radius_.data();
    DipoleSum sum;
    function_(arrays, static_cast<int>(i), static_cast<int>(from), static_cast<int>(to),
              sum);
    const double* g = sum.gradient_t_m;
    Eigen::Matrix3d gradient;
    gradient << g[0], g[3], g[4], g[3], g[1], g[5], g[4], g[5], g[2];
    sample.field_t += Vector3d(sum.field_t);
    sample.gradient_t_m += gradient;
}

// A uniformly magnetised sphere has -mu0 M / 3 as its demagnetising field.
Vector3d own_field_t(const DipoleElement& element, const Dipole& dipole) {
    return (-4e-7 * std::numbers::pi / (3 * element.volume_m3)) * dipole.moment_a_m2;
}

double add_dipole_forces(const DipoleElement& element, const std::array<int, 8>& nodes,
                         const Dipole& dipole, const FieldSample& sample, double* f) {
    const Vector3d pull = 0.125 * (sample.gradient_t_m * dipole.moment_a_m2);
    for (std::size_t a = 0; a < 8; ++a)
        Eigen::Map<Vector3d>(f + 3L * nodes[a]) +=
            element.charge_a_m[a] * sample.field_t + pull;
    return -0.5 * dipole.moment_a_m2.dot(sample.field_t);
}

}  // namespace magfsi::structure
