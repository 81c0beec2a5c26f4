// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/table_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cerrno>
#include <cstring>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "base/words/plain_text.h"
#include "structure/refuse.h"
#include "structure/table_text.h"

namespace magfsi::structure {
namespace {

using namespace table_text;

constexpr const char* decimal_comma = "; if its commas are decimal ones, write points";

struct Line {
    int number = 0;
    std::string text;
};

// Reads one file. The lines are split at construction; columns() interprets them and may
// be called once.
class TableReader {
  public:
    TableReader(std::string_view what, const std::filesystem::path& file,
                std::span<const ColumnKind> known, TableStyle style)
        : what_(what), file_(file), known_(known), style_(style) {
        read_lines();
    }

    std::vector<std::vector<double>> columns(
        const std::vector<std::string_view>& needed) {
        if (rows_.empty())
            fail(1, fmt::format("no header found, such as \"{}\"", example()));
        Line header = rows_.front();
        auto row = rows_.begin();
        if (starts_a_number(header.text))
            header = header_in_a_comment(needed);
        else
            ++row;
        std::string units;
        if (row != rows_.end() && is_row_of_units(header, row->text)) units = row++->text;
        add_columns(header, units);
        check_columns(header, needed);
        std::vector<std::vector<double>> out(known_.size());
        if (row == rows_.end())
            fail(header.number, "no row found, at least one is needed");
        const char separator = separator_ ? *separator_ : separator_of(row->text);
        for (; row != rows_.end(); ++row) add_row(*row, separator, out);
        return out;
    }

  private:
    // A column of the file: its index in known_, known_.size() if it is skipped, and its
    // unit.
    struct Column {
        std::size_t known = 0;
        ColumnUnit unit{};
    };

    // Splits the file into rows and into comments before them, with Linux, Windows or old
    // Macintosh line ends. UTF-16 is refused.
    void read_lines() {
        std::ifstream stream(file_, std::ios::binary);
        if (!stream)
            refuse("cannot open the {} {}: {}", what_, file_.string(),
                   std::strerror(errno));
        std::string all{std::istreambuf_iterator<char>(stream), {}};
        if (all.find('\0') != std::string::npos)
            fail(1, "bytes of 0 found, as in UTF-16; save it as a CSV file in UTF-8");
        words::replace_all(all, "\r\n", "\n");
        std::ranges::replace(all, '\r', '\n');
        int number = 0;
        for (std::size_t begin = 0; begin < all.size();) {
            const std::size_t end = std::min(all.find('\n', begin), all.size());
            const std::string text =
                words::plain(std::string_view(all).substr(begin, end - begin));
            begin = end + 1;
            add_line(++number, trimmed(text));
        }
    }
    void add_line(int number, std::string_view text) {
        if (text.find_first_not_of(" \t,;\"") == std::string_view::npos) return;
        const std::string_view unquoted = text.substr(text[0] == '"' ? 1 : 0);
        if (rows_.empty() && lower(unquoted).starts_with("sep=")) {
            const std::string_view after = unquoted.substr(4);
            separator_ = after.empty() ? '\t' : after[0];
        } else if (unquoted.starts_with('#') || unquoted.starts_with('%')) {
            if (rows_.size() > 1) return;
            std::string comment(text);
            comment.erase(comment.find(unquoted[0]), 1);
            comments_.push_back({number, std::string(trimmed(comment))});
        } else {
            rows_.push_back({number, std::string(text)});
        }
    }

    // True for lines of values, quoted or signed ones included.
    static bool starts_a_number(std::string_view line) {
        return line.find_first_of("0123456789+-.\"") == 0 &&
               line.find_first_of("0123456789") < 3;
    }

    std::string example() const {
        std::vector<std::string> out;
        for (const ColumnKind& kind : known_) out.push_back(example(kind));
        return fmt::format("{}", fmt::join(out, ","));
    }
    static std::string example(const ColumnKind& kind) {
        const std::string_view unit = kind.units.front().text;
        return std::string(kind.name) + (unit.empty() ? "" : fmt::format("[{}]", unit));
    }

    std::vector<std::string> header_fields(std::string_view line) const {
        return fields_of(line, separator_ ? *separator_ : separator_of(line));
    }

    // Index in known_ of the column that a header field names, known_.size() if it is
    // none. A prefix up to a point is ignored.
    std::size_t known_of(std::string_view field) const {
        std::string name = in_parts(field).name;
        if (!is_name(name)) return known_.size();
        name.erase(0, name.rfind('.') + 1);  // "mf.Bx"
        const auto found = std::ranges::find_if(known_, [&](const ColumnKind& kind) {
            return simple(kind.name) == simple(name);
        });
        return found - known_.begin();
    }

