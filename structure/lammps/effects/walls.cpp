// SPDX-License-Identifier: GPL-2.0-or-later
// Walls: sides of the fluid's box, which are planes with the fix of the platform, and its
// obstacles, which are solid shapes. Both push the surfaces of bodies back.
#include "atom.h"
#include "error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/names.h"
#include "structure/lammps/platform_law.h"
#include "structure/lammps/sticking_fix.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/surface.h"
#include "structure/solid_shape.h"

namespace magfsi::structure {
namespace {

using namespace std::string_view_literals;
constexpr auto word_friction = "friction"sv, word_periodic = "periodic"sv,
               word_lost = "lost_share"sv;
// Margin on distances, relative.
constexpr double rounding = 1e-9;
constexpr double at_rest[3] = {0, 0, 0};

// fix ID group magttice/solid SHAPE ... STIFFNESS [friction MU] [periodic LX LY LZ]: a
// solid shape that pushes the surfaces of bodies back. The points pushed are the nodes
// and the middles of the surface's quads, with half of the area each, as a quad alone
// would dip into a ball between its nodes. Each point feels the plane that touches the
// shape at its nearest point.
class FixMagtticeSolid : public StickingFix {
  public:
    FixMagtticeSolid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override {
        using namespace LAMMPS_NS::FixConst;
        return PRE_REVERSE | MIN_PRE_REVERSE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
    }
    void setup_post_neighbor() override { rebuild(); }
    void post_neighbor() override { rebuild(); }
    void min_post_neighbor() override { rebuild(); }
    // Forces are added before the reverse communication, as the quads have nodes of other
    // ranks.
    void setup_pre_reverse(int, int) override { (this->*push_)(); }
    void pre_reverse(int, int) override { (this->*push_)(); }
    void min_pre_reverse(int, int) override { (this->*push_)(); }
    double compute_scalar() override;  // energy of the springs [J], collective
    // Energy lost to friction since the start [J], collective
    double compute_vector(int) override;
    void* extract(const char* name, int& dimension) override;

  private:
    // A point that the shape can push: the mean of four atoms, a node four times or the
    // corners of a quad. The numbers are atom IDs in all_ and local indices in here_.
    struct Point {
        std::array<int, 4> atom{};
        double area_m2 = 0;
        // Place at the last evaluation, and the distance from it within which the shape
        // cannot touch the point.
        Vec3 seen_m{};
        double clear_m = 0;
        int stick = 0;  // number among the stick points of the first atom
    };
    void parse(int narg, char** arg);
    // Lists the points of all bodies; returns the largest number with the same first
    // atom.
    int add_points();
    void rebuild();
    // Adds the forces; rough: with friction.
    template <bool rough>
    void push();

