// SPDX-License-Identifier: GPL-2.0-or-later
// Every key of the table reaches its member.
#include <gtest/gtest.h>

#include <numbers>

#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

constexpr double pi = std::numbers::pi;

Scene complete(const char* name) {
    return read_scene(test_folder / "complete" / name);
}

TEST(Keys, of_time_and_loads) {
    const Scene s = complete("swimmer.yaml");
    EXPECT_EQ(s.name, "everything");
    EXPECT_EQ(s.time.end_s, 0.12);
    EXPECT_EQ(s.time.step_s, 20e-6);
    EXPECT_EQ(s.gravity->acceleration_m_s2, 9.81);
    EXPECT_EQ(s.gravity->direction, (Vec3{0, 0.6, -0.8}));  // normalised
    EXPECT_EQ(s.damping->rate_1_s, 600);
    EXPECT_EQ(s.magnetic_field->plane, (std::array{2, 0}));
    const auto& table = std::get<FieldTable>(s.magnetic_field->course);
    EXPECT_EQ(table.time_s, (std::vector{0.0, 0.0195, 0.032}));
    EXPECT_EQ(table.magnitude_t, (std::vector{-0.017, 0.017, -0.016}));
    EXPECT_EQ(table.direction_rad, (std::vector{0.0, pi / 2, pi}));
    EXPECT_TRUE(table.repeat);
}

TEST(Keys, of_a_body) {
    const Scene s = complete("swimmer.yaml");
    ASSERT_EQ(s.bodies.size(), 1u);
    const Body& b = s.bodies[0];
    EXPECT_EQ(b.name, "robot");
    const auto& box = std::get<Box>(b.mesh);
    EXPECT_EQ(box.size_m, (Vec3{3.7e-3, 1.5e-3, 0.185e-3}));
    EXPECT_EQ(box.elements, (std::array{20, 8, 2}));
    EXPECT_EQ(b.element, ElementVariant::full);
    EXPECT_EQ(b.material.shear_modulus_pa, 33e3);
    EXPECT_EQ(b.material.lame_lambda_pa, 660e3);
    EXPECT_EQ(b.material.density_kg_m3, 1860);
    const auto& m = std::get<HarmonicMagnetization>(*b.magnetization);
    EXPECT_EQ(m.amplitude_a_m, 62e3);
    EXPECT_EQ(m.wavelength_m, 3e-3);
    EXPECT_EQ(m.phase_rad, pi);
    EXPECT_EQ(m.along, 1);
    EXPECT_EQ(m.into, 0);
    EXPECT_EQ(b.clamps, (std::vector<std::string>{"x_min", "z_max"}));
    EXPECT_EQ(b.initial.position_m, (Vec3{8e-3, 4e-3, 4e-3}));
    EXPECT_EQ(b.initial.rotation->plane, (std::array{1, 2}));
    EXPECT_EQ(b.initial.rotation->angle_rad, -pi / 2);
    EXPECT_EQ(b.initial.relaxed->magnitude_t, 0.016);
    EXPECT_EQ(b.initial.relaxed->direction_rad, 2 * pi);
}

TEST(Keys, of_a_vortex) {
    const Fluid fluid = *complete("vortex.yaml").fluid;
    EXPECT_EQ(fluid.taylor_green->speed_m_s, 10e-3);
    EXPECT_EQ(fluid.refinement->levels, 2);
    EXPECT_EQ((*fluid.refinement->box_m)[1], (Vec3{12e-3, 12e-3, 12e-3}));
    EXPECT_EQ(fluid.finest_spacing_m(), 0.25e-3);
}