    // The header of files whose header is a comment (numpy, COMSOL): the last comment
    // that names all needed columns, else the comment directly above the rows if it has
    // as many fields.
    Line header_in_a_comment(const std::vector<std::string_view>& needed) const {
        for (auto line = comments_.rbegin(); line != comments_.rend(); ++line) {
            std::vector<std::string_view> there;
            for (const std::string& field : header_fields(line->text)) {
                if (const auto k = known_of(field); k < known_.size())
                    there.push_back(known_[k].name);
            }
            if (!there.empty() && std::ranges::all_of(needed, [&](std::string_view name) {
                    return std::ranges::find(there, name) != there.end();
                }))
                return *line;
        }
        // The last comment is the header of an export whose columns do not fit.
        if (!comments_.empty() && comments_.back().number + 1 == rows_.front().number) {
            const auto fields = header_fields(comments_.back().text);
            if (fields.size() == header_fields(rows_.front().text).size())
                return comments_.back();
        }
        fail(rows_.front().number,
             fmt::format("numbers found where a header is needed, such as \"{}\"",
                         example()));
    }

    // True for a line such as "s,mT,mT,mT" below names without units.
    bool is_row_of_units(const Line& header, std::string_view line) const {
        const auto names = header_fields(header.text), units = header_fields(line);
        if (starts_a_number(line) || names.size() != units.size()) return false;
        bool any = false;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::size_t k = known_of(names[i]);
            if (k == known_.size()) continue;
            if (in_parts(names[i]).unit || !unit_of(known_[k], bare(units[i])))
                return false;
            any = true;
        }
        return any;
    }
    static std::string_view bare(std::string_view unit) {
        const bool in_brackets = unit.size() > 2 && (unit[0] == '[' || unit[0] == '(');
        return in_brackets ? trimmed(unit.substr(1, unit.size() - 2)) : unit;
    }

    static std::optional<ColumnUnit> unit_of(const ColumnKind& kind,
                                             std::string_view text) {
        for (const ColumnUnit& one : kind.units) {
            if (text == one.text) return one;
        }
        return {};
    }

    void add_columns(const Line& header, const std::string& units_below) {
        const auto fields = header_fields(header.text);
        const auto below = header_fields(units_below);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const std::size_t k = known_of(fields[i]);
            if (k == known_.size()) {
                if (style_ == TableStyle::strict) refuse_unknown(header, fields[i]);
                columns_.push_back({k});
                continue;
            }
            if (std::ranges::find(columns_, k, &Column::known) != columns_.end())
                fail(header.number, fmt::format("column {} found twice", known_[k].name));
            const std::optional<std::string> unit =
                units_below.empty() ? in_parts(fields[i]).unit
                                    : std::optional<std::string>(bare(below[i]));
            columns_.push_back({k, unit_in(header, fields[i], known_[k], unit)});
        }
    }

    ColumnUnit unit_in(const Line& header, std::string_view field, const ColumnKind& kind,
                       const std::optional<std::string>& written) const {
        const bool absent = !written && style_ == TableStyle::exported;
        const std::string unit =
            absent ? unit_of_comments(header, field, kind) : written.value_or("");
        if (const auto found = unit_of(kind, unit)) return *found;
        std::vector<std::string> allowed;
        for (const ColumnUnit& one : kind.units)
            allowed.push_back(one.text.empty() ? "none" : fmt::format("[{}]", one.text));
        fail(
            header.number,
            fmt::format("column \"{}\" found with the unit \"{}\"; {} are allowed, as in "
                        "{}",
                        field, written ? fmt::format("[{}]", unit) : "",
                        fmt::join(allowed, ", "), example(kind)));
    }

