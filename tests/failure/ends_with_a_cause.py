# SPDX-License-Identifier: GPL-2.0-or-later
"""Whatever goes wrong in a coupled run ends all of it at once (testing.check_prompt), with a
named cause and the exit code of the command line's contract."""

import os
import resource
import shutil
import signal
import time
import unittest
import unittest.mock
from pathlib import Path

from magfsi import testing

LONG = {"time.end": "10 s", "coupling.overlap": "allow"}  # until something ends it
LIMIT_S = 120  # only that the test itself ends; testing.check_prompt bounds the time


def mpirun(*programs):
    words = ["mpirun"]
    for i, program in enumerate(programs):
        words += [":"] * (i > 0) + ["-n", "1"] + program
    return words


def structure(folder, settings):
    return [testing.BIN / "magfsi-structure", testing.SMALL, "--out", folder,
            *testing.overrides(settings)]


def fluid(folder, settings):
    return [testing.BIN / "magfsi-fluid-lbm", testing.SMALL, "--out", folder,
            *testing.overrides(settings)]


def finish(command, folder):
    began = time.monotonic()
    return testing.finish(testing.start(command), began, folder, LIMIT_S)


def start(settings):
    return testing.get_going(testing.SMALL, {**LONG, **settings})


class Alone(unittest.TestCase):
    def test_structure_without_fluid(self):
        run = finish(mpirun(structure("unused", {})), "unused")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("structure was started without its partner", run.err)

    def test_fluid_without_structure(self):
        run = finish(mpirun(fluid("unused", {})), "unused")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("fluid was started without its partner", run.err)


class Disagreement(unittest.TestCase):
    def test_two_scenes(self):
        folder = testing.new_folder()
        run = finish(mpirun(structure(folder, LONG),
                            fluid(folder, {**LONG, "gravity.acceleration": "1 m/s2"})), folder)
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("disagree on the scene (hash)", run.err)

    def test_one_scene_has_no_partner(self):
        folder = testing.new_folder()
        run = finish(mpirun(structure(folder, {"fluid": "null", "probes": "null"}),
                            fluid(folder, LONG)), folder)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("scene", run.err)


class Lost(unittest.TestCase):
    def kill_one(self, name, role):
        process, folder = start({})
        began = time.monotonic()
        os.kill(testing.process_of(folder, name), signal.SIGKILL)
        run = testing.finish(process, began, folder, LIMIT_S)
        testing.report(f"{name} killed: ended after {run.seconds:.2f} s: {run.err.strip()}")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn(f"lost a partner: {role} rank 0 was killed by signal 9", run.err)
        causes = [line for line in run.err.strip().splitlines()
                  if not line.startswith("warning: ")]  # those come before the run
        self.assertEqual(len(causes), 1, run.err)
        self.assertEqual(run.summary()["outcome"], "lost_partner")
        self.assertIn(f"{role} rank 0", run.summary()["cause"])

    def test_fluid_killed(self):
        self.kill_one("magfsi-fluid-lbm", "fluid")

    def test_structure_killed(self):
        self.kill_one("magfsi-structure", "structure")

    def test_partner_that_hangs(self):
        process, folder = start({"coupling.timeout": "2 s"})
        stopped = testing.process_of(folder, "magfsi-structure")
        began = time.monotonic()
        os.kill(stopped, signal.SIGSTOP)
        run = testing.finish(process, began, folder, LIMIT_S)
        testing.report(f"structure stopped: ended after {run.seconds:.2f} s: {run.err.strip()}")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("within 2 s", run.err)


DELAYS_S = (0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5)
EVERY_DELAY = 1  # 3: only every third of them


