#include "structure/lammps/data_file.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace magfsi::structure {

void write_data_file(const std::vector<DataAtom>& atoms,
                     const std::filesystem::path& file) {
    Vec3 low{INFINITY, INFINITY, INFINITY};
    Vec3 high{-INFINITY, -INFINITY, -INFINITY};
    for (const DataAtom& atom : atoms) {
        for (int d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], atom.position_m[d]);
            high[d] = std::max(high[d], atom.position_m[d]);
        }
    }
    // The shrink-wrapped boundary replaces these bounds; they only have to hold the
    // atoms.
    const double margin =
        0.01 * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    try {
        auto out = fmt::output_file(file.string());
        out.print("Nodes of all bodies, SI\n\n{} atoms\n1 atom types\n\n", atoms.size());
        for (int d = 0; d < 3; ++d) {
            out.print("{:.17g} {:.17g} {}lo {}hi\n", low[d] - margin, high[d] + margin,
                      "xyz"[d], "xyz"[d]);
        }
        out.print("\nAtoms # sphere: id type diameter mass x y z\n\n");
        for (std::size_t i = 0; i < atoms.size(); ++i) {
            const Vec3& x = atoms[i].position_m;
            out.print("{} 1 0 {:.17g} {:.17g} {:.17g} {:.17g}\n", i + 1, atoms[i].mass_kg,
                      x[0], x[1], x[2]);
        }
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("cannot write the data file {}: {}",
                                             file.string(), error.what()));
    }
}

}  // namespace magfsi::structure
