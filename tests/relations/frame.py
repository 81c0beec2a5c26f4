# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that are written once and stand in any frame: mirrored, turned, shifted, scaled."""
import itertools
import math
import re

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