TEST(Keys, of_rollers_and_integrals) {
    const Scene s = complete("elastic.yaml");
    const auto& rollers = s.bodies[0].rollers;  // of the beam
    ASSERT_EQ(rollers.size(), 2u);
    EXPECT_EQ(rollers[0].faces, (std::vector<std::string>{"z_min", "z_max"}));
    EXPECT_EQ(rollers[0].axis, 2);
    EXPECT_EQ(rollers[1].faces, (std::vector<std::string>{"y_min"}));
    EXPECT_EQ(rollers[1].axis, 1);
    const auto& motions = s.bodies[0].prescribed_motion;
    ASSERT_EQ(motions.size(), 3u);
    EXPECT_EQ(motions[0].faces, (std::vector<std::string>{"x_max"}));
    const auto& wave = std::get<Oscillation>(motions[0].course);
    EXPECT_EQ(wave.amplitude_m, (Vec3{0.5e-3, 0, 0}));
    EXPECT_EQ(wave.frequency_hz, 10);
    EXPECT_EQ(wave.phase_rad, -pi / 2);
    const auto& ramp = std::get<DisplacementRamp>(motions[1].course);
    EXPECT_EQ(ramp.displacement_m, (Vec3{0, 0, 1e-3}));
    EXPECT_EQ(ramp.duration_s, 0.2);
    const auto& turning = std::get<TurningMotion>(motions[2].course);
    EXPECT_EQ(turning.axis, (Vec3{0, 2, 0}));
    EXPECT_EQ(turning.about_m, (Vec3{1e-3, 2e-3, 3e-3}));
    const auto& swing = std::get<AngleOscillation>(turning.angle);
    EXPECT_EQ(swing.amplitude_rad, pi / 4);
    EXPECT_EQ(swing.frequency_hz, 25);
    EXPECT_EQ(swing.phase_rad, pi / 2);
    const auto integrals = complete("swimmer.yaml").probes->integrals;
    ASSERT_EQ(integrals.size(), 2u);
    EXPECT_EQ(integrals[0].name, "all");
    EXPECT_FALSE(std::get<BodyPart>(integrals[0].over).box_m);
    const auto& root = std::get<BodyPart>(integrals[1].over);
    EXPECT_EQ(root.body, "robot");
    EXPECT_EQ((*root.box_m)[1], (Vec3{1e-3, 1.5e-3, 0.2e-3}));
    const auto& plane =
        std::get<FluidPlane>(complete("channel.yaml").probes->integrals.at(0).over);
    EXPECT_EQ(plane.axis, 1);
    EXPECT_EQ(plane.at_m, 3e-3);
}

