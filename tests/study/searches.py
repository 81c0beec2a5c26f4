# SPDX-License-Identifier: GPL-2.0-or-later
"""A search of which the best is known: a clamped beam in a weak field rises in proportion to the
field's part across it, k B sin(angle); with a price of c B^2 the best is at 90 degrees and
B = k / (2 c)."""
from studies import Study, testing

LIFT_M_T = 2.0767  # k, of one run at 0.1 mT across the beam
PRICE = 4500.0  # c [m/T2]
BEST_MT = 1e3 * LIFT_M_T / (2 * PRICE)
BEST_M = LIFT_M_T**2 / (4 * PRICE)

TEXT = f"""
name: bend
scene: {testing.ROOT / "tutorials/beam"}
set:
  magnetic_field.table: null
  output: null
  probes.every: 1 s
  bodies.beam.mesh.box.elements: [9, 2, 1]
parameters:
  magnitude: {{key: magnetic_field.constant.magnitude, range: [0 mT, 0.4 mT]}}
  direction: {{key: magnetic_field.constant.direction, range: [0 deg, 180 deg]}}
measures:
  lift: {{probe: "tip_uz[m]", number: final}}
maximize: lift - {PRICE} * magnitude ** 2
runs: 30
"""


class Search(Study):
    program = "magfsi.optimize"
