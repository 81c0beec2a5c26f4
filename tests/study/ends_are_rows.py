# SPDX-License-Identifier: GPL-2.0-or-later
"""A run that diverges, is stopped or refused is a row of the study with its cause, and the
study goes on."""

import unittest

from studies import Study, testing

TEXT = f"""
scene: {testing.SMALL}
right_within: 5 %
axes:
  field: {{key: magnetic_field.constant.magnitude, values: [1 mT, 20 T]}}  # 20 T inverts elements
errors:
  end: {{probe: "robot.com_z[m]", norm: final, reference: 0.004}}
"""


class EndsAreRows(unittest.TestCase):
    def test_diverged(self):
        study = Study(TEXT)
        study.good_run()
        good, diverged = study.rows()
        self.assertEqual((good["outcome"], good["verdict"]), ("completed", "right"))
        self.assertGreater(float(good["mlups"]), 0)
        testing.report(f"20 T: {diverged['cause']}")
        self.assertEqual((diverged["outcome"], diverged["verdict"]), ("diverged", "diverged"))
        self.assertRegex(diverged["cause"], r"element \d+|node \d+|marker \d+")
        self.assertEqual(diverged["error[1]"], "")
        self.assertIn("1 diverged, 1 right", (study.out / "results.md").read_text())

    def test_stopped_at_the_limit(self):
        study = Study(TEXT.replace("[1 mT, 20 T]", "[1 mT]")
                      + "limit: 2 s\nset: {time.end: 1000 s}\n")
        study.good_run()
        late, = study.rows()
        self.assertEqual(late["outcome"], "stopped")
        self.assertIn("after 2 s, the study's limit", late["cause"])

    def test_refused_by_the_program(self):
        # A point of the longer beam lies outside the shorter one.
        study = Study(f"""
scene: {testing.ROOT}/tutorials/beam/scene.yaml
set: {{output: null, probes.every: 500 ms}}
axes:
  length: {{key: bodies.beam.mesh.box.size.0, values: [17.5 mm, 10 mm]}}
  place: {{key: probes.points.tip.at.0, values: [17.5 mm, 10 mm]}}
errors:
  end: {{probe: "tip_uz[m]", norm: final, reference: 0.0162}}
""")
        study.good_run()
        ended = {(float(row["length[m]"]), float(row["place[m]"])): row for row in study.rows()}
        self.assertEqual([row["outcome"] for row in ended.values()].count("completed"), 3)
        refused = ended[0.01, 0.0175]
        self.assertEqual(refused["outcome"], "refused")
        self.assertIn("outside the body", refused["cause"])


if __name__ == "__main__":
    unittest.main()
