# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions that a participant executes in the steps of a scene, counted by callgrind: what
happens within TaskList::run, nothing of start and end. What the clock or the partner decides is
taken out: lines of progress, LAMMPS's table of timings, and, in a coupled scene, MPI and the
loops that wait for messages. So is what libc does to compare and copy strings, a few of which
LAMMPS reads in each step: a string that crosses a page of memory takes it another way, and where
strings lie changes with the length of the scene's path (0.3 % of the instructions were seen). And
so is its search for free memory, which MPI's messages take pieces of when they come (0.15 %)."""

import os
import re
import subprocess
from pathlib import Path

from magfsi import testing

# With all that they call.
CLOCK = re.compile(r"magfsi::output::Progress::update\(|LAMMPS_NS::(Finish::end|Output::setup)\(")
# wait_until too, a template in an unnamed namespace: what it calls is already taken out with its caller.
PARTNER = re.compile(r"P?MPI_|(void )?magfsi::coupler::(\(anonymous namespace\)::)?(wait_|waited_s)")
LIBC = re.compile(r"(__str\w+|_int_malloc|_int_free|unlink_chunk\S*|malloc_consolidate|sysmalloc|"
                  r"alloc_perturb)$")
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
                sum_ += 0 if LIBC.match(function) else cost
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


def run_alone(program, scene, settings):
    """Returns callgrind's file."""
    folder = testing.new_folder()
    finished([*counted(f"{folder}/count"), program, scene, "--out", folder,
              "--progress", "plain", *testing.overrides(settings)])
    return f"{folder}/count"


def of_steps(program, scene, settings):
    """program: its path; alone, on one rank, without a partner."""
    return total(run_alone(program, scene, settings), CLOCK.match)


def share_of_steps(program, scene, settings, name):
    """The part of them in calls of a function, by a part of its name."""
    file = run_alone(program, scene, settings)
    whole = total(file, CLOCK.match)
    rest = total(file, lambda called: CLOCK.match(called) or name in called)
    if rest == whole:
        raise AssertionError(f"no call of {name} in the steps of {program}")
    return 1 - rest / whole


def run_both(scene, settings, folder, prefix):
    """The two sides of a coupled scene, one rank each; prefix: {program's name: the words
    that start it}."""
    words = [scene, "--out", folder, "--progress", "plain", *testing.overrides(settings)]
    finished(["mpirun", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1",
              "-n", "1", *prefix["magfsi-structure"], *words, ":",
              "-n", "1", *prefix["magfsi-fluid-lbm"], *words])


def beside_partner(name):
    return CLOCK.match(name) or PARTNER.match(name)


def of_coupled_steps(program, scene, settings):
    """program: the path of one side's, which is counted; the other side runs beside it."""
    folder = testing.new_folder()
    prefix = {name: [testing.BIN / name] for name in ("magfsi-structure", "magfsi-fluid-lbm")}
    prefix[Path(program).name] = [*counted(f"{folder}/count"), program]
    run_both(scene, settings, folder, prefix)
    return total(f"{folder}/count", beside_partner)


def of_both_sides(scene, settings):
    """Of the structure and of the fluid, counted in one run."""
    folder = testing.new_folder()
    names = ("magfsi-structure", "magfsi-fluid-lbm")
    run_both(scene, settings, folder,
             {name: [*counted(f"{folder}/{name}"), testing.BIN / name] for name in names})
    return [total(f"{folder}/{name}", beside_partner) for name in names]
