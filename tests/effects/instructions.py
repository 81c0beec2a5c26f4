"""Instructions that a participant executes in the steps of a scene, counted by callgrind: what
happens within TaskList::run and nothing of start and end."""

import os
import re
import subprocess

import magfsi_runs as magfsi


def of_steps(program, scene, settings):
    """program: its path; alone, on one rank, without a partner."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
               "--toggle-collect=magfsi::coupler::TaskList::run()", program, scene,
               "--out", magfsi.new_folder(), "--progress", "plain",
               *magfsi.overrides(settings)]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                            env={**os.environ, "OMP_NUM_THREADS": "1"})
    count = re.search(r"Collected : (\d+)", result.stderr)
    if result.returncode != 0 or not count or int(count[1]) == 0:
        raise AssertionError(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return int(count[1])