    // Unit of a column without one, from comments such as "Length unit: mm" or "Length
    // unit","mm". Other lines about units are refused, since a number in the wrong unit
    // gives a wrong result. Without any such line, SI.
    std::string unit_of_comments(const Line& header, std::string_view field,
                                 const ColumnKind& kind) const {
        const bool length = kind.units.data() == std::data(units::length);
        std::string out(kind.units.front().text);
        for (const Line& line : comments_) {
            if (line.number == header.number) continue;
            const std::string text = lower(line.text);
            const auto at = text.find("length unit");
            if (at != std::string::npos) {
                std::string_view unit = std::string_view(line.text).substr(at + 11);
                unit.remove_prefix(
                    std::min(unit.find_first_not_of("s:=,;\" \t"), unit.size()));
                unit = unit.substr(0, unit.find_first_of(",;\" \t"));
                if (!unit_of({"", units::length}, bare(unit)))
                    refuse_units(line, field, kind);
                if (length) out = bare(unit);
            } else if (speaks_of_units(line.text)) {
                refuse_units(line, field, kind);
            }
        }
        return out;
    }
    // True if a line has the word "unit", a unit's name or a unit symbol of at least two
    // letters.
    bool speaks_of_units(std::string_view text) const {
        std::string word;
        for (std::size_t i = 0; i <= text.size(); ++i) {
            const char c = i < text.size() ? text[i] : ' ';
            if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
                word += c;
                continue;
            }
            if (lower(word) == "unit" || lower(word) == "units" || names_a_unit(word))
                return true;
            for (const ColumnKind& kind : known_) {
                if (word.size() > 1 && unit_of(kind, word)) return true;
            }
            word.clear();
        }
        return false;
    }
    [[noreturn]] void refuse_units(const Line& line, std::string_view field,
                                   const ColumnKind& kind) const {
        fail(line.number, fmt::format("\"{}\" found, which seems to be about units, and "
                                      "the column \"{}\" without one; write it there, as "
                                      "in {}",
                                      line.text, field, example(kind)));
    }

    [[noreturn]] void refuse_unknown(const Line& header, std::string_view field) const {
        std::vector<std::string_view> all;
        for (const ColumnKind& one : known_) all.push_back(one.name);
        fail(header.number,
             fmt::format("column \"{}\" found, {} are allowed, each with its unit, like "
                         "{}",
                         field, fmt::join(all, ", "), example(known_.front())));
    }

    // Throws if a needed column is missing or if only some of the optional ones are
    // there.
    void check_columns(const Line& header,
                       const std::vector<std::string_view>& needed) const {
        std::vector<std::string_view> missing, others;
        std::size_t others_there = 0;
        for (std::size_t k = 0; k < known_.size(); ++k) {
            const bool is_needed =
                std::ranges::find(needed, known_[k].name) != needed.end();
            const bool there =
                std::ranges::find(columns_, k, &Column::known) != columns_.end();
            if (is_needed && !there) missing.push_back(known_[k].name);
            if (is_needed) continue;
            others.push_back(known_[k].name);
            others_there += there ? 1 : 0;
        }
        if (!missing.empty()) {
            std::string expression;
            for (const std::string& field : header_fields(header.text)) {
                if (known_of(field) == known_.size() &&
                    field.find(missing.front()) != std::string::npos)
                    expression =
                        fmt::format("; \"{}\" is an expression: export {} itself", field,
                                    missing.front());
            }
            fail(header.number,
                 fmt::format("header \"{}\" found; the columns {} are needed{}",
                             header.text, fmt::join(needed, ", "), expression));
        }
        if (others_there != 0 && others_there != others.size()) {
            fail(header.number,
                 fmt::format("header \"{}\" found; all or none of {} are needed",
                             header.text, fmt::join(others, ", ")));
        }
    }

    void add_row(const Line& line, char separator,
                 std::vector<std::vector<double>>& out) const {
        const auto fields = fields_of(line.text, separator, columns_.size());
        if (fields.size() != columns_.size()) {
            const bool commas =
                separator == ',' &&
                (fields.size() == 2 * columns_.size() ||
                 std::ranges::any_of(fields, [](const std::string& field) {
                     return field.find_first_of(" \t") != std::string::npos;
                 }));
            fail(line.number,
                 fmt::format("{} values found, {} are needed{}", fields.size(),
                             columns_.size(), commas ? decimal_comma : ""));
        }
        for (std::size_t c = 0; c < fields.size(); ++c) {
            if (columns_[c].known == known_.size()) continue;
            const ColumnUnit& unit = columns_[c].unit;
            out[columns_[c].known].push_back(number(line, fields[c]) * unit.times /
                                             unit.over);
        }
    }

    double number(const Line& line, const std::string& written) const {
        std::string text = written.substr(written.starts_with('+') ? 1 : 0);
        std::ranges::replace(text, 'D', 'e');  // Fortran's exponent: 1D-3
        std::ranges::replace(text, 'd', 'e');
        double value = 0;
        const char* end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc{} || last != end || !std::isfinite(value)) {
            const bool comma = last != end && (*last == ',' || *last == ' ') &&
                               line.text.find(',') != std::string::npos;
            fail(line.number, fmt::format("\"{}\" found, a finite number is needed{}",
                                          written, comma ? decimal_comma : ""));
        }
        return value;
    }

    [[noreturn]] void fail(int line, const std::string& why) const {
        refuse("{} {}, line {}: {}", what_, file_.string(), line, why);
    }

    std::string_view what_;
    const std::filesystem::path& file_;
    std::span<const ColumnKind> known_;
    TableStyle style_;
    std::optional<char> separator_;  // if the file gives it in a line "sep="
    // rows_ begins with the header if it is no comment
    std::vector<Line> comments_, rows_;
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
