// The planes between cells along one axis: uniform, or growing away from a part that is.
#pragma once

#include <array>
#include <vector>

namespace magfsi::openfoam {

struct UniformPart {
    double from_m = 0, to_m = 0;
    double growth = 1.1;  // largest ratio of neighbouring cells outside
};

// length_m is a whole number of spacings. The part is widened to whole spacings; outside,
// cells grow by one ratio a side, as few as fill the rest. Ascending, from 0 to length_m.
std::vector<double> axis_planes(double length_m, double spacing_m,
                                const UniformPart* uniform);

// The cell between the planes that holds the centre of each cell of the uniform grid.
std::vector<int> cell_of_uniform(const std::vector<double>& planes_m, double spacing_m);

}  // namespace magfsi::openfoam
