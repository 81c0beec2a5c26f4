#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "adapters/magfsi/accuracy/cover.h"
#include "adapters/magfsi/accuracy/study_rows.h"

namespace magfsi::launch {

namespace {

constexpr const char* study = "taylor_green_reynolds";
// The studied step falls with the square of the spacing: U dt / L = this / n^2.
constexpr double step_times_cells_squared = 1.62974662;
constexpr const char* studied_reynolds[] = {"50", "100", "200"};

[[noreturn]] void not_covered(const std::string& found, const std::string& allowed) {
    throw NotCovered{study, found, allowed};
}

double cells(const StudyRow& row) {
    return number_in(row, "cells[1]");
}

const char* collision_name(const scene::Fluid& fluid) {
    switch (fluid.collision) {
        case scene::Collision::bgk:
            not_covered("fluid.collision: bgk", "automatic, trt, recursive_regularized");
        case scene::Collision::trt:
            return "trt";
        default:
            // What automatic takes at the relaxation times of this study.
            return "recursive_regularized";
    }
}

ErrorLaw law_at(const std::string& reynolds, const scene::Fluid& fluid) {
    return fit_law(runs_where(
        study_rows(study),
        {{"reynolds[1]", reynolds}, {"collision", collision_name(fluid)}}, cells));
}

// Between two studied Reynolds numbers, the logarithm of the error is a straight line in
// that of the Reynolds number.
ErrorLaw interpolated_law(double reynolds, const scene::Fluid& fluid) {
    std::size_t upper = 1;
    while (upper + 1 < std::size(studied_reynolds) &&
           std::atof(studied_reynolds[upper]) < reynolds)
        ++upper;
    const ErrorLaw a = law_at(studied_reynolds[upper - 1], fluid);
    const ErrorLaw b = law_at(studied_reynolds[upper], fluid);
    const double low = std::atof(studied_reynolds[upper - 1]);
    const double part =
        std::log(reynolds / low) / std::log(std::atof(studied_reynolds[upper]) / low);
    ErrorLaw law = a;
    law.constant = a.constant * std::pow(b.constant / a.constant, part);
    law.order = a.order + part * (b.order - a.order);
    return law;
}

// So that the probes' rows fall on steps.
double whole_step_s(double most_s, const scene::Scene& scene) {
    const double span_s = scene.probes ? scene.probes->every_s : scene.time.end_s;
    return span_s / std::ceil(span_s / most_s * (1 - 1e-9));
}

void check(const scene::Scene& scene) {
    if (!scene.bodies.empty() || !scene.fluid->obstacles.empty())
        not_covered("bodies or obstacles in the vortex", "the fluid alone");
    if (scene.fluid->solver != scene::FluidSolver::lbm ||
        scene.fluid->precision != scene::Precision::double_)
        not_covered("another solver or precision", "solver: lbm, precision: double");
    if (scene.time.step_s)
        not_covered("time.step", "no time.step: it is chosen with the spacing");
}

}  // namespace

std::optional<Cover> cover_taylor_green(const scene::Unresolved& unresolved) {
    const scene::Scene& scene = unresolved.scene;
    if (!unresolved.spacing || !scene.fluid->taylor_green) return std::nullopt;
    check(scene);
    const double side_m = scene.fluid->box_m[0];
    const double speed = scene.fluid->taylor_green->speed_m_s;
    const double reynolds =
        speed * side_m / (2 * std::numbers::pi * scene.fluid->viscosity_m2_s);
    if (reynolds < std::atof(studied_reynolds[0]) * 0.999 ||
        reynolds > std::atof(studied_reynolds[2]) * 1.001) {
        not_covered(fmt::format("the Reynolds number {:.4g} on 1 / k", reynolds),
                    fmt::format("{} to {}", studied_reynolds[0], studied_reynolds[2]));
    }
    Cover cover;
    cover.study = study;
    cover.because = fmt::format("Taylor-Green vortices at Reynolds number {} to {}",
                                studied_reynolds[0], studied_reynolds[2]);
    cover.error_of = "the kinetic energy over six times 1 / (k U), root mean square";
    cover.resolution = "cells along the cube";
    cover.law = interpolated_law(reynolds, *scene.fluid);
    for (double n = cover.law.coarsest; n <= cover.law.finest; n += 2)
        cover.resolutions.push_back(n);
    cover.settings = [scene, side_m, speed](double n) {
        const double step_s = step_times_cells_squared * side_m / (speed * n * n);
        return std::vector<std::string>{
            fmt::format("fluid.spacing={:.12g} mm", 1e3 * side_m / n),
            fmt::format("time.step={:.15g} s", whole_step_s(step_s, scene))};
    };
    return cover;
}

}  // namespace magfsi::launch
