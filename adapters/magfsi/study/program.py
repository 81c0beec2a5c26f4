"""The built magfsi, by its command line."""
import hashlib
import json
import os
import resource
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

EXIT_INPUT = 2


def folder():
    """Where the programs are: the launcher says it."""
    return Path(os.environ.get("MAGFSI_BIN",
                               Path(__file__).resolve().parents[3] / "build/release/bin"))


def build():
    """What tells one build from another: the programs' bytes."""
    digest = hashlib.sha256()
    for name in ("magfsi-structure", "magfsi-equilibrium", "magfsi-fluid-lbm",
                 "magfsi-fluid-openfoam"):
        path = folder() / name
        if path.exists():
            digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def _words(command, scene, cell):
    words = [str(folder() / "magfsi"), command, str(scene)]
    for key, text in cell.sets.items():
        words += ["--set", f"{key}={text}"]
    if cell.ranks:
        words += ["--ranks", cell.ranks]
    return words


def explain(scene, cell):
    """(key figures, None), or (None, what is wrong with the scene)."""
    done = subprocess.run([*_words("explain", scene, cell), "--json"], capture_output=True,
                          text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        return None, lines[-1] if lines else f"magfsi explain ended with {done.returncode}"
    return json.loads(done.stdout), None


@dataclass
class Ended:
    code: int
    core_s: float  # processor time of all processes, start-up included
    elapsed_s: float
    error: str  # last line on stderr


def _processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(scene, cell, out, limit_s):
    """To its end, or to the limit. An interruption ends the run as well."""
    before, began = _processor_s(), time.monotonic()
    process = subprocess.Popen([*_words("run", scene, cell), "--out", str(out)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               start_new_session=True)
    late = ""
    try:
        _, error = process.communicate(timeout=limit_s)
    except subprocess.TimeoutExpired:
        late = f"still running after {limit_s:g} s, the study's limit"
        process.send_signal(signal.SIGTERM)
        _, error = process.communicate()
    except BaseException:
        process.send_signal(signal.SIGTERM)
        process.wait()
        raise
    lines = error.strip().splitlines()
    return Ended(process.returncode, _processor_s() - before, time.monotonic() - began,
                 late or (lines[-1] if lines else ""))
