// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/source_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/magnetics/grid_field.h"
#include "structure/magnetics/point_fields.h"
#include "structure/motion.h"
#include "structure/refuse.h"
#include "structure/table_rows.h"

namespace magfsi::structure {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using point_fields::Gradient;

// One turn of a coil.
struct Loop {
    double radius_m = 0;
};
using ElementShape =
    std::variant<DipoleSource, CuboidMagnet, CylinderMagnet, Loop, GridValues>;

Vector3d vector(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

// Rotation that turns z onto an axis by the shortest way.
Matrix3d frame_along(const Vec3& axis) {
    const Vector3d to = vector(axis);
    if (!(to.norm() > 0))
        refuse(
            "an axis of length 0 found for a source of the field; any other is allowed");
    const Vector3d normal = Vector3d::UnitZ().cross(to);
    // Every axis across z will do where the source's axis is z or its opposite.
    const Vector3d about =
        normal.norm() > 0 ? normal.normalized() : Vector3d(Vector3d::UnitX());
    return Eigen::AngleAxisd(std::atan2(normal.norm(), to.z()), about).toRotationMatrix();
}

Matrix3d turned(const Vec3& axis, double angle_rad) {
    const Vector3d along = vector(axis);
    if (!(along.norm() > 0))
        refuse(
            "an axis of length 0 found for a source of the field; any other is allowed");
    return Eigen::AngleAxisd(angle_rad, along.normalized()).toRotationMatrix();
}

// Field of each shape at a point of its own frame, for std::visit.
template <class T>
struct LocalField {
    const point_fields::Point<T>& x;

    auto operator()(const DipoleSource& s) const {
        return point_fields::dipole(x, s.moment_a_m2);
    }
    auto operator()(const CuboidMagnet& s) const {
        return point_fields::cuboid(x, 0.5 * s.size_m, s.remanence_t);
    }
    auto operator()(const CylinderMagnet& s) const {
        return point_fields::cylinder(x, s.diameter_m / 2, s.height_m / 2, s.remanence_t);
    }
    auto operator()(const Loop& s) const { return point_fields::loop(x, s.radius_m); }
    auto operator()(const GridValues& s) const { return s.at(x); }
};

// Factor of a source's strength at a time.
double strength_at(const StrengthLaw& law, double time_s) {
    struct At {
        double t;
        double operator()(const StrengthOscillation& l) const {
            return std::sin(2 * std::numbers::pi * l.frequency_hz * t + l.phase_rad);
        }
        double operator()(const StrengthTable& l) const {
            return rows_at(l.time_s, l.repeat, t).of(l.factor);
        }
        double operator()(const StrengthRamp& l) const {
            if (t >= l.duration_s) return 1;
            return 0.5 * (1 - std::cos(std::numbers::pi * t / l.duration_s));
        }
        double operator()(const Formula& l) const { return value_at(l.si, t); }
    };
    return std::visit(At{time_s}, law);
}

// Displacement of a source from its position [m]. A formula counts as it is, without its
// value at time 0.
Vector3d way_at(const SourceMotion& motion, double time_s) {
    if (const auto* path = std::get_if<SourcePath>(&motion))
        return vector(
            rows_at(path->time_s, path->repeat, time_s).of(path->displacement_m));
    if (const auto* formula = std::get_if<FormulaMotion>(&motion))
        return vector(value_at(formula->component_m, time_s));
    if (const auto* ramp = std::get_if<DisplacementRamp>(&motion))
        return vector(displacement_m(*ramp, time_s));
    return vector(displacement_m(std::get<Oscillation>(motion), time_s));
}

// Angle of a turning source [rad].
double angle_at(const SourceTurning& turning, double time_s) {
    if (const auto* formula = std::get_if<Formula>(&turning.turns))
        return value_at(formula->si, time_s);
    return 2 * std::numbers::pi * std::get<double>(turning.turns) * time_s;
}

}  // namespace

// One coil, magnet or grid: its place in the frame of its source, and the present one in
// space.
struct SourceField::Element {
    ElementShape shape;
    std::size_t source = 0;
    Vector3d centre_m = Vector3d::Zero();
    Matrix3d frame = Matrix3d::Identity();
    double strength = 1;  // current times turns of a coil, else 1
    // Current over time, for coils of a system; replaces the factor 1.
    std::vector<double> time_s{}, current_a{};
    bool repeat = false;
    std::optional<Formula> current{};

    bool changes() const { return time_s.size() > 1 || current; }
    double current_at(double at_s) const {
        if (current) return value_at(current->si, at_s);
        return current_a.empty() ? 1 : rows_at(time_s, repeat, at_s).of(current_a);
    }

    // At the time of the last set_time
    Vector3d now_centre_m = Vector3d::Zero();
    Matrix3d now_frame = Matrix3d::Identity();
    double now_strength = 1;

    // Adds its field and gradient at a point of space.
    void add(const Vec3& point_m, FieldSample& out) const;
};

void SourceField::Element::add(const Vec3& point_m, FieldSample& out) const {
    if (now_strength == 0) return;
    const Vector3d x = now_frame.transpose() * (vector(point_m) - now_centre_m);
    const point_fields::Point<Gradient> at{
        Gradient::along(0, x[0]), Gradient::along(1, x[1]), Gradient::along(2, x[2])};
    const auto local = std::visit(LocalField<Gradient>{at}, shape);
    Vector3d b;
    Matrix3d g;
    for (int i = 0; i < 3; ++i) {
        const Gradient& component = local[i];
        b[i] = component.value;
        for (int j = 0; j < 3; ++j) g(i, j) = component.d[j];
    }
    out.field_t += now_strength * (now_frame * b);
    out.gradient_t_m += now_strength * (now_frame * g * now_frame.transpose());
}

namespace {

using Elements = std::vector<std::unique_ptr<SourceField::Element>>;

void require_positive(double value, const char* what) {
    if (!(value > 0))
        refuse("{} of {:g} m found for a source of the field, it must be above 0 m", what,
               value);
}

// Splits a source into its elements and checks its sizes.
struct Parts {
    Elements& out;
    std::size_t source;

