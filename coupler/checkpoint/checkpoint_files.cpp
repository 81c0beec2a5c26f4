#include "coupler/checkpoint/checkpoint_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <set>
#include <string>

namespace magfsi::coupler {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = "checkpoint_";

// use(file, step) for each file of a checkpoint, also one that is half-written.
template <class Use>
void each_file(const fs::path& folder, Use&& use) {
    if (!fs::is_directory(folder)) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (const auto step = step_in_name(entry.path())) use(entry.path(), *step);
    }
}

bool has_its_name(const fs::path& file) {
    return file.extension() == ".h5";
}

}  // namespace

fs::path checkpoint_file(const fs::path& folder, std::int64_t step, Role role) {
    return folder / fmt::format("{}{:010d}_{}.h5", prefix, step, to_string(role));
}

std::optional<std::int64_t> step_in_name(const fs::path& file) {
    const std::string name = file.filename().string();
    if (!name.starts_with(prefix)) return {};
    std::int64_t step = 0;
    const char* const end = name.data() + name.size();
    const auto [at, error] = std::from_chars(name.data() + prefix.size(), end, step);
    if (error != std::errc() || at == end || *at != '_' || step < 0) return {};
    return step;
}

std::vector<std::int64_t> steps_found(const fs::path& folder) {
    std::set<std::int64_t, std::greater<>> steps;
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (has_its_name(file)) steps.insert(step);
    });
    return {steps.begin(), steps.end()};
}

std::vector<std::int64_t> steps_complete(const fs::path& folder,
                                         const std::vector<Role>& roles) {
    std::vector<std::int64_t> steps = steps_found(folder);
    std::erase_if(steps, [&](std::int64_t step) {
        return !std::ranges::all_of(roles, [&](Role role) {
            return fs::exists(checkpoint_file(folder, step, role));
        });
    });
    return steps;
}

void prune_checkpoints(const fs::path& folder, const std::vector<Role>& roles) {
    const auto complete = steps_complete(folder, roles);
    if (complete.size() <= checkpoints_kept) return;
    const std::int64_t oldest = complete[checkpoints_kept - 1];
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (step < oldest) fs::remove(file);
    });
}

void clear_checkpoints_after(const fs::path& folder, std::int64_t newest) {
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (step > newest || !has_its_name(file)) fs::remove(file);
    });
}

}  // namespace magfsi::coupler
