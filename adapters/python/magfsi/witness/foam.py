# SPDX-License-Identifier: GPL-2.0-or-later
"""OpenFOAM's stock programs: started, and what they write."""
import os
import re
import shutil
import subprocess

import numpy as np

from magfsi import runs

PROJECT = "/usr/share/openfoam"  # of Debian's package, which sets no environment
# With it OpenFOAM 1912 reads function objects also where a newer GCC has built it (digest_stream.cpp).
DIGEST = runs.BIN.parent / "lib/libmagfsi_openfoam_digest.so"
# A mesh beyond these no longer gives the order of the schemes: OpenFOAM's own warnings (checkMesh).
NON_ORTHOGONAL_DEG, SKEWNESS = 75.0, 4.0
# Of a plane flow with one cell across, whose thickness means nothing.
HARMLESS = ("aspect ratio",)


class Failed(Exception):
    """A program of OpenFOAM: its name, and the end of what it said."""


_under_way = set()


def stop():
    """Ends the programs under way."""
    for process in list(_under_way):
        process.terminate()


def environment():
    """Variables for OpenFOAM's programs."""
    variables = {"WM_PROJECT_DIR": PROJECT, **os.environ}
    if DIGEST.exists():
        variables["LD_PRELOAD"] = f"{DIGEST} {variables.get('LD_PRELOAD', '')}"
    return variables


def run(program, case):
    """What it says, which is in log.PROGRAM as well."""
    if not shutil.which(program):
        raise Failed(f"{program}: not there; install OpenFOAM: apt-get install openfoam")
    log = case / f"log.{program}"
    with open(log, "w") as file:
        # In the case's folder: 1912 looks for the tables of moving points from where it is called.
        process = subprocess.Popen([program], cwd=case, env=environment(), stdout=file,
                                   stderr=subprocess.STDOUT)
        _under_way.add(process)
        try:
            code = process.wait()
        except BaseException:
            process.terminate()
            raise
        finally:
            _under_way.discard(process)
    text = log.read_text(errors="replace")
    if code != 0:
        raise Failed(f"{program} ended with {code}: {' '.join(text.split()[-40:])} ({log})")
    return text


def _numbers(path):
    """Entries of a list file as text, without header and comments."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", path.read_text(), flags=re.S)
    text = text[text.index("}") + 1:]
    return text[text.index("(") + 1:text.rindex(")")]


def patch(case, name):
    """Points (all, 3) of the mesh, and the faces of a patch as rows of point numbers."""
    mesh = case / "constant/polyMesh"
    numbers = _numbers(mesh / "points").replace("(", " ").replace(")", " ").split()
    points = np.array(numbers, float).reshape(-1, 3)
    entry = re.search(rf"\b{name}\s*\{{(.*?)\}}", (mesh / "boundary").read_text(), re.S).group(1)
    count, start = (int(re.search(rf"{key}\s+(\d+)", entry).group(1)) for key in ("nFaces", "startFace"))
    faces = re.findall(r"\d+\(([\d ]+)\)", _numbers(mesh / "faces"))[start:start + count]
    return points, np.array([[int(n) for n in face.split()] for face in faces])


def followed(text):
    """From the output of moveDynamicMesh: (last time of a sound mesh, what was wrong after it); the
    second is None if all were sound."""
    last = 0.0
    patterns = {"angle": r"non-orthogonality Max: ([-0-9.e+]+)", "skewness": r"[Mm]ax skewness = ([-0-9.e+]+)"}
    for part in re.split(r"^Time = ", text, flags=re.M)[1:]:
        time = float(part.split()[0])
        worst = {key: max(map(float, re.findall(pattern, part)), default=0.0)
                 for key, pattern in patterns.items()}
        faults = [line for line in part.splitlines() if line.strip().startswith("***")
                  and not any(word in line for word in HARMLESS)]
        if worst["angle"] > NON_ORTHOGONAL_DEG:
            return last, f"faces {worst['angle']:.0f} degrees from orthogonal (allowed {NON_ORTHOGONAL_DEG:.0f})"
        if worst["skewness"] > SKEWNESS:
            return last, f"a skewness of {worst['skewness']:.2g} (allowed {SKEWNESS:.0f})"
        if faults:
            return last, faults[0].strip(" *")
        last = time
    return last, None


def series(case, name):
    """Times and the rows of total, pressure and viscous vectors of a file of the function object forces."""
    file = next(case.glob(f"postProcessing/forces/*/{name}.dat"))
    rows = [line.replace("(", " ").replace(")", " ").split() for line in file.read_text().splitlines()
            if not line.startswith("#")]
    table = np.array(rows, float)
    return table[:, 0], table[:, 1:].reshape(len(table), -1, 3)


def traction(case):
    """Times, and of each face of the strip pressure and wall shear stress, both over the density."""
    out = {}
    for folder in (case / "postProcessing/traction").iterdir():
        found = {}
        for file in folder.glob("*.raw"):
            pressure = file.stem.startswith("p_") or file.stem.endswith("_p")
            found["p" if pressure else "shear"] = np.loadtxt(file, ndmin=2)
        out[float(folder.name)] = (found["p"][:, 3], found["shear"][:, 3:6])
    times = sorted(out)
    return np.array(times), np.array([out[t][0] for t in times]), np.array([out[t][1] for t in times])
