#include "structure/mesh/mesh_file.h"

#include <fmt/format.h>
#include <fmt/os.h>
#include <fmt/ranges.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "structure/mesh/centre_line.h"

namespace magfsi::structure {
namespace {

// Reads line by line, past comments, and knows where it is for the errors.
class Reader {
  public:
    explicit Reader(const std::filesystem::path& file) : file_(file), stream_(file) {
        if (!stream_) {
            throw std::runtime_error(
                fmt::format("cannot open the mesh file {}", file.string()));
        }
    }

    std::string line(const char* expected) {
        std::string text;
        while (std::getline(stream_, text)) {
            ++number_;
            if (text.empty() || text[0] != '#') return text;
        }
        fail(expected);
    }

    std::size_t count(const std::string& keyword) {
        const std::string expected = fmt::format("\"{} N\"", keyword);
        std::istringstream fields(line(expected.c_str()));
        std::string found;
        long long value = -1;
        if (!(fields >> found >> value) || found != keyword || value < 0) {
            fail(expected.c_str());
        }
        return static_cast<std::size_t>(value);
    }

    [[noreturn]] void fail(const char* expected) const {
        throw std::runtime_error(fmt::format("mesh file {}, line {}: expected {}",
                                             file_.string(), number_, expected));
    }

  private:
    std::filesystem::path file_;
    std::ifstream stream_;
    int number_ = 0;
};

int read_node(std::istream& fields, const Reader& reader, std::size_t nodes) {
    int node = -1;
    if (!(fields >> node) || node < 0 || static_cast<std::size_t>(node) >= nodes) {
        reader.fail("numbers of nodes, from 0 and below their count");
    }
    return node;
}

void read_elements(Reader& reader, Mesh& mesh) {
    mesh.elements.resize(reader.count("elements"));
    const int regions = static_cast<int>(mesh.region_names.size());
    for (Hexahedron& element : mesh.elements) {
        const char* expected = "eight node numbers and the region of an element";
        std::istringstream fields(reader.line(expected));
        for (int& node : element) node = read_node(fields, reader, mesh.nodes.size());
        int region = -1;
        if (!(fields >> region) || region < (regions > 0 ? 0 : -1) || region >= regions) {
            reader.fail(expected);
        }
        if (regions > 0) mesh.region.push_back(region);
    }
}

std::map<std::string, std::vector<int>> read_groups(Reader& reader, const char* keyword,
                                                    std::size_t nodes) {
    std::map<std::string, std::vector<int>> groups;
    for (std::size_t left = reader.count(keyword); left > 0; --left) {
        const char* expected = "the count of nodes and the name of a group";
        std::istringstream title(reader.line(expected));
        long long count = -1;
        std::string name;
        if (!(title >> count) || count < 0 || title.get() != ' ' ||
            !std::getline(title, name)) {
            reader.fail(expected);
        }
        std::istringstream fields(reader.line("the node numbers of a group"));
        for (long long n = 0; n < count; ++n) {
            groups[name].push_back(read_node(fields, reader, nodes));
        }
    }
    return groups;
}

template <typename Out>
void write_groups(Out& out, const char* keyword,
                  const std::map<std::string, std::vector<int>>& groups) {
    out.print("{} {}\n", keyword, groups.size());
    for (const auto& [name, nodes] : groups) {
        out.print("{} {}\n{}\n", nodes.size(), name, fmt::join(nodes, " "));
    }
}

}  // namespace

void write_mesh_file(const Mesh& mesh, const std::filesystem::path& file) {
    try {
        auto out = fmt::output_file(file.string());
        out.print("# magfsi mesh [m]\nnodes {}\n", mesh.nodes.size());
        for (const Vec3& x : mesh.nodes) {
            out.print("{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
        }
        out.print("regions {}\n", mesh.region_names.size());
        for (const std::string& name : mesh.region_names) out.print("{}\n", name);
        out.print("elements {}\n", mesh.elements.size());
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            out.print("{} {}\n", fmt::join(mesh.elements[e], " "),
                      mesh.region.empty() ? -1 : mesh.region[e]);
        }
        write_groups(out, "faces", mesh.faces);
        write_groups(out, "points", mesh.points);
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("cannot write the mesh file {}: {}",
                                             file.string(), error.what()));
    }
}

Mesh read_mesh_file(const std::filesystem::path& file) {
    Reader reader(file);
    Mesh mesh;
    mesh.nodes.resize(reader.count("nodes"));
    for (Vec3& x : mesh.nodes) {
        const char* expected = "three coordinates of a node";
        std::istringstream fields(reader.line(expected));
        if (!(fields >> x[0] >> x[1] >> x[2])) reader.fail(expected);
    }
    mesh.region_names.resize(reader.count("regions"));
    for (std::string& name : mesh.region_names) name = reader.line("a region's name");
    read_elements(reader, mesh);
    mesh.faces = read_groups(reader, "faces", mesh.nodes.size());
    mesh.points = read_groups(reader, "points", mesh.nodes.size());
    if (const auto line = mesh.points.find("centre_line"); line != mesh.points.end()) {
        mesh.centre_line = line_through(mesh, line->second);
    }
    return mesh;
}

}  // namespace magfsi::structure
