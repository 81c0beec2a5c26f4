# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes against themselves. A scene that is mirrored, turned, shifted by cells or through periodic
sides, scaled by powers of two, cut by a restart or put on other ranks is the same scene: every
probe is the same, but for rounding, when it is brought back. No reference is needed."""
import json
import math
import unittest

from frame import AXES, Frame

from magfsi import testing

# Of the scale of a column, or of its vector: rounding (1e-16) that some thousand steps of these
# small flows multiply by 1e3 to 1e4 at most. A cell or a marker in another place gives 1e-5.
BOUND = 1e-10
# Of obstacles without bodies, whose flow multiplies nothing.
BOUND_OF_DRAG = 1e-12


def fluid(f, spacing, viscosity, speed, sides=None, **more):
    """sides: of the scene's axes; those that are not named are periodic."""
    all_sides = {f"{axis}_{end}": "periodic" for axis in AXES for end in ("min", "max")}
    all_sides.update(sides or {})
    return {"box": f.edges(f.size), "spacing": f.mm(spacing), "density": f.density(1000),
            "viscosity": f.viscosity(viscosity),
            "expected_speed": f"{speed * f.length / f.time!r} m/s",
            "boundaries": {f.side(side): kind for side, kind in all_sides.items()}, **more}


def scene(f, end, every, **effects):
    probes = {"every": f.s(every)}
    if "fluid" in effects:
        probes["fluid"] = ["kinetic_energy", "enstrophy", "mass", "momentum", "max_speed"]
    if "bodies" in effects:
        probes["bodies"] = ["com", "speed", "max_displacement", "energy"]
        if "fluid" in effects:
            probes["bodies"] += ["fluid_force", "fluid_torque"]
        if any("prescribed_motion" in body for body in effects["bodies"].values()):
            probes["bodies"].append("reaction_force")
        probes["interface_balance"] = "fluid" in effects
    if "obstacles" in effects.get("fluid", {}):
        probes["fluid"].append("obstacle_force")
    probes.update(effects.pop("probes", {}))
    return {"time": {"end": f.s(end)}, "probes": probes, "report": "off", **effects}


def planes(f, **at):
    """name=(axis, place)."""
    there = {}
    for name, (axis, x) in at.items():
        point = [x if a == axis else 0 for a in AXES]
        along = AXES.index(f.axis(axis))
        at = f.place(point)[along] % f.lengths(f.size)[along]  # a plane is asked for in the box
        there[name] = {"plane": {"axis": f.axis(axis), "at": f.mm(at)}}
    return {"integrals": there}


def wall(f, velocity):
    return {"no_slip": {"velocity": f.speed(velocity)}}


NO_SLIP = {f"{axis}_{end}": "no_slip" for axis in AXES for end in ("min", "max")}
MATERIAL = (33000, 660000, 1500)


def block(f, size, elements, position, magnetization=(60, 10, 30), material=MATERIAL, tilt=None,
          **more):
    """tilt: (plane, angle in degrees)."""
    shear, lame, density = material
    body = {"mesh": {"box": {"size": f.edges(size), "elements": f.lengths(elements)}},
            "material": {"shear_modulus": f.pa(shear), "lame_lambda": f.pa(lame),
                         "density": f.density(density)},
            "initial": {"position": f.in_box(position)},
            "magnetization": {"uniform": f.magnetization(magnetization)}, **more}
    if tilt:
        plane, sign = f.plane(tilt[0])
        body["initial"]["rotation"] = {"plane": plane, "angle": f"{sign * tilt[1]} deg"}
        # Magnetization is of the body's frame, which is mirrored and turned with the rest.
    return body


# Box and periodic axes of each scene; spacing: of level 0.
class Scene:
    def __init__(self, size, spacing, periodic, make, planes=None):
        self.size, self.spacing, self.periodic, self.make = size, spacing, periodic, make
        self.planes = planes or {}


def lid(box):
    def make(f):
        moving = {"z_max": wall(f, [0.2, 0.1, 0])}
        return scene(
            f, 5, 1, fluid=fluid(
                f, 0.5, 30, 0.3, {**NO_SLIP, **moving},
                initial_velocity=f.speed([0.05, -0.03, 0.04]),
                refinement={"levels": 1, "box": f.corners(*box)}),
            probes=planes(f, pl1=("x", 3.5), pl2=("z", 3)))
    return Scene((8, 6, 6), 0.5, "", make, {"pl1": "x", "pl2": "z"})


