# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases of coverage.py with bodies in the fluid that move, or that the fluid moves."""
import math
import re
import sys

from magfsi import runs

from case import BALL, Case

VALIDATION = runs.ROOT / "tests/validation"
sys.path.insert(0, str(VALIDATION / "no_slip"))
import swung  # noqa: E402
import unsteady_stokes  # noqa: E402
import sheet as swung_sheet  # noqa: E402

PERIODIC = """{x_min: periodic, x_max: periodic, y_min: periodic, y_max: periodic,
               z_min: periodic, z_max: periodic}"""


def replaced(text, *pairs):
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


# --- a lattice of balls that settles, creeping: Zick and Homsy ---------------------------------


def sinking(concentration, factor, cells, ratio):
    """A free ball in a periodic cube of fluid at rest, ratio times as dense as the fluid. A force
    on the fluid balances its weight, as a floor would. It sinks past the mean flow with
    W / (6 pi mu a factor), and the mean flow follows from the momentum of all, which is none."""
    diameter = (6 * concentration / math.pi)**(1 / 3)
    speed = 0.25  # to the mean flow: Reynolds number 0.15, whose square counts in a lattice
    weight = 3 * math.pi * diameter * factor * speed
    gravity = weight / (concentration * (ratio - 1))
    spacing = 1 / cells
    # Its relaxation time is 0.8. From 0.2 s on, some times what viscosity takes across a gap, it
    # crosses more than a cell, so that its place in the grid is averaged over.
    scene = f"""
name: sinking
time: {{end: 0.5 s, step: {0.1 * spacing**2:.9g} s}}
bodies:
  ball:
    mesh: {{gmsh: {{file: {BALL}, unit: {diameter:.9g} m}}}}
    material: {{shear_modulus: 10 kPa, lame_lambda: 20 kPa, density: {ratio:g} kg/m3}}
    initial: {{position: [0.51 m, 0.49 m, 0.5 m]}}
gravity: {{acceleration: {gravity:.9g} m/s2, direction: [-1, 0, 0]}}
fluid:
  box: [1 m, 1 m, 1 m]
  spacing: {spacing:.12g} m
  density: 1 kg/m3
  viscosity: 1 m2/s
  expected_speed: {2 * speed:g} m/s
  body_force: [{weight:.9g} N/m3, 0 N/m3, 0 N/m3]
  boundaries: {PERIODIC}
probes:
  every: 10 ms
  bodies: [com, speed]
  integrals: {{through: {{plane: {{axis: x, at: 1 um}}}}}}
"""
    return Case(f"a lattice of balls that sinks, {100 * concentration:.3g} %, {cells} cells",
                scene, "ball.speed_x[m/s]", -speed / (1 + concentration * (ratio - 1)),
                "Zick and Homsy", "mean", start_s=0.2)


def lattices():
    yield sinking(0.064, 2.810, 12, 3)
    yield sinking(0.125, 4.292, 16, 2)
    yield sinking(0.216, 7.442, 16, 1.5)


# --- plates and sheets that swing: unsteady Stokes flow, exact ----------------------------------


def plate(thickness_mm, broadside):
    """What it feels in its second period."""
    moved = unsteady_stokes.force_coefficient(1.5e-3, 1e-3 * thickness_mm, 9.6e-3, swung.OMEGA,
                                              1e-6, broadside)
    text = replaced((VALIDATION / "no_slip/plate.yaml").read_text(), ("2-point", "3-point"),
                    ("0.185 mm]", f"{thickness_mm} mm]"))
    if not broadside:
        text = replaced(text, ("[0 m, 0 m, 20 um]", "[20 um, 0 m, 0 m]"))
    way = "broadside" if broadside else "edgewise"
    return Case(f"a plate swung {way}, {thickness_mm} mm thick", text,
                f"plate.fluid_force_{'z' if broadside else 'x'}[N]", force_n(moved),
                "unsteady Stokes flow", "amplitude", start_s=0.04)


def force_n(moved_m2):
    return (swung.DENSITY * swung.LENGTH * swung.AMPLITUDE * swung.OMEGA**2 * abs(moved_m2))


def sheet(thickness_mm, viscosity):
    moved = swung_sheet.LENGTH * swung_sheet.exact(1e-6 * viscosity, 1e-3 * thickness_mm)
    text = replaced((VALIDATION / "no_slip/sheet.yaml").read_text(),
                    ("0.185 mm]", f"{thickness_mm} mm]"),
                    ("viscosity: 1 mm2/s", f"viscosity: {viscosity} mm2/s"))
    return Case(f"a sheet swung along its plane, {thickness_mm} mm thick, {viscosity} mm2/s", text,
                "sheet.fluid_force_x[N]", force_n(moved), "unsteady Stokes flow", "amplitude",
                start_s=0.04)


def swings():
    yield plate(0.4, broadside=True)
    yield plate(0.185, broadside=True)
    yield plate(0.4, broadside=False)
    yield sheet(0.134, 12.6)
    yield sheet(0.4, 50.3)


