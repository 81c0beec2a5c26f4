# SPDX-License-Identifier: GPL-2.0-or-later
"""However a controller fails, the run ends at once with the reason and exit code 1; told to end, both
end in order."""
import os
import signal
import unittest

from scripts import ALONE, EVERY, WITH_A_STATE, of, testing, with_control

LONG = {**ALONE, "time.end": "100 s"}


class Fails(unittest.TestCase):
    def ends(self, text, *words, settings=None, **control):
        run = testing.run(EVERY, with_control(settings or LONG, text, **control))
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 1, run.err)
        for word in words:
            self.assertIn(word, run.err)
        self.assertIn(words[0], run.summary()["cause"])
        self.assertEqual(run.summary()["outcome"], "stopped")
        testing.report(run.err)
        return run

    def test_raises(self):
        run = self.ends(of("if t > 2e-3: self.nothing\nreturn 0, 0, 1e-3"),
                        "the controller failed", "Traceback (most recent call last)", "steer.py",
                        "in step", "AttributeError: 'Controller' object has no attribute 'nothing'")
        # Of the script alone, once; results up to there are kept.
        self.assertNotIn("magfsi/controller.py", run.err)
        self.assertEqual(run.err.count("AttributeError"), 1, run.err)
        self.assertEqual(len(run.probes()["t[s]"]), 7)

    def test_raises_where_it_begins(self):
        self.ends("class Controller:\n    def __init__(self):\n        1 / 0\n"
                  "    def step(self, t, probes): pass", "in __init__", "ZeroDivisionError")

    def test_ends_itself(self):
        self.ends(of("import sys\nsys.exit(0)"), "SystemExit: 0")

    def test_hangs_in_python(self):
        self.ends(of("while True: pass"), "no answer of the controller at t = 0 s within 1 s",
                  "steer.py\", line 3 in step", timeout="1 s")

    def test_hangs_in_c(self):
        self.ends(of("import threading\nthreading.Lock().acquire() and threading.Event().wait()"),
                  "within 1 s", "line 4 in step", timeout="1 s")

    def test_hangs_where_it_begins(self):
        self.ends("import time\ntime.sleep(1000)\nController = None", "no start of the controller within 1 s",
                  "steer.py\", line 2 in <module>", timeout="1 s")

    def test_returns_nonsense(self):
        allowed = "allowed are three components of the field [T], or a dict"
        for answer, words in (("None", ("step returned None", allowed)),
                              ("1e-3, 2e-3", ("step returned (0.001, 0.002)", allowed)),
                              ("'xyz'", ("step returned 'xyz'", allowed)),
                              ("0, 0, float('nan')", ("finite components",)),
                              ("{'rotation': {'magnitude': '3 mT'}}",
                               ("what step returned", "frequency")),
                              ("{'constant': {'magnitude': 3e-3, 'direction': '1 deg'}}",
                               ("without a unit", "such as 17 mT")),
                              ("{'gradient': 1, 'constant': {'magnitude': '3 mT', 'direction': "
                               "'1 deg'}}", ("gradient",)),
                              ("{'table': {'time': ['1 s', '0 s'], 'magnitude': ['0 T', '0 T'], "
                               "'direction': '0 deg'}}", ("times that ascend",))):
            with self.subTest(answer=answer):
                self.ends(of(f"return {answer}"), *words)

    def test_is_no_controller(self):
        self.ends("Controller = 1", "steer.py: no class Controller with a method step")
        # What the text alone shows is bad input, and nothing is written.
        for text, words in (("class Controler:\n    pass", "steer.py: no class Controller with a method step"),
                            ("def Controller(:", "steer.py:1: invalid syntax")):
            run = testing.run(EVERY, with_control(LONG, text))
            self.assertEqual(run.code, 2, run.err)
            self.assertIn(words, run.err)
            self.assertFalse((run.folder / "run.json").exists())
        self.ends("from nothing_of_that_name import Controller", "ModuleNotFoundError: No module named")

    def test_cannot_be_kept(self):
        """Known at once, not at the first checkpoint."""
        text = of("return 0, 0, 1e-3") + "\n    def __init__(self):\n        self.f = lambda: 1\n"
        run = self.ends(text, "pickle", "lambda", settings={**LONG, "checkpoint.every": "50 s"})
        self.assertEqual(run.summary()["steps"], 0)
        self.assertEqual(testing.run(EVERY, with_control(ALONE, text)).code, 0, "without checkpoints")

    def test_is_killed(self):
        run = testing.run(EVERY, with_control(LONG, of(
            "import os, signal\nif t > 0: os.kill(os.getpid(), signal.SIGKILL)\nreturn 0, 0, 1e-3")))
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("lost a partner: controller rank 0 was killed by signal 9", run.err)
        self.assertEqual(run.summary()["outcome"], "lost_partner")


class Stopped(unittest.TestCase):
    def stopped(self, settings):
        folder = testing.new_folder()
        settings = with_control(settings, WITH_A_STATE, folder=folder)
        process = testing.start(testing.run_command(EVERY, folder, settings))
        testing.wait_for_rows(folder, process, 3)
        process.send_signal(signal.SIGTERM)
        ended = testing.finish(process, 0, folder, 120)
        self.assertEqual(ended.code, 1, ended.err)
        self.assertIn("stopped on request", ended.err)
        self.assertNotIn("Traceback", ended.err)
        return folder, settings, ended.summary()["steps"]

    def test_with_a_checkpoint_that_it_goes_on_from(self):
        folder, settings, steps = self.stopped({**LONG, "checkpoint.every": "50 s"})
        end = f"{(steps + 500) * 2e-6} s"
        run = testing.good_run(EVERY, {**settings, "time.end": end}, folder=folder, restart="latest")
        self.assertEqual(run.summary()["extra"]["restarted_at_step"], steps)

    def test_without_checkpoints(self):
        self.stopped(LONG)


class Alone(unittest.TestCase):
    def end(self, programs):
        words = ["mpirun"]
        for program in programs:
            words += [":"] * (len(words) > 1) + ["-n", "1", *program]
        run = testing.finish(testing.start(words), 0, "unused", 120)
        self.assertEqual(run.code, 4, run.err)
        return run.err

    def test_a_controller_without_a_structure_and_the_other_way_round(self):
        python = ["/usr/bin/python3", "-P", "-m", "magfsi.controller"]
        self.assertIn("found no structure in this MPI job", self.end([python]))
        script = testing.new_folder()
        structure = [testing.BIN / "magfsi-structure", EVERY, "--out", script]
        controlled = testing.overrides(with_control(LONG, of("return 0, 0, 0"), folder=script))
        self.assertIn("whose scene has no control",
                      self.end([structure + testing.overrides(LONG), python]))
        self.assertIn("without its controller", self.end([structure + controlled]))


if __name__ == "__main__":
    unittest.main()
