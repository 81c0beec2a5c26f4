// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/wall_of_planes.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "coupler/immersed_boundary/marker_stencil.h"

namespace magfsi::bodies {

namespace {

using Complex = std::complex<double>;
constexpr Complex im{0, 1};

// Positions of the planes relative to the grid over which the thickness is averaged.
constexpr int places_in_grid = 10;

// Admissible distances of neighbouring planes.
struct Range {
    double closest, widest;
};
constexpr Range range(int count) {
    return count == 2 ? Range{fitted::closest_of_two, fitted::widest_of_two}
                      : Range{fitted::closest_of_more, fitted::widest_apart};
}
// Number of planes from which on the depth of the outer ones hardly depends on the
// number, except on whether it is even.
constexpr int many = 7;

}  // namespace

WallOfPlanes::WallOfPlanes(double viscosity, coupler::Kernel kernel, double stokes_layer)
    : kernel_(kernel),
      viscosity_(viscosity),
      frequency_(2 * viscosity / (stokes_layer * stokes_layer)),
      waves_{} {}

WallOfPlanes::WallOfPlanes(coupler::Kernel kernel, double relaxation_time,
                           double magic_number, double stokes_layer)
    : WallOfPlanes((relaxation_time - 0.5) / 3, kernel, stokes_layer) {
    for (int n = 0; n < cells; ++n)
        waves_[n] = wave(2 * std::numbers::pi * n / cells, relaxation_time, magic_number);
}

// The viscosity does not matter, since times are counted by the oscillation.
WallOfPlanes WallOfPlanes::of_finite_volumes(coupler::Kernel kernel,
                                             double stokes_layer) {
    WallOfPlanes wall(1.0, kernel, stokes_layer);
    for (int n = 0; n < cells; ++n) {
        const double k = 2 * std::numbers::pi * n / cells;
        wall.waves_[n] = 1.0 / (im * wall.frequency_ + 2 * (1 - std::cos(k)));
    }
    return wall;
}

// Amplitude of the velocity q = U + F dt / (2 rho) over that of the force, for the wave
// exp(i k z) at frequency_. The populations that carry the shear are lumped by their
// velocity along z: 0, +1, -1, with 2/3, 1/6, 1/6 of the momentum in equilibrium. They
// have three modes: momentum, the odd moment of third order and the stress, the last two
// relaxed with the odd and the even rate. The linear system is that of one fluid step,
// collision and then streaming, for populations that vary as exp(i frequency_ t).
Complex WallOfPlanes::wave(double k, double relaxation_time, double magic_number) const {
    const double even = 1 / relaxation_time;
    const double odd = 1 / (magic_number / (relaxation_time - 0.5) + 0.5);
    const Eigen::RowVector3d momentum(1, 1, 1), third(0, 1, 1), stress(0, 1, -1);
    const Eigen::RowVector3d third_after = (1 - odd) * third + odd / 3 * momentum;
    const Eigen::RowVector3d stress_after = (1 - even) * stress;
    Eigen::Matrix3d after;
    after << momentum - third_after, (third_after + stress_after) / 2,
        (third_after - stress_after) / 2;
    const double third_forced = odd / 6 + (1 - odd / 2) / 3;
    const Eigen::Vector3d forced(1 - third_forced, third_forced / 2, third_forced / 2);
    const Eigen::DiagonalMatrix<Complex, 3> stream(1, std::exp(-im * k),
                                                   std::exp(im * k));
    Eigen::Matrix3cd system = -(stream * after.cast<Complex>());
    system.diagonal().array() += std::exp(im * frequency_);
    return system.partialPivLu().solve(stream * forced.cast<Complex>()).sum() + 0.5;
}

// Force on the planes at these coordinates z that makes all of them oscillate with the
// velocity V, over rho i omega V: the complex thickness of the fluid that moves with
// them, Stokes layers included.
Complex WallOfPlanes::moved(const std::vector<double>& places) const {
    const Eigen::Index planes = places.size();
    Eigen::MatrixXcd spread(planes, cells);
    for (Eigen::Index p = 0; p < planes; ++p) {
        coupler::Stencil1D s;
        coupler::set_stencil(s, kernel_, places[p]);
        for (int n = 0; n < cells; ++n) {
            spread(p, n) = 0;
            for (int j = 0; j < s.count; ++j)
                spread(p, n) +=
                    s.weight[j] * std::exp(-2 * std::numbers::pi * n / cells * im *
                                           static_cast<double>(s.first + j));
        }
    }
    const Eigen::Map<const Eigen::VectorXcd> response(waves_.data(), cells);
    const Eigen::MatrixXcd felt =
        spread.conjugate() * response.asDiagonal() * spread.transpose() / cells;
    const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(planes);
    return felt.partialPivLu().solve(ones).sum() / (im * frequency_);
}

// The Stokes layers on the two sides of a body, 2 sqrt(nu / (i omega)), are subtracted.
double WallOfPlanes::thickness(const EvenPlanes& planes) const {
    const Complex outside = 2.0 * std::sqrt(viscosity_ / (im * frequency_));
    double sum = 0;
    for (int place = 0; place < places_in_grid; ++place) {
        std::vector<double> at;
        for (int p = 0; p < planes.count; ++p)
            at.push_back(0.5 * cells + (p - 0.5 * (planes.count - 1)) * planes.apart +
                         static_cast<double>(place) / places_in_grid);
        sum += (moved(at) - outside).real();
    }
    return sum / places_in_grid;
}

// Mean over an odd and an even number of planes of half the excess of their thickness.
double WallOfPlanes::depth(double apart) const {
    const auto of = [&](int count) {
        return 0.5 * (thickness({count, apart}) - (count - 1) * apart);
    };
    return 0.5 * (of(many) + of(many + 1));
}

// Tries growing numbers of planes and finds the distance of each number by bisection; the
// thickness grows with the distance.
EvenPlanes WallOfPlanes::for_body(double thickness_wanted) const {
    const auto of = [&](const EvenPlanes& planes) {
        return planes.count < many
                   ? thickness(planes)
                   : (planes.count - 1) * planes.apart + 2 * depth(planes.apart);
    };
    EvenPlanes best{1, 1};
    double best_error = std::abs(of(best) - thickness_wanted);
    if (thickness_wanted < of(best) + fitted::thinner_is_better) return best;
    // Upper bound of the part of a body outside of its outer planes, both sides together.
    const double outside = 2.2;
    const int fewest = (thickness_wanted - outside) / fitted::widest_apart;
    for (int count = std::max(2, fewest);; ++count) {
        auto [low, high] = range(count);
        const double least = of({count, low});
        for (int halving = 0; halving < 20; ++halving) {
            const double middle = 0.5 * (low + high);
            (of({count, middle}) < thickness_wanted ? low : high) = middle;
        }
        const EvenPlanes found{count, 0.5 * (low + high)};
        const double error = std::abs(of(found) - thickness_wanted);
        if (error < best_error) {
            best = found;
            best_error = error;
        }
        if (best_error < 1e-3 || least > thickness_wanted) return best;
    }
}

}  // namespace magfsi::bodies
