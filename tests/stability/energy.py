# SPDX-License-Identifier: GPL-2.0-or-later
"""What no scene may break, whatever its numbers: nothing gains energy that the field and the
weight have not given, and no fluid is lost."""

from magfsi import testing

BOX_M3 = 3.7e-3 * 1.5e-3 * 0.185e-3  # the strip of these scenes
GRAVITY = 9.81
WATER = 1000.0


def gain(probes, body, density, fluid=True, weight=True):
    """The largest energy [J] beyond the start's and what field and weight have given since."""
    # The fluid inside the body moves with it, and the fluid's kinetic energy has its share.
    own = 1 - WATER / density if fluid else 1
    total = [elastic + own * kinetic - work for elastic, kinetic, work in zip(
        probes[f"{body}.energy_elastic[J]"], probes[f"{body}.energy_kinetic[J]"],
        probes[f"{body}.work_magnetic[J]"])]
    if fluid:
        total = [e + f for e, f in zip(total, probes["kinetic_energy[J]"])]
    if weight:
        force = (density - (WATER if fluid else 0)) * BOX_M3 * GRAVITY
        total = [e + force * z for e, z in zip(total, probes[f"{body}.com_z[m]"])]
    return max(e - total[0] for e in total)


def check(test, run, label, density=1860.0, scale_j=None, bound=0.0, **kinds):
    """bound: share of the scale, the largest work of the field unless given, which explicit
    steps may gain."""
    probes = run.probes()
    body = next(name for name in probes if ".energy_kinetic" in name).split(".")[0]
    scale = scale_j or max(map(abs, probes[f"{body}.work_magnetic[J]"]))
    test.assertGreater(scale, 0, f"{label}: nothing happened")
    gained = gain(probes, body, density, **kinds) / scale
    testing.report(f"{label}: gains {gained:+.2e} of {scale:.3g} J")
    test.assertLessEqual(gained, bound, label)
    if "mass[kg]" in probes:
        mass = probes["mass[kg]"]
        # Rounding: the sum of some 1e5 cells.
        test.assertLess(max(abs(m / mass[0] - 1) for m in mass), 1e-12, label)
    if "interface.power_mismatch[1]" in probes:
        testing.check_interface_balance(test, run, label)
    return probes
