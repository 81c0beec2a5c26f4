# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi fit-material: Treloar's rubber and VHB by their measured curves, constants found again from
computed curves, and what is refused."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np

from magfsi import fit_material, rubber, testing

DATA = testing.ROOT / "docs/experiments"


def fitted(*words):
    """What the command prints, and the YAML that it writes."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "material.yaml"
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            fit_material.main([*map(str, words), "--out", str(out)])
        assert out.with_suffix(".png").stat().st_size > 1000
        return printed.getvalue(), out.read_text()


def table(folder, name, columns):
    file = Path(folder) / name
    rows = zip(*columns.values())
    file.write_text(",".join(columns) + "\n" + "".join(",".join(f"{v:.9g}" for v in row) + "\n"
                                                      for row in rows))
    return file


class Fits(unittest.TestCase):
    def test_treloars_rubber(self):
        curves = [fit_material.read_curve(str(DATA / "treloar_uniaxial.csv"))]
        for kind, most in (("gent", 0.04), ("yeoh", 0.04), ("arruda_boyce", 0.06)):
            found = fit_material.fit(curves, kind, 0)
            testing.report(f"{kind}: {100 * found.worst():.2f} % of the largest stress, {found.law.values}")
            self.assertLess(found.worst(), most)

    def test_constants_are_found_again(self):
        law = rubber.Law("gent", {"shear_modulus": 40e3, "limit": 30.0})
        branches = [(20e3, 0.5), (10e3, 20.0)]
        with tempfile.TemporaryDirectory() as folder:
            a = np.linspace(1, 4.5, 40)
            slow = table(folder, "slow.csv", {
                "stretch": a, "stress[kPa]": rubber.relaxed_stress(law, "uniaxial", a) / 1e3})
            t = np.concatenate([[0, 0.01], np.geomspace(0.02, 100, 60)])
            held = np.where(t > 0, 1.5, 1.0)
            relaxing = table(folder, "relaxing.csv", {
                "time[s]": t, "stretch": held,
                "stress[kPa]": rubber.stress_over_time(law, branches, "uniaxial", t, held) / 1e3})
            curves = [fit_material.read_curve(str(f)) for f in (slow, relaxing)]
            found = fit_material.fit(curves, "gent", 2)
        testing.report(f"{found.law.values}, {found.branches}, {found.errors}")
        self.assertAlmostEqual(found.law.values["shear_modulus"] / 40e3, 1, delta=0.01)
        self.assertAlmostEqual(found.law.values["limit"] / 30, 1, delta=0.01)
        # Of steps of the file within which C^-1 does not change evenly.
        for (modulus, time), (right, its) in zip(found.branches, branches):
            self.assertAlmostEqual(modulus / right, 1, delta=0.03)
            self.assertAlmostEqual(time / its, 1, delta=0.05)

    def test_vhb_by_one_set(self):
        loops = [f"{DATA}/vhb4910_hossain_stretch2.5_rate{r}.csv:rate={r}" for r in ("0.01", "0.03", "0.05")]
        printed, text = fitted(f"{DATA}/vhb4910_wang_equilibrium.csv", *loops, "--law", "gent", "--branches", "3")
        testing.report(printed)
        self.assertIn("maxwell:", text)
        errors = [float(line.split(":")[1].split("%")[0]) for line in printed.splitlines()
                  if line.startswith("  vhb")]
        self.assertEqual(len(errors), 4)
        self.assertLess(max(errors), 10)


class Refuses(unittest.TestCase):
    def refused(self, words, part):
        with self.assertRaises(SystemExit) as caught, contextlib.redirect_stderr(io.StringIO()):
            fit_material.main(words)
        self.assertIn(part, str(caught.exception.code))

    def test_what_it_cannot_read(self):
        treloar = str(DATA / "treloar_uniaxial.csv")
        self.refused(["nothing.csv"], "no such file")
        self.refused([treloar + ":mode=sideways"], "found the mode")
        self.refused([treloar + ":speed=1"], "allowed are mode")
        self.refused([treloar + ":rate=fast"], "a number above 0")
        self.refused([treloar, "--branches", "2"], "no curve has times")
        with tempfile.TemporaryDirectory() as folder:
            file = table(folder, "bad.csv", {"stretch": [1, 2, 3], "stress[furlong]": [0, 1, 2]})
            self.refused([str(file)], "found the unit")


if __name__ == "__main__":
    unittest.main(verbosity=2)
