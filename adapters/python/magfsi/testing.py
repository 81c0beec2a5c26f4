# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the built magfsi for tests: start, read what it left, compare."""
import argparse
import atexit
import contextlib
import importlib
import io
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest
from unittest import mock

from magfsi import ending, runs
from magfsi.runs import EXIT_INPUT, BIN, ROOT, overrides, run_command, start  # noqa: F401

SMALL = ROOT / "tests/scenes/small_swimmer.yaml"
# SMALL's robot without its magnetization and place.
STRIP = ("mesh: {box: {size: [3.7 mm, 1.5 mm, 0.185 mm], elements: [10, 4, 1]}}, "
         "element: assumed_strain, "
         "material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}")
# A second one beside it, whose end goes to and fro towards it.
SECOND = {
    "fluid.box": "[20 mm, 4 mm, 8 mm]",
    "bodies.second":
        f"{{{STRIP}, initial: {{position: [13.4 mm, 2 mm, 4 mm]}}, "
        "prescribed_motion: [{face: x_min, oscillation: {amplitude: [2 mm, 0 m, 0.3 mm], "
        "frequency: 62.5 Hz, phase: 90 deg}}]}"}
SWIMMER = ROOT / "tutorials/swimmer/uniform.yaml"
QUICK_SWIMMER = ROOT / "tutorials/swimmer/quick.yaml"
PAPER = ROOT / "tutorials/swimmer/paper.yaml"
for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
    os.environ.setdefault(name, "1")


def new_folder():
    """Removed when the test ends, unless MAGFSI_KEEP is set."""
    folder = tempfile.mkdtemp(prefix="magfsi-test-")
    if "MAGFSI_KEEP" not in os.environ:
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def finish(process, began, folder, limit_s):
    """Fails if it takes longer than limit_s."""
    ended = runs.finish(process, began, folder, limit_s)
    if ended.late:
        raise AssertionError(f"still running after {limit_s} s\n{ended.out}\n{ended.err}")
    return ended


def run(scene, settings=None, ranks=None, limit_s=600, folder=None, restart=None, more=()):
    """magfsi run; fails if it takes longer than limit_s."""
    ended = runs.run(scene, folder or new_folder(), settings, ranks, restart, more, limit_s,
                     end=signal.SIGKILL)
    if ended.late:
        raise AssertionError(f"still running after {limit_s} s\n{ended.out}\n{ended.err}")
    return ended


def good_run(*args, **named):
    result = run(*args, **named)
    if result.code != 0:
        raise AssertionError(f"exit code {result.code}\n{result.out}\n{result.err}")
    return result


def output_of(*words, **named):
    """What a command prints; an AssertionError with the end of it if it fails."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **named)
    if done.returncode != 0:
        raise AssertionError(f"{words}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout


def called(name, refusals, *words):
    """A command of this package, as magfsi.study with its exceptions for bad input, as a shell starts it,
    but in this process: its code, out and err. A new process takes a second to import what it needs."""
    main = importlib.import_module(f"{name}.__main__").main
    out, err, code = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", [name, *map(str, words)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            ending.ended_well(main, name.replace(".", " "), refusals)
        except SystemExit as ended:
            code = ended.code
    return types.SimpleNamespace(code=code, out=out.getvalue(), err=err.getvalue())


def has(program):
    """Whether a program of packages-tests.txt is there. CI installs it, so that it shall not leave
    out anything unseen."""
    found = shutil.which(program) is not None
    if not found and os.environ.get("CI"):
        raise AssertionError(f"no {program} on this machine")
    return found


def needs(program):
    return unittest.skipUnless(has(program), f"no {program} here (apt-get install {program})")


_shared_runs = {}


def shared_run(scene, settings=None, ranks=None):
    """One good run for all tests of a script that only read what it left."""
    key = (scene, tuple(sorted((settings or {}).items())), ranks)
    if key not in _shared_runs:
        _shared_runs[key] = good_run(scene, settings, ranks)
    return _shared_runs[key]


PROMISE_S = 10  # a lost partner, a signal, a full disk: the end of the run


def check_prompt(test, result):
    """It ended within the 10 s that the product promises. Where it did not, the machine may be
    busy with other things: within the time that ten of the shortest runs take there, which is
    10 s where nothing else is to do."""
    if result.seconds <= PROMISE_S:
        return
    began = time.monotonic()
    good_run(SMALL, {"time.end": "50 us", "probes": "null"})
    short_s = time.monotonic() - began
    report(f"ended after {result.seconds:.1f} s, while a run of two steps takes {short_s:.1f} s")
    test.assertLess(result.seconds, 10 * short_s)


def main(**numbers):
    """Runs the script's tests; --kills 100 sets its global KILLS."""
    parser = argparse.ArgumentParser()
    for name, default in numbers.items():
        parser.add_argument(f"--{name.lower()}", dest=name, type=int, default=default)
    known, rest = parser.parse_known_args()
    vars(sys.modules["__main__"]).update(vars(known))
    unittest.main(argv=sys.argv[:1] + rest)


