// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/structure_files.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "adapters/solvers/bodies/field_work.h"
#include "adapters/solvers/bodies/rigid_parts.h"
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/plain_element.h"
#include "structure/lattice/strain.h"

namespace magfsi::bodies {

namespace {

using scene::BodyField;
using structure::Positions8;

// Shape and unit of a field.
struct Kind {
    int components;
    bool of_nodes;  // values at nodes, else in elements
    std::string_view unit;
};

// One entry for each BodyField, in their order.
constexpr Kind kinds[] = {{3, true, "m"},   {3, true, "m/s"}, {3, false, "A/m"},
                          {3, false, "1"},  {3, true, "N"},   {3, true, "N"},
                          {6, false, "Pa"}, {1, false, "1"},  {1, false, "J/m3"}};
static_assert(std::size(kinds) == scene::names<BodyField>.size());

// An element with its integrals at rest, for the mean deformation gradient.
struct Element {
    std::array<int, 8> nodes{};  // numbered over all bodies
    Positions8 gradient_m2;      // integral of grad N_a for each node a
    double volume_m3 = 0;
};

std::vector<Element> elements_at_rest(const structure::Body& body, int first_node) {
    std::vector<Element> all;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        auto nodes = body.mesh.elements[e];
        const auto at_rest = structure::integrate_hexahedron(
            structure::gather(body.mesh.nodes, nodes), static_cast<int>(e));
        for (int& node : nodes) node += first_node;
        all.push_back({nodes, at_rest.gradient, at_rest.volume});
    }
    return all;
}

int nodes_of(const structure::Body& body) {
    return body.mesh.nodes.size();
}

// A function that evaluates a field in the elements of all bodies in turn. add(b, e, F,
// out) appends the values in element e of body b, whose mean deformation gradient is F.
template <class Add>
auto each_element(const std::vector<structure::Body>& bodies, const Add& add) {
    std::vector<std::vector<Element>> elements;
    int first_node = 0;
    for (const structure::Body& body : bodies) {
        elements.push_back(elements_at_rest(body, first_node));
        first_node += nodes_of(body);
    }
    return [elements, add](const StructureFiles::Instant& now, std::vector<double>& out) {
        for (std::size_t b = 0; b < elements.size(); ++b) {
            for (std::size_t e = 0; e < elements[b].size(); ++e) {
                const Element& element = elements[b][e];
                const Positions8 x =
                    structure::gather(now.state.position_m, element.nodes);
                add(b, e,
                    structure::mean_deformation(x, element.gradient_m2,
                                                element.volume_m3),
                    out);
            }
        }
    };
}

template <class Values>
void append(std::vector<double>& out, const Values& values) {
    out.insert(out.end(), std::begin(values), std::end(values));
}

// The material of an element; of a rigid one, which has neither stress nor energy, one
// without moduli.
structure::Material material_in_files(const structure::Body& body, std::size_t element) {
    return structure::is_soft(body, element) ? structure::material_of(body, element)
                                             : structure::Material{};
}

// Elastic energy of each element over its volume at rest [J/m3]: springs, change of
// volume, and the hourglass modes of elements assumed_strain.
auto energy_densities(const std::vector<structure::Body>& bodies) {
    struct Part {
        std::vector<std::array<int, 8>> nodes;
        std::vector<structure::ElementReference> references;
        std::vector<structure::Material> materials;
    };
    std::vector<Part> parts;
    int first_node = 0;
    for (const structure::Body& body : bodies) {
        Part part;
        for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            auto nodes = body.mesh.elements[e];
            part.references.push_back(
                structure::element_reference(structure::gather(body.mesh.nodes, nodes),
                                             body.element, static_cast<int>(e)));
            for (int& node : nodes) node += first_node;
            part.nodes.push_back(nodes);
            part.materials.push_back(material_in_files(body, e));
        }
        first_node += nodes_of(body);
        parts.push_back(std::move(part));
    }
    return [parts](const StructureFiles::Instant& now, std::vector<double>& out) {
        for (const Part& part : parts) {
            for (std::size_t e = 0; e < part.nodes.size(); ++e) {
                const auto& reference = part.references[e];
                if (part.materials[e].shear_modulus_pa == 0) {
                    out.push_back(0);
                    continue;
                }
                const auto element = structure::element_energy(
                    reference, part.materials[e],
                    structure::gather(now.state.position_m, part.nodes[e]));
                out.push_back(element.energy_j / reference.volume);
            }
        }
    };
}

