// How one file of the run folder names another, so that the folder can be moved.
#pragma once

#include <filesystem>
#include <string>

namespace magfsi::output {

// `file` as seen from the folder of `index`; both as this process would open them.
std::string relative_to(const std::filesystem::path& file,
                        const std::filesystem::path& index);

}  // namespace magfsi::output
