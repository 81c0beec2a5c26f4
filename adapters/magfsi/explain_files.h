// SPDX-License-Identifier: GPL-2.0-or-later
// What was read from the files that a scene names: a file in another unit is seen here.
#pragma once

#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

std::string explain_files(const scene::Scene& scene);

}  // namespace magfsi::launch
