#include "coupler/output/probe_file.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>
#include <utility>

#include "coupler/output/number.h"

namespace magfsi::output {
namespace {

constexpr auto time_column = "t[s]";

std::vector<std::string> checked(std::vector<std::string> columns) {
    std::set<std::string> seen{time_column};
    for (const auto& name : columns) {
        if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos)
            throw std::invalid_argument(fmt::format(
                "probe column '{}': a name must not be empty nor hold a comma, "
                "a quote or a line break",
                name));
        if (!seen.insert(name).second)
            throw std::invalid_argument(
                fmt::format("probe column '{}' is there twice; names must differ", name));
    }
    return columns;
}

}  // namespace

ProbeFile::ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns)
    : columns_(checked(std::move(columns))), file_(path) {
    std::string header = time_column;
    for (const auto& name : columns_) header += ',' + name;
    file_.write_record(header + '\n');
}

void ProbeFile::row(double time_s, std::span<const double> values) {
    if (values.size() != columns_.size())
        throw std::invalid_argument(
            fmt::format("{}: a row of {} values was given, but there are {} columns",
                        file_.path().string(), values.size(), columns_.size()));
    std::string line = to_text(time_s);
    for (const double value : values) line += ',' + to_text(value);
    file_.write_record(line + '\n');
    last_.assign(values.begin(), values.end());
}

}  // namespace magfsi::output
