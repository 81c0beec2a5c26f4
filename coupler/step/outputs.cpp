#include "coupler/step/outputs.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::coupler {

void Outputs::need(bool asked, std::string_view name) const {
    if (!asked || std::ranges::find(names_, name) != names_.end()) return;
    throw std::invalid_argument(
        fmt::format("{} is asked for, and this program was built without it", name));
}

void Outputs::begin() {
    for (const auto& output : all_) output->begin();
}

void Outputs::finish() {
    for (const auto& output : all_) output->finish();
}

const output::ProbeFile* Outputs::probes() const {
    for (const auto& output : all_) {
        if (const output::ProbeFile* file = output->probes()) return file;
    }
    return nullptr;
}

}  // namespace magfsi::coupler
