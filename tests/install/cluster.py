# SPDX-License-Identifier: GPL-2.0-or-later
"""The scripts for clusters, as far as one machine can: the job in a scheduler's environment, ended by its
signal, gone on with by the next; the chain against a stand-in for sbatch; recipes that can be read."""
import ast
import os
import shutil
import signal
import subprocess
import unittest
from pathlib import Path

import yaml

from magfsi import testing

JOB, CHAIN = testing.ROOT / "cluster/run.slurm", testing.ROOT / "cluster/chain.sh"


class Job(unittest.TestCase):
    def setUp(self):
        self.folder = Path(testing.new_folder())
        self.scene = self.folder / "scene.yaml"
        values = yaml.safe_load(testing.SMALL.read_text())
        values |= {"name": "chained", "checkpoint": {"every": "0.4 ms"}}
        values["time"]["end"] = "6 ms"
        self.scene.write_text(yaml.safe_dump(values))
        self.environment = {**os.environ, "SLURM_NTASKS": "2", "SLURM_JOB_ID": "1",
                            "MAGFSI": str(testing.ROOT / "magfsi"), "MAGFSI_INSTALL": "no"}

    def start(self, *words):
        return subprocess.Popen(["bash", JOB, *words], cwd=self.folder, env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_a_run_goes_on_over_jobs_until_it_is_complete(self):
        out = self.folder / "runs/chained"
        first = self.start(self.scene)
        testing.wait_until(lambda: list(out.glob("checkpoint_*_fluid.h5")), first)
        first.send_signal(signal.SIGUSR1)
        text = first.communicate(timeout=300)[0]
        self.assertEqual(first.returncode, 0, text)
        self.assertIn("the next one goes on", text)
        self.assertNotEqual(testing.runs.read_summary(out)["outcome"], "completed")

        second = self.start(self.scene)
        text = second.communicate(timeout=300)[0]
        self.assertEqual(second.returncode, 0, text)
        self.assertIn("restart at step", text + (out / "run.log").read_text())
        summary = testing.runs.read_summary(out)
        self.assertEqual((summary["outcome"], summary["ranks"]), ("completed", {"structure": 1, "fluid": 1}))

        third = self.start(self.scene)
        self.assertIn("is complete", third.communicate(timeout=60)[0])
        self.assertEqual(third.returncode, 0)

    def test_what_is_wrong_is_said(self):
        self.assertEqual(self.start().wait(60), 1)
        self.environment["SLURM_NTASKS"] = "1"
        self.assertEqual(self.start(self.scene).wait(60), 2)
        del self.environment["SLURM_NTASKS"]
        job = self.start(self.scene)
        self.assertIn("submit it with sbatch", job.communicate(timeout=60)[0])
        self.assertNotEqual(job.returncode, 0)
        self.environment["SLURM_NTASKS"] = "2"
        self.assertEqual(self.start(self.scene, "--set", "fluid.viscosity=3 parsec").wait(60), 2)


class Chain(unittest.TestCase):
    def test_each_job_waits_for_the_one_before(self):
        folder = Path(testing.new_folder())
        stand_in = folder / "sbatch"
        stand_in.write_text('#!/bin/sh\necho "$@" >>calls\necho "$((100 + $(wc -l <calls)));cluster"\n')
        stand_in.chmod(0o755)
        words = [CHAIN, "3", "--nodes=2", "--", "my_robot", "--set", "name=x"]
        subprocess.run(words, cwd=folder, check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})
        end = f"{JOB} my_robot --set name=x"
        self.assertEqual((folder / "calls").read_text().splitlines(), [
            f"--parsable --nodes=2 {end}",
            f"--parsable --nodes=2 --dependency=afterok:101 {end}",
            f"--parsable --nodes=2 --dependency=afterok:102 {end}"])

    def test_wrong_words_are_refused(self):
        for words in ([], ["zero", "--", "s"], ["2"], ["2", "--"]):
            self.assertNotEqual(subprocess.run([CHAIN, *words], capture_output=True).returncode, 0)


class Recipes(unittest.TestCase):
    def test_the_spack_recipe_is_python_and_names_what_the_build_needs(self):
        text = (testing.ROOT / "packaging/spack/package.py").read_text()
        ast.parse(text)
        for library in ("lammps", "eigen", "suite-sparse", "yaml-cpp", "muparser", "cli11", "fmt", "spdlog",
                        "nlohmann-json", "gmsh", "hdf5", "mpi"):
            self.assertIn(f'depends_on("{library}', text)

    @unittest.skipUnless(shutil.which("shellcheck"), "shellcheck is not installed")
    def test_scripts_pass_shellcheck(self):
        subprocess.run(["shellcheck", "-s", "bash", JOB, CHAIN], check=True)


if __name__ == "__main__":
    unittest.main()
