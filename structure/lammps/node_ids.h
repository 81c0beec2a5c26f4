// Atom IDs of nodes: those of one body after those of the other, from 1 on.
#pragma once

#include <functional>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/script.h"

namespace magfsi::structure {

// Of a body's node 0.
int first_id(const LammpsInput& input, std::size_t body);

// Of the nodes whose held axes are such, ascending.
std::vector<int> ids_where(const LammpsInput& input,
                           const std::function<bool(const HeldAxes&)>& such);

}  // namespace magfsi::structure
