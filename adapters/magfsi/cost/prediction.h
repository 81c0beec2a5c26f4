// What a scene will cost on this machine.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "adapters/magfsi/cost/calibration.h"
#include "adapters/magfsi/cost/work.h"

namespace magfsi::launch {

struct Prediction {
    std::optional<double> wall_s;  // of the steps; nothing for unknown motion to rest
    bool experienced = false;      // it took that long before
    std::optional<double> structure_s, fluid_s, exchange_s;  // its parts
    double structure_bytes = 0, fluid_bytes = 0;             // memory of all ranks
    double disk_bytes = 0;                                   // fields and probes
};

Prediction predict(const Work& work, const Calibration& calibration);

// Nothing without a calibration, and with OpenFOAM.
std::optional<Prediction> prediction(const scene::Scene& scene, const Ranks& ranks);

// With wall_s (null where there is none), memory_bytes by participant, disk_bytes.
nlohmann::ordered_json to_json(const Prediction& prediction);

// For explain: the prediction, or how to get one.
std::string explain_cost(const scene::Scene& scene, const Ranks& ranks);

}  // namespace magfsi::launch
