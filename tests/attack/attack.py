# SPDX-License-Identifier: GPL-2.0-or-later
"""What the attacks share: who is at work for a run folder, and what is left of them."""

import os
import signal
import time
from pathlib import Path

from magfsi import testing

# For what must come, on a machine with other work; the product's own promise is 10 s.
PATIENCE_S = 120
SETTINGS = {"time.end": "2 ms", "checkpoint.every": "0.1 ms", "probes.every": "25 us",
            "output.fluid.every": "1 ms"}
RANKS = "structure=1,fluid=1"


def state(pid):
    """R, S, T, Z, ... of the process table; nothing if there is no such process."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return ""


def at_work(folder):
    """{program: pid} of the processes with this run folder in their command line. A zombie is
    only what init has not collected."""
    found = {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
        except (FileNotFoundError, ProcessLookupError):
            continue
        if str(folder) in words and state(entry.name) not in ("Z", "X", ""):
            name = Path(words[0]).name
            found["mpirun" if name == "prterun" else name] = int(entry.name)  # Open MPI 5's name
    return found


def all_at_work(folder):
    """Waits until a coupled run has all of its processes."""
    wait_for(lambda: len(at_work(folder)) == 4, f"the run in {folder}")
    return at_work(folder)


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not within {PATIENCE_S} s")
        time.sleep(0.01)


def send(pid, number):
    """False where the process is gone."""
    try:
        os.kill(pid, number)
        return True
    except ProcessLookupError:
        return False


def start(folder, settings=None, more=()):
    return testing.start(testing.run_command(testing.SMALL, folder, settings or SETTINGS, RANKS,
                                             more=more))


def finish(process, folder):
    return testing.finish(process, time.monotonic(), folder, PATIENCE_S)


def run(folder, settings=None, restart=None, more=()):
    return testing.run(testing.SMALL, settings or SETTINGS, RANKS, PATIENCE_S, folder, restart,
                       more)


def end(process, folder):
    """Of what a test leaves running."""
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
        finish(process, folder)


def results(folder):
    """Every file of physics: series, fields, checkpoints."""
    folder = Path(folder)
    files = [folder / "probes.csv", *sorted(folder.glob("fields/*")),
             *sorted(folder.glob("checkpoint*.h5"))]
    return {str(f.relative_to(folder)): f.read_bytes() for f in files}


def one_line(test, ended, code, message):
    test.assertEqual(ended.code, code, ended.out + ended.err)
    lines = testing.causes(ended)
    test.assertEqual(len(lines), 1, ended.err)
    test.assertTrue(lines[0].startswith("magfsi"), ended.err)
    test.assertIn(message, lines[0])
    testing.report(lines[0])
