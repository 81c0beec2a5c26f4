# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes against themselves. A scene that is mirrored, turned, shifted by cells or through periodic
sides, scaled by powers of two, cut by a restart or put on other ranks is the same scene: every
probe is the same, but for rounding, when it is brought back. No reference is needed."""
import itertools
import json
import math
import re
import unittest

from magfsi import testing

# Of the scale of a column, or of its vector: rounding (1e-16) that some thousand steps of these
# small flows multiply by 1e3 to 1e4 at most. A cell or a marker in another place gives 1e-5.
BOUND = 1e-10
# Of obstacles without bodies, whose flow multiplies nothing.
BOUND_OF_DRAG = 1e-12
AXES = "xyz"


class Frame:
    """Where a scene stands: scenes are written in numbers of mm by their own axes and say what is
    a point, a direction or an axial vector. to: for each axis of the scene the axis it comes to,
    and its sign. shift: then, mm. length, time, pressure: factors of the units."""

    def __init__(self, size, to=((0, 1), (1, 1), (2, 1)), shift=(0, 0, 0), length=1, time=1,
                 pressure=1):
        self.size, self.to, self.by = size, to, shift
        self.length, self.time, self.pressure = length, time, pressure
        swaps = sum(a > b for (a, _), (b, _) in itertools.combinations(to, 2))
        self.turn = (-1)**swaps * math.prod(sign for _, sign in to)  # -1: a mirror image

    def direction(self, vector):
        there = [0, 0, 0]
        for (axis, sign), value in zip(self.to, vector):
            there[axis] = sign * value
        return there

    def axial(self, vector):
        return [self.turn * value for value in self.direction(vector)]

    def lengths(self, vector):
        return [abs(value) for value in self.direction(vector)]

    def place(self, point):
        middle = [s / 2 for s in self.size]
        there = self.direction([p - m for p, m in zip(point, middle)])
        return [p + m + s for p, m, s in zip(there, self.lengths(middle), self.by)]

    def axis(self, axis):
        return AXES[self.to[AXES.index(axis)][0]]

    def side(self, side):
        axis, end = side.split("_")
        positive = self.to[AXES.index(axis)][1] > 0
        return f"{self.axis(axis)}_{end if positive else {'min': 'max', 'max': 'min'}[end]}"

    def plane(self, plane):
        """Of an angle from its first axis to its second, and the angle's sign."""
        (a, sa), (b, sb) = (self.to[AXES.index(axis)] for axis in plane)
        return AXES[a] + AXES[b], sa * sb

    # With units.
    def mm(self, value):
        return f"{round(self.length * value, 12)!r} mm"

    def point(self, point):
        return [self.mm(value) for value in self.place(point)]

    def in_box(self, point):
        """A point that a shift has moved out of the box, where it is again in it."""
        size = self.lengths(self.size)
        return [self.mm(x % s) for x, s in zip(self.place(point), size)]

    def moved(self, vector):
        return [self.mm(value) for value in self.direction(vector)]

    def edges(self, vector):
        return [self.mm(value) for value in self.lengths(vector)]

    def corners(self, low, high):
        both = list(zip(self.place(low), self.place(high)))
        return [[self.mm(min(pair)) for pair in both], [self.mm(max(pair)) for pair in both]]

    def in_plane(self, axis, point):
        """Of a side or plane normal to an axis: the two other coordinates in their order."""
        there = self.place(point)
        return [self.mm(there[i]) for i in range(3) if i != AXES.index(self.axis(axis))]

    def extent_in_plane(self, axis, size):
        there = self.lengths(size)
        return [self.mm(there[i]) for i in range(3) if i != AXES.index(self.axis(axis))]

    def s(self, milliseconds):
        return f"{milliseconds * self.time!r} ms"

    def speed(self, vector):
        return [f"{v * self.length / self.time!r} m/s" for v in self.direction(vector)]

    def pa(self, value):
        return f"{value * self.pressure!r} Pa"

    def density(self, value):
        return f"{value * self.pressure * (self.time / self.length)**2!r} kg/m3"

    def viscosity(self, value):
        return f"{value * self.length**2 / self.time!r} mm2/s"

    def field(self, vector):
        return [f"{v * math.sqrt(self.pressure)!r} mT" for v in self.axial(vector)]

    def magnetization(self, vector):
        return [f"{v * math.sqrt(self.pressure)!r} kA/m" for v in self.axial(vector)]

    def per_s(self, value):
        return f"{value / self.time!r} 1/s"

    def pa_s(self, value):
        return f"{value * self.pressure * self.time!r} Pa s"

    def acceleration(self, value):
        return f"{value * self.length / self.time**2!r} m/s2"

    def force_density(self, vector):
        return [f"{v * self.pressure / self.length!r} N/m3" for v in self.direction(vector)]

    def moment(self, vector):
        factor = math.sqrt(self.pressure) * self.length**3
        return [f"{v * factor!r} A m2" for v in self.axial(vector)]

    def gradient(self, rows):
        """dB_i / dx_j: an axial vector by a vector."""
        there = [[0] * 3 for _ in range(3)]
        for i, (a, sa) in enumerate(self.to):
            for j, (b, sb) in enumerate(self.to):
                there[a][b] = self.turn * sa * sb * rows[i][j]
        factor = math.sqrt(self.pressure) / self.length
        return [[f"{v * factor!r} T/m" for v in row] for row in there]

    def back(self, columns, planes):
        """Columns of probes, in the scene's own axes; planes: axis of each plane."""
        found = {}
        sides = {self.side(f"{axis}_{end}"): f"{axis}_{end}"
                 for axis in AXES for end in ("min", "max")}
        for name, values in columns.items():
            if ".lift[" in name or ".drag[" in name:
                continue  # along axes that the program chooses
            name = re.sub(r"(?<=\.)[xyz]_(min|max)(?=\.)", lambda m: sides[m[0]], name)
            plane = next((axis for p, axis in planes.items() if name.startswith(p + ".")), None)
            through = plane and ("flow" in name or "flux" in name)
            sign = self.to[AXES.index(plane)][1] if through else 1
            vector = re.match(r"(.*_u?)([xyz])(\[.*)", name)
            if not vector:
                found[name] = [sign * v for v in values]
                continue
            head, there, unit = vector.groups()
            here, sign_of_axis = next((AXES[i], s) for i, (axis, s) in enumerate(self.to)
                                      if AXES[axis] == there)
            sign *= sign_of_axis
            if "torque" in head or "field" in head:
                sign *= self.turn
            moved = 0
            if re.search(r"com_$|points\.|_at_$", head):
                middle = self.size[AXES.index(here)] / 2
                moved = middle - sign * (middle + self.by[AXES.index(there)])
            values = [sign * v + moved * 1e-3 for v in values]
            if head.endswith("com_"):
                box = self.size[AXES.index(here)] * 1e-3
                values = [v - box * math.floor(values[0] / box) for v in values]
            found[head + here + unit] = values
        return found


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
            if column.startswith("interface.") or not factors:
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
