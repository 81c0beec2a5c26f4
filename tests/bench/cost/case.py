# SPDX-License-Identifier: GPL-2.0-or-later
"""A case of coverage.py: a scene, a number of its run, and what is known of that otherwise."""
from dataclasses import dataclass, field

from magfsi import runs

BUDGET_S = 40.0  # for the runs of a case, by the cost model
BALL = runs.ROOT / "docs/accuracy/ball.msh"  # of diameter 1, held by its surface "all"


@dataclass
class Case:
    name: str
    scene: str
    probe: str
    true: float  # None: of the first of the runs in `finer`
    reference: str
    norm: str = "final"
    known_to: float = 0.0  # the reference itself, as a part of it
    start_s: float = None
    budget_s: float = BUDGET_S
    finer: list = field(default_factory=list)  # settings of two runs of the scene, the finest first
