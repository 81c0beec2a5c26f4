# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page shows of a run folder, as numbers and text that JSON holds."""
import csv
import json

import numpy as np

from magfsi import runs
from magfsi.report import fields, shapes, waits
from magfsi.report.fields import packed, spread

# A page of more cannot be sent by mail or opened at once.
LARGEST_PAGE = 20e6
MOST_ROWS = 4000  # of a curve: more than a screen has pixels
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


def rows_shown(columns):
    """Of a course that is too long, in each part of it the rows where some column is at its least
    or largest: a peak of one row is not lost."""
    count = len(columns["t[s]"])
    if count <= MOST_ROWS:
        return list(range(count))
    values = np.array([values for name, values in columns.items() if name != "t[s]"])
    rows = {0, count - 1}
    parts = max(2, MOST_ROWS // (2 * max(1, len(values))))
    edges = np.linspace(0, count, parts + 1).astype(int)
    for begin, end in zip(edges[:-1], edges[1:]):
        part = np.nan_to_num(values[:, begin:end])
        rows.update(begin + part.argmin(axis=1))
        rows.update(begin + part.argmax(axis=1))
    rows.update(spread(count, max(2, MOST_ROWS - len(rows))))
    return sorted(int(row) for row in rows)


def probes(columns):
    if not columns:
        return None
    rows = rows_shown(columns)
    return {"rows": len(rows), "stored": len(columns["t[s]"]), "columns": [
        {"name": name, "values": packed(np.array(values)[rows], "<f4")}
        for name, values in columns.items()]}


def field_vectors(scene, columns):
    """Three courses of the field [T] over the rows of the probes, if they tell them."""
    names = [f"field_{axis}[T]" for axis in AXES]
    if all(name in columns for name in names):
        return [columns[name] for name in names]
    field, strength = scene.get("magnetic_field", {}), columns.get("field[T]")
    law = next((field[key] for key in ("table", "constant") if key in field), {})
    angle = law.get("direction")
    angle = angle[0] if isinstance(angle, list) and len(angle) == 1 else angle
    plane = field.get("plane", "")
    if not strength or not isinstance(angle, (int, float)) or len(plane) != 2:
        return None
    share = dict(zip(plane, (np.cos(angle), np.sin(angle))))
    return [[b * share.get(axis, 0.0) for b in strength] for axis in AXES]


def field(scene, columns):
    vectors = field_vectors(scene, columns) if columns else None
    if vectors is None or not np.abs(vectors).max():
        return None
    rows = rows_shown(columns)
    return {"largest": float(np.linalg.norm(vectors, axis=0).max()),
            "vectors": packed(np.array(vectors)[:, rows].T, "<f4")}


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


def shown_box(scene, found):
    """Lowest and highest corner of what is shown."""
    box = scene.get("fluid", {}).get("box")
    if box:
        return [0, 0, 0], box
    return (found["low"], found["high"]) if found else (None, None)


def read_run(folder, most_bytes):
    """Raises NotARun."""
    scene = read_json(folder / "scene.json", None)
    starts = read_json(folder / "run.json", [])
    if scene is None or not starts:
        raise NotARun(f"{folder}: found no scene.json and run.json; allowed are folders that "
                      "./magfsi run has written")
    summary, columns = read_json(folder / "summary.json", {}), read_probes(folder)
    found = fields.bodies(folder, 0.7 * most_bytes)
    low, high = shown_box(scene, found)
    middle = found["middle"] if found else [b / 2 for b in high] if high else None
    last = starts[-1]
    text = folder / "scene.yaml"
    return {"name": scene.get("name", folder.name), "folder": str(folder),
            "outcome": summary.get("outcome", "not ended"), "cause": summary.get("cause", ""),
            "effects": summary.get("effects", []), "absent": summary.get("absent_effects", []),
            "scene": text.read_text(errors="replace") if text.exists() else "",
            "overrides": last.get("overrides", []), "command": last.get("command", ""),
            "begun": last.get("begun", ""), "machine": last.get("machine", ""),
            "versions": summary.get("versions", last.get("versions", {})),
            "ranks": last.get("ranks", {}), "wall_s": summary.get("wall_s"),
            "steps": summary.get("steps"), "tasks": summary.get("tasks", {}),
            "waiting": summary.get("waiting", {}), "trace": waits.of_trace(folder),
            "end": scene.get("time", {}).get("end"),
            "checks": checks(scene, columns, summary),
            "box": scene.get("fluid", {}).get("box"), "wires": shapes.wires(scene, low, high),
            "field": field(scene, columns), "probes": probes(columns), "bodies": found,
            "flow": fields.flow(folder, scene, middle, 0.3 * most_bytes)
            if "fluid" in scene and middle else None}
