// SPDX-License-Identifier: GPL-2.0-or-later
// structure.pvd and its .vtu files: what the scene's output.structure.fields names.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/scene/scene.h"
#include "coupler/output/vtk.h"
#include "coupler/step/clock.h"
#include "structure/body.h"

namespace magfsi::bodies {

// On the structure's root only.
class StructureFiles {
  public:
    // bodies: those of the scene, in its order; start: step 0.
    StructureFiles(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
                   const NodalState& start, const std::filesystem::path& run_folder);

    // After a restart: the series again up to the clock's step, one file every so many.
    void resume(const coupler::Clock& clock, std::int64_t every);

    // field_t: where the field is not the scene's law.
    void write(std::int64_t index, double time_s, const NodalState& state,
               const std::optional<Vec3>& field_t = {});

    struct Instant {
        double time_s = 0;
        const NodalState& state;
        const std::optional<Vec3>& field_t;
    };

  private:
    // A field of the file, made anew for each: adds its values to `out`.
    struct Field {
        std::string name;
        int components = 1;
        bool of_nodes = false;
        std::function<void(const Instant& now, std::vector<double>& out)> add;
    };
    using Bodies = std::vector<structure::Body>;
    void add(scene::BodyField field, const scene::Scene& scene, const Bodies& bodies);
    void add_of_nodes(scene::BodyField field, const scene::Scene& scene,
                      const Bodies& bodies);
    void add_magnetization(const Bodies& bodies);
    void add_of_elements(scene::BodyField field, const Bodies& bodies);
    std::filesystem::path file(std::int64_t index) const;

    std::vector<std::array<int, 8>> elements_;  // of all bodies, global node numbers
    std::vector<float> body_;                   // number of the body, one an element
    output::Words names_{"body_names", {}};
    std::vector<Vec3> start_m_;
    std::vector<Field> fields_;
    std::filesystem::path folder_;
    output::PvdSeries series_;
};

}  // namespace magfsi::bodies
