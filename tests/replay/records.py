"""A small run that was recorded, and how to play it."""

import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import magfsi_runs as magfsi  # noqa: E402

# Overrides without a value take a key away: a record cannot audit the interface.
SHORT = {"time.end": "1 ms", "probes.interface_balance": ""}


def run(*options, settings=None, folder=None):
    folder = folder or magfsi.new_folder()
    command = [magfsi.BIN / "magfsi", "run", magfsi.SMALL, "--out", folder,
               *magfsi.overrides({**SHORT, **(settings or {})}), *options]
    done = subprocess.run([str(w) for w in command], capture_output=True, text=True, timeout=120)
    return magfsi.Run(done.returncode, done.stdout, done.stderr, 0, folder)


def good(*options, **named):
    result = run(*options, **named)
    if result.code != 0:
        raise AssertionError(f"exit code {result.code}\n{result.out}\n{result.err}")
    return result


def differences(result):
    """replay.csv's second column."""
    lines = (result.folder / "replay.csv").read_text().splitlines()[1:]
    return [float(line.split(",")[1]) for line in lines]
