// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of magfsi run after its job has ended: traces, the page.
#pragma once

#include <filesystem>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Merges the files trace_*.json of the ranks in the run folder into one trace.json,
// sorted by name, and removes them. Does nothing if there are none.
void merge_traces(const std::filesystem::path& out);

// Starts the Python program that writes report.html, at a low priority, and returns
// without waiting for it. Starts nothing if the scene switches the page off or if
// MAGFSI_PAGE is not "yes": ./magfsi sets it for runs of a person, while tests, studies
// and searches leave it unset.
void start_page(const scene::Scene& scene, const std::filesystem::path& out);

}  // namespace magfsi::launch
