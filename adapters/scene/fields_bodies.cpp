#include "adapters/scene/fields.h"

// The nesting below is that of the file.
// clang-format off

namespace magfsi::scene {

namespace {

Field mesh() {
    return group("mesh", "Hexahedra; the frame's origin is the lowest corner.", {
        group("box", "A block.", {
            quantity("size", "m", "Length along x, y and z.").vector(3).above(0),
            integer("elements", "Elements along x, y and z.").vector(3).at_least(1)
                .at_most(100000).chosen_by_accuracy(),
        }).alternative(),
        group("oblique", "A plate of parallelogram cells, each a region \"row R column C\".", {
            integer("cells", "Cells along x and y.").vector(2).at_least(1).at_most(10000),
            quantity("length_a", "m", "A cell's side along x.").above(0),
            quantity("length_b", "m", "Its side at the angle.").above(0),
            quantity("angle", "rad", "Between the two.").above(0).at_most(3.14159),
            quantity("thickness", "m", "Of the plate.").above(0),
            integer("elements", "In a cell: along a, along b, layers.").vector(3).at_least(1)
                .at_most(100000),
            boolean("zigzag", "Rows lean right and left in turn, as in Miura-ori; else all "
                    "alike.").or_default("true"),
        }).alternative(),
        group("gmsh", "Hexahedra from a Gmsh file; physical volumes are regions, physical "
              "surfaces faces to clamp.", {
            text("file", "A .msh file; its path counts from the scene's folder."),
            quantity("unit", "m", "Length of the file's unit.").above(0).or_default("1 m"),
        }).alternative(),
    });
}

std::vector<Field> neo_hookean() {
    return {
        quantity("shear_modulus", "Pa", "G.").above(0),
        quantity("lame_lambda", "Pa", "Lame's first constant, the paper's K.").at_least(0),
        quantity("density", "kg/m3", "Mass by volume.").above(0),
        quantity("viscosity", "Pa s", "Kelvin-Voigt damping: viscous stress over rate of "
                 "strain is twice this.").above(0).optional(),
    };
}

Field material() {
    return group("material", "Neo-Hookean solid, eq. (1).", neo_hookean());
}

Field material_regions() {
    std::vector<Field> keys = neo_hookean();
    keys.insert(keys.begin(), text("region", "One name, or a list.").one_or_list());
    return list_of("material_regions", "Other materials, by the mesh's regions; one that is "
                   "not named is of `material`.", std::move(keys));
}

Field magnetization() {
    const auto vector = [](std::string_view name) {
        return quantity(name, "A/m", "Magnetization vector.").vector(3);
    };
    return group("magnetization", "Remanent magnetization of the undeformed body.", {
        vector("uniform").alternative(),
        group("harmonic", "amplitude [cos(2 pi s / wavelength + phase) along + sin(...) "
              "into], s from the lower end.", {
            quantity("amplitude", "A/m", "Strength.").above(0),
            quantity("wavelength", "m", "Length of one turn; without it, the body's length "
                     "along `along`.").above(0).optional(),
            quantity("phase", "rad", "Angle at s = 0.").or_default("0 deg"),
            axis("along", "Axis of s.").or_default("x"),
            axis("into", "Second axis of the magnetization's plane.").or_default("z"),
        }).alternative(),
        list_of("domains", "Elements whose centre lies in a domain carry its vector; the "
                "first domain wins.", {
            quantity("box", "m", "Lower and upper corner, in the body's frame.")
                .rows(3, 2, 2).alternative(),
            quantity("polygon", "m", "Corners in the x-y plane, in the body's frame.")
                .rows(2, 3, 10000).alternative(),
            vector("vector"),
        }).alternative(),
        list_of("regions", "By the mesh's regions; one that is not named carries none.", {
            text("region", "One name, or a list.").one_or_list(),
            vector("vector"),
        }).alternative(),
        group("table", "Each element takes the vector of the nearest point.", {
            text("file", "CSV with the columns x[m], y[m], z[m], Mx[A/m], My[A/m], "
                 "Mz[A/m]; its path counts from the scene's folder."),
        }).alternative(),
    });
}

Field initial() {
    return group("initial", "State at time 0: relaxed first, then rotated, then placed.", {
        quantity("position", "m", "Where the centre of volume goes; needed in a fluid.")
            .vector(3).optional(),
        group("rotation", "Turn about the centre of volume.", {
            plane("plane", "The angle runs from its first axis to its second.")
                .or_default("xz"),
            quantity("angle", "rad", "How far."),
        }).optional(),
        group("relaxed", "Start from the shape at rest in this constant field, without "
              "fluid and gravity.", {
            quantity("magnitude", "T", "Flux density."),
            quantity("direction", "rad", "Angle in the plane of `magnetic_field`, before "
                     "the rotation."),
        }).optional(),
    });
}

Field prescribed_motion() {
    return list_of("prescribed_motion", "Faces held and moved by something outside, along "
                   "axes of space, from where they start.", {
        text("face", "As in `clamps`; one name, or a list.").one_or_list(),
        group("oscillation", "amplitude (sin(2 pi frequency t + phase) - sin(phase)).", {
            quantity("amplitude", "m", "Along x, y and z.").vector(3),
            quantity("frequency", "1/s", "Periods a second.").above(0),
            quantity("phase", "rad", "0: at full speed at once, to both sides of the start; "
                     "-90 deg: from rest, to one side.").or_default("0 deg"),
        }).alternative(),
        group("ramp", "By (1 - cos(pi t / duration)) / 2, then held there.", {
            quantity("displacement", "m", "Along x, y and z.").vector(3),
            quantity("duration", "s", "Of the way.").above(0),
        }).alternative(),
    });
}

}  // namespace

Field bodies_fields() {
    return named("bodies", "Soft magnetic bodies by name.", {
        mesh(),
        choice<ElementVariant>("element", "full: the paper's element; mean_f: accurate in "
                               "bending with few layers; assumed_strain: in every mode, for "
                               "elements of any proportion.").or_default("full"),
        material(),
        material_regions().optional(),
        magnetization().optional(),
        text("clamps", "Faces held still: x_min to z_max, or names of the Gmsh file.").list()
            .optional(),
        list_of("rollers", "Faces held along one axis, free along the others: both faces "
                "across the depth for plane strain, one for a plane of symmetry.", {
            text("face", "As in `clamps`; one name, or a list.").one_or_list(),
            axis("axis", "Of space, not of a turned body."),
        }).optional(),
        prescribed_motion().optional(),
        initial().optional(),
    });
}

}  // namespace magfsi::scene
