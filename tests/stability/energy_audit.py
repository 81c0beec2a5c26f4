# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy audit closes: what the works give is in the energies and the losses, term by term."""

import unittest

from magfsi import testing

AUDIT = {"probes.energy_audit": "true"}
STRIP = testing.ROOT / "tests/stability/audited_strip.yaml"
VOLUME_M3 = 3.7e-3 * 1.5e-3 * 0.185e-3
WATER, GRAVITY = 1000.0, 9.81


def column(probes, name):
    return probes[f"audit.{name}[J]"]


class EnergyAudit(unittest.TestCase):
    def residual(self, label, result, bound):
        audit = result.summary()["energy_audit"]
        testing.report(f"{label}: {audit}")
        self.assertGreater(audit["work_j"], 0, label)
        self.assertGreater(audit["residual_j"], 0, f"{label}: not measured")
        self.assertLess(audit["residual"], bound, label)
        worst = max(map(abs, column(result.probes(), "residual")))
        self.assertAlmostEqual(worst / audit["residual_j"], 1)
        return audit

    def test_every_term_of_a_body_alone(self):
        # A magnetic strip with viscosity and drag slides on a platform with friction, pulled
        # by one end. Seen: 1.6e-3, of the onset of the platform's springs within a step.
        run = testing.good_run(STRIP)
        self.residual("strip", run, 0.01)
        probes = run.probes()
        for name in ("lost_viscosity", "lost_drag", "lost_friction"):
            lost = column(probes, name)
            self.assertGreater(lost[-1], 0, name)
            self.assertTrue(all(a <= b for a, b in zip(lost, lost[1:])), name)
        residual = max(map(abs, column(probes, "residual")))
        for name in ("work_field", "work_weight", "work_motion", "lost_viscosity",
                     "lost_drag", "lost_friction", "platform"):
            # Above the residual: without any of them it would be larger.
            self.assertGreater(max(map(abs, column(probes, name))), 2 * residual, name)

    def test_rounding_of_a_body_at_rest_is_no_gain(self):
        # Nothing acts: all energies are rounding, here some 1e-21 J; G V is 3e-5 J.
        run = testing.good_run(STRIP, {
            **AUDIT, "magnetic_field": "null", "gravity": "null", "platform": "null",
            "bodies.strip.prescribed_motion": "null", "time.end": "5 ms"})
        self.assertEqual(run.summary()["outcome"], "completed")
        self.assertLess(run.summary()["energy_audit"]["work_j"], 1e-18)

    def test_in_fluids_of_a_tenth_and_ten_times_the_density(self):
        for density in (100, 10000):
            run = testing.good_run(testing.SMALL, {
                **AUDIT, "bodies.robot.material.density": f"{density} kg/m3"})
            # Seen: 3e-5 and 2.2e-4, of the substeps.
            self.residual(f"{density} kg/m3", run, 1e-3)
            self.fluid_is_counted_once(run.probes(), density)
            self.columns_add_up(run.probes())

    def fluid_is_counted_once(self, probes, density):
        whole, once = column(probes, "kinetic_whole"), column(probes, "kinetic")
        largest = max(whole)
        for w, o, k in zip(whole, once, probes["robot.energy_kinetic[J]"]):
            self.assertAlmostEqual(w / largest, k / largest)
            self.assertAlmostEqual(o / largest, (1 - WATER / density) * w / largest)
        weight = (density - WATER) * VOLUME_M3 * GRAVITY
        z = probes["robot.com_z[m]"]
        for work, height in zip(column(probes, "work_weight"), z):
            self.assertAlmostEqual(work / weight, z[0] - height, delta=1e-12)
        fluid = [kinetic + sound - given for kinetic, sound, given in zip(*(
            column(probes, name) for name in ("fluid_kinetic", "fluid_sound", "work_layer")))]
        given = [-(k - fluid[0]) for k in fluid]
        for to_fluid, less, lost in zip(column(probes, "given_to_fluid"), given,
                                        column(probes, "lost_in_fluid")):
            self.assertAlmostEqual(to_fluid + less, lost, delta=1e-9 * max(
                column(probes, "given_to_fluid")))

    # The equation of the residual in docs/energy_audit.md, column by column.
    def columns_add_up(self, probes):
        stored = ("elastic", "kinetic", "given_to_fluid")
        paid = ("work_field", "work_weight", "enclosed_lag")
        scale = max(column(probes, "given_to_fluid"))
        for i, residual in enumerate(column(probes, "residual")):
            sums = [sum(column(probes, name)[i] - column(probes, name)[0] for name in names)
                    for names in (stored, paid)]
            self.assertAlmostEqual(sums[0] - sums[1], residual, delta=1e-9 * scale)

    def test_the_implicit_scheme(self):
        run = testing.good_run(testing.SMALL, {
            **AUDIT, "time.end": "1 ms", "coupling.scheme": "implicit"})
        # Seen: 9e-4; the field comes at once and little work is done in 1 ms.
        self.residual("implicit", run, 5e-3)

    def test_same_on_other_ranks_and_over_a_restart(self):
        short = {**AUDIT, "time.end": "1 ms", "checkpoint.every": "0.5 ms"}
        whole = testing.good_run(testing.SMALL, short)
        folder = testing.new_folder()
        testing.good_run(testing.SMALL, {**short, "time.end": "0.5 ms"}, folder=folder)
        again = testing.finish(testing.start(
            [testing.BIN / "magfsi", "run", testing.SMALL, "--out", folder, "--restart", "latest",
             *testing.overrides(short)]), 0, folder, 600)
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(whole.probes(), again.probes())
        for key in ("work_j", "residual_j", "gained_j"):
            self.assertEqual(whole.summary()["energy_audit"][key],
                             again.summary()["energy_audit"][key])
        divided = testing.good_run(testing.SMALL, short, "structure=2,fluid=2").probes()
        for name, values in whole.probes().items():
            if not name.startswith("audit.") or "residual" in name:
                continue
            scale = max(map(abs, values)) or 1
            if "enclosed_lag" in name:
                # A difference that vanishes for a dense body, but for rounding.
                scale = max(column(whole.probes(), "given_to_fluid"))
                self.assertLess(max(map(abs, values)) / scale, 1e-12)
            # Sums in another order.
            for a, b in zip(values, divided[name]):
                self.assertLess(abs(a - b) / scale, 1e-9, name)


if __name__ == "__main__":
    unittest.main()
