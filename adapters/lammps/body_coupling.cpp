#include "adapters/lammps/body_coupling.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "adapters/bodies/body_mesh.h"
#include "adapters/bodies/body_part.h"
#include "adapters/bodies/fluid_inside.h"
#include "adapters/bodies/probe_row.h"
#include "adapters/bodies/scene_to_body.h"
#include "adapters/lammps/body_iterations.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "coupler/participants/world.h"

namespace magfsi::lammps {

namespace {

std::vector<bodies::PlacedMarker> place_all(const scene::Scene& scene) {
    std::vector<bodies::PlacedMarker> all;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto markers = bodies::place_markers(
            scene.bodies[b], scene.coupling->immersed_boundary, scene.fluid->spacing_m,
            static_cast<int>(b), bodies::spans_fluid(*scene.fluid, scene.bodies[b]));
        all.insert(all.end(), markers.begin(), markers.end());
    }
    return all;
}

void add_to(Vec3& sum, const Vec3& force) {
    for (std::size_t d = 0; d < 3; ++d) sum[d] += force[d];
}

std::vector<Vec3> over_ranks(std::vector<Vec3> sum, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), static_cast<int>(3 * sum.size()), MPI_DOUBLE,
                  MPI_SUM, comm);
    return sum;
}

coupler::PenaltyScale penalty_scale(const scene::Scene& scene,
                                    const coupler::Session& session) {
    coupler::PenaltyScale scale{scene.coupling->immersed_boundary.strength,
                                scene.fluid->density_kg_m3, session.clock().step_s()};
    if (scene.coupling->scheme == coupler::Scheme::implicit) scale.enclosed_follow = 1;
    return scale;
}

std::span<double> flat(std::span<Vec3> v) {
    return {v.empty() ? nullptr : v.front().data(), 3 * v.size()};
}

}  // namespace

BodyCoupling::BodyCoupling(const scene::Scene& scene, const coupler::Session& session,
                           Engine& engine, const std::vector<int>& first_node)
    : scene_(scene),
      session_(session),
      engine_(engine),
      bodies_(scene.bodies.size()),
      gravity_m_s2_(bodies::to_gravity(scene).value_or(Vec3{})) {
    grid_ = coupler::grid_from_text(coupler::swap_text(
        session.world(), "", coupler::startup_timeout_s, "description of the grid"));
    const auto& boundary = scene.coupling->immersed_boundary;
    const auto placed = place_all(scene);
    const coupler::PenaltyScale scale = penalty_scale(scene, session);
    auto markers = own_markers(placed, first_node);
    share_fluid_inside(markers);
    force_ =
        std::make_unique<coupler::PenaltyForce>(std::move(markers), scale, gravity_m_s2_);
    if (boundary.iterations > 1)
        iterated_ = std::make_unique<coupler::IteratedForcing>(force_->markers(), scale);
    find_parts(placed);
    slip_ = std::make_unique<coupler::SlipRecord>(own_areas(placed));
    fluid_velocity_.resize(force_->markers().size());
    exchange_ = std::make_unique<coupler::StructureExchange>(
        session.world(), grid_, boundary.kernel, session.timeout_s());
    attach_force();
    const std::size_t count = force_->markers().size();
    const auto& coupling = *scene.coupling;
    const bool two_samples =
        coupling.scheme != coupler::Scheme::serial ||
        coupling.sampled_velocity == coupler::SampledVelocity::linear;
    if (two_samples) last_velocity_.resize(count);
    if (coupling.scheme == coupler::Scheme::parallel) {
        before_m_.resize(count);
        under_way_.resize(count);
    }
    if (coupling.scheme == coupler::Scheme::implicit) start_iterations();
}

std::vector<coupler::Marker> BodyCoupling::own_markers(
    const std::vector<bodies::PlacedMarker>& placed, const std::vector<int>& first_node) {
    const coupler::SolidCells solid(grid_);
    const auto kernel = scene_.coupling->immersed_boundary.kernel;
    std::vector<coupler::Marker> mine;
    placed_ = placed.size();
    for (const bodies::PlacedMarker& p : placed) {
        const int shift = first_node[static_cast<std::size_t>(p.body)];
        if (!engine_.owns(p.point.node[0] + shift)) continue;
        coupler::Marker marker;
        for (std::size_t a = 0; a < 8; ++a) {
            marker.node[a] = engine_.local_index(p.point.node[a] + shift);
            if (marker.node[a] < 0) {
                throw std::logic_error(
                    fmt::format("atom {} of a marker's element is not on this rank "
                                "(ghost cutoff too small)",
                                p.point.node[a] + shift));
            }
        }
        marker.weight = p.point.weight;
        marker.volume_m3 = p.volume_m3;
        marker.displaced_m3 = p.displaced_m3;
        marker.body = p.body;
        const Vec3 at = coupler::at_marker(marker, engine_.positions());
        const auto stencil = coupler::marker_stencil(grid_, kernel, at);
        if (solid.fluid_share(stencil) < coupler::least_fluid_share) continue;
        mine.push_back(marker);
        placed_index_.push_back(static_cast<int>(&p - placed.data()));
    }
    return mine;
}

