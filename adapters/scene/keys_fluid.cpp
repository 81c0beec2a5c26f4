// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of `fluid`, stored in fluid_lbm/options.h and scene.h. A comment before each
// function names the place of its group below `fluid`.
#include "adapters/scene/keys.h"

// The layout below follows the nesting of the scene file.
// clang-format off

namespace magfsi::scene {

// Keys of `boundaries.SIDE.KIND.rectangle`.
template <class Io>
void keys(Io& io, Rectangle& rectangle) {
    io(quantity("centre", "m",
           "Centre of the opening along the two axes of the side, in the order x, y, z."),
       rectangle.centre_m);
    io(quantity("size", "m", "Lengths of the opening along the same axes.").above(0), rectangle.size_m);
}

// Keys of `boundaries.SIDE.KIND.disc`.
template <class Io>
void keys(Io& io, Disc& disc) {
    io(quantity("centre", "m",
           "Centre of the opening along the two axes of the side, in the order x, y, z."),
       disc.centre_m);
    io(quantity("diameter", "m", "Diameter of the opening.").above(0), disc.diameter_m);
}

template <class Io>
void patch_keys(Io& io, Boundary& side) {
    constexpr std::string_view doc = "Part of the side that is open; the rest is a wall.";
    io.alternatives(side.patch, key("rectangle", doc), key("disc", doc));
}

// Keys of `boundaries.SIDE.velocity_inlet.course.oscillation`.
template <class Io>
void keys(Io& io, InletWave& wave) {
    io(key("mean", "Mean of the factor.").by_default(), wave.mean);
    io(key("amplitude", "Amplitude of the factor."), wave.amplitude);
    io(quantity("frequency", "1/s", "Number of periods per second.").above(0), wave.frequency_hz);
    io(quantity("phase", "rad",
           "Phase at time 0. With 90 deg the factor begins at its largest.").by_default(),
       wave.phase_rad);
}

// Keys of `boundaries.SIDE.velocity_inlet.course.table`.
template <class Io>
void keys(Io& io, InletTable& table) {
    io(key("file",
           "Name of a CSV file with the columns t[s] (also ms, us) and factor in place "
           "of time and factor. Its path counts from the scene's folder.").optional(), table.file);
    io(quantity("time", "s", "Times of the rows, ascending.").optional(), table.time_s);
    io(key("factor", "Factors of the velocity, one per row.").optional(), table.factor);
    io(key("repeat",
           "If true, the table starts again after its last row. Before its first time "
           "the factor holds the first value.").by_default(), table.repeat);
}

// Keys of `boundaries.SIDE.velocity_inlet.course.formula`.
template <class Io>
void keys(Io& io, InletFormula& formula) {
    structure::Formula text{formula.written, formula.si};
    io.whole(text);
    formula = {text.written, text.si};
}

// Keys of `boundaries.SIDE.velocity_inlet.course`.
template <class Io>
void keys(Io& io, InletCourse& course) {
    io.alternatives(course,
        key("oscillation", "Factor mean + amplitude sin(2 pi frequency t + phase)."),
        key("table",
           "Factor that is linear between the rows of a table, and held before the first "
           "and after the last."),
        quantity("formula", "", "Factor as a formula of the time t."));
}

// Keys of `boundaries.SIDE`: a word, or a map with the word as its key.
template <class Io>
void keys(Io& io, Boundary& side) {
    io.whole(side.kind);
    io.word_with_map(side.kind, BoundaryKind::no_slip, "Moving wall.",
                     side.wall_velocity_m_s != Vec3{}, [&](auto& wall) {
        wall(quantity("velocity", "m/s", "Velocity of the wall, along itself."),
       side.wall_velocity_m_s);
    });
    io.word_with_map(side.kind, BoundaryKind::velocity_inlet,
                     "Velocity that is given. Where it points out of the box only its part across "
                     "the side counts: along the side the fluid leaves as it comes.", true, [&](auto& inlet) {
        inlet(quantity("velocity", "m/s", "Mean velocity over the opening."),
              side.inlet.velocity_m_s);
        inlet(key("profile", "Shape of the velocity over the opening. It does not fall towards "
                  "periodic and free-slip sides.").by_default(), side.inlet.profile);
        inlet(quantity("ramp", "s", "Time over which the velocity grows from rest, as (1 - cos) / 2.")
                  .at_least(0).by_default(), side.inlet.ramp_s);
        inlet(key("course", "Factor of the velocity over time: a pulse."), side.inlet.course);
        patch_keys(inlet, side);
    });
    io.word_with_map(side.kind, BoundaryKind::pressure_outlet, "Opening that lets flow and sound out.",
                     true, [&](auto& outlet) {
        outlet(quantity("pressure", "Pa", "Gauge pressure far out.").by_default(),
               side.outlet_pressure_pa);
        patch_keys(outlet, side);
    });
}

// Keys of `obstacles.NAME.sphere`.
template <class Io>
void keys(Io& io, Sphere& sphere) {
    io(quantity("centre", "m", "Centre of the ball."), sphere.centre_m);
    io(quantity("diameter", "m", "Diameter of the ball.").above(0), sphere.diameter_m);
}

// Keys of `obstacles.NAME.cylinder`.
template <class Io>
void keys(Io& io, Cylinder& cylinder) {
    io(quantity("centre", "m", "Middle of the cylinder's length."), cylinder.centre_m);
    io(quantity("diameter", "m", "Diameter of the cylinder.").above(0), cylinder.diameter_m);
    io(key("axis", "Axis along which the cylinder lies.").by_default(), AxisRef{cylinder.axis});
    io(quantity("length", "m",
           "Length of the cylinder. Without it, it goes through the whole box.").above(0),
       cylinder.length_m);
}

// Keys of `obstacles.NAME.box`: two corners in place of a map.
template <class Io>
void keys(Io& io, Block& block) {
    std::array<Vec3, 2> corners{block.low_m, block.high_m};
    io.whole(corners);
    block = {corners[0], corners[1]};
}

// Keys of `obstacles.NAME.stl`.
template <class Io>
void keys(Io& io, StlSurface& surface) {
    io(key("file",
           "Name of an STL file, ASCII or binary. Its path counts from the scene's "
           "folder."),
       surface.file);
    io(quantity("unit", "m", "Length that one unit of the file stands for.").above(0).by_default(),
       surface.unit_m);
    io(quantity("shift", "m", "Position in the box of the file's origin.").by_default(),
       surface.shift_m);
}

// Keys of `obstacles.NAME`.
template <class Io>
void keys(Io& io, Obstacle& obstacle) {
    io.alternatives(obstacle.shape, key("sphere", "Ball."),
                    key("cylinder", "Cylinder along an axis."),
                    quantity("box", "m", "Lower and upper corner of a block."),
                    key("stl", "Solid within a closed surface of triangles."));
}

// Keys of `grading`.
template <class Io>
void keys(Io& io, Grading& grading) {
    io(quantity("uniform", "m", "Lower and upper corner of the part with cubic cells."),
       grading.uniform_m);
    io(key("growth", "Largest ratio of the lengths of neighbouring cells.").above(1).at_most(1.5)
           .by_default(),
       grading.growth);
}

// Keys of `openfoam.write`.
template <class Io>
void keys(Io& io, FoamWrite& write) {
    io(quantity("every", "s", "Time between two time folders; the last time has one, too.")
           .above(0), write.every_s);
    io(key("format", "Format of the numbers in the fields.").by_default(), write.format);
}

// Keys of `openfoam`.
template <class Io>
void keys(Io& io, OpenFoam& openfoam) {
    io(key("schemes",
           "Name of a dictionary whose entries override those of the generated fvSchemes. Its "
           "path counts from the scene's folder."), openfoam.schemes);
    io(key("solution", "The same for fvSolution."), openfoam.solution);
    io(key("functions",
           "Name of a dictionary with function objects, one beside the other or within "
           "functions {}. They run along and write to openfoam/postProcessing of the run folder."),
       openfoam.functions);
    io(key("write",
           "Fields in OpenFOAM's own format: time folders in openfoam/ of the run folder, with "
           "the mesh."), openfoam.write);
}

// Keys of `refinement`.
template <class Io>
void keys(Io& io, Refinement& refinement) {
    io(key("levels", "Number of times that the spacing is halved towards the bodies.")
           .at_least(1).at_most(3)
           .by_default(), refinement.levels);
    io(quantity("margin", "m",
           "Distance between the bodies and the sides of the patch that follows them. "
           "Without it, it is what the kernel and the speeds need.").above(0),
       refinement.margin_m);
    io(quantity("box", "m",
           "Lower and upper corner of a patch that stays where it is."),
       refinement.box_m);
}

// Keys of `taylor_green`.
template <class Io>
void keys(Io& io, TaylorGreen& vortex) {
    io(quantity("speed", "m/s", "Largest speed of the vortex.").above(0), vortex.speed_m_s);
}

// Keys of `rheology.carreau` (Carreau 1972; Yasuda, Armstrong, Cohen 1981).
template <class Io>
void keys(Io& io, Carreau& law) {
    io(quantity("infinite_viscosity", "m2/s",
           "Kinematic viscosity at the highest rates of shear. Above the fluid's own "
           "viscosity the fluid thickens.").above(0), law.infinite_m2_s);
    io(quantity("time", "s",
           "Time constant: one over the rate of shear at which thinning begins.").above(0), law.time_s);
    io(key("exponent", "Exponent n of the shear stress at rates in between.").above(0).at_most(1),
       law.exponent);
    io(key("transition", "Yasuda's exponent, which says how sharply thinning begins.")
           .above(0).at_most(10).by_default(),
       law.transition);
}

// Keys of `rheology.power_law`.
template <class Io>
void keys(Io& io, PowerLaw& law) {
    io(key("exponent",
           "Exponent n of the shear stress. Below 1 the fluid thins, above 1 it "
           "thickens.").above(0).at_most(2),
       law.exponent);
    io(quantity("rate", "1/s", "Rate of shear at which the fluid has its viscosity.").above(0),
       law.rate_1_s);
    io(quantity("least", "m2/s", "Lower bound of the kinematic viscosity.").above(0), law.least_m2_s);
    io(quantity("most", "m2/s", "Upper bound of the kinematic viscosity.").above(0), law.most_m2_s);
}

// Keys of `rheology`.
template <class Io>
void keys(Io& io, Rheology& rheology) {
    io.alternatives(rheology.law, key("carreau",
           "Viscosity that goes from the fluid's own at rest to another one at high "
           "rates of shear."),
                    key("power_law",
           "Viscosity that is a power of the rate of shear, within bounds."));
}

// Keys of `fluid` itself.
template <class Io>
void keys(Io& io, Fluid& fluid) {
    io(key("solver", "Fluid solver: lbm is built in, openfoam is pimpleFoam.").by_default(),
       fluid.solver);
    io(quantity("box", "m", "Lengths of the box along x, y and z.").above(0), fluid.box_m);
    io(quantity("spacing", "m",
           "Edge of the cubic cells (with refinement: of those away from the bodies). It "
           "must divide the box.").above(0),
       fluid.spacing_m);
    io(quantity("density", "kg/m3", "Mass per volume.").above(0), fluid.density_kg_m3);
    io(quantity("viscosity", "m2/s",
           "Kinematic viscosity. dynamic_viscosity can stand in its place.").above(0)
           .optional(), fluid.viscosity_m2_s);
    double dynamic_pa_s = 0;  // converted to the kinematic one when read
    io(quantity("dynamic_viscosity", "Pa s", "Kinematic viscosity times the density.")
           .above(0).optional(),
       dynamic_pa_s);
    if (dynamic_pa_s > 0) fluid.viscosity_m2_s = dynamic_pa_s / fluid.density_kg_m3;
    io(quantity("bulk_viscosity", "m2/s",
           "Kinematic bulk viscosity: it damps sound, which a body or an inlet makes that starts "
           "suddenly, and leaves a resolved flow alone. explain tells the most useful value. "
           "Without it, 2/3 of the viscosity. For solver lbm.").above(0),
       fluid.bulk_viscosity_m2_s);
    io(quantity("expected_speed", "m/s",
           "Largest speed that the run should resolve. It is needed without time.step.")
           .above(0).optional(),
       fluid.expected_speed_m_s);
    io(key("lattice_speed",
           "Expected speed in cells per step, which sets the step where time.step is "
           "absent.").above(0).at_most(0.25).by_default(),
       fluid.lattice_speed);
    io(key("courant", "Expected speed in cells per step for solver openfoam.")
           .above(0).at_most(1).by_default(),
       fluid.courant);
    io(key("grading",
           "Larger cells away from the bodies, for solver openfoam. The lattice stays "
           "uniform."), fluid.grading);
    io(key("openfoam",
           "Dictionaries of the user's that are merged into OpenFOAM's case, and fields in its "
           "format, for solver openfoam. Other solvers leave it alone."), fluid.openfoam);
    io(key("refinement",
           "Finer cells and steps around the bodies, or in a part of the box, for solver "
           "lbm."), fluid.refinement);
    io(key("collision", "Collision model of the lattice Boltzmann method.").by_default(),
       fluid.collision);
    io(key("magic_number", "Lambda of the collisions trt and recursive_mrt: how odd modes relax. "
           "Without it 3/16, which puts walls exactly half way, or what makes the odd rate 1 if "
           "the relaxation time is below 0.55; in recursive_mrt around bodies without slip 0.75 "
           "over the Reynolds number of a cell, from 0.001 to 3/16, falling with the square from "
           "60 on.")
           .above(0).at_most(1),
       fluid.magic_number);
    io(key("precision",
           "Precision of the populations. float takes half of the memory and of the time of "
           "double.").by_default(),
       fluid.precision);
    io.group(key("smagorinsky", "Eddy viscosity of unresolved turbulence.").optional(),
             fluid.smagorinsky_constant > 0, [&](auto& model) {
        model(key("constant", "Constant of the filter. Usual values are 0.1 to 0.2.")
           .above(0).at_most(1),
              fluid.smagorinsky_constant);
    });
    io(key("rheology",
           "Law by which the viscosity depends on the rate of shear, sqrt(2 S:S), for "
           "solver lbm."),
       fluid.rheology);
    io.group(key("boundaries", "Boundary conditions of the six sides of the box.").optional(), true,
             [&](auto& sides) {
        for (std::size_t side = 0; side < 6; ++side)
            sides(key(names<Face>[side], "Kind of the side. no_slip: a wall at rest; periodic: together with the "
                      "opposite side; free_slip: a plane of symmetry. A map gives a wall or an "
                      "inlet its velocity, an outlet its pressure.").by_default(),
                  fluid.boundaries[side]);
    });
    io(key("obstacles", "Rigid bodies at rest in the fluid, by name.").optional(),
       fluid.obstacles);
    io(quantity("initial_velocity", "m/s",
           "Uniform velocity of the fluid at time 0. Without it the fluid is at rest."),
       fluid.initial_velocity_m_s);
    io(key("taylor_green",
           "Start from the Taylor-Green vortex, one period along each side of a periodic "
           "cube."), fluid.taylor_green);
    io(quantity("body_force", "N/m3",
           "Force per volume on the fluid everywhere, such as a pressure gradient."),
       fluid.body_force_n_m3);
}

MAGFSI_KEYS_OF(Fluid)

}  // namespace magfsi::scene
