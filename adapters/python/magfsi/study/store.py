# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that are done are kept by what they are, and not done again."""
import datetime
import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

from magfsi import runs as programs
from magfsi.study import marked
from magfsi.study.product import Cell

FILE_KEYS = ("file", "script")  # of a scene
RECORD = "study.json"  # in the run folder; its presence says that the run is done
PARTICIPANTS = ("magfsi-structure", "magfsi-equilibrium", "magfsi-fluid-")


@dataclass
class Run:
    cell: Cell
    key: str = ""
    folder: Path | None = None
    facts: dict = field(default_factory=dict)
    record: dict = field(default_factory=dict)  # outcome, cause, core_s, ...
    summary: dict = field(default_factory=dict)
    errors: dict = field(default_factory=dict)  # by norm; absent where there is none
    notes: dict = field(default_factory=dict)  # why there is none

    def completed(self):
        return self.record.get("outcome") == "completed"


def _describe_machine():
    """What seconds were measured on, in words."""
    name, memory = platform.machine(), 0
    try:
        with open("/proc/cpuinfo") as file:
            name = next((line.split(":", 1)[1].strip() for line in file
                         if line.startswith("model name")), name)
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30
    except OSError:
        pass
    return f"{name}, {len(os.sched_getaffinity(0))} cores, {memory:.0f} GiB"


def _build():
    """What tells one build from another: the programs' bytes."""
    digest = hashlib.sha256()
    for path in sorted(programs.BIN.glob("magfsi-*")):
        if path.name.startswith(PARTICIPANTS):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def _explain(scene, cell):
    """(key figures, None), or (None, what is wrong with the scene)."""
    try:
        return programs.explain(scene, cell.sets, cell.ranks, as_json=True), None
    except subprocess.CalledProcessError as error:
        lines = error.stderr.strip().splitlines()
        return None, lines[-1] if lines else f"magfsi explain ended with {error.returncode}"


def _files_of(scene, sets):
    """Meshes, tables and scripts that the scene reads: its hash knows their names only."""
    def walk(value):
        if value.is_map():
            for key, child in value.entries().items():
                if key in FILE_KEYS and not child.is_map():
                    yield scene.parent / child.text()
                yield from walk(child)
        elif value.is_list():
            for child in value.items():
                yield from walk(child)
    files = list(walk(marked.read(scene)))
    files += [scene.parent / text for key, text in sets.items()
              if key.rpartition(".")[2] in FILE_KEYS]
    return [f for f in files if f.is_file()]


def scene_file(scene):
    return scene / "scene.yaml" if scene.is_dir() else scene


def _key(facts, files):
    text = json.dumps([facts["scene_hash"], facts["ranks"], facts["version"]], sort_keys=True)
    digest = hashlib.sha256(text.encode())
    for path in files:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _blame(study, cause):
    """The axis whose key the program does not take, by its message."""
    named = re.match(r"--set ([^:]+):", cause)
    for axis in study.axes.values():
        for setting in axis.settings:
            if named and named.group(1) in setting.sets:
                return axis.key_mark or setting.mark
    return study.scene_mark


def _check_input(study, runs):
    """A value with which no run can be is a mistake in the study."""
    def none_can(some):
        return some and all(not r.facts for r in some)
    if none_can(runs):
        cause = runs[0].record["cause"]
        _blame(study, cause).refuse(f"what no run can have ({cause})", "a scene that can run")
    for axis in study.axes.values():
        for setting in axis.settings:
            mine = [r for r in runs if r.cell.settings[axis.name] is setting]
            if none_can(mine):
                setting.mark.refuse(f"what no run can have ({mine[0].record['cause']})",
                                    "a scene that can run")


def planned(scene, cell, out):
    """The run of a cell, with its key, or refused by the program."""
    run = Run(cell)
    facts, fault = _explain(scene, cell)
    if facts:
        run.facts, run.key = facts, _key(facts, _files_of(scene, cell.sets))
        run.folder = out / "runs" / run.key
    else:
        run.record = {"outcome": "refused", "cause": fault}
    return run


def plan(study, cells, out):
    """All runs, each with its key; those that the program refuses are rows of their own."""
    runs = [planned(scene_file(study.scene), cell, out) for cell in cells]
    if not study.refusals_are_rows:
        _check_input(study, runs)
    return runs


def is_done(run):
    return bool(run.key) and (run.folder / RECORD).exists()


def _summary(run):
    try:
        return programs.read_summary(run.folder)
    except (OSError, ValueError):
        return {}


def load(run):
    """What the run left; False if it is not done."""
    try:
        run.record = json.loads((run.folder / RECORD).read_text())
    except (OSError, ValueError):
        return False
    run.summary = _summary(run)
    return True


def _execute(scene, limit_s, run, build, watch=None):
    shutil.rmtree(run.folder, ignore_errors=True)
    run.folder.parent.mkdir(parents=True, exist_ok=True)
    load = os.getloadavg()[0]
    ended = programs.run(scene, run.folder, run.cell.sets, run.cell.ranks, limit_s=limit_s,
                         watch=watch and (lambda: watch(run)))
    run.folder.mkdir(parents=True, exist_ok=True)
    run.summary = _summary(run)
    outcome, cause = run.summary.get("outcome"), run.summary.get("cause", "")
    if ended.late:
        fault = f"still running after {limit_s:g} s, the study's limit"
    else:
        fault = ended.error()
    if ended.code == programs.EXIT_INPUT:
        outcome, cause = "refused", fault
    elif ended.code != 0 and outcome in (None, "completed", "stopped"):
        outcome, cause = "stopped", fault or cause or f"exit code {ended.code}"
    run.record = {"outcome": outcome, "cause": cause, "exit_code": ended.code,
                  "core_s": ended.core_s, "elapsed_s": ended.seconds, "build": build,
                  "load_before": load, "run": run.cell.text(),
                  "date": datetime.date.today().isoformat(), "machine": _describe_machine()}
    partial = run.folder / (RECORD + ".part")
    partial.write_text(json.dumps(run.record, indent=2) + "\n")
    partial.replace(run.folder / RECORD)


def do(scene, limit_s, runs, check=None, again=False, quiet=False, watch=None):
    """Those that are missing, one after the other; returns how many were run now. check(run):
    after each of them. quiet: no line for each. watch(run): while it runs; true tells it to end."""
    build, now, others = _build(), set(), 0
    for number, run in enumerate(runs, 1):
        if not run.key:
            continue
        done = load(run)
        # The same scene in two cells is one run.
        if not done or (again and run.key not in now):
            if not quiet:
                print(f"{number} of {len(runs)}: {run.cell.text()}", end=" ", flush=True)
            _execute(scene, limit_s, run, build, watch)
            now.add(run.key)
            if not quiet:
                print(f"{run.record['outcome']} in {run.record['elapsed_s']:.1f} s "
                      f"{run.record['cause']}".rstrip(), flush=True)
            if check:
                check(run)
        elif run.record.get("build") != build:
            others += 1
    if others and not quiet:
        print(f"{others} of {len(runs)} runs are kept from another build of magfsi; --again "
              "repeats them", file=sys.stderr)
    return len(now)
