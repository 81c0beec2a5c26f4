// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/probe_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "coupler/output/file.h"

namespace magfsi::output {
namespace {

constexpr auto time_column = "t[s]";

// Returns the names or throws std::invalid_argument.
std::vector<std::string> checked(std::vector<std::string> columns) {
    std::set<std::string> seen{time_column};
    for (const auto& name : columns) {
        if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos)
            throw std::invalid_argument(
                fmt::format("probe column '{}': a name must not be empty nor hold a "
                            "comma, a quote or a line break",
                            name));
        if (!seen.insert(name).second)
            throw std::invalid_argument(
                fmt::format("probe column '{}' is there twice; names must differ", name));
    }
    return columns;
}

std::string header(const std::vector<std::string>& columns) {
    std::string line = time_column;
    for (const auto& name : columns) line += ',' + name;
    return line + '\n';
}

// The numbers of a row, the time first.
std::vector<double> numbers(const std::string& line) {
    std::vector<double> values;
    const char* at = line.c_str();
    for (char* end = nullptr;; at = end + 1) {
        values.push_back(std::strtod(at, &end));
        if (*end != ',') return values;
    }
}

// Rewrites the file with the header and the complete rows up to until_s, and returns the
// values of the last of them.
std::vector<double> cut(const std::filesystem::path& path, const std::string& head,
                        double until_s) {
    std::string kept = head;
    std::vector<double> last;
    if (std::ifstream in(path); in) {
        std::string line;
        std::getline(in, line);
        if (line + '\n' != head)
            throw std::runtime_error(fmt::format(
                "{}: other columns than those of this run; move the file away",
                path.string()));
        // A line without a line break at its end is incomplete.
        while (std::getline(in, line) && !in.eof()) {
            const auto row = numbers(line);
            if (row.front() > until_s) break;
            kept += line + '\n';
            last.assign(row.begin() + 1, row.end());
        }
    }
    write_atomically(path, kept);
    return last;
}

}  // namespace

ProbeFile::ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns)
    : columns_(checked(std::move(columns))), file_(path) {
    file_.write_record(header(columns_));
}

ProbeFile::ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns,
                     double until_s)
    : columns_(checked(std::move(columns))),
      last_(cut(path, header(columns_), until_s)),
      file_(path, Open::append) {}

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
