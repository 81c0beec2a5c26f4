# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi witness: its plane flow around a strip is that of a case written by hand, its forces and power are
those of each other and of an inviscid fluid, and what it cannot follow it says.

    witness.py --whole      the meshes of the claim, over the time of the case written by hand
    witness.py --short      two cells in place of three, and half of the time"""
import csv
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

from magfsi import runs, testing
from magfsi.witness import compare, foam

HERE = Path(__file__).parent
STRIP = HERE / "strip.yaml"
WHOLE, SHORT = "--whole" in sys.argv, "--short" in sys.argv
MOTION = "bodies.plate.prescribed_motion"
FACES = "face: [z_min, z_max]"


def witness(folder, *words):
    """(exit code, what it says)."""
    done = subprocess.run([sys.executable, "-P", "-m", "magfsi.witness", str(folder), *words],
                          capture_output=True, text=True, timeout=3000)
    return done.returncode, done.stdout + done.stderr


def good(folder, *words):
    """(series by name, what it says)."""
    code, text = witness(folder, *words)
    if code != 0:
        raise AssertionError(text)
    table = runs.read_table(Path(folder) / "witness/series.csv", float)
    return {name: np.array(values) for name, values in table.items()}, text


def rows(folder):
    with open(Path(folder) / "witness/witness.csv", newline="") as file:
        return {row["quantity"]: row for row in csv.DictReader(line for line in file if line[0] != "#")}


class Heaving(unittest.TestCase):
    """Against a case written by hand, with finer cells (9 in the thickness)."""

    def test_force_is_that_of_a_case_written_by_hand(self):
        end, cells, bound = (("60 ms", "6,9", 0.03) if WHOLE else ("6 ms", "2", 0.04) if SHORT
                             else ("12 ms", "3", 0.04))
        run = testing.good_run(STRIP, {"time.end": end})
        found, text = good(run.folder, "--cells", cells)
        reference = runs.read_table(HERE / "heaving_plate.csv", float)
        t = np.array(reference["t[s]"])
        # Means of 0.5 ms at both: the first and the last 1.5 ms would be means of one side.
        kept = (t > 2e-3) & (t < found["t[s]"][-1] - 1.5e-3)
        force = np.interp(t[kept], found["t[s]"], found["witness.force_z[N/m]"])
        expected = np.array(reference["force_across[N/m]"])[kept]
        apart = compare.rms(force - expected) / compare.rms(expected)
        testing.report(f"force beside the case written by hand: {100 * apart:.2f} % rms; {text.splitlines()[-2]}")
        # Whole: the meshes of the case by hand differ by 1.2 %, and where cells lie differs. Small: a third of
        # the cells, at first order three times as far off.
        self.assertLess(apart, bound)
        # Across: nothing moves it there.
        along = np.abs(found["witness.force_x[N/m]"]).max()
        self.assertLess(along, 0.01 * np.abs(expected).max())
        if WHOLE:
            work = float(rows(run.folder)["work on the fluid"]["witness"])
            bar = float(rows(run.folder)["work on the fluid"]["witness_bar"])
            testing.report(f"work of the last period {1e6 * work:.2f} +- {1e6 * bar:.2f} uJ/m")
            # Its own error is 1 %, and so is that of the case by hand.
            self.assertLess(abs(work / 154.1e-6 - 1), 0.02)
            # Twice what meshes of 6 and 9 cells are apart in the course of the work.
            self.assertLess(bar, 0.05 * work)


    def test_a_strip_that_starts_tilted_heaves_alike(self):
        # By 30 degrees, and across itself: the box, four lengths wide, hardly tells.
        up = 0.5 * np.array([-0.5, np.sqrt(0.75)])  # of 0.5 mm
        run = testing.good_run(STRIP, {
            "time.end": "12 ms", "bodies.plate.initial.rotation": "{plane: xz, angle: 30 deg}",
            f"{MOTION}.0.oscillation.amplitude": f"[{up[0]} mm, 0 mm, {up[1]} mm]"})
        found, text = good(run.folder, "--cells", "3")
        self.assertIn("takes the shape of the start", text)
        reference = runs.read_table(HERE / "heaving_plate.csv", float)
        t = np.array(reference["t[s]"])
        kept = (t > 2e-3) & (t < 10.5e-3)
        force = 2 * (up[0] * found["witness.force_x[N/m]"] + up[1] * found["witness.force_z[N/m]"])
        expected = np.array(reference["force_across[N/m]"])[kept]
        apart = compare.rms(np.interp(t[kept], found["t[s]"], force) - expected) / compare.rms(expected)
        testing.report(f"tilted, force across: {100 * apart:.2f} % rms")
        self.assertLess(apart, 0.04)


class Turning(unittest.TestCase):
    """A strip that turns about its middle by 2 (1 - cos) degrees at 250 Hz: small against its length, and fast
    against the friction (a Stokes layer of 36 um)."""

    RATE = 2 * np.pi * 250
    ANGLE = np.radians(2)

    @classmethod
    def setUpClass(cls):
        cls.beside = testing.good_run(STRIP, {
            "time.end": "6 ms", "output.structure.every": "0.1 ms", "fluid.expected_speed": "1 m/s",
            MOTION: f"[{{{FACES}, turning: {{axis: [0, -1, 0], about: [8 mm, 0.33333333333333 mm, 8 mm], "
                    "oscillation: {amplitude: 2 deg, frequency: 250 Hz, phase: -90 deg}}}]"})
        cls.found, cls.text = good(cls.beside.folder, "--cells", "3")

    def inertia(self, moment):
        """The part of a moment that goes with the acceleration, over the last whole period."""
        t = self.found["t[s]"]
        kept = t > t[-1] - 2 * np.pi / self.RATE
        gain = self.ANGLE * self.RATE**2 * np.cos(self.RATE * t[kept])
        return -(moment[kept] * gain).sum() / (gain * gain).sum()

    def test_moment_is_that_of_added_inertia(self):
        # From x to z is about -y. A thin plate in an unbounded inviscid fluid: pi rho L^4 / 128 (Newman, Marine
        # Hydrodynamics, 4.14).
        plate = np.pi * 1000 * 3.7e-3**4 / 128
        share = self.inertia(self.found["witness.moment[N m/m]"]) / plate
        testing.report(f"moment of added inertia over that of a thin plate: {share:.3f}")
        # More by the thickness (a tenth of the width gives 1.18: 0.147 in place of 0.125 in Newman's table), the walls and
        # the Stokes layer, by a few per cent each; less by the Gaussian mean, 1 - exp(-(2 pi / 80)^2 / 2) = 0.3 %.
        self.assertGreater(share, 1.0)
        self.assertLess(share, 1.25)

    def test_power_is_moment_times_rate(self):
        t = self.found["t[s]"]
        rate = self.ANGLE * self.RATE * np.sin(self.RATE * t)
        # The faces' traction times their velocity, against the moment that OpenFOAM sums. Both are means over 50 us,
        # of a product and of a factor, 1.5 % apart at twice the frequency.
        expected = -self.found["witness.moment[N m/m]"] * rate
        kept = (t > 1e-3) & (t < t[-1] - 2e-4)
        apart = compare.rms((self.found["witness.power[W/m]"] - expected)[kept]) / compare.rms(expected[kept])
        testing.report(f"power against moment times rate: {100 * apart:.2f} %")
        self.assertLess(apart, 0.03)

    def test_run_beside_it_has_the_same_sign(self):
        # A coarse grid: half a cell in the thickness. Its moment is that of the witness within a half.
        share = self.inertia(self.found["run.moment[N m/m]"]) / self.inertia(self.found["witness.moment[N m/m]"])
        testing.report(f"moment of added inertia, run over witness: {share:.3f}")
        self.assertGreater(share, 0.5)
        self.assertLess(share, 1.5)

    def test_a_mesh_alone_has_no_bar(self):
        self.assertIn("no bars to judge by", self.text)
        self.assertEqual(rows(self.beside.folder)["work on the fluid"]["witness_bar"], "")


class Bending(unittest.TestCase):
    def test_a_soft_strip_shaken_at_one_end(self):
        run = testing.good_run(STRIP, {
            "time.end": "15 ms", "probes.energy_audit": "true",
            "bodies.plate.material": "{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}",
            "bodies.plate.rollers": "[{face: [y_min, y_max], axis: y}]",
            f"{MOTION}.0.face": "[x_min]"})
        found, text = good(run.folder, "--cells", "2")
        # Nearly incompressible: of its thickness of 185 um it keeps all but 1e-4.
        held = float(text.split("moving the surface by up to ")[1].split()[0])
        self.assertLess(held, 0.02)
        share = found["run.work[J/m]"][-1] / found["witness.work[J/m]"][-1]
        testing.report(f"bending: area held within {held:.2g} um, work of the run over the witness's {share:.3f}")
        # The run's grid has half a cell in the thickness: up to 30 % off in strokes of this length.
        self.assertGreater(share, 0.6)
        self.assertLess(share, 1.4)


class Following(unittest.TestCase):
    def test_a_stroke_that_no_mesh_follows_is_followed_in_part(self):
        run = testing.good_run(STRIP, {
            "time.end": "20 ms", "fluid.expected_speed": "1 m/s",
            MOTION: f"[{{{FACES}, turning: {{axis: [0, 1, 0], about: [8 mm, 0.33333333333333 mm, 8 mm], "
                    "angle: 170 deg*(1 - cos(2*pi*25 Hz*t))/2}}]"})
        found, text = good(run.folder, "--cells", "2")
        self.assertRegex(text, r"the mesh could follow to [0-9.]+ ms, [0-9]+% of the motion, and no further")
        testing.report(next(line for line in text.splitlines() if "could follow" in line))
        self.assertLess(found["t[s]"][-1], 0.95 * 20e-3)
        self.assertGreater(found["t[s]"][-1], 0.2 * 20e-3)

    def test_faults_of_meshes_are_read(self):
        good_mesh = "Time = 0.1\n Mesh non-orthogonality Max: 30.5 average: 5\n Max skewness = 0.5 OK.\n"
        steep = good_mesh.replace("0.1", "0.2").replace("30.5", "76")
        inverted = "Time = 0.2\n ***Zero or negative cell volume detected.\n"
        flat = good_mesh.replace("0.1", "0.2") + " ***High aspect ratio cells found, Max aspect ratio: 2000\n"
        self.assertEqual(foam.followed(good_mesh), (0.1, None))
        self.assertEqual(foam.followed(good_mesh + steep)[0], 0.1)
        self.assertIn("76 degrees", foam.followed(good_mesh + steep)[1])
        self.assertIn("negative cell volume", foam.followed(good_mesh + inverted)[1])
        self.assertEqual(foam.followed(good_mesh + flat), (0.2, None))


if __name__ == "__main__":
    sys.argv = [word for word in sys.argv if word not in ("--whole", "--short")]
    unittest.main()
