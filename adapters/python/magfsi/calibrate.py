# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi bench --calibrate: measures this machine by short runs, half a minute in all, and keeps
the seconds and bytes in the user's cache folder; explain predicts from them."""
import datetime
import json
import os
import sys
import tempfile
from pathlib import Path

from magfsi import runs

BEAM = runs.ROOT / "tutorials/beam/scene.yaml"
LARGEST_LOAD = 0.5  # that leaves the cores to these runs
SMALL, LARGE = 24, 72  # cells along a cube: in the caches, and beyond them

# A stream through a periodic cube: nothing but the lattice.
FLUID = """
name: calibration
time: {{end: {end} s, step: 1 s}}
fluid:
  box: [{n} m, {n} m, {n} m]
  spacing: 1 m
  density: 1 kg/m3
  viscosity: 0.05 m2/s
  precision: {precision}
  collision: {collision}
  initial_velocity: [0.01 m/s, 0 m/s, 0 m/s]
  boundaries: {{x_min: {kind}, x_max: {kind}, y_min: {kind}, y_max: {kind},
               z_min: {kind}, z_max: {kind}}}
"""
PROBES = "probes: {{every: {every} s, fluid: [{quantities}]}}\n"
FILES = "output: {{fluid: {{every: {every} s, fields: [velocity]}}}}\n"


def fluid_scene(n, steps, precision="double", probes=0, files=0, quantities="kinetic_energy",
          collision="trt", kind="periodic"):
    text = FLUID.format(n=n, end=steps, precision=precision, collision=collision, kind=kind)
    if probes:
        text += PROBES.format(every=probes, quantities=quantities)
    if files:
        text += FILES.format(every=files)
    return text


def strip_scene(elements, probes):
    """A strip that bends in LAMMPS, without fluid."""
    return f"""
name: calibration
time: {{end: 20 ms, step: 100 us}}
bodies:
  strip:
    mesh: {{box: {{size: [3.7 mm, 1.5 mm, 0.185 mm], elements: {elements}}}}}
    element: assumed_strain
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
    magnetization: {{harmonic: {{amplitude: 62 kA/m, phase: 45 deg}}}}
magnetic_field: {{plane: xz, constant: {{magnitude: 5 mT, direction: 45 deg}}}}
probes: {{every: {probes}, bodies: [com, shape, energy]}}
output: {{structure: {{every: 1 ms}}}}
"""


def coupled_scene(n, steps):
    """The same in the middle of a closed cube of n cells a side, 24 and more."""
    side = 0.2 * n
    return f"""
name: calibration
time: {{end: {20 * steps} us, step: 20 us}}
bodies:
  strip:
    mesh: {{box: {{size: [3.7 mm, 1.5 mm, 0.185 mm], elements: [10, 4, 1]}}}}
    element: assumed_strain
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
    magnetization: {{harmonic: {{amplitude: 62 kA/m, phase: 45 deg}}}}
    initial: {{position: [{side / 2} mm, {side / 2} mm, {side / 2} mm]}}
magnetic_field: {{plane: xz, constant: {{magnitude: 5 mT, direction: 45 deg}}}}
fluid:
  box: [{side} mm, {side} mm, {side} mm]
  spacing: 0.2 mm
  density: 1000 kg/m3
  viscosity: 1 mm2/s
  expected_speed: 0.5 m/s
  collision: recursive_regularized
coupling: {{}}
"""


