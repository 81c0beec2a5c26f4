"""What the page shows of a run folder, as numbers and text that JSON holds."""
import base64
import csv
import json

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi import runs
from magfsi.plotting import read_grid
from magfsi.report import shapes

# A page of more cannot be sent by mail or opened at once.
LARGEST_PAGE = 20e6
MOST_ROWS = 2000  # of a curve: more than a screen has pixels
MOST_SIDE = 160  # pixels of a slice
MOST_SLICES = 60
AXES = "xyz"


class NotARun(Exception):
    pass


def packed(array, kind):
    return base64.b64encode(np.ascontiguousarray(array, kind).tobytes()).decode()


def spread(count, most):
    """Indices of at most so many of them, first and last among them."""
    return sorted({round(i) for i in np.linspace(0, count - 1, min(count, most))})


def read_json(path, other):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return other


def probes(folder):
    try:
        columns = runs.read_columns(folder / "probes.csv")
    except (OSError, ValueError, csv.Error):
        return None
    count = len(columns.get("t[s]", []))
    if count == 0:
        return None
    rows = spread(count, MOST_ROWS)
    return {"rows": len(rows), "columns": [
        {"name": name, "values": packed(np.array(values)[rows], "<f4")}
        for name, values in columns.items()]}


def surface(grid):
    """Outer faces of the bodies (faces, 4) by the numbers of their nodes, their elements, and
    the nodes that they have."""
    filter_ = vtk.vtkGeometryFilter()
    filter_.SetInputData(grid)
    filter_.PassThroughPointIdsOn()
    filter_.PassThroughCellIdsOn()
    filter_.Update()
    skin = filter_.GetOutput()
    faces = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    nodes = vtk_to_numpy(skin.GetPointData().GetArray("vtkOriginalPointIds"))
    elements = vtk_to_numpy(skin.GetCellData().GetArray("vtkOriginalCellIds"))
    return faces, elements, nodes


def magnetization(grid, elements):
    """Of each face the component that varies most over the bodies, from -1 to 1."""
    array = grid.GetCellData().GetArray("magnetization")
    if array is None:
        return None
    values = vtk_to_numpy(array)
    axis = int(np.ptp(values, axis=0).argmax())
    largest = np.abs(values[:, axis]).max()
    if largest == 0:
        return None
    return {"label": f"magnetisation along {AXES[axis]} at rest, +-{largest / 1e3:.3g} kA/m",
            "values": packed(127 * values[elements, axis] / largest, "i1")}


def bodies(folder, most_bytes):
    """Positions of the surface in every frame, or in as many as there is room for."""
    try:
        stored = runs.frames(folder)
    except OSError:
        return None
    stored = [(time, file) for time, file in stored if file.exists()]
    if not stored:
        return None
    first = read_grid(stored[0][1])
    faces, elements, nodes = surface(first)
    # Base64 takes four characters for three bytes.
    each = 7 * len(nodes) * 4 / 3
    chosen = [stored[i] for i in spread(len(stored), max(2, int(most_bytes / each)))]
    points, speeds = [], []
    for _, file in chosen:
        grid = read_grid(file)
        points.append(vtk_to_numpy(grid.GetPoints().GetData())[nodes])
        velocity = grid.GetPointData().GetArray("velocity")
        speeds.append(np.zeros(len(nodes)) if velocity is None else
                      np.linalg.norm(vtk_to_numpy(velocity)[nodes], axis=1))
    points, speeds = np.array(points), np.array(speeds)
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    step = max(np.ptp(points, axis=(0, 1)).max() / 65535, 1e-12)
    fastest = speeds.max()
    return {"times": [time for time, _ in chosen], "stored": len(stored), "nodes": len(nodes),
            "low": low.tolist(), "high": high.tolist(), "step": step,
            "points": packed(np.round((points - low) / step), "<u2"),
            "faces": packed(faces, "<u4"), "magnetization": magnetization(first, elements),
            "fastest": float(fastest),
            "speeds": packed(np.round(255 * speeds / fastest) if fastest else speeds, "u1")}


