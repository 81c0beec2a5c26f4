# SPDX-License-Identifier: GPL-2.0-or-later
"""The built programs: started, waited for, and what they leave in a run folder."""
import argparse
import csv
import json
import math
import os
import resource
import signal
import subprocess
import time
import xml.etree.ElementTree
from pathlib import Path

try:
    from magfsi.place import PROGRAMS, ROOT  # of an installed package: setup.py, Install.cmake
except ImportError:
    ROOT = Path(__file__).resolve().parents[3]
    PROGRAMS = ROOT / "build/release/bin"
# Where the programs are; the launcher and CTest set it. ROOT has the tutorials.
BIN = Path(os.environ.get("MAGFSI_BIN", PROGRAMS)).resolve()
EXIT_INPUT = 2
WATCHED_EVERY_S = 0.5
MANY_ROWS = 2000


def read_table(path, kind=str):
    """Columns of a CSV file by name, as lists of words, or of numbers for the kind float; lines of
    comment begin with #. A row that a run was stopped in is left out."""
    with open(path, newline="") as file:
        names, *lines = [line for line in file if not line.startswith("#")] or [""]
    names = next(csv.reader([names]), [])
    if kind is float and len(lines) > MANY_ROWS:
        import numpy  # reads a long course in less than half of the time, but not all that is allowed here
        try:
            values = numpy.loadtxt(lines, delimiter=",", comments=None, ndmin=2)
            if values.shape[1] == len(names):
                return dict(zip(names, values.T.tolist()))
        except ValueError:  # a row that a run was stopped in
            pass
    rows = [*csv.reader(lines)]
    rows = [row for row in rows if len(row) == len(names)]
    return {name: [kind(row[i]) for row in rows] for i, name in enumerate(names)}


def read_rows(path):
    """Rows of a CSV file, each {column: word}."""
    table = read_table(path)
    return [dict(zip(table, row)) for row in zip(*table.values())]


def read_summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text())


def frames(folder, collection="structure.pvd"):
    """[(time in s, file)] of a run's collection for ParaView."""
    path = Path(folder) / collection
    entries = xml.etree.ElementTree.parse(path).iter("DataSet")
    return [(float(e.get("timestep")), path.parent / e.get("file")) for e in entries]


class Run:
    """A finished run: exit code, output, seconds, run folder."""

    def __init__(self, code, out, err, seconds, folder, late=False):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds
        self.folder, self.late = Path(folder), late
        self.core_s = 0.0  # processor time of all processes, start-up included

    def error(self):
        """The last line on stderr."""
        return (self.err.strip().splitlines() or [""])[-1]

    def summary(self):
        return read_summary(self.folder)

    def probes(self):
        return read_table(self.folder / "probes.csv", float)


def setting(text):
    """Of a command's --set, for argparse: key and value."""
    key, equals, value = text.partition("=")
    if not equals or not key:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed path.to.key=value")
    return key, value


def overrides(settings):
    """settings: {"path.to.key": value}."""
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def command(verb, scene, settings=None, ranks=None):
    words = [BIN / "magfsi", verb, scene, *overrides(settings or {})]
    return words + (["--ranks", ranks] if ranks else [])


def start(words, bound=False):
    """bound: ends with the thread that starts it, even where that one is killed."""
    binding = ["setpriv", "--pdeathsig", "TERM"] if bound else []
    return subprocess.Popen([*binding, *(str(word) for word in words)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, start_new_session=True)


def _communicate(process, limit_s, watch):
    """(output, errors); None when the limit was reached. A run of which watch() says so is told to
    end before."""
    until = math.inf if limit_s is None else time.monotonic() + limit_s
    while True:
        left = until - time.monotonic()
        try:
            wait_s = min(left, WATCHED_EVERY_S) if watch else left
            return process.communicate(timeout=None if wait_s == math.inf else max(wait_s, 0))
        except subprocess.TimeoutExpired:
            if time.monotonic() >= until:
                return None
        if watch():
            process.send_signal(signal.SIGTERM)
            watch = None


def finish(process, began, folder, limit_s, end=signal.SIGKILL, watch=None):
    """end: what a process gets that runs for longer, and the run is `late`. watch(): looked at
    while it runs; true, and the run is told to end."""
    late = False
    try:
        ended = _communicate(process, limit_s, watch)
        if ended is None:
            late = True
            os.killpg(process.pid, end) if end == signal.SIGKILL else process.send_signal(end)
            ended = process.communicate()
        out, err = ended
    except BaseException:  # an interruption ends the run as well
        process.send_signal(signal.SIGTERM)
        process.wait()
        raise
    return Run(process.returncode, out, err, time.monotonic() - began, folder, late)


def _processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_command(scene, folder, settings=None, ranks=None, restart=None, more=()):
    restarted = ["--restart", restart] if restart else []
    return [*command("run", scene, settings, ranks), "--out", folder, *restarted, *more]


def run(scene, folder, settings=None, ranks=None, restart=None, more=(), limit_s=None,
        end=signal.SIGTERM, watch=None):
    """magfsi run, to its end or to the limit, or until watch() is true."""
    words = run_command(scene, folder, settings, ranks, restart, more)
    before, began = _processor_s(), time.monotonic()
    ended = finish(start(words, bound=True), began, folder, limit_s, end, watch)
    ended.core_s = _processor_s() - before
    return ended


def explain(scene, settings=None, ranks=None, as_json=False):
    """What magfsi explain prints, or its key figures. Raises CalledProcessError."""
    words = [*command("explain", scene, settings, ranks), *(["--json"] if as_json else [])]
    text = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                          check=True).stdout
    return json.loads(text) if as_json else text
