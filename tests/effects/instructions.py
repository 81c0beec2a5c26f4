"""Instructions that a participant executes in the steps of a scene, counted by callgrind: what
happens within TaskList::run, nothing of start and end, and without the lines of progress, whose
number is the clock's."""

import os
import re
import subprocess

import magfsi_runs as magfsi


def of_steps(program, scene, settings):
    """program: its path; alone, on one rank, without a partner."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
               "--toggle-collect=magfsi::coupler::TaskList::run()",
               "--toggle-collect=magfsi::output::Progress::update(long)", program, scene,
               "--out", magfsi.new_folder(), "--progress", "plain",
               *magfsi.overrides(settings)]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                            env={**os.environ, "OMP_NUM_THREADS": "1", "LD_BIND_NOW": "1"})
    count = re.search(r"Collected : (\d+)", result.stderr)
    if result.returncode != 0 or not count or int(count[1]) == 0:
        raise AssertionError(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return int(count[1])
