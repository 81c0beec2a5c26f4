#include "structure/lammps/lattice_file.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace magfsi::structure {
namespace {

// Reads line by line, past comments and blanks, and knows where it is for the errors.
class Reader {
  public:
    explicit Reader(const std::filesystem::path& file) : file_(file), stream_(file) {
        if (!stream_) {
            throw std::runtime_error(
                fmt::format("cannot open the lattice file {}", file.string()));
        }
    }

    std::istringstream line(const char* expected) {
        std::string text;
        while (std::getline(stream_, text)) {
            ++number_;
            const auto first = text.find_first_not_of(" \t\r");
            if (first != std::string::npos && text[first] != '#') {
                return std::istringstream(text);
            }
        }
        fail(expected);
    }

    std::size_t count(const char* keyword, const char* expected) {
        std::istringstream fields = line(expected);
        std::string found;
        long long value = -1;
        if (!(fields >> found >> value) || found != keyword || value < 1) fail(expected);
        return static_cast<std::size_t>(value);
    }

    [[noreturn]] void fail(const char* expected) const {
        throw std::runtime_error(fmt::format("lattice file {}, line {}: expected {}",
                                             file_.string(), number_, expected));
    }

  private:
    std::filesystem::path file_;
    std::ifstream stream_;
    int number_ = 0;
};

}  // namespace

void write_lattice_file(const LatticeFile& lattice, const std::filesystem::path& file) {
    try {
        auto out = fmt::output_file(file.string());
        out.print("# magttice lattice [m, A/m]\nnodes {}\n", lattice.nodes_m.size());
        for (const Vec3& x : lattice.nodes_m) {
            out.print("{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
        }
        out.print("elements {}\n", lattice.elements.size());
        for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
            for (int node : lattice.elements[e]) out.print("{} ", node);
            const Vec3 m =
                lattice.magnetization_a_m.empty() ? Vec3{} : lattice.magnetization_a_m[e];
            out.print("{:.17g} {:.17g} {:.17g}", m[0], m[1], m[2]);
            if (!lattice.element_material.empty()) {
                out.print(" {}", lattice.element_material[e]);
            }
            out.print("\n");
        }
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("cannot write the lattice file {}: {}",
                                             file.string(), error.what()));
    }
}

LatticeFile read_lattice_file(const std::filesystem::path& file) {
    Reader reader(file);
    LatticeFile out;
    out.nodes_m.resize(reader.count("nodes", "\"nodes N\" with N of at least 1"));
    for (Vec3& x : out.nodes_m) {
        const char* expected = "three coordinates of a node";
        std::istringstream fields = reader.line(expected);
        if (!(fields >> x[0] >> x[1] >> x[2])) reader.fail(expected);
    }
    out.elements.resize(reader.count("elements", "\"elements M\" with M of at least 1"));
    out.magnetization_a_m.resize(out.elements.size());
    out.element_material.resize(out.elements.size());
    for (std::size_t e = 0; e < out.elements.size(); ++e) {
        const char* expected =
            "eight node numbers and the magnetisation of an element, and perhaps the "
            "number of its material";
        std::istringstream fields = reader.line(expected);
        for (int& node : out.elements[e]) fields >> node;
        Vec3& m = out.magnetization_a_m[e];
        if (!(fields >> m[0] >> m[1] >> m[2])) reader.fail(expected);
        int& material = out.element_material[e];
        if (!(fields >> std::ws).eof() && (!(fields >> material) || material < 0)) {
            reader.fail(expected);
        }
    }
    if (std::ranges::all_of(out.element_material, [](int m) { return m == 0; })) {
        out.element_material.clear();
    }
    return out;
}

}  // namespace magfsi::structure
