#include "adapters/scene/checks.h"

namespace magfsi::scene {

const Node& Marks::deepest(Path path) const {
    const Node* node = root_;
    for (const std::string& part : path) {
        const Node* child = node->find(part);
        if (!child) break;
        node = child;
    }
    return *node;
}

const Origin& Marks::value(Path path) const {
    return deepest(path).origin;
}

const Origin& Marks::key(Path path) const {
    const Node& node = deepest(path);
    return &node == root_ ? node.origin : node.key_origin;
}

const Origin& Marks::item(Path path, std::size_t i) const {
    const Node& node = deepest(path);
    return node.type == Node::Type::sequence && i < node.children.size()
               ? node.children[i].origin
               : node.origin;
}

bool Marks::has(Path path) const {
    const Node* node = root_;
    for (const std::string& part : path) {
        if (node) node = node->find(part);
    }
    return node != nullptr;
}

void check_scene(const Scene& scene, const Marks& marks) {
    if (scene.bodies.empty() && !scene.fluid)
        refuse(marks.value({}), "neither bodies nor a fluid", "at least one of them",
               "add the key \"bodies\" or \"fluid\"");
    check_bodies(scene, marks);
    check_loads(scene, marks);
    check_fluid(scene, marks);
    check_openfoam(scene, marks);
    check_step(scene, marks);
    check_outputs(scene, marks);
}

}  // namespace magfsi::scene
