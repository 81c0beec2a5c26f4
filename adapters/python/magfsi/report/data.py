# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page shows of a run folder, as numbers and text that JSON holds."""
import csv
import json

import numpy as np

from magfsi import runs
from magfsi.report import fields, shapes, sources, vortices, waits
from magfsi.report.fields import packed, spread

LARGEST_PAGE = 2e6  # bytes; a phone opens no more at once
MOST_ROWS = 4000  # of a curve: more than a screen has pixels
MOST_PLACES = 200  # of a magnet that moves
ROUNDING = 1e-9  # of the largest
AXES = "xyz"


class NotARun(Exception):
    pass


def read_json(path, other):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return other


def read_probes(folder):
    try:
        columns = runs.read_table(folder / "probes.csv", float)
    except (OSError, ValueError, csv.Error):
        return {}
    return columns if columns.get("t[s]") else {}


def rows_shown(columns, most=MOST_ROWS):
    """Of a course that is too long, in each part of it the rows where some column is at its least
    or largest: a peak of one row is not lost."""
    count = len(columns["t[s]"])
    if count <= most:
        return list(range(count))
    values = np.array([values for name, values in columns.items() if name != "t[s]"])
    rows = {0, count - 1}
    parts = max(2, most // (2 * max(1, len(values))))
    edges = np.linspace(0, count, parts + 1).astype(int)
    for begin, end in zip(edges[:-1], edges[1:]):
        part = np.nan_to_num(values[:, begin:end])
        rows.update(begin + part.argmin(axis=1))
        rows.update(begin + part.argmax(axis=1))
    rows.update(spread(count, max(2, most - len(rows))))
    return sorted(int(row) for row in rows)


def as_column(name, values):
    """A length from its first value on: single precision would lose a small change of it."""
    base = values[0] if name.endswith("[m]") and np.isfinite(values[0]) else 0.0
    return {"name": name, "base": base, "values": packed(np.array(values) - base, "<f4")}


def probes(columns, rows):
    if not columns:
        return None
    return {"rows": len(rows), "stored": len(columns["t[s]"]), "columns": [
        as_column(name, np.array(values)[rows]) for name, values in columns.items()]}


def uniform_field(scene, columns):
    """Three courses of the field [T] over the rows of the probes, if they tell them."""
    names = [f"field_{axis}[T]" for axis in AXES]
    if all(name in columns for name in names):
        return np.array([columns[name] for name in names]).T
    field, strength = scene.get("magnetic_field", {}), columns.get("field[T]")
    law = next((field[key] for key in ("table", "constant") if key in field), {})
    angle = law.get("direction")
    angle = angle[0] if isinstance(angle, list) and len(angle) == 1 else angle
    plane = field.get("plane", "")
    if not strength or not isinstance(angle, (int, float)) or len(plane) != 2:
        return None
    share = dict(zip(plane, (np.cos(angle), np.sin(angle))))
    return np.array([[b * share.get(axis, 0.0) for axis in AXES] for b in strength])


def field_and_sources(scene, columns, rows, found):
    """(the field over time, magnets and coils over time, courses of the field at the first body):
    the uniform field, and where it varies in space that at the body's middle."""
    times = np.array(columns["t[s]"])[rows] if columns else np.array(found["times"] if found else [])
    uniform = uniform_field(scene, columns)
    vectors = None if uniform is None else uniform[rows]
    drawn, courses = [], {}
    law = scene.get("magnetic_field", {})
    varies = bool((law.get("sources") or law.get("gradient")) and found and len(times))
    if varies:
        at = np.stack([np.interp(times, found["times"], c) for c in np.array(found["centres"]).T], 1)
        made, missing, more = sources.of_scene(scene, times, at)
        if "gradient" in law:
            more = more + (at - law["gradient"].get("origin", [0, 0, 0])) @ np.array(law["gradient"]["matrix"]).T
        drawn = [seen_source(source, times) for source in made] + [{"missing": name} for name in missing]
        vectors = more if vectors is None else vectors + more
        if columns and np.isfinite(vectors).all():
            courses = {f"field_at_{found['names'][0]}_{axis}[T]": vectors[:, a]
                       for a, axis in enumerate(AXES)}
    if vectors is None or not len(times) or not np.abs(vectors).max() > 0:  # of NaN neither
        return None, drawn, courses
    return {"largest": float(np.linalg.norm(vectors, axis=1).max()), "times": packed(times, "<f4"),
            "at": found["names"][0] if varies else "", "vectors": packed(vectors, "<f4")}, drawn, courses


def seen_source(source, times):
    still = not (np.ptp(source["place"], axis=0).any() or np.ptp(source["turned"], axis=0).any() or
                 np.ptp(source["factor"]))
    chosen = [0] if still and source["currents"] is None else spread(len(times), MOST_PLACES)
    matrices = np.concatenate([source["turned"].reshape(-1, 9), source["place"]], axis=1)[chosen]
    return {"name": source["name"], "times": packed(times[chosen], "<f4"),
            "lines": [np.round(line, 9).tolist() for line in source["lines"]],
            "moment": None if source["moment"] is None else source["moment"].tolist(),
            "matrices": packed(matrices, "<f4"), "factor": packed(source["factor"][chosen], "<f4"),
            "currents": None if source["currents"] is None else
            [packed(current[chosen], "<f4") for current in source["currents"]]}


def rises(values):
    """Whether it only rises or only falls, by more than rounding."""
    steps = np.diff(values)
    least = ROUNDING * np.abs(values).max()
    return len(steps) > 0 and (bool((steps > least).all()) or bool((steps < -least).all()))


def load(scene, columns, rows):
    """Of equilibria what is varied from one to the next, in place of a time that has no meaning:
    the field's strength or direction if it only rises or only falls, else the number."""
    if not columns or "equilibrium" not in scene.get("time", {}):
        return None
    strength = np.array(columns.get("field[T]", []))[rows] if "field[T]" in columns else None
    field, plane = uniform_field(scene, columns), scene.get("magnetic_field", {}).get("plane", "")
    if strength is not None and rises(strength):
        return {"name": "field", "unit": "T", "values": packed(strength, "<f4")}
    if field is not None and len(plane) == 2:
        first, second = (field[rows, AXES.index(axis)] for axis in plane)
        angle = np.degrees(np.unwrap(np.arctan2(second, first)))
        angle -= 360 * np.floor(angle.min() / 360 + ROUNDING)
        if rises(angle):
            return {"name": f"direction of the field in {plane}", "unit": "deg",
                    "values": packed(angle, "<f4")}
    return {"name": "equilibrium", "unit": "1", "values": packed(np.array(rows) + 1, "<f4")}


def largest(columns, name):
    values = [abs(v) for v in columns.get(name, [])]
    return max(values) if values else None


def is_closed(scene):
    sides = scene.get("fluid", {}).get("boundaries", {}).values()
    return not any(kind in side for side in sides for kind in ("velocity_inlet", "pressure_outlet"))


def mass_drift(scene, columns):
    mass = columns.get("mass[kg]")
    if not mass or not is_closed(scene):
        return None
    return (max(mass) - min(mass)) / max(abs(mass[0]), 1e-300)


def mass_limit(scene):
    """Single precision keeps seven digits of a cell. Walls between cells, as balls, cylinders and
    surfaces have them, are interpolated, which conserves mass as well as the scheme is exact."""
    obstacles = scene.get("fluid", {}).get("obstacles", {}).values()
    return 1e-6 if all("box" in shape for shape in obstacles) else 1e-4


def checks(scene, columns, summary):
    """[(what, figure, limit, unit)] of the audits that the run has made; limits are those above
    which the program or its documentation warns (docs/coupling.md, docs/energy_audit.md)."""
    boundary, audit = summary.get("immersed_boundary", {}), summary.get("energy_audit", {})
    found = [("no-slip error", boundary.get("no_slip_error"), 0.05),
             ("leakage", boundary.get("leakage"), 0.05),
             ("energy: residual over work", audit.get("residual"), 0.01),
             ("energy: gained over work", audit.get("gained"), 0.01),
             ("mass of the closed box: change", mass_drift(scene, columns), mass_limit(scene))]
    for what in ("momentum", "power"):
        found.append((f"{what} lost between body and fluid",
                      largest(columns, f"interface.{what}_mismatch[1]"), 1e-12))
    return [{"name": name, "value": value, "limit": limit, "good": value <= limit}
            for name, value, limit in found if value is not None and np.isfinite(value)]


def most_rows(columns, most_bytes):
    """Base64 takes four characters for three bytes."""
    return int(min(MOST_ROWS, max(100, 0.15 * most_bytes / (len(columns) * 4 * 4 / 3))))


def shown_box(scene, found):
    """Lowest and highest corner of what is shown."""
    box = scene.get("fluid", {}).get("box")
    if box:
        return [0, 0, 0], box
    return (found["low"], found["high"]) if found else (None, None)


def bytes_of(value):
    """Length of the packed numbers in it, which are most of what it takes on a page."""
    if isinstance(value, str):
        return len(value)
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return sum(map(bytes_of, inner))


def read_run(folder, most_bytes, columns=None, surfaces=True):
    """`columns` are those of probes.csv where they have been read already; surfaces: whether vortices
    are wanted, too, which get the room that all else leaves. Raises NotARun."""
    scene = read_json(folder / "scene.json", None)
    starts = read_json(folder / "run.json", [])
    if scene is None or not starts:
        raise NotARun(f"{folder}: found no scene.json and run.json; allowed are folders that "
                      "./magfsi run has written")
    summary = read_json(folder / "summary.json", {})
    columns = read_probes(folder) if columns is None else columns
    found = fields.bodies(folder, 0.4 * most_bytes)
    rows = rows_shown(columns, most_rows(columns, most_bytes)) if columns else []
    field, drawn, courses = field_and_sources(scene, columns, rows, found)
    seen = probes(columns, rows)
    if seen and courses:
        # A law of time that is none is not what the body feels.
        seen["columns"] = [c for c in seen["columns"] if not c["name"].startswith("field") or
                           any(columns[c["name"]])]
        seen["columns"] += [as_column(name, values) for name, values in courses.items()]
    low, high = shown_box(scene, found)
    middle = found["middle"] if found else [b / 2 for b in high] if high else None
    slices = fields.flows(folder, scene, middle, 0.38 * most_bytes) if "fluid" in scene and middle else []
    room = most_bytes - bytes_of([seen, found, slices])
    turning = vortices.vortices(folder, room) if surfaces and slices else None
    last = starts[-1]
    texts = [file for name in ("scene_as_given.yaml", "scene.yaml") if (file := folder / name).exists()]
    return {"name": scene.get("name", folder.name), "folder": str(folder),
            "outcome": summary.get("outcome", "not ended"), "cause": summary.get("cause", ""),
            "effects": summary.get("effects", []), "absent": summary.get("absent_effects", []),
            "scene": texts[0].read_text(errors="replace") if texts else "",
            "overrides": last.get("overrides", []), "command": last.get("command", ""),
            "begun": last.get("begun", ""), "machine": last.get("machine", ""),
            "versions": summary.get("versions", last.get("versions", {})),
            "ranks": last.get("ranks", {}), "wall_s": summary.get("wall_s"),
            "steps": summary.get("steps"), "tasks": summary.get("tasks", {}),
            "waiting": summary.get("waiting", {}), "trace": waits.of_trace(folder),
            "end": scene.get("time", {}).get("end"),
            "checks": checks(scene, columns, summary),
            "box": scene.get("fluid", {}).get("box"), "wires": shapes.wires(scene, low, high),
            "field": field, "sources": drawn, "load": load(scene, columns, rows), "probes": seen,
            "points": scene.get("probes", {}).get("points", {}), "bodies": found,
            "flow": slices[0] if slices else None, "other_flows": slices[1:],
            "vortices": turning}