# --- balls that settle: ten Cate et al., Phys. Fluids 14 (2002) 4012 ---------------------------

# density, viscosity [mm2/s], speed in an unbounded tank [mm/s], its part that is reached, end [s]
TEN_CATE = {"E1": (970, 384.5, 38, 0.947, 1.6), "E2": (965, 219.7, 60, 0.953, 1.2),
            "E3": (962, 117.46, 91, 0.959, 0.9), "E4": (960, 60.4, 128, 0.955, 0.8)}


def settling(name, spacing_mm, forcing):
    density, viscosity, speed, reached, end = TEN_CATE[name]
    text = replaced((VALIDATION / "sphere/settling.yaml").read_text(),
                    ("gmsh: {file: ball.msh, unit: 1 m}", f"gmsh: {{file: {BALL}, unit: 15 mm}}"),
                    ("spacing: 1.25 mm", f"spacing: {spacing_mm} mm"),
                    ("density: 970", f"density: {density}"),
                    ("viscosity: 384.5", f"viscosity: {viscosity}"),
                    ("expected_speed: 40", f"expected_speed: {1.1 * speed:.3g}"),
                    ("lattice_speed: 0.01", "lattice_speed: 0.04"), ("end: 1.6", f"end: {end}"))
    text += f"coupling: {{immersed_boundary: {{forcing: {forcing}}}}}\n"
    # Their speeds scatter by 2 %.
    return Case(f"a ball that settles, {name}, {15 / spacing_mm:.3g} cells across, {forcing}",
                text, "ball.speed_z[m/s]", -1e-3 * speed * reached, "experiment", "peak", 0.02,
                budget_s=120)


def settlings():
    yield settling("E1", 5, "penalty")
    for name in TEN_CATE:
        yield settling(name, 3.75 if name == "E1" else 2.5, "no_slip")


# --- a flag behind a cylinder: S. Turek, J. Hron, LNCSE 53 (2006) 371 ---------------------------


def flag(case, column, true, **more):
    text = (VALIDATION / f"turek_hron/{case}.yaml").read_text()
    text = text[:text.index("coupling:")]  # without slip, the default
    return Case(f"{case}, 10 mm, {column.split('[')[0]}", text, column, true, "benchmark", **more)


def flags():
    yield flag("fsi1", "A_uy[m]", 0.8209e-3, budget_s=120)
    yield flag("fsi2", "A_uy[m]", 80.6e-3, norm="amplitude", start_s=12, budget_s=300)


# --- the swimmer with other gaits: the scene itself, finer than any run of the star --------------

# The finest run has half the spacing of the star's, half the lattice speed of its centre and its
# shortest elements. Another has all of them 1.5 times as large: from that the finest one differs
# by more than its own error, if that is of an order of 1.7 at least (docs/accuracy/swimmer: 2).
FINEST = {"fluid.spacing": "0.08 mm", "fluid.lattice_speed": "0.025",
          "bodies.robot.mesh.box.elements": "[40, 16, 2]"}
OTHER = {"fluid.spacing": "0.12 mm", "fluid.lattice_speed": "0.0375",
         "bodies.robot.mesh.box.elements": "[27, 11, 1]"}


def gait(name, *pairs, thickness_mm=0.185, end_ms=10):
    """The middle's rise over the ends in the first part of a period, in a patch."""
    text = (runs.ROOT / "tutorials/swimmer/converged.yaml").read_text()
    text = text[:text.index("\n# Fields for ParaView")]
    text = replaced(re.sub(r"  fluid: \[.*\n", "", text),
                    ("0.13333333333333 mm", "0.32 mm"), ("end: 120 ms", f"end: {end_ms} ms"),
                    ("box: [16 mm, 8 mm, 16 mm]", "box: [9.6 mm, 4.8 mm, 9.6 mm]"),
                    ("position: [8 mm, 4 mm, 4 mm]", "position: [4.8 mm, 2.4 mm, 4 mm]"),
                    ("0.185 mm]", f"{thickness_mm} mm]"),
                    ("0.0925 mm]", f"{thickness_mm / 2:.6g} mm]"), *pairs)
    return Case(f"swimmer, {name}", text, "robot.mid_rise[m]", None, "finer run", budget_s=100,
                finer=[FINEST, OTHER])


def gaits():
    field = "[-17 mT, 17 mT, -17 mT, -17 mT]"
    yield gait("10 mT", (field, "[-10 mT, 10 mT, -10 mT, -10 mT]"))
    yield gait("40 Hz", ("[0 ms, 19.5 ms, 32 ms, 40 ms]", "[0 ms, 12 ms, 20 ms, 25 ms]"),
               end_ms=6.2)
    yield gait("0.3 mm thick, 30 mT", (field, "[-30 mT, 30 mT, -30 mT, -30 mT]"),
               thickness_mm=0.3)


CASES = (lattices, swings, settlings, flags, gaits)
