// What a scene will cost on this machine.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "adapters/magfsi/cost/calibration.h"
#include "adapters/magfsi/cost/work.h"

namespace magfsi::launch {

struct Prediction {
    std::optional<double> wall_s;  // of the steps; nothing for unknown motion to rest
    std::optional<double> structure_s, fluid_s, exchange_s;  // its parts
    double structure_bytes = 0, fluid_bytes = 0;             // memory of all ranks
    double disk_bytes = 0;                                   // fields and probes
};

Prediction predict(const Work& work, const Calibration& calibration);

// The same work on other ranks.
Work on_ranks(Work work, const Ranks& ranks);

// The ranks, up to a core each, on which this will take clearly less time; nothing where
// there are none. Memory decides nothing here.
std::optional<std::pair<Ranks, Prediction>> faster_ranks(const scene::Scene& scene,
                                                         const Ranks& ranks);

// Nothing without a calibration, and with OpenFOAM.
std::optional<Prediction> prediction(const scene::Scene& scene, const Ranks& ranks);

// With wall_s (null where there is none), memory_bytes by participant, disk_bytes.
nlohmann::ordered_json to_json(const Prediction& prediction);

// For explain: the prediction, or how to get one.
std::string explain_cost(const scene::Scene& scene, const Ranks& ranks);

}  // namespace magfsi::launch
