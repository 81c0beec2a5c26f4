# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes with a controller: its script is written where the run is."""
from pathlib import Path

from magfsi import testing

EVERY = testing.ROOT / "tests/scenes/every_structure_effect.yaml"
# The strip alone, free, in a field of 17 mT: 10 calls.
ALONE = {"time.end": "10 ms", "probes.every": "0.5 ms", "platform": "", "contact": "",
         "magnetic_field.gradient": "", "output.structure.every": "2 ms"}
COUPLED = {"time.end": "2 ms", "output.structure.every": "0.25 ms", "output.fluid.every": "0.5 ms"}

# What it does hangs on all it has seen, and on random numbers of its own.
WITH_A_STATE = """
import random

class Controller:
    def __init__(self):
        self.random, self.sum = random.Random(7), 0.0

    def step(self, t, probes):
        self.sum += sum(probes.values())
        direction = 30 + 20 * self.random.random() + 1e3 * self.sum
        return {"constant": {"magnitude": "9 mT", "direction": f"{direction!r} deg"}}
"""


def of(body):
    """A script of which step does this."""
    return "\n".join(["class Controller:", "    def step(self, t, probes):",
                      *(f"        {line}" for line in body.splitlines())])


def with_control(settings, text, every="1 ms", probes=(), folder=None, timeout=None):
    """The settings and a controller of this text."""
    script = Path(folder or testing.new_folder()) / "steer.py"
    script.write_text(text)
    more = {"probes": f"[{', '.join(probes)}]" if probes else None, "timeout": timeout}
    keys = "".join(f", {key}: {value}" for key, value in more.items() if value)
    return {**settings, "control": f"{{script: {script}, every: {every}{keys}}}"}
