#include "coupler/scene/fields.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

namespace {

Field boundaries() {
    std::vector<Field> faces;
    for (const std::string_view face : names<Face>) {
        faces.push_back(
            choice<BoundaryKind>(face, "Wall at rest; periodic goes in pairs; a map gives a "
                                 "wall its velocity.")
                .carrying(group("no_slip", "Moving wall.", {
                    quantity("velocity", "m/s", "Along the wall.").vector(3),
                }))
                .or_default("no_slip"));
    }
    return group("boundaries", "What bounds the box, face by face.", std::move(faces));
}

}  // namespace

Field fluid_fields() {
    return group("fluid", "Viscous fluid in a box with its lowest corner at the origin.", {
        choice<FluidSolver>("solver", "lbm: built in; openfoam: pimpleFoam.")
            .or_default("lbm"),
        quantity("box", "m", "Length along x, y and z.").vector(3).above(0),
        quantity("spacing", "m", "Edge of the cubic cells; divides the box.").above(0),
        quantity("density", "kg/m3", "Mass by volume.").above(0),
        quantity("viscosity", "m2/s", "Kinematic viscosity.").above(0),
        quantity("expected_speed", "m/s", "Largest speed that the run should resolve; "
                 "needed without time.step.").above(0).optional(),
        number("lattice_speed", "That speed in cells a step: sets the step when time.step "
               "is absent.").above(0).at_most(0.25).or_default("0.05"),
        choice<Collision>("collision", "Collision model of the lattice Boltzmann method.")
            .or_default("automatic"),
        boundaries().optional(),
        quantity("initial_velocity", "m/s", "Uniform; without it, at rest.").vector(3)
            .optional(),
        quantity("body_force", "N/m3", "On the fluid everywhere, such as a pressure "
                 "gradient.").vector(3).optional(),
    });
}

Field probes_fields() {
    return group("probes", "Time series in probes.csv.", {
        quantity("every", "s", "Time between rows.").above(0),
        choice<BodyQuantity>("bodies", "Columns for each body.").list().optional(),
        named("points", "Material points by name: position and displacement.", {
            identifier("body", "Name of the body."),
            quantity("at", "m", "Place in the undeformed body, in its frame.").vector(3),
        }).optional(),
        choice<FluidQuantity>("fluid", "Columns for the fluid.").list().optional(),
        boolean("interface_balance", "Momentum and power given and received, in columns.")
            .or_default("false"),
    });
}

Field output_fields() {
    return group("output", "Fields for ParaView.", {
        group("structure", "Bodies: structure.pvd.", {
            quantity("every", "s", "Time between files.").above(0),
        }).optional(),
        group("fluid", "Fluid: fluid.pvd.", {
            quantity("every", "s", "Time between files.").above(0),
            choice<FluidField>("fields", "What is written.").list()
                .or_default("[velocity]"),
        }).optional(),
    });
}

}  // namespace magfsi::scene
