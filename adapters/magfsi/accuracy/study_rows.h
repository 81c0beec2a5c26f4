// The rows of the studies of docs/accuracy, which are built into the program.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/magfsi/accuracy/law.h"

namespace magfsi::launch {

using StudyRow = std::map<std::string, std::string>;  // by column, as runs.csv names it

// Of runs.csv of docs/accuracy/NAME; none if there is no such study.
std::vector<StudyRow> study_rows(std::string_view name);

std::vector<StudyRow> parse_rows(std::string_view csv);

// The rows that completed and have these values in these columns, as runs.
std::vector<StudiedRun> runs_where(const std::vector<StudyRow>& rows,
                                   const std::map<std::string, std::string>& values,
                                   double (*resolution)(const StudyRow&),
                                   const std::string& error_column = "error[1]");

double number_in(const StudyRow& row, const std::string& column);

}  // namespace magfsi::launch
