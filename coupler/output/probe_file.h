// SPDX-License-Identifier: GPL-2.0-or-later
// Time series as comma-separated values, complete after every row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupler/output/file.h"

namespace magfsi::output {

// Header "t[s]," and the columns, each named with its unit ("robot.com_x[m]"); then rows
// of numbers in their shortest form that reads back to the same double. No time stamps,
// no locale: two equal runs give equal bytes.
class ProbeFile {
  public:
    // Throws std::invalid_argument on a name that is empty, given twice, equal to "t[s]"
    // or holds a comma, a quote or a line break; FileError where the file cannot be
    // written.
    ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns);

    // After a restart: goes on with the file that is there and takes away its rows after
    // `until_s`, which are about to come again. Without a file, a new one. Throws
    // std::runtime_error when its columns are others.
    ProbeFile(const std::filesystem::path& path, std::vector<std::string> columns,
              double until_s);

    const std::vector<std::string>& columns() const { return columns_; }

    // One value a column. Throws std::invalid_argument on another count, FileError when
    // the disk is full; the file then still ends with the last complete row.
    void row(double time_s, std::span<const double> values);

    std::span<const double> last_row() const { return last_; }  // empty before the first

  private:
    std::vector<std::string> columns_;  // without t[s]
    std::vector<double> last_;
    File file_;
};

}  // namespace magfsi::output