class Stopped(unittest.TestCase):
    def ask_to_end(self, process, folder):
        process.send_signal(signal.SIGTERM)
        run = testing.finish(process, time.monotonic(), folder, LIMIT_S)
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 1, run.err)
        self.assertIn("stopped on request", run.err)
        self.assertEqual(run.summary()["outcome"], "stopped")
        # Of both sides, or there is nothing to go on from.
        self.assertEqual("--restart latest" in run.err, len(list(Path(folder).glob("checkpoint*.h5"))) >= 2)
        return run

    def test_asked_to_end(self):
        self.ask_to_end(*start({}))

    def test_asked_to_end_while_it_starts(self):
        """Whatever is there already: mpirun, the solvers, their first step."""
        for more in ({}, {"checkpoint.every": "1 s"}):
            for delay_s in DELAYS_S[::EVERY_DELAY]:
                with self.subTest(more, delay_s=delay_s):
                    folder = testing.new_folder()
                    process = testing.start(
                        testing.run_command(testing.SMALL, folder, {**LONG, **more}))
                    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
                    testing.wait_until(children.read_text, process)
                    time.sleep(delay_s)
                    self.ask_to_end(process, folder)

    def test_asked_to_end_while_suspended(self):
        """Nobody is there to answer: what is left of the run is ended."""
        process, folder = start({})
        for program in ("magfsi-structure", "magfsi-fluid-lbm"):
            os.kill(testing.process_of(folder, program), signal.SIGSTOP)
        run = self.ask_to_end(process, folder)
        testing.report(f"suspended, asked to end: ended after {run.seconds:.2f} s")


class DiskFull(unittest.TestCase):
    """A file that cannot grow fails as on a full disk: by the error of the write."""

    def full(self, program, settings, name, limit_bytes):
        process, folder = start(settings)
        resource.prlimit(testing.process_of(folder, program), resource.RLIMIT_FSIZE,
                         (limit_bytes, limit_bytes))
        run = testing.finish(process, time.monotonic(), folder, LIMIT_S)
        testing.report(f"{name}: ended after {run.seconds:.2f} s: {run.err.strip()}")
        testing.check_prompt(self, run)
        self.assertEqual(run.code, 1, run.err)
        self.assertRegex(run.err, rf"cannot write .*{name}.*: File too large")
        self.assertRegex(run.err, r"step \d+")
        self.assertEqual(run.summary()["outcome"], "stopped")
        self.assertIn(name, run.summary()["cause"])
        return folder

    # A row is about 600 bytes.
    def test_probes(self):
        folder = self.full("magfsi-structure", {"probes.every": "25 us"}, "probes.csv", 100000)
        text = (Path(folder) / "probes.csv").read_text()
        self.assertTrue(text.endswith("\n"), "the last row is torn")

    def test_fields_of_the_fluid(self):
        self.full("magfsi-fluid-lbm", {"output.fluid.every": "1 ms"}, "fluid_0", 50000)

    def test_checkpoint(self):
        self.full("magfsi-fluid-lbm", {"checkpoint.every": "5 ms"}, "checkpoint_0", 50000)


class Diverged(unittest.TestCase):
    def test_inverted_element_is_named(self):
        run = testing.run(testing.SMALL, {"magnetic_field.constant.magnitude": "20 T"},
                         limit_s=LIMIT_S)
        testing.report(f"20 T: {run.err.strip()}")
        self.assertEqual(run.code, 3, run.err)
        self.assertRegex(run.err, r"element \d+|node \d+|marker \d+")
        self.assertRegex(run.err, r"step \d+")
        self.assertEqual(run.summary()["outcome"], "diverged")
        self.assertTrue(run.summary()["cause"])

    def test_field_without_a_value(self):
        """A gap of the formula between two of the instants at which it is checked before."""
        gap = "sqrt(abs(t - 1.0066 ms) < 1 us ? -1 : 1)"
        run = testing.run(testing.ROOT / "docs/examples/scenes/formula.yaml",
                          {"magnetic_field.plus.0.formula.x": f"'1 mT*{gap}'", "time.end": "20 ms"},
                          limit_s=LIMIT_S)
        self.assertEqual(run.code, 3, run.err)
        self.assertRegex(run.err, r"the formula 0\.001\*sqrt.* is not a number at t = 0\.00100")
        self.assertEqual(run.summary()["outcome"], "diverged")

    def test_body_that_leaves_the_box(self):
        run = testing.run(testing.SMALL, {"coupling.overlap": "allow",
                                          "bodies.robot.initial.position": "[4 mm, 2 mm, 0.2 mm]",
                                        "gravity.acceleration": "900 m/s2",
                                        "time.end": "100 ms"}, limit_s=120)
        testing.report(f"falls out: {run.err.strip()}")
        self.assertEqual(run.code, 3, run.err)
        self.assertIn("left the fluid", run.err)