class Bench:
    """Runs scenes in a temporary folder; each is a dictionary, its summary.json."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def run(self, scene, ranks, sets=None):
        if not isinstance(scene, Path):
            file = self.folder / "scene.yaml"
            file.write_text(scene)
            scene = file
        done = runs.run(scene, self.folder / "run", sets, ranks, more=["--overwrite"])
        if done.code != 0:
            sys.exit(f"magfsi bench --calibrate: {done.error()}")
        return done.summary()


def memory(summary, role):
    return summary["memory_bytes"][role]


def busy_s(summary, role, task):
    """Of a task, without what it waited for the partner."""
    return summary["tasks"][role].get(task, 0) - summary["waiting"][role].get(task, 0)


def fluid(bench, cores):
    """Speeds of a fluid alone, and its memory."""
    speeds, found = [], {}
    for n, steps in ((SMALL, 3000), (LARGE, 100)):
        for ranks in sorted({1, cores}):
            for precision in ("double", "float"):
                s = bench.run(fluid_scene(n, steps, precision), f"fluid={ranks}")
                speeds.append({"cells": n**3, "ranks": ranks,
                               "single_precision": precision == "float",
                               "s_per_cell_step": s["tasks"]["fluid"]["advance fluid"]
                               / steps / n**3})
                if ranks == 1 and precision == "double":
                    found[n] = s
    cells = LARGE**3 - SMALL**3
    per_cell = (memory(found[LARGE], "fluid") - memory(found[SMALL], "fluid")) / cells
    regularized = bench.run(fluid_scene(LARGE, 100, collision="recursive_regularized"),
                            "fluid=1")
    walled = bench.run(fluid_scene(LARGE, 100, kind="no_slip"), "fluid=1")
    probed = bench.run(fluid_scene(LARGE, 40, probes=2), "fluid=1")
    curled = bench.run(fluid_scene(LARGE, 40, probes=2, quantities="enstrophy"), "fluid=1")
    written = bench.run(fluid_scene(LARGE, 40, files=10), "fluid=1")

    def besides_s(s):
        return max(0, s["tasks"]["fluid"]["advance fluid"]
                   - found[LARGE]["tasks"]["fluid"]["advance fluid"]) / 100

    return {
        "fluid": speeds,
        "s_per_cell_regularized": besides_s(regularized) / LARGE**3,
        "s_per_wall_cell": besides_s(walled) / (6 * LARGE**2),
        "bytes_per_cell": per_cell,
        "fluid_bytes": memory(found[SMALL], "fluid") - SMALL**3 * per_cell,
        "bytes_per_cell_file": max(0, memory(written, "fluid") - memory(found[LARGE], "fluid"))
        / LARGE**3,
        "bytes_per_cell_curl": max(0, memory(curled, "fluid") - memory(found[LARGE], "fluid"))
        / LARGE**3,
        "s_per_cell_row": probed["tasks"]["fluid"]["probes"] / 20 / LARGE**3,
        "s_per_cell_enstrophy": curled["tasks"]["fluid"]["probes"] / 20 / LARGE**3,
        "s_per_cell_byte": written["tasks"]["fluid"]["write fields"] / 4 / LARGE**3 / 12,
    }


def structure(bench, file_bytes, cores):
    """Of a strip in LAMMPS: a line through two meshes, and what more ranks exchange."""
    coarse = bench.run(strip_scene("[10, 4, 1]", "0.2 ms"), "structure=1")
    fine = bench.run(strip_scene("[40, 16, 1]", "1 ms"), "structure=1")
    seconds, elements = [], []
    for s in (coarse, fine):
        seconds.append(s["tasks"]["structure"]["advance structure"] / s["substeps"])
        elements.append(s["structure"]["elements"])
    slope = max(0, (seconds[1] - seconds[0]) / (elements[1] - elements[0]))
    level = max(0, seconds[0] - slope * elements[0])
    shared = level
    if cores > 1:
        s = bench.run(strip_scene("[10, 4, 1]", "0.2 ms"), f"structure={cores}")
        shared = (s["tasks"]["structure"]["advance structure"] / s["substeps"]
                  - slope * elements[0] / cores)
    grown = memory(fine, "structure") - memory(coarse, "structure")
    per_element = max(0, grown / (elements[1] - elements[0]))
    return {
        "s_per_element_substep": slope,
        "s_per_substep": level,
        "s_per_substep_exchange": max(0, shared - level),
        "s_per_probe_row": coarse["tasks"]["structure"]["probes"] / 100,
        "s_per_element_file": fine["tasks"]["structure"]["write fields"] / 20 / elements[1],
        "bytes_per_element": per_element,
        "lammps_bytes": memory(coarse, "structure") - per_element * elements[0] - file_bytes,
    }


def newton(bench):
    """Of a beam that bends without instability, 20 loads; files of fields cost memory."""
    speeds, sets = [], {"probes.every": "50 ms", "output": "null"}
    for elements, nodes in (("[12, 4, 1]", 13 * 5 * 2), ("[36, 10, 1]", 37 * 11 * 2)):
        s = bench.run(BEAM, "structure=1",
                      {"bodies.beam.mesh.box.elements": elements, **sets})
        speeds.append({"nodes": nodes, "s_per_point": s["tasks"]["structure"]
                       ["find equilibrium"] / s["steps"]})
        if len(speeds) == 1:
            lean = s
    rich = bench.run(BEAM, "structure=1", {"bodies.beam.mesh.box.elements": "[12, 4, 1]",
                                           "probes.every": "50 ms"})
    return {"newton": speeds, "newton_bytes": memory(lean, "structure"),
            "newton_bytes_per_element": max(0, memory(s, "structure")
                                            - memory(lean, "structure")) / (360 - 48),
            "structure_file_bytes": max(0, memory(rich, "structure")
                                        - memory(lean, "structure"))}


def coupled(bench, known, cores):
    """What two sides add: markers, messages, and what waiting for each other costs."""
    runs = {(n, ranks): bench.run(coupled_scene(n, steps), f"structure=1,fluid={ranks}")
            for n, steps in ((SMALL, 600), (LARGE, 200)) for ranks in sorted({1, cores})}
    s, shared = runs[SMALL, 1], runs[SMALL, cores]
    markers, elements = s["immersed_boundary"]["markers"], s["structure"]["elements"]
    substep = s["tasks"]["structure"]["advance structure"] / s["substeps"]
    alone = known["s_per_substep"] + known["s_per_element_substep"] * elements
    spread = sum(busy_s(s, "fluid", task) for task in ("spread impulses", "sample velocities"))
    cells_bytes = SMALL**3 * known["bytes_per_cell"]
    found = {
        "s_per_marker_substep": max(0, substep - alone) / markers,
        "s_per_marker_step": spread / s["steps"] / markers,
        "bytes_per_marker": max(0, memory(s, "structure") - known["lammps_bytes"]
                                - elements * known["bytes_per_element"]) / markers,
        "coupled_fluid_bytes": (memory(shared, "fluid") - cells_bytes) / cores,
    }
    for ranks, name in ((1, ""), (cores, "_shared")):
        small, large = (rest_s(runs[n, ranks], n, ranks, known, substep) - markers
                        * found["s_per_marker_step"] for n in (SMALL, LARGE))
        slope = max(0, large - small) / (LARGE**3 - SMALL**3)
        found[f"s_per_coupled_cell{name}"] = slope
        found[f"s_per_coupled_step{name}"] = max(0, small - slope * SMALL**3)
    return found


def rest_s(s, n, ranks, known, substep):
    """Of a step on a cube in closed walls, what the prices of both sides alone leave."""
    [cell] = [speed["s_per_cell_step"] for speed in known["fluid"]
              if speed["cells"] == n**3 and speed["ranks"] == ranks
              and not speed["single_precision"]]
    besides = n**3 * known["s_per_cell_regularized"] + 6 * n**2 * known["s_per_wall_cell"]
    return (s["wall_s"] - s["substeps"] * substep) / s["steps"] - n**3 * cell - besides / ranks


def main():
    facts = runs.explain(BEAM, as_json=True)
    cores, load = len(os.sched_getaffinity(0)), os.getloadavg()[0]
    if load > LARGEST_LOAD:
        print(f"the machine has other work (load {load:.1f}): prices will be too high; repeat this "
              "when it is idle", file=sys.stderr)
    found = {"machine": facts["machine"], "version": facts["version"],
             "date": datetime.date.today().isoformat()}
    with tempfile.TemporaryDirectory(prefix="magfsi-calibrate-") as folder:
        bench = Bench(folder)
        found.update(fluid(bench, min(cores, 8)))
        found.update(newton(bench))
        found.update(structure(bench, found["structure_file_bytes"], min(cores, 8)))
        found.update(coupled(bench, found, min(cores, 8)))
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "magfsi"
    cache.mkdir(parents=True, exist_ok=True)
    part = cache / "calibration.json.part"
    part.write_text(json.dumps(found, indent=2) + "\n")
    part.replace(cache / "calibration.json")
    print(f"{found['machine']}: {cache / 'calibration.json'}")


if __name__ == "__main__":
    main()
