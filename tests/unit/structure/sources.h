// SPDX-License-Identifier: GPL-2.0-or-later
// A source of the field at a place, and its field at a point.
#pragma once

#include <utility>
#include <vector>

#include "structure/magnetics/source_field.h"

namespace magfsi::structure {

inline FieldSource source(SourceShape shape, const Vec3& position_m = {}) {
    FieldSource out;
    out.shape = std::move(shape);
    out.position_m = position_m;
    return out;
}

inline FieldSample at(const std::vector<FieldSource>& sources, const Vec3& point_m,
                      double time_s = 0) {
    SourceField field(sources);
    field.set_time(time_s);
    return field.sample(point_m);
}

}  // namespace magfsi::structure
