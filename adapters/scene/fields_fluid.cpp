#include "adapters/scene/fields.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

namespace {

Field rectangle() {
    return group("rectangle", "Part of the side that is open; the rest is a wall.", {
        quantity("centre", "m", "Along the two axes of the side, in the order x, y, z.")
            .vector(2),
        quantity("size", "m", "Along the same axes.").vector(2).above(0),
    }).optional_alternative();
}

Field disc() {
    return group("disc", "Part of the side that is open; the rest is a wall.", {
        quantity("centre", "m", "Along the two axes of the side, in the order x, y, z.")
            .vector(2),
        quantity("diameter", "m", "Of the opening.").above(0),
    }).optional_alternative();
}

Field velocity_inlet() {
    return group("velocity_inlet", "Given velocity, inwards or outwards.", {
        quantity("velocity", "m/s", "Mean over the opening.").vector(3),
        choice<InletProfile>("profile", "Over the opening; it does not fall towards periodic "
                             "and free-slip sides.").or_default("uniform"),
        quantity("ramp", "s", "Grows from rest over this time, as (1 - cos) / 2.")
            .at_least(0).or_default("0 s"),
        rectangle(),
        disc(),
    });
}

Field pressure_outlet() {
    return group("pressure_outlet", "Lets flow and sound out.", {
        quantity("pressure", "Pa", "Gauge pressure far out.").or_default("0 Pa"),
        rectangle(),
        disc(),
    });
}

Field obstacles() {
    return named("obstacles", "Rigid bodies at rest in the fluid, by name.", {
        group("sphere", "A ball.", {
            quantity("centre", "m", "Its place in the box.").vector(3),
            quantity("diameter", "m", "Its size.").above(0),
        }).alternative(),
        group("cylinder", "Along an axis.", {
            quantity("centre", "m", "Middle of its length.").vector(3),
            quantity("diameter", "m", "Its size.").above(0),
            axis("axis", "Its direction.").or_default("z"),
            quantity("length", "m", "Without it, through the box.").above(0).optional(),
        }).alternative(),
        quantity("box", "m", "Lower and upper corner.").rows(3, 2, 2).alternative(),
        group("stl", "Closed surface of triangles.", {
            text("file", "ASCII or binary STL; its path counts from the scene's folder."),
            quantity("unit", "m", "Length of the file's unit.").above(0).or_default("1 m"),
            quantity("shift", "m", "Where the file's origin comes to.").vector(3)
                .or_default("[0 m, 0 m, 0 m]"),
        }).alternative(),
    });
}

Field boundaries() {
    std::vector<Field> faces;
    for (const std::string_view face : names<Face>) {
        faces.push_back(
            choice<BoundaryKind>(face, "Wall at rest; periodic goes in pairs; free_slip is a "
                                 "plane of symmetry; a map gives a wall or an inlet its "
                                 "velocity, an outlet its pressure.")
                .carrying(group("no_slip", "Moving wall.", {
                    quantity("velocity", "m/s", "Along the wall.").vector(3),
                }))
                .carrying(velocity_inlet())
                .carrying(pressure_outlet())
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
        quantity("spacing", "m", "Edge of the cubic cells; divides the box.").above(0)
            .chosen_by_accuracy(),
        quantity("density", "kg/m3", "Mass by volume.").above(0),
        quantity("viscosity", "m2/s", "Kinematic viscosity.").above(0),
        quantity("expected_speed", "m/s", "Largest speed that the run should resolve; "
                 "needed without time.step.").above(0).optional(),
        number("lattice_speed", "That speed in cells a step: sets the step when time.step "
               "is absent.").above(0).at_most(0.25).or_default("0.05"),
        number("courant", "The same for openfoam.").above(0).at_most(1).or_default("0.2"),
        group("grading", "Larger cells away from the bodies, for openfoam; the lattice stays "
              "uniform.", {
            quantity("uniform", "m", "Lower and upper corner of the part with cubic cells.")
                .rows(3, 2, 2),
            number("growth", "Largest ratio of neighbouring cells.").above(1).at_most(1.5)
                .or_default("1.1"),
        }).optional(),
        choice<Collision>("collision", "Collision model of the lattice Boltzmann method.")
            .or_default("automatic"),
        number("magic_number", "Lambda of the collision trt; without it 3/16, which puts "
               "walls exactly half way, or what makes the odd rate 1 if the relaxation "
               "time is below 0.55.").above(0).at_most(1).optional(),
        choice<Precision>("precision", "Of populations in memory: double; float halves "
                          "memory and time; float_double computes in double.")
            .or_default("double"),
        group("smagorinsky", "Eddy viscosity of unresolved turbulence.", {
            number("constant", "Of the filter; 0.1 to 0.2 is usual.").above(0).at_most(1),
        }).optional(),
        boundaries().optional(),
        obstacles().optional(),
        quantity("initial_velocity", "m/s", "Uniform; without it, at rest.").vector(3)
            .optional(),
        group("taylor_green", "Starts as the Taylor-Green vortex, one period along each side "
              "of a periodic cube.", {
            quantity("speed", "m/s", "Its largest.").above(0),
        }).optional(),
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
        named("integrals", "Integrals by name, over a plane of the fluid or a part of a body.", {
            group("plane", "Across the box, outside obstacles: volume flow, flux of momentum "
                  "(of density times velocity), mean gauge pressure.", {
                axis("axis", "Its normal; flow along it is positive."),
                quantity("at", "m", "Where it cuts the axis."),
            }).alternative(),
            group("part", "Mean displacement by mass, momentum and, in a fluid, the fluid's "
                  "force on it.", {
                identifier("body", "Name of the body."),
                quantity("box", "m", "Lower and upper corner, in the body's frame: elements "
                         "whose centre lies there; without it, the whole body.")
                    .rows(3, 2, 2).optional(),
            }).alternative(),
        }).optional(),
        choice<FluidQuantity>("fluid", "Columns for the fluid.").list().optional(),
        boolean("interface_balance", "Momentum and power given and received, in columns.")
            .or_default("false"),
        boolean("energy_audit", "Energies, works and losses of all bodies and what the fluid "
                "has of them, in columns, with the residual.").or_default("false"),
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
