# SPDX-License-Identifier: GPL-2.0-or-later
"""The program magfsi-design as an object: equilibria of one body and their derivatives. Its messages
are described in adapters/solvers/design/design_server.cpp."""
import json
import subprocess
from dataclasses import dataclass, field

import numpy as np

from magfsi import runs
from magfsi.study.marked import InputError


class Failed(RuntimeError):
    """The program ended, or refused a request."""


@dataclass
class Design:
    """What a designer chooses, for one pose."""
    magnetization: np.ndarray  # (elements, 3) [A/m]
    field: np.ndarray  # (3) [T]
    stiffness: np.ndarray = field(default_factory=lambda: np.zeros(0))  # factor of each region
    thickness: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def numbers(self):
        return np.concatenate([self.magnetization.ravel(), self.field, self.stiffness, self.thickness])

    def head(self, what, **more):
        return {"do": what, "stiffness": len(self.stiffness), "thickness": len(self.thickness), **more}


@dataclass
class Found:
    """An equilibrium that was followed for a share of the way."""
    x: np.ndarray  # (nodes, 3) [m]
    share: float
    iterations: int

    @property
    def reached(self):
        return self.share == 1


class Program:
    """One process. Its attributes describe the body: rest (nodes, 3), centres and volumes of the
    elements, and `facts` with faces, regions, centre_line, held."""

    def __init__(self, scene, body="", sets=None):
        words = [runs.BIN / "magfsi-design", scene, *(["--body", body] if body else []),
                 *runs.overrides(sets or {})]
        self._process = subprocess.Popen([str(w) for w in words], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        line = self._process.stdout.readline()
        if not line:
            said = self._process.stderr.read().decode(errors="replace").strip()
            self.close()
            code = self._process.returncode
            raise (InputError if code == runs.EXIT_INPUT else Failed)(
                said.splitlines()[-1] if said else f"magfsi-design ended with exit code {code}")
        self.facts = json.loads(line)
        nodes, elements = self.facts["nodes"], self.facts["elements"]
        self.rest = self._numbers(3 * nodes).reshape(-1, 3)
        self.centres = self._numbers(3 * elements).reshape(-1, 3)
        self.volumes = self._numbers(elements)

    def close(self):
        self._process.stdin.close()
        self._process.wait()
        self._process.stdout.close()
        self._process.stderr.close()

    def _numbers(self, count):
        data = self._process.stdout.read(8 * count)
        if len(data) < 8 * count:
            raise Failed("magfsi-design ended in the middle of an answer")
        return np.frombuffer(data, dtype=float).copy()

    def _ask(self, head, *arrays):
        """The answer's line; the doubles after it are still to be read."""
        try:
            self._process.stdin.write(json.dumps(head).encode() + b"\n")
            for array in arrays:
                self._process.stdin.write(np.ascontiguousarray(array, dtype=float).tobytes())
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except OSError as error:
            raise Failed(f"magfsi-design has ended: {error}") from error
        if not line:
            raise Failed("magfsi-design has ended: "
                         + self._process.stderr.read().decode(errors="replace").strip())
        answer = json.loads(line)
        if "error" in answer:
            raise (InputError if answer.get("input") else Failed)(answer["error"])
        return answer

    def _found(self, head, *arrays):
        answer = self._ask(head, *arrays)
        return Found(self._numbers(self.rest.size).reshape(-1, 3), answer["share"],
                     answer["iterations"])

    def move(self, x, old, new, halvings=3):
        """From the equilibrium x of one design to that of another."""
        return self._found(new.head("move", halvings=halvings), x, old.numbers(), new.numbers())

    def rise(self, design):
        """From the body at rest, while all loads rise."""
        return self._found(design.head("rise"), design.numbers())

    def release(self, x, design):
        """Where the body comes to rest from x."""
        return self._found(design.head("release"), x, design.numbers())

    def sensitivity(self, x, design, entries, rows):
        """Derivatives of linear functionals of the positions: by the magnetisation
        (rows, elements, 3), by the field (rows, 3), by the factors of stiffness and of thickness
        (rows, regions).
        entries: array of (row, 3 node + axis, weight, 1 for a force of supports)."""
        self._ask(design.head("sensitivity", rows=rows, entries=len(entries)), x, design.numbers(),
                  entries)
        return (self._numbers(rows * self.volumes.size * 3).reshape(rows, -1, 3),
                self._numbers(rows * 3).reshape(rows, 3),
                self._numbers(rows * len(design.stiffness)).reshape(rows, len(design.stiffness)),
                self._numbers(rows * len(design.thickness)).reshape(rows, len(design.thickness)))

    def support(self, x, design):
        """Forces of clamps and rollers on the nodes (nodes, 3) [N]."""
        self._ask(design.head("support"), x, design.numbers())
        return self._numbers(self.rest.size).reshape(-1, 3)

    def locate(self, points):
        """Material points: (nodes (n, 8), weights (n, 8))."""
        points = np.atleast_2d(points)
        self._ask({"do": "locate", "points": len(points)}, points)
        both = self._numbers(16 * len(points)).reshape(-1, 16)
        return both[:, :8].astype(int), both[:, 8:]

    def centre_line(self):
        """Material points of the mesh's centre line, from one end to the other."""
        line = self.facts["centre_line"]
        return (np.array([p["node"] for p in line], dtype=int).reshape(-1, 8),
                np.array([p["weight"] for p in line], dtype=float).reshape(-1, 8))
