#!/usr/bin/python3
"""A record that does not fit is refused with one line; one that was cut short plays up to there."""

import unittest

import records
from records import magfsi


class Refused(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorded = records.good("--record", settings={"time.end": "0.5 ms"})

    def refused(self, *options, **named):
        result = records.run(*options, **named)
        self.assertEqual(result.code, 2, result.err)
        self.assertEqual(len(result.err.strip().splitlines()), 1, result.err)
        return result.err

    def play(self, side="fluid"):
        return "--replay", f"{side}={self.recorded.folder}"

    def test_longer_than_the_record(self):
        self.assertIn("ends after 20 coupled steps, this run takes 40; add --set "
                      "time.end='0.0005 s'", self.refused(*self.play()))

    def test_cut_short(self):
        record = self.recorded.folder / "exchange.record"
        whole = record.read_bytes()
        folder = magfsi.new_folder()
        cut = f"{folder}/exchange.record"
        with open(cut, "wb") as file:
            file.write(whole[:len(whole) * 3 // 4])
        err = self.refused("--replay", f"fluid={cut}", settings={"time.end": "0.5 ms"})
        self.assertRegex(err, r"ends after 1[0-9] coupled steps")
        advice = err.split("time.end='")[1].split("'")[0]
        played = records.good("--replay", f"fluid={cut}", settings={"time.end": advice})
        self.assertEqual(set(records.differences(played)), {0})

    def test_other_markers(self):
        err = self.refused(*self.play(), settings={
            "time.end": "0.5 ms", "bodies.robot.initial.position": "[4 mm, 2 mm, 4 mm]"})
        self.assertIn("they start elsewhere", err)

    def test_other_step(self):
        err = self.refused(*self.play(), settings={"time.end": "0.5 ms",
                                                   "fluid.lattice_speed": "0.04"})
        self.assertIn("set time.step", err)

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
        self.assertIn("--record", self.refused("--replay", f"fluid={magfsi.new_folder()}"))

    def test_no_side(self):
        self.assertIn("found 'runs/x'", self.refused("--replay", "runs/x"))

    def test_no_fluid(self):
        alone = {"fluid": "", "probes.fluid": ""}
        self.assertIn("fluid", self.refused("--record", settings=alone))
        self.assertIn("fluid", self.refused(*self.play(), settings=alone))


if __name__ == "__main__":
    unittest.main()