// What came off the nodes is no force of the markers any more.
void BodyCoupling::share_fluid_inside(std::vector<coupler::Marker>& markers) {
    const scene::Scene& scene = scene_;
    notes_velocities_ =
        bodies::ProbeRow::wants(scene, scene::BodyQuantity::fluid_force) ||
        (scene.probes && !scene.probes->integrals.empty());
    std::vector<double> off_kg_m3;
    for (const scene::Body& body : scene.bodies)
        off_kg_m3.push_back(bodies::off_nodes_kg_m3(scene, bodies::to_body(body)));
    for (coupler::Marker& m : markers) {
        const double off = off_kg_m3[static_cast<std::size_t>(m.body)];
        if (notes_velocities_) off_nodes_kg_.push_back(off * m.displaced_m3);
        m.displaced_m3 *= 1 - off / scene.fluid->density_kg_m3;
    }
    start_velocity_.resize(off_nodes_kg_.size());
}

void BodyCoupling::attach_force() {
    const auto& probes = scene_.probes;
    if (!probes || !probes->energy_audit) {
        return engine_.attach_fluid_force(
            [this](const double* velocity, double* force, double step_s) {
                force_->apply(velocity, force, step_s);
            });
    }
    work_ = std::make_unique<coupler::MarkerWork>(force_->markers().size());
    engine_.attach_fluid_force(
        [this](const double* velocity, double* force, double step_s) {
            force_->apply(velocity, force, step_s);
            work_->add_substep(*force_, velocity, step_s);
        });
}

void BodyCoupling::note_velocities() {
    if (work_) work_->begin_step();
    if (!notes_velocities_) return;
    engine_.renew_ghost_velocities();
    for (std::size_t m = 0; m < start_velocity_.size(); ++m)
        start_velocity_[m] =
            coupler::at_marker(force_->markers()[m], engine_.velocities());
}

std::vector<coupler::MarkerArea> BodyCoupling::own_areas(
    const std::vector<bodies::PlacedMarker>& placed) const {
    std::vector<coupler::MarkerArea> areas;
    for (std::size_t m = 0; m < placed_index_.size(); ++m) {
        const auto& p = placed[static_cast<std::size_t>(placed_index_[m])];
        if (p.first_edge == std::array<double, 8>{}) continue;
        areas.push_back({static_cast<int>(m), p.first_edge, p.second_edge});
    }
    return areas;
}

std::vector<Vec3> BodyCoupling::marker_positions() const {
    std::vector<Vec3> positions;
    positions.reserve(force_->markers().size());
    for (const coupler::Marker& marker : force_->markers()) {
        positions.push_back(coupler::at_marker(marker, engine_.positions()));
    }
    return positions;
}

void BodyCoupling::exchange_first() {
    now_m_ = marker_positions();
    const std::vector<Vec3> nothing(now_m_.size());
    if (session_.restart()) {
        if (under_way_.empty())
            exchange_->send(-1, now_m_, nothing, now_m_);
        else
            exchange_->send(-1, before_m_, under_way_, now_m_);
        // The checkpoint has them already, to the last bit.
        std::vector<Vec3> again(fluid_velocity_.size());
        exchange_->receive(-1, again);
        return;
    }
    exchange_->send(-1, now_m_, nothing, now_m_);
    exchange_->receive(-1, fluid_velocity_);
    force_->enclosed().start(fluid_velocity_);
    if (!last_velocity_.empty()) last_velocity_ = fluid_velocity_;
}

void BodyCoupling::begin_step() {
    note_velocities();
    if (!iterated_) return force_->begin_step(fluid_velocity_);
    force_->begin_step(fluid_velocity_, iterated_->impulse());
    iterated_->begin_step();
}

void BodyCoupling::begin_step_with_mean() {
    note_velocities();
    for (std::size_t m = 0; m < last_velocity_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            last_velocity_[m][d] = 0.5 * (last_velocity_[m][d] + fluid_velocity_[m][d]);
    }
    force_->begin_step(last_velocity_);
    last_velocity_ = fluid_velocity_;
}

void BodyCoupling::begin_step_extrapolated() {
    std::vector<Vec3> end = fluid_velocity_;
    for (std::size_t m = 0; m < end.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            end[m][d] += fluid_velocity_[m][d] - last_velocity_[m][d];
    }
    begin_step();
    force_->let_change(fluid_velocity_, end);
    last_velocity_ = fluid_velocity_;
}

void BodyCoupling::send_impulses() {
    before_m_ = std::move(now_m_);
    now_m_ = marker_positions();
    const int iteration = iterations_ ? current_iteration() : 0;
    exchange_->send({session_.clock().step(), iteration}, before_m_, force_->impulse(),
                    now_m_);
}

