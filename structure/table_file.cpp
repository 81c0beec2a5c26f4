// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/table_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> out;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        out.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    return out;
}

class TableReader {
  public:
    TableReader(std::string_view what, const std::filesystem::path& file,
                std::span<const ColumnKind> known, TableStyle style)
        : what_(what), file_(file), known_(known), style_(style), stream_(file) {
        if (!stream_) refuse("cannot open the {} {}", what, file.string());
    }

    std::vector<std::vector<double>> columns(
        const std::vector<std::string_view>& needed) {
        std::string line;
        if (!next(line)) {
            fail(fmt::format("no header found, such as \"{}\"", fmt::join(names(), ",")));
        }
        std::vector<std::vector<double>> out(known_.size());
        const bool under_percent = !exported_header_.empty() && starts_a_number(line);
        for (const std::string_view field :
             fields_of(under_percent ? exported_header_ : line))
            add_column(field);
        check_columns(under_percent ? exported_header_ : line, needed);
        if (under_percent) add_row(line, out);
        while (next(line)) add_row(line, out);
        if (std::ranges::all_of(out, [](const auto& column) { return column.empty(); })) {
            fail("no row found, at least one is needed");
        }
        return out;
    }

  private:
    struct Column {
        std::size_t known = 0;
        ColumnUnit unit{};
    };

    std::vector<std::string> names() const {
        std::vector<std::string> out;
        for (const ColumnKind& kind : known_)
            out.push_back(fmt::format("{}[{}]", kind.name, kind.units.front().text));
        return out;
    }

    bool next(std::string& line) {
        while (std::getline(stream_, line)) {
            ++number_;
            const std::string_view text = trimmed(line);
            if (text.empty() || text[0] == '#') continue;
            if (style_ == TableStyle::strict || text[0] != '%') return true;
            exported_header_ = trimmed(text.substr(1));
            if (constexpr std::string_view says = "Length unit:";
                exported_header_.starts_with(says))
                length_unit_ = trimmed(std::string_view(exported_header_).substr(12));
        }
        return false;
    }
    static bool starts_a_number(std::string_view line) {
        return trimmed(line).find_first_of("0123456789+-.") == 0;
    }

    // What other programs write, in our way: name[unit].
    std::string ours(std::string_view field) const {
        const auto bracket = field.find_first_of("([");
        std::string name(trimmed(field.substr(0, bracket)));
        name.erase(0, name.rfind('.') + 1);
        if (name == "X" || name == "Y" || name == "Z") name[0] += 'x' - 'X';
        std::string unit;
        if (bracket != std::string_view::npos) {
            const auto end = field.find_first_of(")]", bracket);
            unit = field.substr(bracket + 1, end - bracket - 1);
        }
        const auto kind = std::ranges::find(known_, name, &ColumnKind::name);
        if (unit.empty() && kind != known_.end()) unit = kind->units.front().text;
        const bool length = unit == "m" && bracket == std::string_view::npos;
        return fmt::format("{}[{}]", name,
                           length && !length_unit_.empty() ? length_unit_ : unit);
    }

    void add_column(std::string_view as_written) {
        const std::string field(style_ == TableStyle::strict ? std::string(as_written)
                                                             : ours(as_written));
        const auto bracket = field.find('[');
        const auto kind =
            std::ranges::find(known_, field.substr(0, bracket), &ColumnKind::name);
        if (kind == known_.end() && style_ == TableStyle::exported) {
            columns_.push_back({known_.size()});
            return;
        }
        if (kind == known_.end()) {
            std::vector<std::string_view> all;
            for (const ColumnKind& one : known_) all.push_back(one.name);
            fail(fmt::format(
                "column \"{}\" found, {} are allowed, each with its unit, like {}", field,
                fmt::join(all, ", "), names().front()));
        }
        const std::string unit =
            bracket == std::string::npos ? "" : field.substr(bracket);
        std::vector<std::string> allowed;
        for (const ColumnUnit& one : kind->units) {
            // A plain number has none.
            allowed.push_back(one.text.empty() ? "" : fmt::format("[{}]", one.text));
            if (unit != allowed.back()) continue;
            const auto place = static_cast<std::size_t>(kind - known_.begin());
            if (std::ranges::find(columns_, place, &Column::known) != columns_.end())
                fail(fmt::format("column {} found twice", kind->name));
            columns_.push_back({place, one});
            return;
        }
        fail(fmt::format("column \"{}\" found with the unit \"{}\"; {} are allowed",
                         field, unit, fmt::join(allowed, ", ")));
    }

    void check_columns(const std::string& header,
                       const std::vector<std::string_view>& needed) const {
        std::vector<std::string_view> others;
        std::size_t needed_there = 0, others_there = 0;
        for (std::size_t k = 0; k < known_.size(); ++k) {
            const bool is_needed =
                std::ranges::find(needed, known_[k].name) != needed.end();
            const bool there =
                std::ranges::find(columns_, k, &Column::known) != columns_.end();
            if (!is_needed) others.push_back(known_[k].name);
            (is_needed ? needed_there : others_there) += there ? 1 : 0;
        }
        if (needed_there != needed.size()) {
            fail(fmt::format("header \"{}\" found; the columns {} are needed", header,
                             fmt::join(needed, ", ")));
        }
        if (others_there != 0 && others_there != others.size()) {
            fail(fmt::format("header \"{}\" found; all or none of {} are needed", header,
                             fmt::join(others, ", ")));
        }
    }

    void add_row(std::string_view line, std::vector<std::vector<double>>& out) const {
        const auto fields = fields_of(line);
        if (fields.size() != columns_.size()) {
            fail(fmt::format("{} values found, {} are needed", fields.size(),
                             columns_.size()));
        }
        for (std::size_t c = 0; c < fields.size(); ++c) {
            if (columns_[c].known == known_.size()) continue;
            const ColumnUnit& unit = columns_[c].unit;
            out[columns_[c].known].push_back(number(fields[c]) * unit.times / unit.over);
        }
    }

    double number(std::string_view text) const {
        double value = 0;
        const char* end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc{} || last != end || !std::isfinite(value)) {
            fail(fmt::format("\"{}\" found, a finite number is needed", text));
        }
        return value;
    }

    [[noreturn]] void fail(const std::string& why) const {
        refuse("{} {}, line {}: {}", what_, file_.string(), number_, why);
    }

    std::string_view what_;
    const std::filesystem::path& file_;
    std::span<const ColumnKind> known_;
    TableStyle style_;
    std::string exported_header_, length_unit_;
    std::ifstream stream_;
    int number_ = 0;
    std::vector<Column> columns_;
};

}  // namespace

std::vector<std::vector<double>> read_table(std::string_view what,
                                            const std::filesystem::path& file,
                                            std::span<const ColumnKind> known,
                                            const std::vector<std::string_view>& needed,
                                            TableStyle style) {
    return TableReader(what, file, known, style).columns(needed);
}

}  // namespace magfsi::structure
