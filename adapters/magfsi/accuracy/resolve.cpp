#include "adapters/magfsi/accuracy/choose.h"
#include "adapters/magfsi/cost/prediction.h"
#include "adapters/scene/reader.h"

namespace magfsi::launch {

std::optional<Choice> resolve_accuracy(const std::filesystem::path& scene,
                                       const std::vector<std::string>& overrides,
                                       const Ranks& ranks) {
    const auto unresolved = scene::read_unresolved(scene, overrides);
    if (!unresolved) return std::nullopt;
    const auto with = [&](const std::vector<std::string>& settings) {
        std::vector<std::string> all = overrides;
        all.insert(all.end(), settings.begin(), settings.end());
        all.emplace_back("accuracy=null");
        return all;
    };
    const WallTime wall_s =
        [&](const std::vector<std::string>& settings) -> std::optional<double> {
        const auto candidate = scene::read_scene(scene, with(settings));
        const auto cost = prediction(candidate, choose_ranks(candidate, ranks));
        return cost ? cost->wall_s : std::nullopt;
    };
    Choice choice = choose(*unresolved, wall_s);
    choice.settings = with(choice.settings);
    choice.settings.erase(
        choice.settings.begin(),
        choice.settings.begin() + static_cast<std::ptrdiff_t>(overrides.size()));
    return choice;
}

}  // namespace magfsi::launch
