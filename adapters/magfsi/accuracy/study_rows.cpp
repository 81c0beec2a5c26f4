#include "adapters/magfsi/accuracy/study_rows.h"

#include <algorithm>
#include <cstdlib>

#include "adapters/scene/split.h"
#include "shipped_studies.h"  // made by CMake from docs/accuracy/*/runs.csv

namespace magfsi::launch {

std::vector<StudyRow> parse_rows(std::string_view csv) {
    std::vector<StudyRow> rows;
    std::vector<std::string> names;
    while (!csv.empty()) {
        const auto end = std::min(csv.find('\n'), csv.size());
        // Without quotes within: the texts that hold commas come last in a row.
        const auto cells = scene::split(csv.substr(0, end), ',');
        csv.remove_prefix(std::min(end + 1, csv.size()));
        if (names.empty()) {
            names = cells;
            continue;
        }
        if (cells.size() < 2) continue;
        StudyRow row;
        for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i)
            row[names[i]] = cells[i];
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<StudyRow> study_rows(std::string_view name) {
    for (const auto& [study, csv] : shipped_studies) {
        if (study == name) return parse_rows(csv);
    }
    return {};
}

double number_in(const StudyRow& row, const std::string& column) {
    const auto found = row.find(column);
    return found == row.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

std::vector<StudiedRun> runs_where(const std::vector<StudyRow>& rows,
                                   const std::map<std::string, std::string>& values,
                                   double (*resolution)(const StudyRow&),
                                   const std::string& error_column) {
    std::vector<StudiedRun> runs;
    for (const StudyRow& row : rows) {
        const bool alike = std::ranges::all_of(values, [&](const auto& wanted) {
            const auto found = row.find(wanted.first);
            return found != row.end() && found->second == wanted.second;
        });
        const double error = number_in(row, error_column);
        if (alike && error > 0) runs.push_back({resolution(row), error});
    }
    return runs;
}

}  // namespace magfsi::launch
