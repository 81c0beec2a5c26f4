// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/names.h"

#include <fcntl.h>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/words/path_word.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Groups that a script may have besides those of bodies and motions. LAMMPS has 32. The
// last two are there with rigid parts, and with some in prescribed motion, only.
const std::vector<std::string> own_groups{
    "all", "clamped", "moving", "held_x", "held_y", "held_z", "rigid", moved_parts_group};
constexpr std::size_t groups_without_rigid_parts = 6, max_groups = 32;

std::string sanitized(const std::string& name) {
    std::string out = name.empty() ? "body" : name;
    for (char& c : out) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return out;
}

}  // namespace

std::vector<std::string> lammps_names(const std::vector<Body>& bodies,
                                      std::size_t motions) {
    const bool rigid = std::ranges::any_of(
        bodies, [](const Body& body) { return !body.rigid_parts.empty(); });
    const std::size_t most = max_groups - groups_without_rigid_parts - (rigid ? 1 : 0) -
                             (has_moved_parts(bodies) ? 1 : 0);
    if (bodies.size() + motions > most) {
        refuse(
            "{} bodies and {} prescribed motions found, LAMMPS has groups for {} of both",
            bodies.size(), motions, most);
    }
    std::vector<std::string> taken = own_groups;
    for (std::size_t m = 0; m < motions; ++m) taken.push_back(moved_group(m));
    const std::ptrdiff_t first = taken.size();
    for (const Body& body : bodies) {
        const std::string wanted = sanitized(body.name);
        std::string name = wanted;
        for (int n = 2; std::ranges::find(taken, name) != taken.end(); ++n) {
            name = fmt::format("{}_{}", wanted, n);
        }
        taken.push_back(name);
    }
    return {taken.begin() + first, taken.end()};
}

std::string held_group(std::size_t axis) {
    return own_groups[3 + axis];
}

std::string moved_group(std::size_t motion) {
    return fmt::format("moved_{}", motion + 1);
}

// True if a path in double quotes passes LAMMPS's parser unchanged: printable ASCII
// without quotes, variables ($) and formats (%).
bool is_quotable(const std::string& path) {
    return std::ranges::all_of(path, [](char c) {
        return c >= ' ' && c <= '~' && c != '"' && c != '$' && c != '%';
    });
}

std::string path_in_script(const std::string& path) {
    return is_quotable(path) ? '"' + path + '"' : words::path_word(path);
}

std::string data_in_script(const std::string& path) {
    if (is_quotable(path)) return '"' + path + '"';
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        throw std::runtime_error(
            fmt::format("cannot open {}: {}", path, std::strerror(errno)));
    return fmt::format("/proc/self/fd/{}", descriptor);
}

std::string id_ranges(const std::vector<int>& ids) {
    std::string out;
    for (std::size_t i = 0; i < ids.size();) {
        std::size_t last = i;
        const int stride = i + 1 < ids.size() ? ids[i + 1] - ids[i] : 1;
        while (last + 1 < ids.size() && ids[last + 1] - ids[last] == stride) ++last;
        if (!out.empty()) out += ' ';
        if (last > i + 1) {
            out += fmt::format("{}:{}:{}", ids[i], ids[last], stride);
            i = last + 1;
        } else {
            out += fmt::format("{}", ids[i]);
            ++i;
        }
    }
    return out;
}

int first_id(const LammpsInput& input, std::size_t body) {
    std::size_t before = 0;
    for (std::size_t b = 0; b < body; ++b) before += input.bodies[b].mesh.nodes.size();
    return static_cast<int>(before) + 1;
}

std::vector<int> ids_where(const LammpsInput& input,
                           const std::function<bool(const HeldAxes&)>& condition) {
    std::vector<int> ids;
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const auto held = held_axes(input.bodies[b]);
        const int first = first_id(input, b);
        for (std::size_t n = 0; n < held.size(); ++n) {
            if (condition(held[n])) ids.push_back(first + static_cast<int>(n));
        }
    }
    return ids;
}

}  // namespace magfsi::structure
