# SPDX-License-Identifier: GPL-2.0-or-later
"""What a design leaves: the magnetisation, a scene with it that runs, shapes, figures in numbers."""
import csv
import io
import json
import os

import numpy as np
import yaml

from magfsi.optimize.result import _move_files
from magfsi.study import store

# Of the scene: what has to do with the body and its loads.
KEPT = ("name", "bodies", "magnetic_field", "gravity", "platform", "contact", "damping")
RISE_S = 1.0  # of the scene that is written: the field of a pose rises, stays and goes, each within


def _csv(columns):
    """Text of a CSV file of {name: values}."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values()):
        writer.writerow([f"{value:.9g}" for value in row])
    return text.getvalue()


def magnetization_text(program, vectors):
    names = [f"{a}[m]" for a in "xyz"] + [f"M{a}[A/m]" for a in "xyz"]
    return _csv(dict(zip(names, np.column_stack([program.centres, vectors]).T)))


def shape_text(term, x):
    columns = {f"{a}[m]": values for a, values in zip("xyz", term.places(x).T)}
    columns |= {f"wanted_{a}[m]": values for a, values in zip("xyz", term.goal.T)}
    return _csv(columns)


def scene_tree(problem, designs, folder):
    """The scene with the design: each pose's field rises, stays for a moment and goes."""
    wanted = problem.wanted
    scene = store.scene_file(wanted.scene)
    tree = yaml.safe_load(scene.read_text())
    for key, text in wanted.sets.items():
        *above, last = key.split(".")
        node = tree
        for word in above:
            node = node.setdefault(word, {}) if not isinstance(node.get(word), dict) else node[word]
        if text == "":
            node.pop(last, None)
        else:
            node[last] = yaml.safe_load(text)
    _move_files(tree, scene.parent, folder)
    name = problem.program.facts["body"]
    out = {key: tree[key] for key in KEPT if tree.get(key) is not None}
    out["name"] = wanted.name
    out["bodies"] = {name: {**tree["bodies"][name], "magnetization":
                            {"table": {"file": "magnetization.csv"}}}}
    if len(designs[0].stiffness):
        _stiffen(out["bodies"][name], problem, designs[0].stiffness)
    if len(designs[0].thickness):  # the mesh is then in a file, with its regions
        out["bodies"][name]["mesh"] = {"gmsh": {"file": "mesh.msh", "unit": "1 m"}}
        out["bodies"][name].pop("regions", None)
    course = [f"[{', '.join(f'{b:.9g} T' for b in row)}]"
              for field in (d.field for d in designs) for row in (np.zeros(3), field, field)]
    kept = {key: value for key, value in (tree.get("magnetic_field") or {}).items()
            if key in ("plane", "gradient", "sources")}
    times = [f"{RISE_S * i:g} s" for i in range(len(course))]
    out["magnetic_field"] = {**kept, "vector_table": {
        "time": times, "vector": [yaml.safe_load(row) for row in course]}}
    end_s = RISE_S * (len(course) - 1)
    out["time"] = {"end": f"{end_s:g} s", "equilibrium": {"method": "newton"}}
    every = f"{RISE_S / 20:g} s"  # the points of the path
    out["probes"] = {"every": every, "bodies": ["com"]}
    out["output"] = {"structure": {"every": every}}
    return out


def _stiffen(body, problem, factors):
    """Each region gets the body's material with its factor."""
    from magfsi.units import parse

    def times(material, factor):
        return {key: f"{parse(str(value))[0] * factor:.9g} Pa"
                if key in ("shear_modulus", "lame_lambda") else value
                for key, value in material.items()}

    of_region = {}
    for entry in body.get("material_regions", []):
        named = entry["region"] if isinstance(entry["region"], list) else [entry["region"]]
        of_region |= {name: {k: v for k, v in entry.items() if k != "region"} for name in named}
    body["material_regions"] = [
        {"region": name, **times({**body["material"], **of_region.get(name, {})}, factor)}
        for name, factor in zip(problem.program.facts["regions"], factors)]


def scene_text(problem, designs, folder):
    tree = scene_tree(problem, designs, folder)
    said = "".join(f"#   {pose.name}: {(3 * i + 2) * RISE_S:g} s\n"
                   for i, pose in enumerate(problem.wanted.poses))
    return (f"# A design of {problem.wanted.file.name}; its poses are there at\n{said}"
            + yaml.safe_dump(tree, sort_keys=False, allow_unicode=True, default_flow_style=None,
                             width=100))


def history_text(search):
    return _csv({"step": range(1, len(search.history) + 1),
                 "share": [s.share for s in search.history],
                 "rms": [s.rms for s in search.history],
                 "damping": [s.damping for s in search.history],
                 "trials": [s.trials for s in search.history],
                 "lost": [s.lost for s in search.history],
                 "seconds[s]": [s.seconds for s in search.history]})


def summary(problem, search, state, more):
    """Figures for programs and for the page."""
    designs = search.unknowns.designs(state.p)
    poses = {}
    for pose, error, design in zip(problem.wanted.poses, search.errors(state), designs):
        poses[pose.name] = {"error": error, "field_t": list(map(float, design.field))}
    return {"name": problem.wanted.name, "tolerance": problem.wanted.tolerance, "poses": poses,
            "steps": len(search.history), "unknowns": search.unknowns.size,
            "stiffness": list(map(float, designs[0].stiffness)), **more}


def write_all(folder, texts):
    """{name: text or bytes}, each file whole or not at all."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in texts.items():
        beside = folder / f".{name}.{os.getpid()}.tmp"
        if isinstance(content, bytes):
            beside.write_bytes(content)
        else:
            beside.write_text(content)
        os.replace(beside, folder / name)


def as_json(facts):
    return json.dumps(facts, indent=2) + "\n"
