# SPDX-License-Identifier: GPL-2.0-or-later
"""A wrong study ends with exit code 2, one line that names the place, and nothing written."""

import unittest

from studies import Study, testing

GOOD = f"""scene: {testing.SMALL}
axes:
  field: {{key: magnetic_field.constant.magnitude, values: [1 mT, 2 mT]}}
errors:
  end: {{probe: "robot.com_z[m]", norm: final, reference: 0.004}}
"""
# What is written in place of what; line and column of the error; what it says.
WRONG = [
    ("axes:", "axis:", "1:1|3", 'the unknown key "axis".*did you mean "axes"'),
    ("values: [1 mT, 2 mT]", "values: 1 mT", "3:59", "found \"1 mT\"; allowed a list of values"),
    ("values: [1 mT, 2 mT]", "values: []", "3:59", "no values"),
    ("key: magnetic_field.constant.magnitude", "key: magnetic_field.constant.magnitud", "3:",
     "unknown key \"magnitud\".*did you mean \"magnitude\""),
    ("[1 mT, 2 mT]", "[1 mT, 2 mm]", "3:66", "allowed a magnetic flux density"),
    ("norm: final", "norm: finall", "5:40", "allowed one of final, max"),
    ("norm: final", "norm: l2", "5:55", "a course in time"),
    ("norm: final", "norm: gain", "5:8", "gain with a reference"),
    (", reference: 0.004", "", "5:8", "final without a reference"),
    ("reference: 0.004", "reference: finest", "5:", "order.axis"),
    ("reference: 0.004", "reference: {formula: exp(-q)}", "5:", 'the name "q"'),
    ("reference: 0.004", "reference: {formula: __import__(1)}", "5:", "in the formula"),
    ("reference: 0.004", "reference: {table: {file: none.csv, time: t, value: u}}", "5:",
     "no such file"),
    ("errors:", "skip: [{fild: 1 mT}]\nerrors:", "4:", 'the axis "fild"'),
    ("errors:", "skip: [{field: 3 mT}]\nerrors:", "4:", "a value of this axis: 1 mT, 2 mT"),
    ("errors:", "targets: [3]\nerrors:", "4:11", "a percentage above 0"),
    ("errors:", "ranks: solid=1\nerrors:", "1:8", "--ranks: found 'solid=1'"),
    (str(testing.SMALL), "none.yaml", "1:8", "no such file"),
    ("axes:", "axes: [", "", "found no valid YAML"),
]


class IsRefused(unittest.TestCase):
    def test_each_mistake_by_its_place(self):
        for old, new, place, says in WRONG:
            with self.subTest(new):
                self.assertIn(old, GOOD)
                study = Study(GOOD.replace(old, new, 1))
                done = study.called()
                self.assertEqual(done.code, 2, done.out + done.err)
                self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                where = place if "|" not in place else "[0-9]+:[0-9]+"
                self.assertRegex(done.err, rf"{study.file}:{where}")
                self.assertRegex(done.err, rf"{study.file}:\d+:\d+: .*{says}")
                self.assertFalse(study.out.exists())

    def test_a_probe_that_the_scene_has_not(self):
        study = Study(GOOD.replace("com_z", "com_q"))
        done = study.run()
        self.assertEqual(done.code, 2, done.err)
        self.assertRegex(done.err, rf'{study.file}:5:16: .*"robot.com_q\[m\]".*robot.com_z')

    def test_no_file(self):
        study = Study(GOOD)
        study.file.unlink()
        self.assertEqual(study.run().code, 2)


if __name__ == "__main__":
    unittest.main()
