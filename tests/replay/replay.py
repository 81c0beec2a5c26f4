# SPDX-License-Identifier: GPL-2.0-or-later
"""One side of a recorded run, played to the other. A live side that meets the recorded other one
does what it did: to the last bit on the same ranks; where the live side is changed, the first step
that differs is named. A record that does not fit is refused with one line; one that was cut short
plays up to there."""

import unittest

from magfsi import runs, testing

# Overrides without a value take a key away: a record cannot audit the interface.
SHORT = {"time.end": "1 ms", "probes.interface_balance": ""}
STEPS = 40  # of 1 ms


def run(*options, settings=None, folder=None):
    return testing.run(testing.SMALL, {**SHORT, **(settings or {})}, limit_s=120, folder=folder,
                       more=options)


def good(*options, **named):
    result = run(*options, **named)
    if result.code != 0:
        raise AssertionError(f"exit code {result.code}\n{result.out}\n{result.err}")
    return result


def differences(result):
    """replay.csv's second column."""
    return list(runs.read_columns(result.folder / "replay.csv").values())[1]


class OneSide(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorded = good("--record", "--ranks", "structure=1,fluid=2")

    def fluid_columns(self, result):
        names = ["kinetic_energy[J]", "mass[kg]", "max_speed[m/s]"]
        return [result.probes()[name] for name in names]

    def test_recording_changes_nothing(self):
        plain = good("--ranks", "structure=1,fluid=2")
        self.assertEqual((plain.folder / "probes.csv").read_bytes(),
                         (self.recorded.folder / "probes.csv").read_bytes())
        self.assertFalse((plain.folder / "exchange.record").exists())

    def test_live_structure(self):
        played = good("--replay", f"fluid={self.recorded.folder}")
        self.assertEqual((played.folder / "probes.csv").read_bytes(),
                         (self.recorded.folder / "probes.csv").read_bytes())
        self.assertEqual(differences(played), [0] * STEPS)
        self.assertIn("to the last bit", played.out)
        self.assertEqual(played.summary()["outcome"], "completed")

    # Sums over ranks round otherwise: a marker of a size of mm moves by some 1e-16 m.
    def test_live_structure_on_other_ranks(self):
        played = good("--replay", f"fluid={self.recorded.folder}",
                              "--ranks", "structure=2")
        worst = max(differences(played))
        testing.report(f"structure on 2 ranks instead of 1: {worst:.2g} m")
        self.assertLess(worst, 1e-12)

    def test_live_fluid(self):
        played = good("--replay", f"structure={self.recorded.folder}",
                              "--ranks", "fluid=2")
        self.assertEqual(differences(played), [0] * STEPS)
        self.assertEqual(self.fluid_columns(played), self.fluid_columns(self.recorded))

    def test_live_fluid_that_was_changed(self):
        played = good("--replay", f"structure={self.recorded.folder}",
                              settings={"fluid.viscosity": "2 mm2/s"})
        found = differences(played)
        self.assertGreater(found[0], 0)
        self.assertIn("first after step 1", played.out)

    def test_scheme_with_both_at_once(self):
        settings = {"coupling.scheme": "parallel"}
        recorded = good("--record", "--ranks", "structure=1,fluid=1",
                                settings=settings)
        for side in ("structure", "fluid"):
            played = good("--replay", f"{side}={recorded.folder}", "--ranks",
                                  "fluid=1" if side == "structure" else "structure=1",
                                  settings=settings)
            self.assertEqual(differences(played), [0] * STEPS, side)


class Refused(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorded = good("--record", settings={"time.end": "0.5 ms"})

    def refused(self, *options, **named):
        result = run(*options, **named)
        testing.check_refused(self, result)
        return result.err

    def play(self, side="fluid"):
        return "--replay", f"{side}={self.recorded.folder}"

    def test_longer_than_the_record(self):
        self.assertIn("ends after 20 coupled steps, this run takes 40; add --set "
                      "time.end='0.0005 s'", self.refused(*self.play()))

    def test_cut_short(self):
        record = self.recorded.folder / "exchange.record"
        whole = record.read_bytes()
        folder = testing.new_folder()
        cut = f"{folder}/exchange.record"
        with open(cut, "wb") as file:
            file.write(whole[:len(whole) * 3 // 4])
        err = self.refused("--replay", f"fluid={cut}", settings={"time.end": "0.5 ms"})
        self.assertRegex(err, r"ends after 1[0-9] coupled steps")
        advice = err.split("time.end='")[1].split("'")[0]
        played = good("--replay", f"fluid={cut}", settings={"time.end": advice})
        self.assertEqual(set(differences(played)), {0})

    def test_other_markers(self):
        err = self.refused(*self.play(), settings={
            "time.end": "0.5 ms", "bodies.robot.initial.position": "[4 mm, 2 mm, 4 mm]"})
        self.assertIn("they start elsewhere", err)

    def test_other_step(self):
        err = self.refused(*self.play(), settings={"time.end": "0.5 ms",
                                                   "fluid.lattice_speed": "0.04"})
        self.assertIn("set time.step", err)

    def test_other_forcing(self):
        self.assertIn("forcing=no_slip", self.refused(*self.play(), settings={
            "time.end": "0.5 ms", "coupling.immersed_boundary.forcing": "penalty"}))

    def test_audit(self):
        self.assertIn("--set probes.interface_balance=", self.refused(
            *self.play(), settings={"probes.interface_balance": "true",
                                    "time.end": "0.5 ms"}))

    def test_implicit(self):
        implicit = {"time.end": "0.5 ms", "coupling.scheme": "implicit"}
        self.assertIn("coupling.scheme: serial", self.refused("--record", settings=implicit))
        self.assertIn("coupling.scheme=serial", self.refused(*self.play(), settings=implicit))

    def test_own_folder(self):
        self.assertIn("--out", self.refused(*self.play(), folder=self.recorded.folder))

    def test_no_record(self):
        self.assertIn("--record", self.refused("--replay", f"fluid={testing.new_folder()}"))

    def test_no_side(self):
        self.assertIn("found 'runs/x'", self.refused("--replay", "runs/x"))

    def test_no_fluid(self):
        alone = {"fluid": "", "probes.fluid": ""}
        self.assertIn("fluid", self.refused("--record", settings=alone))
        self.assertIn("fluid", self.refused(*self.play(), settings=alone))


if __name__ == "__main__":
    unittest.main()
