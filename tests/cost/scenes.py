# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes whose cost is asked for, each in a folder of its own, and the command."""
import csv
import json
import sys
import time
from pathlib import Path

from magfsi import runs, testing
from magfsi.cost.__main__ import REFUSALS

FEM = runs.ROOT / "tests/validation/structure/beam_LH17.5.csv"
BEAM = """
name: beam
time: {end: 0.25 s, equilibrium: {method: newton}}
bodies:
  beam:
    mesh: {box: {size: [17.5 mm, 5 mm, 1 mm], elements: [12, 4, 1]}}
    material: {shear_modulus: 330 kPa, lame_lambda: 6.6 MPa, density: 1860 kg/m3}
    magnetization: {uniform: [100 kA/m, 0 A/m, 0 A/m]}
    clamps: [x_min]
magnetic_field:
  plane: xz
  table: {time: [0 s, 1 s], magnitude: [0 mT, 132 mT], direction: 90 deg}
probes:
  every: 50 ms
  points: {tip: {body: beam, at: [17.5 mm, 2.5 mm, 0.5 mm]}}
"""


class Scene:
    def __init__(self, text):
        self.folder = Path(testing.new_folder())
        self.file = self.folder / "scene.yaml"
        self.file.write_text(text)
        self.out = self.folder / "out"

    def command(self, *more):
        return [sys.executable, "-m", "magfsi.cost", self.file, "--out", self.out, *more]

    def cost(self, *more, limit_s=300):
        return testing.finish(testing.start(self.command(*more)), time.monotonic(), self.out,
                              limit_s)

    def called(self, *more):
        """magfsi cost in this process."""
        return testing.called("magfsi.cost", REFUSALS, *self.command(*more)[3:])

    def good_cost(self, *more):
        done = self.cost(*more)
        if done.code != 0:
            raise AssertionError(f"exit code {done.code}\n{done.out}\n{done.err}")
        testing.report(done.out[done.out.find("Probes"):])
        return done

    def run(self, *more, limit_s=300):
        """magfsi run, in this folder: its default run folders are there."""
        words = [testing.BIN / "magfsi", "run", self.file, *more]
        process = testing.subprocess.Popen(
            [str(w) for w in words], stdout=-1, stderr=-1, text=True, cwd=self.folder,
            start_new_session=True)
        return testing.finish(process, time.monotonic(), self.folder, limit_s)

    def probe(self, column):
        with open(self.out / "cost.csv", newline="") as file:
            row = next(r for r in csv.DictReader(file) if r["probe"] == column)
        return {key: float(word) if key not in ("probe", "norm", "doubt") else word
                for key, word in row.items()}

    def records(self):
        """When each run that is done was done, by its folder."""
        return {path.parent.name: path.stat().st_mtime_ns
                for path in self.out.glob("runs/*/study.json")}

    def summary(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())


def beam_tip_m(gamma):
    """By 3D finite elements."""
    row = next(r for r in runs.read_rows(FEM) if float(r["gamma"]) == gamma)
    return float(row["uz_tip/L"]) * 0.0175
