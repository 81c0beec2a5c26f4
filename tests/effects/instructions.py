"""Instructions that a participant executes in the steps of a scene, counted by callgrind: what
happens within TaskList::run, nothing of start and end. What the clock or the partner decides is
taken out: lines of progress, LAMMPS's table of timings, and, in a coupled scene, MPI and the
loops that wait for messages. So is what libc does to compare and copy strings, a few of which
LAMMPS reads in each step: a string that crosses a page of memory takes it another way, and where
strings lie changes with the length of the scene's path (0.3 % of the instructions were seen)."""

import os
import re
import subprocess
from pathlib import Path

import magfsi_runs as magfsi

# With all that they call.
CLOCK = re.compile(r"magfsi::output::Progress::update\(|LAMMPS_NS::(Finish::end|Output::setup)\(")
PARTNER = re.compile(r"P?MPI_|magfsi::coupler::(wait_|waited_s)")
TEXT = re.compile(r"__str\w+$")
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "LD_BIND_NOW": "1"}


def counted(file):
    return ["valgrind", "--tool=callgrind", f"--callgrind-out-file={file}",
            "--compress-strings=no", "--compress-pos=no",
            "--toggle-collect=magfsi::coupler::TaskList::run()"]


def total(file, apart):
    """Of callgrind's file; apart: of the names of the functions that do not count, with
    all that they call."""
    sum_, function, called = 0, "", None
    for line in Path(file).read_text().splitlines():
        if line.startswith("fn="):
            function = line[3:]
        elif line.startswith("cfn="):
            called = line[4:]
        elif line[:1].isdigit():
            # A line after `calls=` is the cost of what is called, any other of the function.
            cost = int(line.split()[1])
            if called is None:
                sum_ += 0 if TEXT.match(function) else cost
            elif apart(called) and not apart(function):
                sum_ -= cost
            called = None
    if sum_ <= 0:
        raise AssertionError(f"{file} has no steps")
    return sum_


def finished(command):
    words = [str(word) for word in command]
    result = subprocess.run(words, capture_output=True, text=True,
                            env={**os.environ, **ENVIRONMENT})
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(words)}\n{result.stdout}{result.stderr}")


def of_steps(program, scene, settings):
    """program: its path; alone, on one rank, without a partner."""
    folder = magfsi.new_folder()
    finished([*counted(f"{folder}/count"), program, scene, "--out", folder,
              "--progress", "plain", *magfsi.overrides(settings)])
    return total(f"{folder}/count", lambda name: CLOCK.match(name))


def of_coupled_steps(program, scene, settings):
    """program: the path of one side's, which is counted; the other side runs beside it."""
    folder = magfsi.new_folder()
    words = [scene, "--out", folder, "--progress", "plain", *magfsi.overrides(settings)]
    other = {"magfsi-structure": "magfsi-fluid-lbm", "magfsi-fluid-lbm": "magfsi-structure"}
    sides = {Path(program).name: [*counted(f"{folder}/count"), program],
             other[Path(program).name]: [magfsi.BIN / other[Path(program).name]]}
    finished(["mpirun", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1",
              "-n", "1", *sides["magfsi-structure"], *words, ":",
              "-n", "1", *sides["magfsi-fluid-lbm"], *words])
    return total(f"{folder}/count", lambda name: CLOCK.match(name) or PARTNER.match(name))