def causes(result):
    """What it said on stderr but for warnings, which come before the run."""
    return [line for line in result.err.strip().splitlines() if not line.startswith("warning: ")]


def check_refused(test, result, message=""):
    """Bad input ends with exit code 2 and one line."""
    test.assertEqual(result.code, EXIT_INPUT, result.err)
    test.assertEqual(len(causes(result)), 1, result.err)
    test.assertIn(message, result.err)
    report(result.err.strip())


def check_same_files(test, found, expected):
    """{name: bytes} of two folders are equal. Names what differs: unittest's own comparison of
    megabytes takes for ever when it fails."""
    test.assertEqual(sorted(found), sorted(expected))
    test.assertEqual([name for name in found if found[name] != expected[name]], [])


def processes_of(folder, *names):
    """Process ids of these participants of this run folder."""
    found = []
    for line in subprocess.check_output(["ps", "-eo", "pid,args"], text=True).splitlines():
        pid, _, args = line.strip().partition(" ")
        if args.strip().split(" ")[0] in [str(BIN / n) for n in names] and str(folder) in args:
            found.append(int(pid))
    return found


def process_of(folder, name):
    found = processes_of(folder, name)
    if not found:
        raise AssertionError(f"no {name} runs")
    return found[0]


def get_going(scene, settings, ranks=None, rows=3):
    """A run that has written some rows of probes, and its folder."""
    folder = new_folder()
    process = start(run_command(scene, folder, settings, ranks))
    wait_for_rows(folder, process, rows)
    return process, folder


def wait_for_rows(folder, process, rows):
    probes = os.path.join(folder, "probes.csv")

    def written():
        if not os.path.exists(probes):
            return False
        with open(probes) as file:
            return len(file.readlines()) > rows

    if not wait_until(written, process):
        raise AssertionError(f"ended before its time: {process.communicate()}")


def wait_until(condition, process, step_s=0.005, limit_s=120):
    """False if the process ended before."""
    for _ in range(round(limit_s / step_s)):
        if condition():
            return True
        if process.poll() is not None:
            return False
        time.sleep(step_s)
    raise AssertionError(f"what was waited for did not come within {limit_s} s")


def report(text):
    """Figures go to CTest's log."""
    print(text, file=sys.stderr, flush=True)


def difference(a, b, column):
    """Root mean square over time, of the largest value."""
    pairs = list(zip(a[column], b[column], strict=True))
    return math.sqrt(sum((x - y)**2 for x, y in pairs) / len(pairs)) / max(map(abs, a[column]))


def worst_difference(expected, found):
    """(largest difference of the physics, its column), of the largest value of the column or of
    its vector: a component may be zero by symmetry."""
    vector = {name: re.sub(r"_(u?)[xyz]\[", r"_\1[", name) for name in expected}
    scale = {}
    for name, values in expected.items():
        scale[vector[name]] = max([scale.get(vector[name], 0.0)] + [abs(v) for v in values])
    return max((abs(a - b) / scale[vector[n]], n) for n in expected
               if scale[vector[n]] > 0 and not n.startswith("interface.")
               for a, b in zip(expected[n], found[n], strict=True))


# Of the worst step: two orders above the 1e-16 of a sum of some 1e4 terms of either sign.
BALANCE_BOUND = 1e-12


def check_interface_balance(test, result, label):
    """The fluid gets all the momentum and power that the bodies give, in every step."""
    probes = result.probes()
    worst = [max(probes[f"interface.{what}_mismatch[1]"]) for what in ("momentum", "power")]
    report(f"{label}: worst step: mismatch of momentum {worst[0]:.1e}, power {worst[1]:.1e}")
    test.assertLess(max(worst), BALANCE_BOUND, label)
    test.assertGreater(sum(worst), 0, "exactly zero would mean: not measured")
