#include "coupler/output/relative_path.h"

namespace magfsi::output {

std::string relative_to(const std::filesystem::path& file,
                        const std::filesystem::path& index) {
    const auto full = std::filesystem::absolute(file).lexically_normal();
    const auto folder = std::filesystem::absolute(index).lexically_normal().parent_path();
    return full.lexically_relative(folder).generic_string();
}

}  // namespace magfsi::output
