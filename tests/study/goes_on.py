# SPDX-License-Identifier: GPL-2.0-or-later
"""A study that was interrupted goes on with the runs that are missing, and repeats none."""

import signal
import time
import unittest

from studies import Study, testing

# Runs of about a second; the order of the file is that of the runs.
TEXT = f"""
scene: {testing.SMALL}
axes:
  field: {{key: magnetic_field.constant.magnitude, values: [1 mT, 2 mT, 3 mT]}}
errors:
  end: {{probe: "robot.com_z[m]", norm: final, reference: 4 mm}}
""".replace("4 mm}", "0.004}")


def wait_for_one(study):
    for _ in range(1200):
        if study.records():
            return
        time.sleep(0.05)
    raise AssertionError("no run was done within 60 s")


class GoesOn(unittest.TestCase):
    def test_after_an_interruption(self):
        study = Study(TEXT)
        process = testing.start(study.command())
        wait_for_one(study)
        process.send_signal(signal.SIGTERM)
        ended = testing.finish(process, time.monotonic(), study.out, 120)
        before = study.records()
        self.assertEqual(ended.code, 1, ended.err)
        self.assertIn("the same command goes on", ended.err)
        self.assertLess(len(before), 3, "it was interrupted too late to prove anything")

        second = study.good_run()
        after = study.records()
        self.assertEqual(len(after), 3)
        self.assertEqual({key: after[key] for key in before}, before)
        self.assertEqual(second.out.count("completed in"), 3 - len(before))

        third = study.good_run()
        self.assertEqual(study.records(), after)
        self.assertNotIn("completed in", third.out)

    def test_what_a_run_is_decides(self):
        """The spelling of a value does not, its size does."""
        study = Study(TEXT.replace("[1 mT, 2 mT, 3 mT]", "[1 mT, 1000 uT]"))
        study.good_run()
        self.assertEqual(len(study.records()), 1)
        study.file.write_text(TEXT.replace("[1 mT, 2 mT, 3 mT]", "[1 mT, 2 mT]"))
        self.assertEqual(study.good_run().out.count("completed in"), 1)
        self.assertEqual([row["field[T]"] for row in study.rows()], ["0.001", "0.002"])


if __name__ == "__main__":
    unittest.main()