def periodic_bodies(f):
    """A strip is pushed into a cube, through the side x of the box where they are shifted by half
    of it; dipoles and contact act between them."""
    push = [{"face": f.side("x_min"), "ramp": {"displacement": f.moved([2.5, 0, 0]),
                                               "duration": f.s(2)}}]
    return scene(
        f, 2, 0.5,
        bodies={"strip": block(f, [1.5, 1.2, 0.4], [6, 4, 2], [3, 4.1, 4.2],
                               prescribed_motion=push),
                "cube": block(f, [1, 0.8, 0.6], [4, 3, 3], [4.6, 4, 4], (20, -30, 50),
                              (50000, 1000000, 1200))},
        contact={"distance": f.mm(0.35)}, dipoles={},
        magnetic_field={"vector": f.field([2, 5, 12])},
        fluid=fluid(f, 0.5, 2, 1))


def periodic_obstacle(f):
    """Flow past a ball, and a strip that is pushed towards it."""
    push = [{"face": f.side("x_min"), "ramp": {"displacement": f.moved([1.2, 0, 0]),
                                               "duration": f.s(2)}}]
    return scene(
        f, 2, 0.5,
        bodies={"strip": block(f, [1.5, 1.2, 0.4], [6, 4, 2], [2.2, 4, 4],
                               prescribed_motion=push)},
        contact={"distance": f.mm(0.35)},
        magnetic_field={"vector": f.field([2, 5, 12])},
        probes=planes(f, pl1=("x", 5.2), pl2=("z", 4)),
        fluid=fluid(f, 0.5, 2, 1, initial_velocity=f.speed([0.1, 0.05, 0.02]),
                    obstacles={"ball": {"sphere": {"centre": f.in_box([5.1, 4.1, 3.9]),
                                                   "diameter": f.mm(2.2)}}}))


def obstacles_alone(f):
    """Flow past a ball, a cylinder and a block."""
    low, high = [5.5, 1.3, 1.2], [6.6, 2.1, 2.9]
    where = f.place(low)  # a block is moved as a whole, by less than a box
    back = [s * math.floor(x / s) for x, s in zip(where, f.lengths(f.size))]
    block_at = [[f.mm(x - b) for x, b in zip(corner, back)]
                for corner in zip(*(sorted(pair) for pair in zip(where, f.place(high))))]
    return scene(
        f, 2, 0.5,
        probes=planes(f, pl1=("x", 5.2), pl2=("z", 4)),
        fluid=fluid(f, 0.5, 2, 1, initial_velocity=f.speed([0.1, 0.05, 0.02]),
                    obstacles={"ball": {"sphere": {"centre": f.in_box([5.1, 5.1, 3.9]),
                                                   "diameter": f.mm(2.2)}},
                               "rod": {"cylinder": {"centre": f.in_box([2.1, 3.9, 4.2]),
                                                    "diameter": f.mm(1.3), "length": f.mm(3.1),
                                                    "axis": f.axis("y")}},
                               "block": {"box": block_at}}))


def inlet(shape, profile):
    """An oblique inlet over a part of a side beside a lid that moves towards it."""
    def make(f):
        opening = ({"disc": {"centre": f.in_plane("x", [0, 2.3, 3.15]), "diameter": f.mm(2.7)}}
                   if shape == "disc" else
                   {"rectangle": {"centre": f.in_plane("x", [0, 2.3, 3.15]),
                                  "size": f.extent_in_plane("x", [0, 2.7, 1.3])}})
        sides = {**NO_SLIP, "z_max": wall(f, [0.2, 0.1, 0]), "x_max": {"pressure_outlet": {}},
                 "x_min": {"velocity_inlet": {"velocity": f.speed([0.1, 0.02, 0]),
                                              "profile": profile, "ramp": f.s(1), **opening}}}
        return scene(f, 3, 1, fluid=fluid(f, 0.5, 10, 0.5, sides),
                     probes=planes(f, pl1=("x", 2.5), pl2=("z", 3)))
    return Scene((5, 5, 5), 0.5, "", make, {"pl1": "x", "pl2": "z"})


SCENES = {}
OF_FLUIDS_AND_BODIES = {
    # A patch of two coarse cells along each axis, with corners inside of cells and on borders.
    "thin_patch": lid(([2.6, 2.1, 2.6], [4.4, 3.4, 3.4])),
    "patch_on_borders": lid(([2.5, 2, 2], [4.5, 3.5, 3])),
    "periodic_bodies": Scene((8, 8, 8), 0.5, "xyz", periodic_bodies),
    "periodic_obstacle": Scene((8, 8, 8), 0.5, "xyz", periodic_obstacle, {"pl1": "x", "pl2": "z"}),
    "periodic_obstacles_alone": Scene((8, 8, 8), 0.5, "xyz", obstacles_alone,
                                      {"pl1": "x", "pl2": "z"}),
    "inlet_disc": inlet("disc", "parabolic"),
    "inlet_rectangle": inlet("rectangle", "uniform"),
}

