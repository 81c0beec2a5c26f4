// What no single key can tell: contradictions between keys, geometry, stability limits.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "adapters/scene/document.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

using Path = std::initializer_list<std::string>;

// Finds the place of a value for an error.
class Marks {
  public:
    explicit Marks(const Node& root) : root_(&root) {}

    // The value at the path, or the nearest map around it when the key is absent.
    const Origin& value(Path path) const;
    // The key at the path itself.
    const Origin& key(Path path) const;
    // Entry i of the list at the path, or the value itself where it is no such list.
    const Origin& item(Path path, std::size_t i) const;
    bool has(Path path) const;

  private:
    const Node& deepest(Path path) const;
    const Node* root_;
};

// Throws SceneError at the first fault. The scene is complete (wavelengths, coupling).
void check_scene(const Scene& scene, const Marks& marks);

// Its parts, a source file each.
void check_bodies(const Scene& scene, const Marks& marks);
void check_loads(const Scene& scene, const Marks& marks);
void check_platform(const Scene& scene, const Marks& marks);  // of scenes with bodies
void check_fluid(const Scene& scene, const Marks& marks);
void check_openfoam(const Scene& scene, const Marks& marks);
void check_step(const Scene& scene, const Marks& marks);
void check_outputs(const Scene& scene, const Marks& marks);
void check_retry(const Scene& scene, const Marks& marks);

double largest_speed_m_s(const PrescribedMotion& motion);

// Whether the mesh has the face; those of a Gmsh file are known when it is read. list:
// what the face stands in.
void check_face(const Body& body, const std::string& face, std::string_view list,
                const Origin& here);

void check_prescribed_motion(const Scene& scene, const Body& body, const Marks& marks);

}  // namespace magfsi::scene
