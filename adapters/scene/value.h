// Values at the leaves of the tree, read as their field says. Each throws SceneError at
// the node's place.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/document.h"
#include "adapters/scene/field.h"

namespace magfsi::scene {

// The scalars of a leaf in order, whatever its layout; throws if the layout does not fit.
std::vector<const Node*> scalars(const Node& node, const Field& field);

double number_value(const Node& scalar, const Field& field);  // SI
int integer_value(const Node& scalar, const Field& field);
bool boolean_value(const Node& scalar, const Field& field);
std::string text_value(const Node& scalar, const Field& field);  // text and identifier
std::size_t choice_value(const Node& scalar, const Field& field);

// Throws if the name is no identifier.
void check_identifier(const std::string& name, const Origin& where);

}  // namespace magfsi::scene
