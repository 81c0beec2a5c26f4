# SPDX-License-Identifier: GPL-2.0-or-later
"""Relations of scenes with the effects that relations.py has not: weight, platform, friction,
damping, viscosity of the material, gradients, sources, rollers, rigid bodies; rheology, eddies,
forces on the fluid, courses, free slip, bulk viscosity."""

from relations import NO_SLIP, Compared, Scene, add_tests, block, fluid, planes, scene

from magfsi import testing


def land(f):
    """Two bodies on a platform; one is rolled against the other."""
    strip = block(f, [3, 1.2, 0.4], [8, 4, 2], [2.4, 4.1, 1.3], tilt=("zx", 9))
    strip["material"]["viscosity"] = f.pa_s(2)
    cube = block(f, [1, 0.8, 0.6], [4, 3, 3], [5.1, 4, 1.4], (20, -30, 50), (50000, 1000000, 1200))
    cube["rollers"] = [{"face": f.side("y_min"), "axis": f.axis("y")}]
    dipole = {"dipole": {"moment": f.moment([0.01, 0.03, 0.02])}, "position": f.point([4, -20, 25]),
              "strength": {"oscillation": {"frequency": f.per_s(100), "phase": "30 deg"}}}
    return scene(
        f, 2, 0.5, bodies={"strip": strip, "cube": cube},
        gravity={"acceleration": f.acceleration(9.81), "direction": f.direction([0, 0, -1])},
        damping={"rate": f.per_s(20)}, contact={"friction": 0.2}, dipoles={},
        platform={"point": f.point([0, 0, 1]), "normal": f.direction([0, 0, 1]), "friction": 0.3},
        magnetic_field={"vector": f.field([12, 5, 9]), "sources": {"magnet": dipole},
                        "gradient": {"matrix": f.gradient([[1, 0.2, 0.1], [0.2, 0.5, -0.3],
                                                           [0.1, -0.3, -1.5]]),
                                     "origin": f.point([4, 4, 4])}})


def rigid(f):
    """A rigid brick sinks beside a soft one, in a fluid that is driven: rounding is that of its density,
    beside which slow flows are small."""
    brick = block(f, [1.5, 1.2, 0.8], [4, 3, 2], [2.9, 4.1, 5], (20, -30, 50), tilt=("zx", 20))
    brick["rigid"] = True
    return scene(
        f, 2, 0.5, bodies={"brick": brick, "soft": block(f, [1, 0.8, 0.6], [4, 3, 3], [5.5, 4, 3])},
        gravity={"acceleration": f.acceleration(9.81), "direction": f.direction([0, 0.6, -0.8])},
        magnetic_field={"vector": f.field([2, 5, 12])},
        fluid=fluid(f, 0.5, 2, 1, body_force=f.force_density([270000, -90000, 180000])))


def thinning(f):
    """A thinning fluid is driven past a ball between walls."""
    sides = {side: "no_slip" for side in ("z_min", "z_max")}
    return scene(
        f, 3, 1, probes=planes(f, pl1=("x", 2.5), pl2=("z", 3)),
        fluid=fluid(f, 0.5, 10, 0.5, sides, body_force=f.force_density([3000, 500, 0]),
                    rheology={"power_law": {"exponent": 0.6, "rate": f.per_s(10),
                                            "least": f.viscosity(2), "most": f.viscosity(20)}},
                    obstacles={"ball": {"sphere": {"centre": f.in_box([2.6, 2.4, 2.3]),
                                                   "diameter": f.mm(1.8)}}}))


def course(f):
    """A pulse into a box with free slip; eddies and a bulk viscosity."""
    wave = {"oscillation": {"mean": 0.5, "amplitude": 0.5, "frequency": f.per_s(200), "phase": "-90 deg"}}
    sides = {**NO_SLIP, "y_max": "free_slip", "x_max": {"pressure_outlet": {}},
             "x_min": {"velocity_inlet": {"velocity": f.speed([0.2, 0, 0]), "profile": "parabolic",
                                          "course": wave}}}
    return scene(
        f, 3, 1, probes=planes(f, pl1=("x", 2.5), pl2=("z", 3)),
        fluid=fluid(f, 0.5, 10, 0.5, sides, smagorinsky={"constant": 0.15},
                    bulk_viscosity=f.viscosity(50)))


class Effects(Compared):
    pass


if __name__ == "__main__":
    add_tests(Effects, {
        "land": Scene((8, 8, 8), 0.5, "", land),
        "rigid": Scene((8, 8, 8), 0.5, "xyz", rigid),
        "thinning": Scene((5, 5, 5), 0.5, "xy", thinning, {"pl1": "x", "pl2": "z"}),
        "course": Scene((5, 5, 5), 0.5, "", course, {"pl1": "x", "pl2": "z"}),
    })
    testing.main()
