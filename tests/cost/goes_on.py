# SPDX-License-Identifier: GPL-2.0-or-later
"""What was interrupted goes on; what is wrong is refused."""
import signal
import time
import unittest

from scenes import BEAM, Scene, testing


class GoesOn(unittest.TestCase):
    def test_after_an_interruption(self):
        scene = Scene(BEAM)
        process = testing.start(scene.command("--budget", "30 s"))
        self.assertTrue(testing.wait_until(scene.records, process))
        process.send_signal(signal.SIGTERM)
        ended = testing.finish(process, time.monotonic(), scene.out, 120)
        before = scene.records()
        self.assertEqual(ended.code, 1, ended.err)
        self.assertIn("the same command goes on", ended.err)

        second = scene.good_cost("--budget", "30 s")
        after = scene.records()
        self.assertGreater(len(after), len(before), "it was interrupted too late")
        self.assertEqual({key: after[key] for key in before}, before)
        self.assertEqual(second.out.count("completed in"), len(after) - len(before))
        self.assertNotIn("completed in", scene.good_cost("--budget", "30 s").out)


class IsRefused(unittest.TestCase):
    WRONG = [
        (["--error", "3"], "allowed a percentage such as '3 %'"),
        (["--budget", "5 m"], "allowed a time such as '5 min'"),
        (["--norm", "finall"], "invalid choice"),
        (["--set", "fluid"], "allowed path.to.key=value"),
        (["--set", "bodies.beam.elment=full"], 'unknown key "elment"'),
    ]

    def test_each_in_one_line(self):
        for words, says in self.WRONG:
            with self.subTest(words):
                scene = Scene(BEAM)
                done = scene.called(*words)
                self.assertEqual(done.code, 2, done.out + done.err)
                self.assertEqual(len(done.err.strip().splitlines()), 1, done.err)
                self.assertIn(says, done.err)
                self.assertFalse(scene.out.exists())

    def test_a_scene_without_probes(self):
        scene = Scene(BEAM[:BEAM.index("probes:")])
        done = scene.called()
        self.assertEqual((done.code, len(done.err.strip().splitlines())), (2, 1), done.err)
        self.assertIn("no probes", done.err)

    def test_a_probe_that_is_not_there(self):
        scene = Scene(BEAM)
        done = scene.cost("--budget", "30 s", "--probe", "tip_q")
        self.assertEqual((done.code, len(done.err.strip().splitlines())), (2, 1), done.err)
        self.assertRegex(done.err, r"tip_q.*tip_uz\[m\]")

    def test_run(self):
        scene = Scene(BEAM)
        for words, says in ((["--error", "x"], "allowed a percentage"),
                            (["--error", "3 %", "--restart", "latest"], "belongs to one setting")):
            done = scene.run(*words)
            self.assertEqual((done.code, len(done.err.strip().splitlines())), (2, 1), done.err)
            self.assertIn(says, done.err)
            self.assertFalse((scene.folder / "runs").exists())


if __name__ == "__main__":
    unittest.main()
