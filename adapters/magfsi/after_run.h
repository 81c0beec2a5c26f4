// SPDX-License-Identifier: GPL-2.0-or-later
// What magfsi run does when its job has ended.
#pragma once

#include <filesystem>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// One trace.json of the files that the ranks have left.
void merge_traces(const std::filesystem::path& out);

// Starts what writes report.html, at a low priority, and does not wait for it: the
// run has ended. Only for a person's run: ./magfsi says so by MAGFSI_PAGE=yes, which
// tests, studies and searches do not.
void start_page(const scene::Scene& scene, const std::filesystem::path& out);

}  // namespace magfsi::launch