    std::optional<SolidShape> shape_;
    // Length of the shape's period along each axis, 0 along axes without one
    Vec3 period_m_{};
    Platform plane_;  // stiffness and friction of all contact planes
    void (FixMagtticeSolid::*push_)() = &FixMagtticeSolid::push<false>;
    // Points of all bodies, and those of this rank
    std::vector<Point> all_, here_;
    double energy_j_ = 0;  // this rank's share, at the last forces
    double slid_j_ = 0;    // energy lost since the start, this rank's share
};

FixMagtticeSolid::FixMagtticeSolid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : StickingFix(lammps, narg, arg) {
    parse(narg, arg);
    const int most = add_points();
    if (all_.empty())
        fail(*error,
             "fix {} magttice/solid found no fix magttice before it, it needs one", id);
    if (plane_.friction > 0) {
        keep_sticks(most);
        push_ = &FixMagtticeSolid::push<true>;
    }
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 1;
    extvector = 1;
    global_freq = 1;
    energy_global_flag = 1;
    thermo_energy = 1;
}

void FixMagtticeSolid::parse(int narg, char** arg) {
    const int stiffness = 3 + (narg > 3 ? shape_word_count(arg[3]) : 0);
    try {
        shape_ = parse_shape({arg + 3, arg + std::clamp(stiffness, 3, narg)});
    } catch (const std::exception& cause) {
        fail(*error, "fix {} magttice/solid: {}", id, cause.what());
    }
    const bool rough = narg > stiffness + 2 && arg[stiffness + 1] == word_friction;
    const int words = stiffness + (rough ? 3 : 1);
    const bool periodic = narg == words + 4 && arg[words] == word_periodic;
    if (narg != words && !periodic)
        fail(*error,
             "fix {} magttice/solid needs a shape, a stiffness and no more than "
             "\"friction\" with one value and \"periodic\" with three",
             id);
    for (int d = 0; periodic && d < 3; ++d)
        period_m_[d] = number(arg[words + 1 + d], lmp);
    plane_.stiffness_pa_m = number(arg[stiffness], lmp);
    if (rough) plane_.friction = number(arg[stiffness + 2], lmp);
    if (!(plane_.stiffness_pa_m > 0) || !(plane_.friction >= 0))
        fail(*error,
             "fix {} magttice/solid: stiffness {} and friction {} found; one must be "
             "positive, the other not negative",
             id, arg[stiffness], rough ? arg[stiffness + 2] : "0");
}

// Nodes have the stick point 0 of their atom, quads further ones of their first node.
int FixMagtticeSolid::add_points() {
    int most = 1;
    for (const FixMagttice* body : bodies_of(*modify)) {
        Mesh mesh;
        mesh.nodes = body->nodes_m();
        mesh.elements = body->lattice().elements;
        const int first = body->range().first_id;
        const auto areas = surface_areas(mesh.nodes, mesh.elements);
        for (std::size_t n = 0; n < areas.size(); ++n) {
            if (areas[n] == 0) continue;
            all_.push_back({{}, 0.5 * areas[n], {}, 0, 0});
            all_.back().atom.fill(first + static_cast<int>(n));
        }
        std::vector<int> of_node(mesh.nodes.size());
        for (const SurfaceQuad& quad : boundary_quads(mesh)) {
            const int number = ++of_node[quad.node[0]];
            most = std::max(most, number + 1);
            all_.push_back({quad.node,
                            0.5 * quad_area(corners(mesh.nodes, quad.node)),
                            {},
                            0,
                            number});
            for (int& node : all_.back().atom) node += first;
        }
    }
    return most;
}

void FixMagtticeSolid::rebuild() {
    here_.clear();
    for (const Point& point : all_) {
        const int owner = atom->map(point.atom[0]);
        if (owner < 0 || owner >= atom->nlocal || (atom->mask[owner] & groupbit) == 0)
            continue;
        here_.push_back(point);
        for (int& a : here_.back().atom) {
            const int seen = atom->map(a);
            if (seen < 0)
                fail(*error,
                     "fix {} magttice/solid: atom {} is not known beside its neighbour; "
                     "raise comm_modify cutoff",
                     id, a);
            a = seen;
        }
    }
}

template <bool rough>
void FixMagtticeSolid::push() {
    energy_j_ = 0;
    const double* const* const x = atom->x;
    double* const* const f = atom->f;
    for (Point& point : here_) {
        Vec3 place{};
        for (const int a : point.atom) place += 0.25 * vector_at(x[a]);
        if (distance_m(place, point.seen_m) < point.clear_m) continue;
        const SignedDistance to = signed_distance(*shape_, place, period_m_);
        point.seen_m = place;
        point.clear_m = std::max(0.0, (1 - rounding) * to.distance_m);
        Platform plane = plane_;
        plane.normal = to.normal;
        plane.point_m = place - to.distance_m * to.normal;
        PlatformContact contact;
        if constexpr (rough)
            contact = platform_contact(plane, point.area_m2, place.data(), at_rest, 0,
                                       stick(point.atom[0], point.stick));
        else
            contact = frictionless_contact(plane, point.area_m2, place.data(), at_rest);
        energy_j_ += contact.energy_j;
        slid_j_ += contact.slid_j;
        for (const int a : point.atom) add_to(f[a], 0.25 * contact.force_n);
    }
}

double FixMagtticeSolid::compute_vector(int) {
    double all = 0;
    MPI_Allreduce(&slid_j_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

void* FixMagtticeSolid::extract(const char* name, int& dimension) {
    dimension = 0;
    return plane_.friction > 0 && name == word_lost ? &slid_j_ : nullptr;
}

double FixMagtticeSolid::compute_scalar() {
    double all = 0;
    MPI_Allreduce(&energy_j_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

// Stiffness that the moduli ask for [Pa/m]: that of a platform under a column of one
// element, (lambda + 2 G) / (2 h), since a corner or the pole of a ball may meet the
// wall. h is the mean size of an element. The largest of all bodies counts.
double stiffness_of_bodies_pa_m(const LammpsInput& input) {
    double largest = 0;
    for (const Body& body : input.bodies) {
        const double size_m = std::cbrt(volume_m3(body.mesh) /
                                        static_cast<double>(body.mesh.elements.size()));
        for (const Material& material : pressing_materials(body, input.bodies))
            largest = std::max(largest, platform_stiffness_pa_m(material, size_m));
    }
    return largest;
}

// At least that which contact was given.
double at_least_of_contact(double stiffness_pa_m, const LammpsInput& input) {
    return std::max(stiffness_pa_m, input.contact ? input.contact->stiffness_pa_m : 0);
}

// Stiffness of plane walls [Pa/m].
double plane_stiffness_pa_m(const LammpsInput& input) {
    return at_least_of_contact(stiffness_of_bodies_pa_m(input), input);
}

// Stiffness of shapes [Pa/m]. A ball on a ball or on an edge is carried by one or two
// nodes, where a plane wall has many. With 16 times a wall's stiffness a ball of 1 mm
// that falls at 8 cm/s penetrates by 5 um, at the cost of a step of a fifth of the stable
// one.
double shape_stiffness_pa_m(const LammpsInput& input) {
    return at_least_of_contact(16 * stiffness_of_bodies_pa_m(input), input);
}

void add_walls(Lines& lines, const LammpsInput& input) {
    const std::vector<std::string> bodies =
        lammps_names(input.bodies, input.motions.size());
    const double mu = input.contact ? input.contact->friction : 0;
    const std::string rough = mu > 0 ? fmt::format(" friction {:.17g}", mu) : "";
    for (const Wall& wall : input.walls) {
        std::string group = "all";
        if (wall.bodies.size() < bodies.size()) {
            group = "touch_" + wall.name;
            std::string line = fmt::format("group {} union", group);
            for (const std::size_t b : wall.bodies) line += " " + bodies[b];
            lines.push_back(line);
        }
        if (wall.shape) {
            lines.push_back(fmt::format("fix wall_{} {} magttice/solid {} {:.17g}{}{}",
                                        wall.name, group, shape_words(*wall.shape),
                                        shape_stiffness_pa_m(input), rough,
                                        periodic_words(input)));
            continue;
        }
        const Platform& plane = wall.plane;
        lines.push_back(fmt::format(
            "fix wall_{} {} magttice/platform {:.17g} {:.17g} {:.17g}{}", wall.name,
            group, fmt::join(plane.point_m, " "), fmt::join(plane.normal, " "),
            plane_stiffness_pa_m(input), rough));
    }
}

// Stiffness for the stable step. Between a shape and the side next to it both press a
// node, nearly along one line. In the corner of two sides each presses along its own
// axis, so that they do not add.
double pressing_spring_pa_m(const LammpsInput& input, const Body&) {
    const bool shapes = std::ranges::any_of(
        input.walls, [](const Wall& wall) { return wall.shape.has_value(); });
    return plane_stiffness_pa_m(input) + (shapes ? shape_stiffness_pa_m(input) : 0);
}

}  // namespace

extern const Effect walls_effect{
    .name = "walls",
    .asked = [](const LammpsInput& input) { return !input.walls.empty(); },
    .commands = add_walls,
    .surface_spring_pa_m = pressing_spring_pa_m,
    .fix = {"magttice/solid", make_fix<FixMagtticeSolid>}};

}  // namespace magfsi::structure
