// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/surface/stl_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

namespace magfsi::surface {

namespace {

// Sizes in the binary format: header, number of triangles, a triangle, and the normal at
// its beginning.
constexpr std::size_t header_bytes = 80, count_bytes = 4, triangle_bytes = 50;
constexpr std::size_t normal_bytes = 12;

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse_file(file, "cannot be opened");
    return {std::istreambuf_iterator<char>(in), {}};
}

// Number of triangles according to the header of a binary file; 0 if the file is shorter.
std::uint32_t binary_count(const std::string& bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes + count_bytes) {
        std::memcpy(&count, bytes.data() + header_bytes, count_bytes);
    }
    return count;
}

// True if the file has exactly the size of a binary file with that number of triangles.
bool is_binary(const std::string& bytes) {
    return bytes.size() >= header_bytes + count_bytes &&
           bytes.size() == header_bytes + count_bytes +
                               triangle_bytes * std::size_t{binary_count(bytes)};
}

std::vector<Triangle> read_binary(const std::string& bytes) {
    std::vector<Triangle> triangles(binary_count(bytes));
    const char* at = bytes.data() + header_bytes + count_bytes;
    for (Triangle& triangle : triangles) {
        float corners[9];
        std::memcpy(corners, at + normal_bytes, sizeof corners);
        for (int i = 0; i < 9; ++i) triangle[i / 3][i % 3] = corners[i];
        at += triangle_bytes;
    }
    return triangles;
}

// The words of a text, separated by blanks and line ends, in lower case.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    // Reads the next word; false at the end of the text.
    bool next(std::string& word) {
        skip(true);
        word.clear();
        for (; at_ < text_.size() && !is_space(text_[at_]); ++at_)
            word +=
                static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_])));
        return !word.empty();
    }
    // Skips the rest of a line: the name of a solid, which may contain any word.
    void skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
    // Number of the present line, from 1 on.
    std::ptrdiff_t line() const {
        return 1 + std::count(text_.begin(),
                              text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    }

  private:
    static bool is_space(char c) {
        return std::isspace(static_cast<unsigned char>(c)) != 0;
    }
    void skip(bool space) {
        while (at_ < text_.size() && is_space(text_[at_]) == space) ++at_;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

// The next word as a number. Throws std::invalid_argument if it is none.
double coordinate(Words& words, const std::string& file) {
    std::string word;
    const bool there = words.next(word);
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    double value = 0;
    const auto [last, error] = std::from_chars(begin, end, value);
    if (there && error == std::errc{} && last == end) return value;
    refuse_file(file, "has a vertex that is not three numbers: line ", words.line(),
                ", \"", word.substr(0, 40), "\"",
                word.find(',') == std::string::npos ? "" : "; write decimal points");
}

std::vector<Triangle> read_ascii(const std::string& text, const std::string& file) {
    Words words(text);
    std::vector<Triangle> triangles;
    std::size_t corner = 0;
    for (std::string word; words.next(word);) {
        if (word == "solid" || word == "endsolid") words.skip_line();
        if (word == "endfacet" && corner != 0) {
            refuse_file(file, "has a facet whose number of vertices is not 3, line ",
                        words.line());
        }
        if (word != "vertex") continue;
        if (corner == 0) triangles.emplace_back();
        for (double& x : triangles.back()[corner]) x = coordinate(words, file);
        corner = (corner + 1) % 3;
    }
    if (corner != 0) refuse_file(file, "ends inside a triangle; export it anew");
    return triangles;
}

bool begins_with_solid(std::string_view text) {
    std::string word;
    return Words(text.substr(0, 1000)).next(word) && word == "solid";
}

}  // namespace

std::vector<Triangle> read_stl(const std::string& file) {
    std::string bytes = contents(file);
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);  // byte order mark
    const bool binary = is_binary(bytes);
    if (!binary && !begins_with_solid(bytes)) {
        refuse_file(file, "has ", bytes.size(),
                    " bytes; it neither begins with \"solid\" (ASCII) nor has the 84 + "
                    "50 bytes per triangle of its count (binary): export it anew");
    }
    std::vector<Triangle> triangles =
        binary ? read_binary(bytes) : read_ascii(bytes, file);
    if (triangles.empty()) refuse_file(file, "has no triangle; export a surface");
    constexpr double most = std::numeric_limits<float>::max();
    for (const Triangle& triangle : triangles) {
        for (const Vec3& corner : triangle) {
            for (const double x : corner) {
                if (!(std::abs(x) <= most))
                    refuse_file(file, "has a vertex that is not finite; export it anew");
            }
        }
    }
    return triangles;
}

}  // namespace magfsi::surface