// Elastic force of the lattice on each node [N], -dE/dx.
auto elastic_forces(const std::vector<structure::Body>& bodies) {
    auto kernels = std::make_shared<std::vector<structure::ElementKernel>>();
    std::vector<std::size_t> counts;
    for (const structure::Body& body : bodies) {
        kernels->emplace_back().assign(structure::build_lattice(body));
        counts.push_back(body.mesh.nodes.size());
    }
    return
        [kernels, counts](const StructureFiles::Instant& now, std::vector<double>& out) {
            std::size_t first = out.size(), node = 0;
            out.resize(first + 3 * now.state.position_m.size());
            for (std::size_t b = 0; b < counts.size(); ++b) {
                (*kernels)[b].add_forces(now.state.position_m[node].data(),
                                         out.data() + first);
                first += 3 * counts[b];
                node += counts[b];
            }
        };
}

// Force of the applied field on each node [N]; zeros without a field.
auto magnetic_forces(const scene::Scene& scene,
                     const std::vector<structure::Body>& bodies) {
    auto laws = std::make_shared<std::vector<FieldForces>>();
    const scene::MagneticField field =
        scene.magnetic_field.value_or(scene::MagneticField{});
    for (const structure::Body& body : bodies) laws->emplace_back(body, field);
    return [laws](const StructureFiles::Instant& now, std::vector<double>& out) {
        std::span<const Vec3> left(now.state.position_m);
        for (const FieldForces& law : *laws) {
            for (const Vec3& force :
                 law.at(left.first(law.nodes()), now.time_s, now.field_t))
                append(out, force);
            left = left.subspan(law.nodes());
        }
    };
}

auto of_each_node(std::function<Vec3(const NodalState&, std::size_t)> value) {
    return [value](const StructureFiles::Instant& now, std::vector<double>& out) {
        for (std::size_t n = 0; n < now.state.position_m.size(); ++n)
            append(out, value(now.state, n));
    };
}

Vec3 magnetization_of(const structure::Body& body, std::size_t element) {
    return body.magnetization_a_m.empty() ? Vec3{} : body.magnetization_a_m[element];
}

}  // namespace

StructureFiles::StructureFiles(const scene::Scene& scene, const Bodies& bodies,
                               const NodalState& start,
                               const std::filesystem::path& run_folder)
    : start_m_(start.position_m),
      folder_(run_folder / "fields"),
      series_(run_folder / "structure.pvd") {
    int first_node = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const structure::Body& body = bodies[b];
        for (auto nodes : body.mesh.elements) {
            for (int& node : nodes) node += first_node;
            elements_.push_back(nodes);
            body_.push_back(static_cast<float>(b));
        }
        names_.words.push_back(body.name);
        first_node += nodes_of(body);
    }
    for (const BodyField field : scene.output.structure->fields)
        add(field, scene, bodies);
    add_orientations(scene, bodies);
}

void StructureFiles::add(BodyField field, const scene::Scene& scene,
                         const Bodies& bodies) {
    const Kind& kind = kinds[static_cast<int>(field)];
    fields_.push_back({fmt::format("{}[{}]", scene::name_of(field), kind.unit),
                       kind.components, kind.of_nodes, nullptr});
    if (kind.of_nodes)
        add_of_nodes(field, scene, bodies);
    else if (field == BodyField::magnetization)
        add_magnetization(bodies);
    else
        add_of_elements(field, bodies);
}

void StructureFiles::add_of_nodes(BodyField field, const scene::Scene& scene,
                                  const Bodies& bodies) {
    auto& add = fields_.back().add;
    if (field == BodyField::displacement) {
        add = of_each_node([this](const NodalState& state, std::size_t n) {
            return state.position_m[n] - start_m_[n];
        });
    } else if (field == BodyField::velocity) {
        add = of_each_node(
            [](const NodalState& state, std::size_t n) { return state.velocity_m_s[n]; });
    } else if (field == BodyField::magnetic_force) {
        add = magnetic_forces(scene, bodies);
    } else {
        add = elastic_forces(bodies);
    }
}

