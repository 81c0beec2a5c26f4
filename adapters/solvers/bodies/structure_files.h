// SPDX-License-Identifier: GPL-2.0-or-later
// Output files of the bodies for ParaView: structure.pvd and its .vtu files, with the
// fields that the scene's output.structure.fields names; where bodies have rigid parts,
// the orientation of each, too.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/nodal_state.h"
#include "coupler/output/vtk.h"
#include "coupler/step/clock.h"
#include "structure/body.h"

namespace magfsi::bodies {

// Writes one file for each instant, with all bodies in it. Lives on the structure's root
// only and calls nothing collective.
class StructureFiles {
  public:
    // bodies: those of the scene, in its order; start: their state at step 0, to which
    // displacements refer. run_folder: gets structure.pvd and the folder fields.
    StructureFiles(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
                   const NodalState& start, const std::filesystem::path& run_folder);

    // After a restart: lists the existing files up to the clock's step in structure.pvd
    // again. every: number of steps between two files.
    void resume(const coupler::Clock& clock, std::int64_t every);

    // Writes fields/structure_INDEX.vtu and adds it to structure.pvd. field_t: uniform
    // field [T] that replaces the scene's law. Throws output::FileError on a failing
    // disk.
    void write(std::int64_t index, double time_s, const NodalState& state,
               const std::optional<Vec3>& field_t = {});

    // The arguments of write, as the fields see them.
    struct Instant {
        double time_s = 0;
        const NodalState& state;
        const std::optional<Vec3>& field_t;
    };

  private:
    // A field of the files. add: evaluates it and appends its values to `out`,
    // `components` for each node or element, in the order of the bodies.
    struct Field {
        std::string name;  // includes the unit in brackets
        int components = 1;
        bool of_nodes = false;  // values at nodes, else in elements
        std::function<void(const Instant& now, std::vector<double>& out)> add;
    };
    using Bodies = std::vector<structure::Body>;
    void add(scene::BodyField field, const scene::Scene& scene, const Bodies& bodies);
    void add_of_nodes(scene::BodyField field, const scene::Scene& scene,
                      const Bodies& bodies);
    void add_magnetization(const Bodies& bodies);
    void add_of_elements(scene::BodyField field, const Bodies& bodies);
    void add_orientations(const scene::Scene& scene, const Bodies& bodies);
    std::filesystem::path file(std::int64_t index) const;

    // The elements of all bodies, with nodes numbered over all bodies.
    std::vector<std::array<int, 8>> elements_;
    std::vector<float> body_;  // for each element the number of its body
    output::Words names_{"body_names", {}};
    std::vector<Vec3> start_m_;
    std::vector<Field> fields_;
    std::filesystem::path folder_;
    output::PvdSeries series_;
};

}  // namespace magfsi::bodies
