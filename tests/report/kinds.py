# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of every kind that a page shows, for its tests and for tests/bench/report."""
from pathlib import Path

import numpy as np
from magfsi import runs, testing
from magfsi.report.__main__ import write

FIELDS = {"time.end": "2 ms", "output.structure.every": "0.5 ms",
          "output.fluid": "{every: 1 ms, fields: [velocity, pressure]}"}
SECOND = ("{mesh: {box: {size: [1 mm, 1 mm, 0.2 mm], elements: [4, 4, 1]}}, element: assumed_strain, "
          "material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}, "
          "initial: {position: [2 mm, 2 mm, 6 mm]}}")
# As many frames as a second of play should have, and how long they took.
PLAY = """new Promise(done => {
  document.getElementById("play").click();
  let count = 0; const began = performance.now();
  (function next() {
    if (++count < %d) return requestAnimationFrame(next);
    document.getElementById("play").click();
    done((performance.now() - began) / 1e3);
  })();
})"""


def page(*folders, out=None):
    """Writes the page of these runs and returns where it is."""
    out = Path(out or Path(folders[0]) / "report.html")
    write([Path(folder) for folder in folders], out)
    return out


def swimmer():
    return testing.shared_run(testing.SMALL, FIELDS)


def two_robots():
    return testing.good_run(testing.SMALL, {**FIELDS, "bodies.second": SECOND})


def structure_alone():
    return testing.good_run(testing.ROOT / "tutorials/beam",
                            {"time.end": "200 ms", "output.structure.every": "50 ms",
                             "bodies.beam.mesh.box.elements": "[9, 2, 1]"})


def without_fields():
    return testing.good_run(testing.SMALL, {"time.end": "1 ms", "fluid": "",
                                            "probes": "{every: 0.1 ms, bodies: [com]}"})


def diverged():
    run = testing.run(testing.SMALL, {**FIELDS, "magnetic_field.constant.magnitude": "9 T"})
    assert run.code == 3, run.err
    return run


def long_course(run):
    """A run folder with 100,000 rows of 30 columns and 1,000 frames of bodies and flow: what is there of a long
    run."""
    folder = Path(testing.new_folder())
    t = np.linspace(0, 1, 100000)
    names = ["t[s]"] + [f"robot.q{i}[m]" for i in range(30)]
    columns = [t] + [np.sin((i + 1) * 6 * t) for i in range(30)]
    np.savetxt(folder / "probes.csv", np.array(columns).T, delimiter=",", header=",".join(names),
               comments="", fmt="%.9g")
    for file in ("scene.json", "run.json", "summary.json", "scene.yaml"):
        (folder / file).write_bytes((run.folder / file).read_bytes())
    for collection in ("structure.pvd", "fluid.pvd"):
        stored = [file for _, file in runs.frames(run.folder, collection)]
        entries = "".join(f'<DataSet timestep="{i / 999}" part="0" file="{stored[(i - 1000) % len(stored)]}"/>'
                          for i in range(1000))  # the last is the run's last
        (folder / collection).write_text(f"<VTKFile><Collection>{entries}</Collection></VTKFile>")
    return folder


# Run folders of each.
KINDS = {"small swimmer": lambda: swimmer().folder, "structure alone": lambda: structure_alone().folder,
         "without fields": lambda: without_fields().folder, "two robots": lambda: two_robots().folder,
         "diverged": lambda: diverged().folder,
         "100,000 rows, 1,000 frames": lambda: long_course(swimmer())}
