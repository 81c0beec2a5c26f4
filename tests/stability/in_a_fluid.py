# SPDX-License-Identifier: GPL-2.0-or-later
"""A magnetic sheet in water under loads and with properties far from the usual: each run ends
right, with no energy that nobody gave and no fluid lost."""

import unittest

import energy
from magfsi import testing

MATERIAL = "bodies.robot.material."
PERIODIC = {"fluid.boundaries": "{" + ", ".join(
    f"{axis}_{end}: periodic" for axis in "xyz" for end in ("min", "max")) + "}"}
SHAPE = ("robot.bend[rad]", "robot.end_to_end[m]")


def field(times_ms, millitesla, repeat=False):
    return {"magnetic_field": "{plane: xz, table: {time: [%s], magnitude: [%s], direction: "
            "50 deg, repeat: %s}}" % (", ".join(f"{t} ms" for t in times_ms),
                                      ", ".join(f"{b} mT" for b in millitesla),
                                      str(repeat).lower())}


def swim(settings, ranks=None):
    return testing.good_run(testing.SMALL, settings, ranks)


class InAFluid(unittest.TestCase):
    def check(self, label, settings, **expected):
        return energy.check(self, swim(settings), label, **expected)

    def test_ten_times_and_a_tenth_of_the_stiffness(self):
        stiff = self.check("10 G", {MATERIAL + "shear_modulus": "330 kPa",
                                    MATERIAL + "lame_lambda": "6.6 MPa"})
        usual = self.check("G", {})
        self.check("G / 10", {MATERIAL + "shear_modulus": "3.3 kPa",
                               MATERIAL + "lame_lambda": "66 kPa"})
        bends = [max(map(abs, probes["robot.bend[rad]"])) for probes in (stiff, usual)]
        self.assertLess(bends[0], bends[1])

    def test_lighter_than_the_fluid(self):
        for density in (10, 100, 500, 1000):
            self.check(f"{density} kg/m3", {MATERIAL + "density": f"{density} kg/m3"},
                       density=density)

    def test_ten_times_the_field_at_once(self):
        # It is pulled through itself.
        self.check("200 mT", {"magnetic_field.constant.magnitude": "200 mT",
                              "coupling.overlap": "allow"})

    def test_field_reversed_in_one_step(self):
        self.check("reversed", field([0, 1.5, 1.501, 4], [10, 10, -10, -10]))

    def test_field_reversed_200_times_a_second(self):
        self.check("200 Hz", {"time.end": "20 ms",
                              **field([0, 2.499, 2.5, 4.999, 5], [17, 17, -17, -17, 17],
                                      True)})

    def test_sheet_thinner_than_the_spacing_and_thicker(self):
        for spacing in ("0.5 mm", "0.125 mm"):
            self.check(f"spacing {spacing}",
                       {"fluid.spacing": spacing, "time.end": "2 ms"})

    def test_flow_started_at_once(self):
        probes = swim({**PERIODIC, "gravity": "", "magnetic_field": "",
                       "bodies.robot.magnetization": "", "bodies.robot.clamps": "[x_min]",
                       "fluid.initial_velocity": "[0 m/s, 0 m/s, 0.3 m/s]"}).probes()
        total = [sum(parts) for parts in zip(probes["kinetic_energy[J]"],
                                             probes["robot.energy_elastic[J]"],
                                             probes["robot.energy_kinetic[J]"])]
        self.assertLessEqual(max(total), total[0])
        self.assertGreater(max(probes["robot.max_displacement[m]"]), 0.1e-3)

    def test_carried_across_periodic_sides_and_ranks(self):
        away = {**PERIODIC, "gravity": "", "time.end": "20 ms"}
        flow = {**away, "fluid.initial_velocity": "[0.3 m/s, 0 m/s, 0.3 m/s]"}
        still, carried, divided = (swim(away).probes(), swim(flow).probes(),
                                   swim(flow, "structure=2,fluid=3").probes())
        # Its front passes the side after 3 ms; in all it moves by 4.8 mm of 8.
        self.assertGreater(carried["robot.com_x[m]"][-1] - carried["robot.com_x[m]"][0], 4e-3)
        for name in SHAPE:
            span = max(still[name]) - min(still[name])
            same = max(abs(a - b) for a, b in zip(carried[name], still[name])) / span
            rounding = max(abs(a - b) for a, b in zip(carried[name], divided[name])) / span
            testing.report(f"{name}: carried {same:.3f}, other ranks {rounding:.1e}")
            # Seen: 4.8 %, of a flow of 0.05 cells a step that the body must first follow;
            # it is 0.24 m/s after 20 ms.
            self.assertLess(same, 0.1)
            # Sums in another order, over 800 steps of a nonlinear body.
            self.assertLess(rounding, 1e-9)


if __name__ == "__main__":
    unittest.main()
