# SPDX-License-Identifier: GPL-2.0-or-later
"""What diverges and ends with on_divergence: stop runs to its end with retry, right as if it had
had the smaller step from the start; after the retries that it may have it ends as before."""

import unittest
from pathlib import Path

from magfsi import testing

HERE = Path(__file__).resolve().parent
RAMP = "bodies.cube.prescribed_motion.0.ramp."
CUBE = {"time.end": "2 ms", RAMP + "duration": "0.5 ms", "checkpoint.every": "0.1 ms"}
# Ten times the field at once, after a quiet time.
SHEET = {"time.end": "4 ms", "coupling.overlap": "allow", "fluid.lattice_speed": 0.2,
         "checkpoint.every": "0.5 ms",
         "magnetic_field": "{plane: xz, table: {time: [0 ms, 2 ms, 2.01 ms, 4 ms], magnitude: "
                           "[10 mT, 10 mT, 150 mT, 150 mT], direction: 50 deg}}"}
CHANNEL = {"checkpoint.every": "10 ms"}
RETRY = {"checkpoint.on_divergence": "retry"}


class Retry(unittest.TestCase):
    def retried(self, scene, settings, half, times=1):
        """The run, and the one at the small step from the start."""
        stopped = testing.run(scene, settings)
        self.assertEqual(stopped.code, 3, stopped.err)
        run = testing.run(scene, {**settings, **RETRY})
        self.assertEqual(run.code, 0, run.err)
        summary = run.summary()
        self.assertEqual(summary["outcome"], "completed")
        told = summary["retries"]
        self.assertEqual(len(told), times)
        self.assertEqual(told[0]["cause"], stopped.summary()["cause"])
        self.assertGreater(told[0]["from_s"], 0)
        log = (run.folder / "run.log").read_text()
        self.assertEqual(log.count("retry 1 of at most 3: " + told[0]["cause"]), 1)
        fine = testing.good_run(scene, {**settings, **half})
        self.assertEqual(len(run.probes()["t[s]"]), len(fine.probes()["t[s]"]))
        return run, fine

    def compare(self, run, fine, bounds):
        """Over the whole run, as parts of each column's range."""
        mine, theirs = run.probes(), fine.probes()
        for name, bound in bounds.items():
            span = max(theirs[name]) - min(theirs[name])
            error = max(abs(a - b) for a, b in zip(mine[name], theirs[name])) / span
            testing.report(f"{name}: {error:.2e} from the run at the small step")
            self.assertLess(error, bound, name)

    def test_bodies_alone(self):
        run, fine = self.retried(HERE / "crushed.yaml", CUBE,
                                 {"time.step": "3.33333333 us"})
        # A step of 0.9 of the limit has an error of some 1e-2 in its frequency; the first
        # 0.4 ms had it.
        self.compare(run, fine, {"cube.com_x[m]": 0.01, "cube.energy_elastic[J]": 0.01,
                                 "cube.energy_kinetic[J]": 0.05})
        self.assertLess(run.summary()["energy_audit"]["residual"], 0.01)
        self.goes_on(run.folder)

    def goes_on(self, folder):
        """A restart goes on with the steps that the retry has left."""
        step = testing.run(HERE / "crushed.yaml", {**CUBE, **RETRY, "time.end": "3 ms"},
                          folder=folder, restart="latest")
        self.assertEqual(step.code, 0, step.err)
        self.assertEqual(step.summary()["steps"], 900)
        self.assertEqual(step.summary()["substeps"], 60 + 780)

    def test_fluid_alone(self):
        run, fine = self.retried(HERE / "driven_channel.yaml", CHANNEL,
                                 {"fluid.lattice_speed": 0.1})
        # The lattice's error goes with the square of its speed: 0.4 cells a step until then.
        self.compare(run, fine, {"kinetic_energy[J]": 0.01, "max_speed[m/s]": 0.01})
        mass = run.probes()["mass[kg]"]
        self.assertLess(max(mass) - min(mass), 1e-12 * mass[0])

    def test_bodies_in_a_fluid(self):
        run, fine = self.retried(testing.SMALL, SHEET, {"fluid.lattice_speed": 0.1})
        # Runs at a half and a quarter of the step differ by 0.06 on this coarse grid.
        self.compare(run, fine, {f"robot.{name}": 0.1 for name in
                                 ("end_to_end[m]", "energy_elastic[J]", "work_magnetic[J]")})
        testing.check_interface_balance(self, run, "retried")

    def test_bounded(self):
        through = {**CUBE, **RETRY, RAMP + "displacement": "[-4 mm, 0 mm, 0 mm]",
                   "checkpoint.max_retries": 2}
        run = testing.run(HERE / "crushed.yaml", through)
        self.assertEqual(run.code, 3, run.err)
        self.assertIn("no retry: 2 of at most 2 retries done", run.err)
        summary = run.summary()
        self.assertEqual(summary["outcome"], "diverged")
        self.assertRegex(summary["cause"], "inverted|gained energy")
        first, second = summary["retries"]
        testing.report(f"from {first['from_s']} and {second['from_s']} s")
        self.assertLess(second["coupled_step_s"], 0.6 * first["coupled_step_s"])
        self.assertLessEqual(second["from_s"], first["from_s"])


if __name__ == "__main__":
    unittest.main()
