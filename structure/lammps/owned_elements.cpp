#include "structure/lammps/owned_elements.h"

#include "atom.h"
#include "domain.h"

namespace magfsi::structure {

OwnedElements owned_elements(const NodeRange& range,
                             const std::vector<Hexahedron>& elements,
                             const std::vector<std::vector<int>>& by_first,
                             LAMMPS_NS::Atom& atom, LAMMPS_NS::Domain& domain) {
    OwnedElements out;
    for (int i = 0; i < atom.nlocal; ++i) {
        const int node = range.node(atom.tag[i]);
        if (node < 0) continue;
        for (int e : by_first[static_cast<std::size_t>(node)]) {
            std::array<int, 8> atoms{};
            for (int a = 0; a < 8; ++a) {
                const int id = range.first_id + elements[e][a];
                const int seen = atom.map(id);
                if (seen < 0) {
                    out.missing_id = id;
                    return out;
                }
                atoms[a] = domain.closest_image(i, seen);
            }
            out.element.push_back(e);
            out.atom.push_back(atoms);
        }
    }
    return out;
}

}  // namespace magfsi::structure