void BodyCoupling::iterate_forcing() {
    const std::int64_t step = session_.clock().step();
    std::vector<Vec3> velocity(force_->markers().size());
    for (int i = 1; i < scene_.coupling->immersed_boundary.iterations; ++i) {
        exchange_->receive({step, i}, velocity);
        exchange_->send({step, i}, before_m_,
                        iterated_->correct(before_m_, now_m_, velocity), now_m_);
    }
}

void BodyCoupling::receive_velocities() {
    exchange_->receive(session_.clock().step(), fluid_velocity_);
}

std::vector<BodyCoupling::MarkerArray> BodyCoupling::carried() {
    std::vector<MarkerArray> all{
        {"fluid_velocity", flat(fluid_velocity_)},
        {"enclosed_velocity", flat(force_->enclosed().last_velocity())},
        {"enclosed_acceleration", flat(force_->enclosed().acceleration())}};
    if (!last_velocity_.empty()) all.push_back({"last_velocity", flat(last_velocity_)});
    if (!under_way_.empty()) {
        std::ranges::copy(force_->impulse(), under_way_.begin());
        all.push_back({"before", flat(before_m_)});
        all.push_back({"impulse", flat(under_way_)});
    }
    if (iterated_) all.push_back({"owed_impulse", flat(iterated_->impulse())});
    if (work_) {
        all.push_back({"works", flat(work_->works())});
        all.push_back({"fluid_force", flat(work_->last_fluid_force())});
        all.push_back({"enclosed_force", flat(work_->last_enclosed_force())});
    }
    if (iterations_) add_learnt(all);
    return all;
}

void BodyCoupling::shorten_last_step(double part) {
    const auto closer = [&](std::span<Vec3> last) {
        for (std::size_t m = 0; m < last.size(); ++m) {
            for (std::size_t d = 0; d < 3; ++d)
                last[m][d] =
                    fluid_velocity_[m][d] + part * (last[m][d] - fluid_velocity_[m][d]);
        }
    };
    closer(force_->enclosed().last_velocity());
    closer(last_velocity_);
}

void BodyCoupling::find_parts(const std::vector<bodies::PlacedMarker>& placed) {
    const scene::Scene& scene = scene_;
    if (!scene.probes) return;
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        const auto* part = std::get_if<scene::BodyPart>(&integral.over);
        if (!part) continue;
        const auto body = std::ranges::find(scene.bodies, part->body, &scene::Body::name);
        const auto b = static_cast<int>(body - scene.bodies.begin());
        const auto in = bodies::elements_of(*part, bodies::to_mesh(*body));
        auto& markers = parts_.emplace_back();
        for (std::size_t m = 0; m < placed_index_.size(); ++m) {
            const auto& p = placed[static_cast<std::size_t>(placed_index_[m])];
            if (p.body == b && in[static_cast<std::size_t>(p.point.element)])
                markers.push_back(m);
        }
    }
}

Vec3 BodyCoupling::force_on(std::size_t marker) const {
    const double step_s = session_.clock().step_s();
    const Vec3 velocity =
        coupler::at_marker(force_->markers()[marker], engine_.velocities());
    Vec3 force = force_->constant_force()[marker];
    for (std::size_t d = 0; d < 3; ++d) {
        const double acceleration =
            (velocity[d] - start_velocity_[marker][d]) / step_s - gravity_m_s2_[d];
        force[d] +=
            off_nodes_kg_[marker] * acceleration - force_->impulse()[marker][d] / step_s;
    }
    return force;
}

std::vector<Vec3> BodyCoupling::force_on_bodies() {
    engine_.renew_ghost_velocities();
    std::vector<Vec3> sum(bodies_);
    for (std::size_t m = 0; m < force_->markers().size(); ++m)
        add_to(sum[static_cast<std::size_t>(force_->markers()[m].body)], force_on(m));
    return over_ranks(std::move(sum), session_.world().local());
}

std::vector<Vec3> BodyCoupling::force_on_parts() {
    engine_.renew_ghost_velocities();
    std::vector<Vec3> sum(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        for (const std::size_t m : parts_[p]) add_to(sum[p], force_on(m));
    }
    return over_ranks(std::move(sum), session_.world().local());
}

void BodyCoupling::audit(coupler::BalanceRecord& record) const {
    coupler::InterfaceBalance given;
    std::span<const Vec3> impulse = force_->impulse();
    std::vector<Vec3> with_iterations;
    if (iterated_) {
        with_iterations = iterated_->added_to(impulse);
        impulse = with_iterations;
    }
    for (std::size_t m = 0; m < impulse.size(); ++m)
        coupler::add_marker(given, impulse[m], fluid_velocity_[m]);
    record.add(given);
}

void BodyCoupling::measure_slip() {
    engine_.renew_ghost_velocities();
    slip_->add(force_->markers(), fluid_velocity_, engine_.positions(),
               engine_.velocities());
}

coupler::SlipReport BodyCoupling::slip() const {
    return slip_->collect(session_.world().local());
}

}  // namespace magfsi::lammps
