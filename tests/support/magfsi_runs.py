"""Runs of the built magfsi for tests: start, read what it left, compare."""

import atexit
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ["MAGFSI_BIN"])  # set by CTest: where the programs are
SMALL = ROOT / "tests/scenes/small_swimmer.yaml"
SWIMMER = ROOT / "tutorials/swimmer/scene.yaml"
PAPER = ROOT / "tutorials/swimmer/paper.yaml"


class Run:
    """A finished run: exit code, output, seconds, run folder."""

    def __init__(self, code, out, err, seconds, folder):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds
        self.folder = Path(folder)

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def probes(self):
        """Columns of probes.csv as lists of numbers."""
        with open(self.folder / "probes.csv", newline="") as file:
            rows = list(csv.reader(file))
        return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def overrides(settings):
    words = []
    for key, value in settings.items():
        words += ["--set", f"{key}={value}"]
    return words


def new_folder():
    """Removed when the test ends, unless MAGFSI_KEEP is set."""
    folder = tempfile.mkdtemp(prefix="magfsi-test-")
    if "MAGFSI_KEEP" not in os.environ:
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def finish(process, start, folder, limit_s):
    try:
        out, err = process.communicate(timeout=limit_s)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        raise AssertionError(f"still running after {limit_s} s\n{out}\n{err}")
    return Run(process.returncode, out, err, time.monotonic() - start, folder)


def start(command):
    return subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, start_new_session=True)


def run(scene, settings=None, ranks=None, limit_s=600, folder=None, restart=None):
    """magfsi run; raises if it takes longer than limit_s."""
    folder = folder or new_folder()
    command = [BIN / "magfsi", "run", scene, "--out", folder, *overrides(settings or {})]
    if ranks:
        command += ["--ranks", ranks]
    if restart:
        command += ["--restart", restart]
    began = time.monotonic()
    return finish(start(command), began, folder, limit_s)


def good_run(*args, **named):
    result = run(*args, **named)
    if result.code != 0:
        raise AssertionError(f"exit code {result.code}\n{result.out}\n{result.err}")
    return result


def process_of(folder, name):
    """Process id of the participant of this run folder."""
    for line in subprocess.check_output(["ps", "-eo", "pid,args"], text=True).splitlines():
        pid, _, args = line.strip().partition(" ")
        if args.strip().startswith(str(BIN / name)) and str(folder) in args:
            return int(pid)
    raise AssertionError(f"no {name} runs")


def report(text):
    """Figures go to CTest's log."""
    print(text, file=sys.stderr, flush=True)


# Of the worst step: two orders above the 1e-16 of a sum of some 1e4 terms of either sign.
BALANCE_BOUND = 1e-12


def check_interface_balance(test, result, label):
    """The fluid gets all the momentum and power that the bodies give, in every step."""
    probes = result.probes()
    worst = [max(probes[f"interface.{what}_mismatch[1]"]) for what in ("momentum", "power")]
    report(f"{label}: worst step: mismatch of momentum {worst[0]:.1e}, power {worst[1]:.1e}")
    test.assertLess(max(worst), BALANCE_BOUND, label)
    test.assertGreater(sum(worst), 0, "exactly zero would mean: not measured")
