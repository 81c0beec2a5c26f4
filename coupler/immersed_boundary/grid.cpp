// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/grid.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace magfsi::coupler {

namespace {

[[noreturn]] void refuse_repetition() {
    throw std::invalid_argument(
        "coupling.scheme: implicit repeats steps, and this fluid cannot go back to the "
        "start of one; take serial, or fluid.solver: lbm");
}

}  // namespace

std::string to_text(const Grid& grid) {
    nlohmann::json ranks = nlohmann::json::array();
    for (const auto& boxes : grid.owned_by_rank) {
        nlohmann::json of_rank = nlohmann::json::array();
        for (const CellBox& box : boxes) of_rank.push_back({box.lo, box.hi});
        ranks.push_back(of_rank);
    }
    nlohmann::json solid = nlohmann::json::array();
    for (const GridRow& r : grid.solid) solid.push_back({r.y, r.z, r.x_begin, r.x_end});
    return nlohmann::json{
        {"spacing_m", grid.spacing_m},
        {"cells", grid.cells},
        {"periodic", grid.periodic},
        {"boxes_by_rank", ranks},
        {"follows", grid.follows},
        {"renewal", {grid.renewal.every, grid.renewal.ahead, grid.renewal.margin_cells}},
        {"solid", solid}}
        .dump();
}

Grid grid_from_text(const std::string& text) {
    const auto json = nlohmann::json::parse(text);
    Grid grid;
    grid.spacing_m = json.at("spacing_m");
    grid.cells = json.at("cells");
    grid.periodic = json.at("periodic");
    if (json.contains("boxes_by_rank")) {
        for (const auto& boxes : json.at("boxes_by_rank")) {
            grid.owned_by_rank.emplace_back();
            for (const auto& box : boxes)
                grid.owned_by_rank.back().push_back({box.at(0), box.at(1)});
        }
    } else {  // a record of an older version
        for (const auto& box : json.at("owned_by_rank"))
            grid.owned_by_rank.push_back({{box.at(0), box.at(1)}});
    }
    if (json.contains("follows")) {  // absent in older records
        grid.follows = json.at("follows");
        const auto& renewal = json.at("renewal");
        grid.renewal = {renewal.at(0), renewal.at(1), renewal.at(2)};
    }
    for (const auto& row : json.at("solid"))
        grid.solid.push_back({row.at(0), row.at(1), row.at(2), row.at(3)});
    return grid;
}

void GridFluid::keep() {
    refuse_repetition();
}
void GridFluid::go_back() {
    refuse_repetition();
}

}  // namespace magfsi::coupler
