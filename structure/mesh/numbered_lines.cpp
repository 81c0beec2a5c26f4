#include "structure/mesh/numbered_lines.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace magfsi::structure {

NumberedLines::NumberedLines(std::string kind, const std::filesystem::path& file)
    : kind_(std::move(kind)), file_(file), stream_(file) {
    if (!stream_) {
        throw std::runtime_error(
            fmt::format("cannot open the {} {}", kind_, file.string()));
    }
}

std::istringstream NumberedLines::next(const std::string& expected) {
    std::string text;
    while (std::getline(stream_, text)) {
        ++number_;
        const auto first = text.find_first_not_of(" \t\r");
        if (first != std::string::npos && text[first] != '#') {
            return std::istringstream(text);
        }
    }
    fail(expected);
}

std::size_t NumberedLines::count(const std::string& keyword, std::size_t least) {
    const std::string expected =
        fmt::format("\"{} N\" with N of at least {}", keyword, least);
    std::istringstream fields = next(expected);
    std::string found;
    long long value = -1;
    if (!(fields >> found >> value) || found != keyword || value < 0 ||
        static_cast<std::size_t>(value) < least) {
        fail(expected);
    }
    return static_cast<std::size_t>(value);
}

std::vector<Vec3> NumberedLines::nodes(std::size_t least) {
    std::vector<Vec3> nodes_m(count("nodes", least));
    const char* expected = "three coordinates of a node";
    for (Vec3& x : nodes_m) {
        std::istringstream fields = next(expected);
        if (!(fields >> x[0] >> x[1] >> x[2])) fail(expected);
    }
    return nodes_m;
}

void NumberedLines::fail(const std::string& expected) const {
    throw std::runtime_error(fmt::format("{} {}, line {}: expected {}", kind_,
                                         file_.string(), number_, expected));
}

}  // namespace magfsi::structure
