// Parts of bodies that probes integrate over.
#pragma once

#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Which elements have their centre in the part's box. Throws std::invalid_argument where
// none has.
std::vector<bool> elements_of(const scene::BodyPart& part, const structure::Mesh& mesh);

// Of each node's mass the share that belongs to the part's elements; 1 at every node of
// the whole body.
std::vector<double> node_shares(const std::vector<bool>& elements,
                                const structure::Mesh& mesh);

}  // namespace magfsi::bodies