// Adds two fields: the magnetisation as the body carries it, F M or R M, and that at
// rest, M. The energy in a field B is its product with -B for each volume at rest
// (magnetic_forces.h, turned_moments.h).
void StructureFiles::add_magnetization(const Bodies& bodies) {
    std::vector<double> at_rest;
    std::vector<std::vector<Vec3>> of_body;
    std::vector<bool> turns;
    for (const structure::Body& body : bodies) {
        turns.push_back(structure::is_turned(body));
        auto& own = of_body.emplace_back();
        for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
            own.push_back(magnetization_of(body, e));
            append(at_rest, own.back());
        }
    }
    fields_.back().add = each_element(
        bodies, [of_body, turns](std::size_t b, std::size_t e, const Eigen::Matrix3d& f,
                                 std::vector<double>& out) {
            const Vec3& m = of_body[b][e];
            const Eigen::Matrix3d by = turns[b] ? structure::rotation_of(f) : f;
            const Eigen::Vector3d now = by * Eigen::Vector3d(m[0], m[1], m[2]);
            append(out, now);
        });
    fields_.push_back(
        {"magnetization_at_rest[A/m]", 3, false,
         [at_rest](const Instant&, std::vector<double>& out) { append(out, at_rest); }});
}

void StructureFiles::add_of_elements(BodyField field, const Bodies& bodies) {
    auto& add = fields_.back().add;
    using Matrix = Eigen::Matrix3d;
    using Out = std::vector<double>;
    if (field == BodyField::stretches) {
        add =
            each_element(bodies, [](std::size_t, std::size_t, const Matrix& f, Out& out) {
                append(out, structure::principal_stretches(f));
            });
    } else if (field == BodyField::volume_ratio) {
        add = each_element(bodies, [](std::size_t, std::size_t, const Matrix& f,
                                      Out& out) { out.push_back(f.determinant()); });
    } else if (field == BodyField::stress) {
        std::vector<std::vector<structure::Material>> of_body;
        for (const structure::Body& body : bodies) {
            auto& own = of_body.emplace_back();
            for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
                own.push_back(material_in_files(body, e));
        }
        add = each_element(
            bodies, [of_body](std::size_t b, std::size_t e, const Matrix& f, Out& out) {
                append(out, structure::cauchy_stress_pa(of_body[b][e], f));
            });
    } else {
        add = energy_densities(bodies);
    }
}

// Adds two fields where there are rigid parts: the turn of the body's frame in space as
// a quaternion w, x, y, z, and as three angles. Soft elements have zeros, which are no
// quaternion of a turn.
void StructureFiles::add_orientations(const scene::Scene& scene, const Bodies& bodies) {
    const std::vector<RigidPartOfScene> parts = rigid_parts_of(bodies);
    if (parts.empty()) return;
    std::vector<int> part_of_element;  // -1: soft
    std::vector<Eigen::Quaterniond> at_start;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const int first = static_cast<int>(at_start.size());
        for (std::size_t e = 0; e < bodies[b].mesh.elements.size(); ++e)
            part_of_element.push_back(structure::is_soft(bodies[b], e)
                                          ? -1
                                          : first + bodies[b].element_rigid[e]);
        at_start.resize(at_start.size() + bodies[b].rigid_parts.size(),
                        turn_at_start(scene.bodies[b].initial));
    }
    // value: what is appended of a turn, `count` numbers.
    const auto of_turns = [=](std::size_t count, const auto& value) {
        return [=](const Instant& now, std::vector<double>& out) {
            for (const int part : part_of_element) {
                if (part < 0)
                    out.resize(out.size() + count);
                else
                    append(out, value(now.state.rigid.at(part).turn * at_start[part]));
            }
        };
    };
    fields_.push_back(
        {"orientation[1]", 4, false, of_turns(4, [](const Eigen::Quaterniond& q) {
             return std::array{q.w(), q.x(), q.y(), q.z()};
         })});
    fields_.push_back({"angles[rad]", 3, false, of_turns(3, angles_rad)});
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

void StructureFiles::write(std::int64_t index, double time_s, const NodalState& state,
                           const std::optional<Vec3>& field_t) {
    std::vector<double> points;
    for (const Vec3& x : state.position_m) append(points, x);
    std::vector<std::vector<double>> values(fields_.size());
    std::vector<output::Field> of_nodes, of_elements;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const Field& field = fields_[i];
        field.add({time_s, state, field_t}, values[i]);
        (field.of_nodes ? of_nodes : of_elements)
            .push_back(
                {field.name, field.components, std::span<const double>(values[i])});
    }
    of_elements.push_back({"body", 1, std::span<const float>(body_)});
    output::write_vtu(file(index), {std::span<const double>(points), elements_}, of_nodes,
                      of_elements, {&names_, 1});
    series_.add(time_s, file(index));
}

}  // namespace magfsi::bodies
