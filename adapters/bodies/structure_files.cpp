#include "adapters/bodies/structure_files.h"

#include <fmt/format.h>

#include "coupler/output/vtk.h"

namespace magfsi::bodies {

StructureFiles::StructureFiles(const std::vector<structure::Body>& bodies,
                               const NodalState& start,
                               const std::filesystem::path& run_folder)
    : start_m_(start.position_m),
      folder_(run_folder / "fields"),
      series_(run_folder / "structure.pvd") {
    int first_node = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const structure::Body& body = bodies[b];
        for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            auto nodes = body.mesh.elements[e];
            for (int& node : nodes) node += first_node;
            elements_.push_back(nodes);
            const auto m = body.magnetization_a_m.empty() ? structure::Vec3{}
                                                          : body.magnetization_a_m[e];
            magnetization_.insert(magnetization_.end(), m.begin(), m.end());
            body_.push_back(static_cast<float>(b));
        }
        first_node += static_cast<int>(body.mesh.nodes.size());
    }
}

std::filesystem::path StructureFiles::file(std::int64_t index) const {
    return folder_ / fmt::format("structure_{:06d}.vtu", index);
}

void StructureFiles::resume(const coupler::Clock& clock, std::int64_t every) {
    for (std::int64_t step = 0; step <= clock.step(); step += every) {
        if (std::filesystem::exists(file(step / every)))
            series_.add(clock.time_s(step), file(step / every));
    }
}

void StructureFiles::write(std::int64_t index, double time_s, const NodalState& state) {
    std::vector<double> points, displacement, velocity;
    for (std::size_t n = 0; n < state.position_m.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            points.push_back(state.position_m[n][d]);
            displacement.push_back(state.position_m[n][d] - start_m_[n][d]);
            velocity.push_back(state.velocity_m_s[n][d]);
        }
    }
    const auto values = [](const auto& v) { return std::span(v); };
    const output::Field point_fields[] = {{"displacement", 3, values(displacement)},
                                          {"velocity", 3, values(velocity)}};
    const output::Field cell_fields[] = {{"magnetization", 3, values(magnetization_)},
                                         {"body", 1, values(body_)}};
    output::write_vtu(file(index), {std::span<const double>(points), elements_},
                      point_fields, cell_fields);
    series_.add(time_s, file(index));
}

}  // namespace magfsi::bodies