def slice_of(file, axis, at):
    """Speeds on the cells of a plane: (values (rows, columns), origin, size)."""
    grid = read_grid(file)
    array = grid.GetCellData().GetArray("velocity")
    if array is None:
        return None
    cells = [n - 1 for n in grid.GetDimensions()]
    spacing, origin = grid.GetSpacing(), grid.GetOrigin()
    speed = np.linalg.norm(vtk_to_numpy(array), axis=1).reshape(cells[::-1])  # z, y, x
    layer = int(np.clip((at - origin[axis]) / spacing[axis], 0, cells[axis] - 1))
    plane = speed.take(layer, axis=2 - axis)
    across = [a for a in range(3) if a != axis]
    coarser = max(1, -(-max(plane.shape) // MOST_SIDE))
    return (plane[::coarser, ::coarser], [origin[a] for a in across],
            [cells[a] * spacing[a] for a in across])


def flow(folder, scene, box_of_bodies):
    """Speed in the plane of the field, or across y, through the bodies' first place."""
    try:
        # Of a refined grid the coarse cells, which are everywhere and have the finer ones' means.
        stored = [(t, file) for t, file in runs.frames(folder, "fluid.pvd")
                  if file.suffix in (".vti", ".pvti") and "_level" not in file.name
                  and file.exists()]
    except OSError:
        return None
    plane = scene.get("magnetic_field", {}).get("plane", "xz")
    axis = next(a for a in range(3) if AXES[a] not in plane)
    at = box_of_bodies[axis] if box_of_bodies else scene["fluid"]["box"][axis] / 2
    chosen = [stored[i] for i in spread(len(stored), MOST_SLICES)] if stored else []
    slices = [slice_of(file, axis, at) for _, file in chosen]
    if not slices or any(s is None for s in slices):
        return None
    values = np.array([s[0] for s in slices])
    fastest = float(values.max())
    return {"times": [time for time, _ in chosen], "axis": axis, "at": at,
            "rows": values.shape[1], "columns": values.shape[2], "origin": slices[0][1],
            "size": slices[0][2], "fastest": fastest,
            "values": packed(np.round(255 * values / fastest) if fastest else values, "u1")}


def field_direction(scene):
    """Unit vector of a positive field, where it keeps one direction."""
    field = scene.get("magnetic_field", {})
    law = next((field[key] for key in ("table", "constant", "oscillating") if key in field), {})
    angle = law.get("direction")
    angle = angle[0] if isinstance(angle, list) and len(angle) == 1 else angle
    plane = field.get("plane", "")
    if not isinstance(angle, (int, float)) or len(plane) != 2:
        return None
    vector = [0.0, 0.0, 0.0]
    vector[AXES.index(plane[0])], vector[AXES.index(plane[1])] = np.cos(angle), np.sin(angle)
    return vector


def largest(columns, name):
    values = [abs(v) for v in columns.get(name, [])]
    return max(values) if values else None


def checks(folder, summary):
    """[(what, figure, limit, unit)] of the audits that the run has made; limits are those above
    which the program or its documentation warns (docs/coupling.md, docs/energy_audit.md)."""
    boundary, audit = summary.get("immersed_boundary", {}), summary.get("energy_audit", {})
    found = [("no-slip error", boundary.get("no_slip_error"), 0.05),
             ("leakage", boundary.get("leakage"), 0.05),
             ("energy: residual over work", audit.get("residual"), 0.01),
             ("energy: gained over work", audit.get("gained"), 0.01)]
    try:
        columns = runs.read_columns(folder / "probes.csv")
    except (OSError, ValueError):
        columns = {}
    for what in ("momentum", "power"):
        found.append((f"{what} lost between body and fluid",
                      largest(columns, f"interface.{what}_mismatch[1]"), 1e-12))
    return [{"name": name, "value": value, "limit": limit, "good": value <= limit}
            for name, value, limit in found if value is not None]


def read_run(folder, most_bytes):
    """Raises NotARun."""
    scene = read_json(folder / "scene.json", None)
    starts = read_json(folder / "run.json", [])
    if scene is None or not starts:
        raise NotARun(f"{folder}: found no scene.json and run.json; allowed are folders that "
                      "./magfsi run has written")
    summary = read_json(folder / "summary.json", {})
    found = bodies(folder, most_bytes)
    middle = [(a + b) / 2 for a, b in zip(found["low"], found["high"])] if found else None
    box = scene.get("fluid", {}).get("box")
    low, high = ([0, 0, 0], box) if box else (found["low"], found["high"]) if found else (None,) * 2
    last = starts[-1]
    text = folder / "scene.yaml"
    return {"name": scene.get("name", folder.name), "folder": str(folder),
            "outcome": summary.get("outcome", "not ended"), "cause": summary.get("cause", ""),
            "effects": summary.get("effects", []), "absent": summary.get("absent_effects", []),
            "scene": text.read_text() if text.exists() else "",
            "overrides": last.get("overrides", []), "command": last.get("command", ""),
            "begun": last.get("begun", ""), "machine": last.get("machine", ""),
            "versions": summary.get("versions", last.get("versions", {})),
            "ranks": last.get("ranks", {}), "wall_s": summary.get("wall_s"),
            "steps": summary.get("steps"), "tasks": summary.get("tasks", {}),
            "checks": checks(folder, summary), "box": box,
            "wires": shapes.wires(scene, low, high),
            "field": field_direction(scene), "probes": probes(folder), "bodies": found,
            "flow": flow(folder, scene, middle) if "fluid" in scene else None}
