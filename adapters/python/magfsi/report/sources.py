# SPDX-License-Identifier: GPL-2.0-or-later
"""Magnets and coils of a scene over time: lines to draw, and their field at a place. A magnet is cut
into small dipoles, a loop into straight pieces: 1e-3 of the field a diameter away, which is enough
to look at; the run itself has closed forms (structure/magnetics)."""
import itertools

import numpy as np

MU0_4PI = 1e-7  # T m/A
PIECES = 96  # of a loop
CUTS = 10  # of a magnet along each axis
TURN = np.linspace(0, 2 * np.pi, PIECES + 1)


class NotKnown(Exception):
    """A law that this file does not follow: a formula, values from a file."""


def rotation(axis, angle):
    """Rodrigues' matrices, one for each angle."""
    x, y, z = np.array(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.asarray(angle, float)[..., None, None]
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


def frame_along(axis):
    """Columns: two directions across the axis, and the axis."""
    third = np.array(axis, float) / np.linalg.norm(axis)
    if np.allclose(third, [0, 0, 1]):
        return np.eye(3)
    first = np.cross(np.eye(3)[np.abs(third).argmin()], third)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(third, first), third], axis=1)


def table(times, rows, repeat, t):
    times = np.array(times)
    if repeat:
        t = np.where(t > times[-1], times[0] + (t - times[0]) % (times[-1] - times[0]), t)
    rows = np.array(rows, float)
    return np.stack([np.interp(t, times, row) for row in rows.reshape(len(times), -1).T], axis=-1)


def rise(t, duration):
    return (1 - np.cos(np.pi * np.clip(t / duration, 0, 1))) / 2


def strength(law, t):
    kind, of = next(iter(law.items()), ("", {}))
    if kind == "oscillation":
        return np.sin(2 * np.pi * of["frequency"] * t + of["phase"])
    if kind == "table":
        return table(of["time"], of["factor"], of["repeat"], t)[:, 0]
    if kind == "ramp":
        return rise(t, of["duration"])
    if kind:
        raise NotKnown(kind)
    return np.ones_like(t)


def displacement(law, t):
    kind, of = next(iter(law.items()), ("", {}))
    if kind == "oscillation":
        course = np.sin(2 * np.pi * of["frequency"] * t + of["phase"]) - np.sin(of["phase"])
        return course[:, None] * of["amplitude"]
    if kind == "ramp":
        return rise(t, of["duration"])[:, None] * of["displacement"]
    if kind == "path":
        return table(of["time"], of["displacement"], of["repeat"], t)
    if kind:
        raise NotKnown(kind)
    return np.zeros((len(t), 3))


def placed(source, t):
    """Rotations and places over time."""
    turn = source.get("rotation")
    turned = rotation(turn["axis"], turn["angle"]) if turn else np.eye(3)
    place = np.array(source.get("position", [0, 0, 0])) + displacement(source.get("motion", {}), t)
    turned = np.tile(turned, (len(t), 1, 1))
    turning = source.get("turning")
    if turning:
        if "frequency" not in turning:
            raise NotKnown("angle")
        more = rotation(turning["axis"], 2 * np.pi * turning["frequency"] * t)
        turned = more @ turned
        if "about" in turning:
            about = np.array(turning["about"])
            place = about + np.einsum("tij,tj->ti", more, place - about)
    return turned, place


def circle(diameter, along, middle=(0, 0, 0)):
    points = np.stack([np.cos(TURN), np.sin(TURN), 0 * TURN], axis=1) * diameter / 2
    return points @ along.T + middle


def magnet(points, moment):
    """Dipoles of one moment in all at these places of the source's frame."""
    return {"points": points, "moments": np.tile(np.array(moment) / len(points), (len(points), 1))}


STEPS = (np.arange(CUTS) + 0.5) / CUTS
PARTS = np.array(list(itertools.product(STEPS, repeat=3)))  # middles of the parts of a unit cube


def in_cylinder(diameter, height):
    """Middles of parts of one volume."""
    share, turn, along = PARTS.T
    radius = diameter / 2 * np.sqrt(share)
    return np.stack([radius * np.cos(2 * np.pi * turn), radius * np.sin(2 * np.pi * turn),
                     height * (along - 0.5)], axis=1)