TEST(Keys, of_the_fluid) {
    const Fluid f = *complete("swimmer.yaml").fluid;
    EXPECT_EQ(f.solver, FluidSolver::openfoam);
    EXPECT_EQ(f.box_m, (Vec3{16e-3, 8e-3, 16e-3}));
    EXPECT_EQ(f.spacing_m, 0.2e-3);
    EXPECT_EQ(f.density_kg_m3, 998);
    EXPECT_EQ(f.viscosity_m2_s, 1e-6);
    EXPECT_EQ(f.expected_speed_m_s, 0.5);
    EXPECT_EQ(f.lattice_speed, 0.06);
    EXPECT_EQ(f.courant, 0.3);
    ASSERT_TRUE(f.grading);
    EXPECT_EQ(f.grading->uniform_m[1], (Vec3{6e-3, 3e-3, 4e-3}));
    EXPECT_EQ(f.grading->growth, 1.2);
    ASSERT_TRUE(f.openfoam);
    EXPECT_EQ(f.openfoam->schemes, (test_folder / "complete/fine/schemes").string());
    EXPECT_EQ(f.openfoam->solution, (test_folder / "complete/solution").string());
    EXPECT_EQ(f.openfoam->functions, "/funcs");  // from the root
    EXPECT_EQ(f.openfoam->write->every_s, 5e-3);
    EXPECT_EQ(f.openfoam->write->format, FoamFormat::binary);
    EXPECT_EQ(f.collision, Collision::bgk);
    EXPECT_EQ(f.boundaries[0].kind, BoundaryKind::periodic);
    EXPECT_EQ(f.boundaries[1].kind, BoundaryKind::periodic);
    for (std::size_t face = 2; face < 6; ++face)
        EXPECT_EQ(f.boundaries[face].kind, BoundaryKind::no_slip);
    EXPECT_EQ(f.boundaries[4].wall_velocity_m_s, (Vec3{0.1, 0.2, 0}));
    EXPECT_EQ(f.boundaries[5].wall_velocity_m_s, (Vec3{}));
    EXPECT_EQ(f.initial_velocity_m_s, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(f.body_force_n_m3, (Vec3{10, 20, 30000}));
}

TEST(Keys, of_the_implicit_scheme) {
    const Scene s = complete("implicit.yaml");
    EXPECT_EQ(s.coupling->scheme, Scheme::implicit);
    EXPECT_EQ(s.fluid->refinement->levels, 1);
    EXPECT_EQ(s.fluid->refinement->margin_m, 1.6e-3);
    EXPECT_EQ(s.coupling->sampled_velocity, SampledVelocity::frozen);
    const Iteration& i = *s.coupling->iteration;
    EXPECT_EQ(i.acceleration, AccelerationMethod::aitken);
    EXPECT_EQ(i.velocity_tolerance, 2e-3);
    EXPECT_EQ(i.max_iterations, 15);
    EXPECT_EQ(i.on_no_convergence, OnNoConvergence::continue_);
    EXPECT_EQ(i.initial_guess, InitialGuess::constant);
    EXPECT_EQ(i.relaxation, 0.25);
    EXPECT_EQ(i.max_used_iterations, 30);
    EXPECT_EQ(i.reused_steps, 3);
    EXPECT_EQ(i.filter_limit, 1e-5);
}

TEST(Keys, of_coupling_and_outputs) {
    const Scene s = complete("swimmer.yaml");
    EXPECT_EQ(s.coupling->sampled_velocity, SampledVelocity::linear);
    EXPECT_EQ(s.coupling->substeps, 12);
    EXPECT_EQ(s.coupling->timeout_s, 30);
    EXPECT_EQ(s.coupling->immersed_boundary.kernel, Kernel::four_point);
    EXPECT_EQ(s.coupling->immersed_boundary.strength, 0.25);
    EXPECT_EQ(s.probes->every_s, 0.2e-3);
    EXPECT_EQ(s.probes->bodies, (std::vector{BodyQuantity::energy, BodyQuantity::com}));
    ASSERT_EQ(s.probes->points.size(), 2u);
    EXPECT_EQ(s.probes->points[0].name, "left");  // by the alphabet
    EXPECT_EQ(s.probes->points[1].name, "tip");
    EXPECT_EQ(s.probes->points[1].body, "robot");
    EXPECT_EQ(s.probes->points[1].at_m, (Vec3{3.7e-3, 0.75e-3, 0.0925e-3}));
    EXPECT_EQ(s.probes->fluid,
              (std::vector{FluidQuantity::mass, FluidQuantity::enstrophy}));
    EXPECT_TRUE(s.probes->interface_balance);
    EXPECT_TRUE(s.probes->energy_audit);
    EXPECT_EQ(s.output.structure->every_s, 1e-3);
    EXPECT_EQ(s.output.structure->fields,
              (std::vector{BodyField::stress, BodyField::velocity}));
    EXPECT_EQ(s.report, PageAtEnd::off);
    EXPECT_EQ(s.output.fluid->every_s, 2e-3);
    EXPECT_EQ(s.checkpoint->every_s, 5e-3);
    EXPECT_FALSE(s.checkpoint->retry());
    EXPECT_EQ(s.checkpoint->max_retries, 2);
    EXPECT_EQ(s.output.fluid->fields,
              (std::vector{FluidField::vorticity, FluidField::density}));
}

TEST(Keys, of_the_other_alternatives) {
    const Scene s = complete("elastic.yaml");
    ASSERT_EQ(s.bodies.size(), 2u);
    EXPECT_EQ(s.bodies[0].name, "beam");  // by the alphabet
    EXPECT_EQ(std::get<UniformMagnetization>(*s.bodies[0].magnetization).vector_a_m,
              (Vec3{62e3, -1e3, 2}));
    const auto& domains =
        std::get<DomainMagnetization>(*s.bodies[1].magnetization).domains;
    ASSERT_EQ(domains.size(), 3u);
    EXPECT_EQ(domains[2].shape.ball, (BallShape{{8e-3, 8e-3, 0.5e-3}, 1e-3}));
    EXPECT_EQ((*domains[0].shape.box_m)[1], (Vec3{5e-3, 10e-3, 1e-3}));
    EXPECT_EQ(domains[0].vector_a_m, (Vec3{81e3, 0, 0}));
    EXPECT_TRUE(domains[0].shape.polygon_xy_m.empty());
    EXPECT_FALSE(domains[1].shape.box_m);
    ASSERT_EQ(domains[1].shape.polygon_xy_m.size(), 3u);
    EXPECT_EQ(domains[1].shape.polygon_xy_m[2], (std::array{10e-3, 10e-3}));
    const auto& constant = std::get<ConstantField>(s.magnetic_field->course);
    EXPECT_EQ(constant.magnitude_t, 0.2);
    EXPECT_EQ(constant.direction_rad, pi / 2);
    EXPECT_FALSE(s.fluid || s.coupling || s.gravity || s.damping || s.probes);

    const Scene turning = complete("turning.yaml");
    const auto& rotation = std::get<RotatingField>(turning.magnetic_field->course);
    EXPECT_EQ(rotation.magnitude_t, 0.017);
    EXPECT_EQ(rotation.start_rad, pi);
    EXPECT_EQ(rotation.frequency_hz, 5);
}

TEST(Keys, of_platform_contact_and_equilibrium) {
    const Scene s = complete("platform.yaml");
    EXPECT_EQ(s.time.equilibrium->method, EquilibriumMethod::dynamics);
    EXPECT_EQ(s.time.equilibrium->tolerance, 1e-5);
    EXPECT_EQ(s.bodies[0].material.viscosity_pa_s, 2);
    EXPECT_EQ(std::get<TableMagnetization>(*s.bodies[0].magnetization).file,
              (test_folder / "complete/profile.csv").string());
    EXPECT_EQ(s.magnetic_field->gradient->matrix_t_m[2], (Vec3{0.5, 0, -2}));
    EXPECT_EQ(s.magnetic_field->gradient->origin_m, (Vec3{1e-3, 0, 2e-3}));
    EXPECT_EQ(s.platform->point_m, (Vec3{0, 0, -1e-3}));
    EXPECT_EQ(s.platform->normal, (Vec3{0, 0.6, 0.8}));  // normalised
    EXPECT_EQ(s.platform->stiffness_pa_m, 20e6);
    EXPECT_EQ(s.platform->friction, 0.3);
    EXPECT_TRUE(s.dipoles->within_bodies);
    EXPECT_EQ(s.contact->distance_m, 0.2e-3);
    EXPECT_EQ(s.contact->stiffness_pa_m, 30e6);
}

TEST(Keys, of_regions_by_shapes) {
    const Scene s = complete("elastic.yaml");
    EXPECT_TRUE(s.bodies[1].regions.empty());
    const std::vector<NamedRegion>& regions = s.bodies[0].regions;
    ASSERT_EQ(regions.size(), 3U);
    EXPECT_EQ(regions[0].name, "bead");
    EXPECT_EQ(regions[0].shape.ball, (BallShape{{1e-3, 2e-3, 0.5e-3}, 2e-3}));
    EXPECT_EQ(regions[1].shape.box_m,
              (std::array{Vec3{15e-3, 0, 0}, Vec3{17.5e-3, 5e-3, 1e-3}}));
    EXPECT_EQ(regions[2].shape.polygon_xy_m.size(), 3U);
    EXPECT_FALSE(regions[2].shape.ball || regions[2].shape.box_m);
}

TEST(Keys, of_meshes_with_regions) {
    const Scene s = complete("origami.yaml");
    const auto& plate = std::get<ObliquePlate>(s.bodies[1].mesh);
    EXPECT_EQ(plate.cells, (std::array{4, 3}));
    EXPECT_EQ(plate.length_a_m, 10e-3);
    EXPECT_EQ(plate.length_b_m, 12e-3);
    EXPECT_DOUBLE_EQ(plate.angle_rad, pi / 3);  // 60 times a rounded degree
    EXPECT_EQ(plate.thickness_m, 1e-3);
    EXPECT_EQ(plate.elements_per_cell, (std::array{6, 7, 2}));
    EXPECT_FALSE(plate.zigzag);
    EXPECT_EQ(s.bodies[1].element, ElementVariant::assumed_strain);
    const auto& regions =
        std::get<RegionMagnetization>(*s.bodies[1].magnetization).regions;
    ASSERT_EQ(regions.size(), 2u);
    EXPECT_EQ(regions[0].regions,
              (std::vector<std::string>{"row 0 column 0", "row 1 column 1"}));
    EXPECT_EQ(regions[1].vector_a_m, (Vec3{0, 81e3, 0}));
    const auto& materials = s.bodies[1].material_regions;
    ASSERT_EQ(materials.size(), 2u);
    EXPECT_EQ(materials[0].regions, (std::vector<std::string>{"row 2 column 0"}));
    EXPECT_EQ(materials[0].material.shear_modulus_pa, 33e3);
    EXPECT_EQ(materials[0].material.viscosity_pa_s, 3);
    EXPECT_EQ(materials[1].regions,
              (std::vector<std::string>{"row 0 column 0", "row 1 column 1"}));
    EXPECT_EQ(materials[1].material.lame_lambda_pa, 20e6);
    EXPECT_EQ(materials[1].material.density_kg_m3, 2000);
    EXPECT_EQ(materials[1].material.viscosity_pa_s, 0);
    const auto& file = std::get<MeshFile>(s.bodies[0].mesh);
    EXPECT_EQ(file.file, (test_folder / "complete/gripper.msh").string());
    EXPECT_EQ(file.unit_m, 1e-3);
    EXPECT_EQ(s.bodies[0].clamps, (std::vector<std::string>{"palm"}));
}

TEST(Keys, of_a_viscosity_by_the_rate_of_shear) {
    const auto carreau = std::get<Carreau>(complete("blood.yaml").fluid->rheology->law);
    EXPECT_DOUBLE_EQ(carreau.infinite_m2_s, 2e-6);
    EXPECT_EQ(carreau.time_s, 3);
    EXPECT_EQ(carreau.exponent, 0.4);
    EXPECT_EQ(carreau.transition, 1.5);
    const auto power = std::get<PowerLaw>(complete("paste.yaml").fluid->rheology->law);
    EXPECT_EQ(power.exponent, 0.6);
    EXPECT_EQ(power.rate_1_s, 25);
    EXPECT_DOUBLE_EQ(power.least_m2_s, 0.2e-6);
    EXPECT_DOUBLE_EQ(power.most_m2_s, 6e-6);
}

TEST(Keys, of_a_channel_with_obstacles) {
    const Fluid f = *complete("channel.yaml").fluid;
    EXPECT_EQ(f.collision, Collision::trt);
    EXPECT_EQ(f.bulk_viscosity_m2_s, 3e-4);
    EXPECT_EQ(f.magic_number, 0.25);
    EXPECT_EQ(f.precision, Precision::float_);
    EXPECT_EQ(f.smagorinsky_constant, 0.16);
    const Boundary& inlet = f.boundaries[0];
    EXPECT_EQ(inlet.kind, BoundaryKind::velocity_inlet);
    EXPECT_EQ(inlet.inlet.velocity_m_s, (Vec3{0.1, 0, 0}));
    EXPECT_EQ(inlet.inlet.profile, InletProfile::parabolic);
    EXPECT_EQ(inlet.inlet.ramp_s, 5e-3);
    const auto& disc = std::get<Disc>(*inlet.patch);
    EXPECT_EQ(disc.centre_m, (std::array{4e-3, 5e-3}));
    EXPECT_EQ(disc.diameter_m, 3e-3);
    const Boundary& outlet = f.boundaries[1];
    EXPECT_EQ(outlet.kind, BoundaryKind::pressure_outlet);
    EXPECT_EQ(outlet.outlet_pressure_pa, 2);
    const auto& rectangle = std::get<Rectangle>(*outlet.patch);
    EXPECT_EQ(rectangle.centre_m, (std::array{4e-3, 3e-3}));
    EXPECT_EQ(rectangle.size_m, (std::array{2e-3, 1e-3}));
    EXPECT_EQ(f.boundaries[2].kind, BoundaryKind::free_slip);
    EXPECT_EQ(f.boundaries[4].kind, BoundaryKind::pressure_outlet);
    EXPECT_FALSE(f.boundaries[4].patch);
}

TEST(Keys, of_obstacles) {
    const auto obstacles = complete("channel.yaml").fluid->obstacles;
    ASSERT_EQ(obstacles.size(), 4u);  // by the alphabet
    EXPECT_EQ(std::get<Sphere>(obstacles[0].shape).centre_m, (Vec3{4e-3, 4e-3, 4e-3}));
    EXPECT_EQ(std::get<Block>(obstacles[1].shape).high_m, (Vec3{2e-3, 2e-3, 2e-3}));
    const auto& rod = std::get<Cylinder>(obstacles[2].shape);
    EXPECT_EQ(rod.axis, 1);
    EXPECT_EQ(rod.length_m, 3e-3);
    const auto& surface = std::get<StlSurface>(obstacles[3].shape);
    EXPECT_EQ(surface.file, (test_folder / "complete/stent.stl").string());
    EXPECT_EQ(surface.unit_m, 1e-3);
    EXPECT_EQ(surface.shift_m, (Vec3{1e-3, 2e-3, 3e-3}));
}

TEST(Keys, of_rigid_parts_and_round_bodies) {
    const auto bodies = complete("rigid.yaml").bodies;
    ASSERT_EQ(bodies.size(), 6u);  // by the alphabet
    EXPECT_EQ(bodies[0].rigid, std::vector<std::string>{"tip"});
    EXPECT_FALSE(bodies[0].is_all_rigid());
    EXPECT_TRUE(bodies[1].is_all_rigid());
    EXPECT_EQ(bodies[1].material.shear_modulus_pa, 0);
    EXPECT_EQ(std::get<BallMesh>(bodies[1].mesh), (BallMesh{2e-3, {4, 2}}));
    EXPECT_EQ(std::get<Pivot>(*bodies[1].hold).about_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_NEAR((*bodies[1].initial.angular_velocity_rad_s)[0], std::numbers::pi / 2,
                1e-15);
    EXPECT_EQ(std::get<CapsuleMesh>(bodies[2].mesh),
              (CapsuleMesh{1e-3, 3e-3, {2, 1, 4}}));
    EXPECT_EQ(bodies[2].initial.velocity_m_s, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(std::get<CylinderMesh>(bodies[3].mesh),
              (CylinderMesh{0.5e-3, 3e-3, {1, 1, 6}}));
    EXPECT_EQ(std::get<Hinge>(*bodies[3].hold).axis, (Vec3{0, 0, 2}));
    EXPECT_EQ(std::get<Hinge>(*bodies[3].hold).about_m, (Vec3{4e-3, 5e-3, 6e-3}));
    EXPECT_TRUE(bodies[4].rigid.empty());
    EXPECT_EQ(std::get<ConeMesh>(bodies[4].mesh),
              (ConeMesh{{1e-3, 0.2e-3}, 2e-3, {2, 1, 5}}));
    EXPECT_EQ(
        std::get<WireMesh>(bodies[5].mesh),
        (WireMesh{0.5e-3, 1e-3, 3, 0.2e-3, {1, 1, 60}, true, WireHead{0.8e-3, 1e-3}}));
}

TEST(Keys, of_shapes) {
    const auto bodies = complete("shapes.yaml").bodies;
    ASSERT_EQ(bodies.size(), 3u);  // by the alphabet
    const auto& cubes = std::get<VoxelMesh>(bodies[0].mesh);
    EXPECT_EQ(cubes.file, (test_folder / "complete/robot.stl").string());
    EXPECT_EQ(cubes.unit_m, 1e-3);
    EXPECT_EQ(cubes.spacing_m, 0.1e-3);
    ASSERT_EQ(cubes.faces.size(), 1u);
    EXPECT_EQ(cubes.faces[0].name, "tip");
    EXPECT_EQ(cubes.faces[0].box_m[1], (Vec3{4e-3, 5e-3, 6e-3}));
    const auto& arc = std::get<Arc>(bodies[1].mesh);
    EXPECT_EQ(arc.radius_m, 2e-3);
    EXPECT_NEAR(arc.angle_rad, std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(arc.section_m, (std::array{1e-3, 0.2e-3}));
    EXPECT_EQ(arc.elements, (std::array{12, 3, 1}));
    const auto& helix = std::get<Helix>(bodies[2].mesh);
    EXPECT_EQ(helix.radius_m, 0.5e-3);
    EXPECT_EQ(helix.pitch_m, 2e-3);
    EXPECT_EQ(helix.turns, 1.5);
    EXPECT_EQ(helix.section_m, (std::array{0.3e-3, 0.2e-3}));
    EXPECT_EQ(helix.elements, (std::array{30, 2, 1}));
    EXPECT_TRUE(helix.left_handed);
    const auto& radial = std::get<RadialMagnetization>(*bodies[0].magnetization);
    EXPECT_EQ(radial.strength_a_m, -20e3);
    EXPECT_EQ(radial.centre_m, (Vec3{1e-3, 2e-3, 3e-3}));
    EXPECT_EQ(radial.axis, (Vec3{0, 0, 2}));
    const auto& curve = std::get<CurveMagnetization>(*bodies[1].magnetization);
    EXPECT_EQ(curve.strength_a_m, 62e3);
    EXPECT_EQ(curve.wavelength_m, 3e-3);
    EXPECT_NEAR(curve.phase_rad, std::numbers::pi / 4, 1e-15);
    EXPECT_EQ(curve.plane, (std::array{0, 1}));
    ASSERT_EQ(curve.points_m.size(), 2u);
    EXPECT_EQ(curve.points_m[1], (Vec3{1e-3, 0, 0}));
}

}  // namespace
}  // namespace magfsi::scene
