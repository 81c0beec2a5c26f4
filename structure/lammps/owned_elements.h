// Which elements and nodes of a body are this rank's: an element belongs to the rank that
// owns its first node.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace LAMMPS_NS {
class Atom;
class Domain;
}  // namespace LAMMPS_NS

namespace magfsi::structure {

// Node n of the body is the atom with ID first_id + n.
struct NodeRange {
    int first_id = 1;
    int count = 0;
    // Node number of an atom ID, or -1 if the atom is not of this body.
    int node(int id) const {
        return id >= first_id && id < first_id + count ? id - first_id : -1;
    }
};

struct OwnedElements {
    std::vector<int> element;
    std::vector<std::array<int, 8>> atom;  // local or ghost indices
    int missing_id = 0;                    // an atom that this rank cannot see, or 0
};

OwnedElements owned_elements(const NodeRange& range,
                             const std::vector<Hexahedron>& elements,
                             const std::vector<std::vector<int>>& by_first,
                             LAMMPS_NS::Atom& atom, LAMMPS_NS::Domain& domain);

}  // namespace magfsi::structure
