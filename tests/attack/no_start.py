# SPDX-License-Identifier: GPL-2.0-or-later
"""Whatever keeps a run from starting: one line of ours and a code of the table."""

import os
import resource
import shutil
import stat
import subprocess
import unittest
from pathlib import Path

import attack
from attack import testing


class NoStart(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder())

    def run_with(self, environment, before=None):
        words = testing.run_command(testing.SMALL, self.folder / "run", attack.SETTINGS)
        done = subprocess.run([str(word) for word in words], text=True, capture_output=True,
                              env=environment, preexec_fn=before, timeout=attack.PATIENCE_S,
                              check=False)
        ours = [line for line in done.stderr.splitlines() if line.startswith("magfsi: ")]
        return done.returncode, ours, done

    def mpirun(self, script, version="mpirun (Open MPI) 4.1.4"):
        """An mpirun that is another program."""
        path = self.folder / "mpirun"
        path.write_text(f'#!/bin/sh\n[ "$1" != --version ] || {{ echo "{version}"; exit; }}\n{script}\n')
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}

    def ends(self, environment, message, before=None):
        code, ours, done = self.run_with(environment, before)
        self.assertEqual(code, 1, done.stderr)
        self.assertEqual(len(ours), 1, done.stderr)
        self.assertIn(message, ours[0])
        testing.report(ours[0])

    def test_an_mpirun_that_does_nothing(self):
        self.ends(self.mpirun("exit 0"), "nothing was run")

    def test_an_mpirun_that_fails(self):
        self.ends(self.mpirun("echo no slots >&2; exit 213"), "ended with code 213")

    def test_an_mpirun_that_hangs_on_its_way_out(self):
        """As Open MPI's does once in a while: all its processes are gone, and it waits."""
        self.ends(self.mpirun("sleep 2; exec sleep 1000"), "nothing was run")

    def test_an_mpirun_of_another_mpi(self):
        """MPICH's beside Open MPI's: passed over where Debian's name for Open MPI's is there."""
        foreign = self.mpirun("touch started", "HYDRA build details:")
        code, ours, done = self.run_with(foreign)
        self.assertEqual((code, ours), (0, []), done.stderr)
        self.assertTrue(done.stdout.startswith("mpirun.openmpi "), done.stdout)
        code, found = self.ask_the_doctor(foreign)
        self.assertEqual(code, 0, found)
        self.assertIn("passed over: mpirun (HYDRA build details:)", found["mpirun"])

    def test_only_an_mpirun_of_another_mpi(self):
        foreign = self.mpirun("touch started", "HYDRA build details:")
        for name in ("sh", "timeout"):
            (self.folder / name).symlink_to(shutil.which(name))
        alone = {**foreign, "PATH": str(self.folder)}
        self.ends(alone, "belongs to another MPI than these programs")
        self.assertFalse((self.folder / "run").exists())
        code, found = self.ask_the_doctor(alone)
        self.assertEqual(code, 1)
        self.assertIn("apt-get install openmpi-bin", found["mpirun"])

    def test_processes_that_another_mpirun_started(self):
        """Each would be a job of its own, and all would write into one folder."""
        words = [testing.BIN / "magfsi-fluid-lbm", testing.SMALL, "--out", self.folder / "run"]
        done = subprocess.run(words, text=True, capture_output=True, check=False,
                              env={**os.environ, "PMI_SIZE": "2", "PMI_RANK": "0"},
                              timeout=attack.PATIENCE_S)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("started by the mpirun of another MPI", done.stderr)

    def test_an_allocation_of_one_task(self):
        """Slurm's, with fewer tasks than the run has ranks: it starts all the same."""
        host = os.uname().nodename
        code, ours, done = self.run_with({
            **os.environ, "SLURM_JOB_ID": "1", "SLURM_JOBID": "1", "SLURM_NTASKS": "1",
            "SLURM_NNODES": "1", "SLURM_JOB_NUM_NODES": "1", "SLURM_NODELIST": host,
            "SLURM_JOB_NODELIST": host, "SLURM_TASKS_PER_NODE": "1", "SLURM_CPUS_ON_NODE": "1"})
        self.assertEqual((code, ours), (0, []), done.stderr)

    def test_no_mpirun(self):
        self.ends({**os.environ, "PATH": str(self.folder)}, "cannot start mpirun")

    def test_no_path(self):
        without = {key: value for key, value in os.environ.items() if key != "PATH"}
        code, ours, done = self.run_with(without)
        self.assertEqual(code, 0, done.stderr)
        self.assertEqual(ours, [])

    def test_a_small_stack(self):
        def small():
            resource.setrlimit(resource.RLIMIT_STACK, (300 * 1024, 300 * 1024))
        self.ends(os.environ, "ulimit -s", small)

    def ask_the_doctor(self, environment):
        done = subprocess.run([testing.BIN / "magfsi", "doctor"], text=True, capture_output=True,
                              env=environment, cwd=self.folder, timeout=attack.PATIENCE_S,
                              check=False)
        return done.returncode, dict(line.split(maxsplit=1) for line in done.stdout.splitlines())

    def test_the_doctor_names_what_is_wrong(self):
        """With its cause and what to do, and nothing else where all is well."""
        code, found = self.ask_the_doctor(os.environ)
        testing.report("\n".join(f"{name}: {text}" for name, text in found.items()))
        self.assertEqual(code, int(any(text.startswith("FAULT") for text in found.values())))
        self.assertIn("two ranks started, talked and ended", found["MPI"])
        code, found = self.ask_the_doctor(self.mpirun("exit 213"))
        self.assertEqual(code, 1)
        self.assertIn("FAULT: two ranks of mpirun ended with code 213", found["MPI"])

    def test_a_run_folder_that_cannot_be(self):
        for out in ("/dev/null/run", "/proc/run", "/sys/run"):
            with self.subTest(out):
                ended = testing.run(testing.SMALL, folder=out, limit_s=attack.PATIENCE_S)
                attack.one_line(self, ended, 1, out)

    def test_a_calibration_that_is_damaged(self):
        cache = self.folder / "cache/magfsi"
        cache.mkdir(parents=True)
        for text in ('{"version": 1, "machine": 2}', "{", "[]", '{"version": "0.1.0"}', ""):
            (cache / "calibration.json").write_text(text)
            code, ours, done = self.run_with({**os.environ, "XDG_CACHE_HOME":
                                              str(self.folder / "cache")})
            self.assertEqual(code, 0, done.stderr)
            self.assertEqual(ours, [])


if __name__ == "__main__":
    unittest.main()
