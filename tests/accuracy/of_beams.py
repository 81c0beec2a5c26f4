#!/usr/bin/python3
"""The error that accuracy promises holds for beams that the study did not contain: shorter, more
slender, narrower, in weaker fields, of a softer and more compressible material."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

MOST = 4 / 3  # of the promise: what docs/accuracy says of it
BEAM = magfsi.ROOT / "tutorials/beam"
CASES = [  # length, width [mm], strongest field [mT] (132: gamma 0.04), error
    ("short", 12, 4, 66, "5 %"),
    ("slender", 25, 5, 132, "3 %"),
    ("slender, weak", 30, 4, 20, "4 %"),
    ("narrow", 17.5, 2, 132, "2 %"),
    ("soft", 17.5, 4, 30, "3 %"),
]
# A third of the tutorial's stiffness, and Lame's lambda 5 G in place of 20 G: gamma 0.03.
MATERIALS = {"soft": {"shear_modulus": "100 kPa", "lame_lambda": "500 kPa"}}


def settings(name, length, width, field):
    material = {f"bodies.beam.material.{key}": value
                for key, value in MATERIALS.get(name, {}).items()}
    return material | {"bodies.beam.mesh.box.size": f"[{length} mm, {width} mm, 1 mm]",
            "probes.points.tip.at": f"[{length} mm, {width / 2} mm, 0.5 mm]",
            "magnetic_field.table.magnitude": f"[0 mT, {field} mT]",
            "probes.every": "250 ms", "output": "null"}


def tip(run):
    return run.probes()["tip_uz[m]"][1:]


class Beams(unittest.TestCase):
    def test_promise(self):
        for name, length, width, field, error in CASES:
            with self.subTest(name):
                case = settings(name, length, width, field)
                # Elements of half the thickness: 2 L / H along, a fourth of the least error.
                fine = [2 * length, max(1, round(2 * width)), 1]
                wanted = tip(magfsi.good_run(BEAM, case | {
                    "bodies.beam.mesh.box.elements": str([int(n) for n in fine])}))
                run = magfsi.good_run(BEAM, case | {
                    "bodies.beam.mesh.box.elements": "null", "accuracy.error": error})
                told = run.summary()["accuracy"]
                found = max(abs(a / b - 1) for a, b in zip(tip(run), wanted))
                magfsi.report(f"{name}: {told['resolution']} elements, {error} asked for, "
                              f"{100 * told['expected_error']:.2f} % promised, "
                              f"{100 * found:.2f} % found")
                self.assertLessEqual(told["expected_error"], 0.01 * float(error.split()[0]))
                self.assertLess(found, MOST * told["expected_error"])
                log = (run.folder / "run.log").read_text()
                self.assertIn("accuracy: by docs/accuracy/beam", log)
                self.assertIn("half of that error", log)


if __name__ == "__main__":
    unittest.main()
