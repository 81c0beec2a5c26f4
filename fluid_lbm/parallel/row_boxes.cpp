#include "fluid_lbm/parallel/row_boxes.h"

#include <algorithm>

namespace magfsi::fluid {

namespace {

// What is left after the rows at cut sides; a single row between two cuts is at both.
RowBox inner(const RowLayout& layout) {
    const auto cut = [](Beyond beyond) { return beyond == Beyond::neighbor ? 1 : 0; };
    RowBox box{cut(layout.beyond_y[0]), layout.ny - cut(layout.beyond_y[1]),
               cut(layout.beyond_z[0]), layout.nz - cut(layout.beyond_z[1])};
    box.y_end = std::max(box.y_end, box.y_begin);
    box.z_end = std::max(box.z_end, box.z_begin);
    return box;
}

std::vector<RowBox> without_empty(std::vector<RowBox> boxes) {
    std::erase_if(boxes, [](const RowBox& box) { return box.size() == 0; });
    return boxes;
}

}  // namespace

std::vector<RowBox> rows_at_cuts(const RowLayout& layout) {
    const RowBox in = inner(layout);
    return without_empty({{0, layout.ny, 0, in.z_begin},
                          {0, layout.ny, in.z_end, layout.nz},
                          {0, in.y_begin, in.z_begin, in.z_end},
                          {in.y_end, layout.ny, in.z_begin, in.z_end}});
}

std::vector<RowBox> inner_rows(const RowLayout& layout) {
    const RowBox in = inner(layout);
    if (in.size() == layout.ny * layout.nz) return {in};  // nothing to exchange
    const int middle = (in.z_begin + in.z_end) / 2;
    return without_empty({{in.y_begin, in.y_end, in.z_begin, middle},
                          {in.y_begin, in.y_end, middle, in.z_end}});
}

}  // namespace magfsi::fluid
