// SPDX-License-Identifier: GPL-2.0-or-later
// Time series as comma-separated values; the file is complete after every row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupler/output/file.h"

namespace magfsi::output {

// The file begins with a line of column names, "t[s]" and the given ones, each with its
// unit ("robot.com_x[m]"). Rows of numbers follow, each number as the shortest decimal
// that reads back to the same double. Without time stamps and independent of the locale,
// equal runs give equal bytes.
class ProbeFile {
  public:
    // Creates the file and writes the names. Throws std::invalid_argument for a name that
    // is empty, given twice, equal to "t[s]" or contains a comma, a quote or a line
    // break; FileError if the file cannot be written.
    ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns);

    // Continues the file of a run that was restarted at until_s [s]: rows after that time
    // are removed, since they will be written again. Creates the file if there is none.
    // Throws std::runtime_error if the file has other columns.
    ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns,
              double until_s);

    const std::vector<std::string>& columns() const { return columns_; }

    // Appends a row with one value per column. Throws std::invalid_argument for another
    // number of values, FileError if the disk is full; the file then still ends with the
    // last complete row.
    void row(double time_s, std::span<const double> values);

    // Values of the last row; empty if the file has no row.
    std::span<const double> last_row() const { return last_; }

  private:
    std::vector<std::string> columns_;  // names without "t[s]"
    std::vector<double> last_;
    File file_;
};

}  // namespace magfsi::output