def coils(kind, of, t):
    """[(points of the loop, current over time)]"""
    if kind == "coil_system":
        made = []
        for coil in of["coils"]:
            if "current" in coil:
                raise NotKnown("formula")
            rows = np.array(coil["currents"]) * coil["turns"]
            course = table(of["time"], rows, of["repeat"], t)[:, 0] if len(rows) > 1 else rows[0] + 0 * t
            made.append((circle(coil["diameter"], frame_along(coil["axis"]), coil["position"]), course))
        return made
    along, current = frame_along(of["axis"]), of["current"] * of["turns"] + 0 * t
    if kind == "coil":
        return [(circle(of["diameter"], along), current)]
    half = of["distance"] / 2 * along[:, 2]
    return [(circle(of["diameter"], along, -half), current),
            (circle(of["diameter"], along, half), -current if of["opposed"] else current)]


def described(kind, of):
    """(lines, dipoles) of a magnet in its frame."""
    if kind == "dipole":
        return [], magnet(np.zeros((1, 3)), of["moment"])
    if kind == "cuboid":
        size = np.array(of["size"])
        corners = [np.array(c) * size / 2 for c in itertools.product((-1, 1), repeat=3)]
        lines = [np.array(pair) for pair in itertools.combinations(corners, 2)
                 if np.count_nonzero(pair[0] != pair[1]) == 1]
        return lines, magnet((PARTS - 0.5) * size, np.array(of["remanence"]) * size.prod() / (4e-7 * np.pi))
    if kind == "cylinder":
        along, height, diameter = frame_along(of["axis"]), of["height"], of["diameter"]
        moment = np.array(of["remanence"]) * np.pi / 4 * diameter**2 * height / (4e-7 * np.pi)
        ends = [circle(diameter, along, s * height / 2 * along[:, 2]) for s in (-1, 1)]
        return ends + [np.array([ends[0][i], ends[1][i]]) for i in range(0, PIECES, PIECES // 4)], \
            magnet(in_cylinder(diameter, height) @ along.T, along @ moment)
    raise NotKnown(kind)


def of_dipoles(away, moments):
    far = np.linalg.norm(away, axis=-1, keepdims=True)
    along = (away * moments).sum(axis=-1, keepdims=True) / far**2
    return MU0_4PI * ((3 * along * away - moments) / far**3).sum(axis=-2)


def of_loop(away, pieces):
    """Biot and Savart's law for each ampere; away: from the middles of the pieces."""
    far = np.linalg.norm(away, axis=-1, keepdims=True)
    return MU0_4PI * (np.cross(pieces, away) / far**3).sum(axis=-2)


def one(name, source, t, at):
    """What is drawn of a source over time, and its field at places over time."""
    kind = next(k for k in ("dipole", "cuboid", "cylinder", "coil", "coil_pair", "coil_system", "grid")
                if k in source)
    turned, place = placed(source, t)
    factor = strength(source.get("strength", {}), t)
    # In the frame of the source, where it stands still.
    seen = np.einsum("tji,tj->ti", turned, at - place)
    if "coil" in kind:
        loops = coils(kind, source[kind], t)
        lines = [points for points, _ in loops]
        field = sum((factor * current)[:, None] * of_loop(
            seen[:, None] - (points[1:] + points[:-1]) / 2, np.diff(points, axis=0))
            for points, current in loops)
        moment, currents = None, np.array([factor * current for _, current in loops])
    else:
        lines, parts = described(kind, source[kind])
        field = factor[:, None] * of_dipoles(seen[:, None] - parts["points"], parts["moments"])
        moment, currents = parts["moments"].sum(axis=0), None
    return {"name": name, "lines": lines, "moment": moment, "turned": turned, "place": place,
            "factor": factor, "currents": currents}, np.einsum("tij,tj->ti", turned, field)


def of_scene(scene, t, at):
    """(what is drawn, the names of what cannot be, the sum of the fields) at these times and places;
    without the field where a law is not known."""
    drawn, missing, whole = [], [], np.zeros((len(t), 3))
    for name, source in scene.get("magnetic_field", {}).get("sources", {}).items():
        try:
            source_drawn, field = one(name, source, t, at)
            drawn.append(source_drawn)
            whole = whole + field
        except NotKnown:
            missing.append(name)
            whole = np.full((len(t), 3), np.nan)
    return drawn, missing, whole