class Mpirun(unittest.TestCase):
    SETTINGS = {"time.end": "1 ms", "checkpoint.every": "0.5 ms"}

    def run_with(self, mpirun, folder, restart=None, version="4.1.4"):
        """With this shell script for mpirun."""
        tools = Path(testing.new_folder())
        (tools / "mpirun").write_text(
            f'#!/bin/sh\n[ "$1" != --version ] || {{ echo "mpirun (Open MPI) {version}"; exit; }}\n{mpirun}\n')
        (tools / "mpirun").chmod(0o755)
        with unittest.mock.patch.dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}"):
            return testing.run(testing.SMALL, self.SETTINGS, limit_s=LIMIT_S, folder=folder,
                               restart=restart)

    def test_when_all_is_done_loses_nothing(self):
        run = self.run_with(f'{shutil.which("mpirun")} "$@"\nkill -SEGV $$', testing.new_folder())
        self.assertEqual(run.code, 0, run.err)
        self.assertEqual(run.summary()["outcome"], "completed")
        self.assertIn("mpirun crashed when the run had ended", run.err)

    def test_before_is_a_loss(self):
        folder = testing.new_folder()
        self.assertEqual(testing.run(testing.SMALL, self.SETTINGS, folder=folder).code, 0)
        run = self.run_with("kill -SEGV $$", folder, restart="latest")
        self.assertEqual(run.code, 4, run.err)
        self.assertIn("mpirun was killed by signal 11", run.err)
        self.assertEqual(run.summary()["outcome"], "lost_partner")

    def test_each_has_a_folder_of_its_own_that_goes_with_it(self):
        """A shared one was taken by another job, one by the process's number left by a killed one."""
        for version, name in ("4.1.4", "OMPI_MCA_orte_tmpdir_base"), ("5.0.7", "PRTE_MCA_prte_tmpdir_base"):
            seen = Path(testing.new_folder()) / "seen"
            for _ in range(2):
                self.run_with(f'[ ! -d "${name}" ] || echo "${name}" >>{seen}\nexit 1', testing.new_folder(),
                              version=version)
            folders = seen.read_text().splitlines()
            self.assertEqual(len(set(folders)), 2, folders)
            self.assertFalse([each for each in folders if Path(each).exists()], folders)

    def test_without_a_folder_of_temporary_files(self):
        with unittest.mock.patch.dict(os.environ, TMPDIR="/proc/none"):
            os.environ.pop("OMPI_MCA_orte_tmpdir_base", None)
            os.environ.pop("PRTE_MCA_prte_tmpdir_base", None)
            run = testing.run(testing.SMALL, self.SETTINGS, limit_s=LIMIT_S)
        self.assertEqual(run.code, 1, run.err)
        self.assertIn("the folder of temporary files (/proc/none) is not to be had", run.err)
        self.assertIn("set TMPDIR", run.err)


class BadInput(unittest.TestCase):
    def test_nothing_is_written(self):
        folder = Path(testing.new_folder()) / "run"
        run = testing.run(testing.SMALL, {"fluid.spacing": "0.25"}, folder=folder, limit_s=LIMIT_S)
        self.assertEqual(run.code, 2, run.err)
        self.assertEqual(len(run.err.strip().splitlines()), 1, run.err)
        self.assertFalse(folder.exists())

    def test_run_folder_that_cannot_be(self):
        run = testing.run(testing.SMALL, folder="/dev/null/run", limit_s=LIMIT_S)
        self.assertEqual(run.code, 1, run.err)
        self.assertIn("/dev/null/run", run.err)


if __name__ == "__main__":
    testing.main(EVERY_DELAY=EVERY_DELAY)
