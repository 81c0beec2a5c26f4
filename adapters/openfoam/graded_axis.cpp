#include "adapters/openfoam/graded_axis.h"

#include <algorithm>
#include <cmath>

namespace magfsi::openfoam {

namespace {

// Sum of growth^1 to growth^cells.
double reach(double growth, int cells) {
    double sum = 0, width = 1;
    for (int i = 0; i < cells; ++i) sum += width *= growth;
    return sum;
}

// Widths, in spacings, that fill `gap` spacings, the finest first.
std::vector<double> growing(double gap, double most_growth) {
    std::vector<double> widths;
    if (gap < 0.5) return widths;  // a whole number: none
    int cells = 1;
    while (reach(most_growth, cells) < gap) ++cells;
    cells = std::min(cells, static_cast<int>(std::lround(gap)));
    double low = 1, high = most_growth;
    for (int i = 0; i < 60; ++i) {  // to the last bit
        const double middle = (low + high) / 2;
        (reach(middle, cells) < gap ? low : high) = middle;
    }
    double width = 1;
    for (int i = 0; i < cells; ++i) widths.push_back(width *= high);
    const double stretch = gap / reach(high, cells);
    for (double& w : widths) w *= stretch;
    return widths;
}

}  // namespace

std::vector<double> axis_planes(double length_m, double spacing_m,
                                const UniformPart* uniform) {
    const auto cells = static_cast<int>(std::lround(length_m / spacing_m));
    int from = 0, to = cells;
    constexpr double rounding = 1e-6;  // of a cell
    if (uniform) {
        from = static_cast<int>(std::floor(uniform->from_m / spacing_m + rounding));
        to = static_cast<int>(std::ceil(uniform->to_m / spacing_m - rounding));
    }
    std::vector<double> below, planes;
    if (from > 0) below = growing(from, uniform->growth);
    double at = from;
    for (const double width : below) planes.push_back((at -= width) * spacing_m);
    std::reverse(planes.begin(), planes.end());
    for (int i = from; i <= to; ++i) planes.push_back(i * spacing_m);
    at = to;
    if (to < cells) {
        for (const double width : growing(cells - to, uniform->growth))
            planes.push_back((at += width) * spacing_m);
    }
    planes.front() = 0;
    planes.back() = length_m;
    return planes;
}

std::vector<int> cell_of_uniform(const std::vector<double>& planes_m, double spacing_m) {
    const auto cells = std::lround(planes_m.back() / spacing_m);
    std::vector<int> cell(static_cast<std::size_t>(cells));
    int at = 0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const double centre = (static_cast<double>(i) + 0.5) * spacing_m;
        while (planes_m[static_cast<std::size_t>(at) + 1] < centre) ++at;
        cell[i] = at;
    }
    return cell;
}

}  // namespace magfsi::openfoam