MIRRORS = {f"mirrored in {AXES[i]}": [(j, -1 if j == i else 1) for j in range(3)]
           for i in range(3)}
TURNS = {"turned, x to y": [(1, 1), (0, -1), (2, 1)], "turned, x to y to z": [(1, 1), (2, 1), (0, 1)]}


def relations(one):
    """Frames by what they are called."""
    frames = {name: Frame(one.size, to) for name, to in (MIRRORS | TURNS).items()}
    if one.periodic:
        shift = [one.spacing * (3 + i) if AXES[i] in one.periodic else 0 for i in range(3)]
        frames["shifted by some cells"] = Frame(one.size, shift=shift)
    for axes in ["x", "y", "z", "xy", "xz", "yz", "xyz"]:
        if not set(axes) <= set(one.periodic):
            continue
        shift = [one.spacing * round(one.size[i] / one.spacing / 2) if AXES[i] in axes else 0
                 for i in range(3)]
        frames[f"shifted by half a box along {axes}"] = Frame(one.size, shift=shift)
    return frames


def written(name, frame, **more):
    """The scene's file, in a folder of its own."""
    path = f"{testing.new_folder()}/scene.yaml"
    with open(path, "w") as file:
        json.dump(SCENES[name].make(frame) | more, file)
    return path


def columns_of(name, frame):
    return frame.back(testing.good_run(written(name, frame)).probes(), SCENES[name].planes)


class Compared(unittest.TestCase):
    def compare(self, name, relation, expected, found, bound=BOUND):
        worst, column = testing.worst_difference(expected, found)
        testing.report(f"{name} {relation}: {worst:.1e} in {column}")
        self.assertLessEqual(worst, bound, column)


def moved(name):
    def test(self):
        expected = columns_of(name, Frame(SCENES[name].size))
        for relation, frame in relations(SCENES[name]).items():
            with self.subTest(relation):
                self.compare(name, relation, expected, columns_of(name, frame),
                             BOUND_OF_DRAG if name.endswith("alone") else BOUND)
    return test


def split(name):
    """By a restart in the middle, on other ranks after it."""
    def test(self):
        frame = Frame(SCENES[name].size)
        scene_file = written(name, frame)
        with open(scene_file) as file:
            content = json.load(file)
        end_ms = float(content["time"]["end"].split()[0])
        whole = testing.good_run(scene_file)
        half = {"time.end": f"{end_ms / 2} ms", "checkpoint.every": f"{end_ms / 2} ms"}
        before = testing.good_run(scene_file, half)
        ranks = ",".join(f"{role}=2" for role, key in (("structure", "bodies"), ("fluid", "fluid"))
                         if key in content)
        after = testing.good_run(scene_file, {"checkpoint.every": f"{end_ms / 2} ms"}, ranks,
                                 folder=before.folder, restart="latest")
        self.compare(name, "split, on other ranks", whole.probes(), after.probes())
    return test


def scaled(name):
    """Lengths twice, times four times, pressures sixteen times as large: each number of the program
    is a power of two times as large, and so is each column."""
    def test(self):
        one = SCENES[name]
        expected = testing.good_run(written(name, Frame(one.size))).probes()
        frame = Frame(one.size, length=2, time=4, pressure=16)
        found = testing.good_run(written(name, frame)).probes()
        for column, values in expected.items():
            factors = {b / a for a, b in zip(values, found[column]) if a}
            if "mismatch" in column or not factors:  # differences of rounding
                continue
            factor = factors.pop()
            self.assertFalse(factors, f"{column} is not one factor times as large")
            self.assertEqual(math.frexp(abs(factor))[0], 0.5, f"{column}: {factor}")
    return test


def add_tests(cases, scenes):
    """To a class of test cases: each relation of each scene."""
    SCENES.update(scenes)
    for name in scenes:
        for test in (moved, split, scaled):
            setattr(cases, f"test_{name}_{test.__name__}", test(name))


class Relations(Compared):
    pass


if __name__ == "__main__":
    add_tests(Relations, OF_FLUIDS_AND_BODIES)
    testing.main()