    SourceField::Element& add(ElementShape shape) const {
        auto element = std::make_unique<SourceField::Element>();
        element->shape = std::move(shape);
        element->source = source;
        out.push_back(std::move(element));
        return *out.back();
    }
    void operator()(const DipoleSource& s) const { add(s); }
    void operator()(const CuboidMagnet& s) const {
        for (const double edge : s.size_m) require_positive(edge, "an edge");
        add(s);
    }
    void operator()(const CylinderMagnet& s) const {
        require_positive(s.diameter_m, "a diameter");
        require_positive(s.height_m, "a height");
        add(s).frame = frame_along(s.axis);
    }
    // along_m: place on the axis; sense: 1 or -1, the direction of the current.
    void add_coil(const CircularCoil& s, double along_m, double sense) const {
        require_positive(s.diameter_m, "a diameter");
        SourceField::Element& coil = add(Loop{s.diameter_m / 2});
        coil.frame = frame_along(s.axis);
        coil.centre_m = along_m * coil.frame.col(2);
        coil.strength = sense * s.current_a * s.turns;
    }
    void operator()(const CircularCoil& s) const { add_coil(s, 0, 1); }
    void operator()(const CoilPair& s) const {
        require_positive(s.distance_m, "a distance of coils");
        add_coil(s, -s.distance_m / 2, 1);
        add_coil(s, s.distance_m / 2, s.opposed ? -1 : 1);
    }
    void operator()(const CoilSystem& s) const {
        for (const SystemCoil& one : s.coils) {
            require_positive(one.diameter_m, "a diameter");
            const std::size_t times =
                one.current ? 0 : std::max<std::size_t>(1, s.time_s.size());
            if (one.current_a.size() != times) {
                refuse("{} currents of a coil for {} times found, one for each is needed",
                       one.current_a.size(), times);
            }
            SourceField::Element& coil = add(Loop{one.diameter_m / 2});
            coil.frame = frame_along(one.axis);
            coil.centre_m = vector(one.position_m);
            coil.strength = one.turns;
            coil.current = one.current;
            coil.current_a = one.current_a;
            if (!one.current) coil.time_s = s.time_s;
            coil.repeat = s.repeat;
        }
    }
    void operator()(const GridField& s) const { add(read_grid(s.file)); }
};

}  // namespace

SourceField::SourceField(const std::vector<FieldSource>& sources) : sources_(sources) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
        std::visit(Parts{elements_, i}, sources_[i].shape);
    set_time(0);
}

SourceField::~SourceField() = default;
SourceField::SourceField(SourceField&&) noexcept = default;
SourceField& SourceField::operator=(SourceField&&) noexcept = default;

bool SourceField::at_rest() const {
    return std::ranges::none_of(sources_,
                                [](const FieldSource& s) {
                                    return s.strength || s.motion || s.turning;
                                }) &&
           std::ranges::none_of(elements_, [](const auto& e) { return e->changes(); });
}

void SourceField::set_time(double time_s) {
    // The turning comes last, so that a source that circles a point takes its motion
    // along.
    struct Place {
        Vector3d position;
        Matrix3d frame;
        double strength;
    };
    std::vector<Place> places;
    for (const FieldSource& source : sources_) {
        Place place{vector(source.position_m), Matrix3d::Identity(), 1};
        if (source.rotation)
            place.frame = turned(source.rotation->axis, source.rotation->angle_rad);
        if (source.motion) place.position += way_at(*source.motion, time_s);
        if (source.turning) {
            const SourceTurning& turning = *source.turning;
            const Matrix3d turn = turned(turning.axis, angle_at(turning, time_s));
            place.frame = turn * place.frame;
            if (turning.about_m) {
                const Vector3d about = vector(*turning.about_m);
                place.position = about + turn * (place.position - about);
            }
        }
        if (source.strength) place.strength = strength_at(*source.strength, time_s);
        places.push_back(place);
    }
    for (const auto& element : elements_) {
        const Place& place = places[element->source];
        element->now_centre_m = place.position + place.frame * element->centre_m;
        element->now_frame = place.frame * element->frame;
        element->now_strength =
            place.strength * element->strength * element->current_at(time_s);
    }
}

FieldSample SourceField::sample(const Vec3& point_m) const {
    FieldSample out;
    for (const auto& element : elements_) element->add(point_m, out);
    return out;
}

Matrix3d SourceField::gradient_along(const Vec3& point_m, const Vector3d& way) const {
    const double length = way.norm();
    if (length == 0) return Matrix3d::Zero();
    // Step of the difference: near the cube root of rounding, relative to the distance of
    // the nearest source.
    double distance_m = INFINITY;
    for (const auto& element : elements_)
        distance_m =
            std::min(distance_m, (vector(point_m) - element->now_centre_m).norm());
    const double step_m = 1e-5 * std::max(distance_m, 1e-6);
    const Vector3d step = step_m / length * way;
    Vec3 ahead = point_m, behind = point_m;
    for (std::size_t d = 0; d < 3; ++d) {
        ahead[d] += step[d];
        behind[d] -= step[d];
    }
    return (length / (2 * step_m)) *
           (sample(ahead).gradient_t_m - sample(behind).gradient_t_m);
}

}  // namespace magfsi::structure
