"""The short runs whose task times and memory make the calibration."""
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]

# A stream through a periodic cube: nothing but the lattice.
FLUID = """
name: calibration
time: {{end: {end} s, step: 1 s}}
fluid:
  box: [{n} m, {n} m, {n} m]
  spacing: 1 m
  density: 1 kg/m3
  viscosity: 0.05 m2/s
  precision: {precision}
  collision: {collision}
  initial_velocity: [0.01 m/s, 0 m/s, 0 m/s]
  boundaries: {{x_min: {kind}, x_max: {kind}, y_min: {kind}, y_max: {kind},
               z_min: {kind}, z_max: {kind}}}
"""
PROBES = "probes: {{every: {every} s, fluid: [{quantities}]}}\n"
FILES = "output: {{fluid: {{every: {every} s, fields: [velocity]}}}}\n"


def fluid(n, steps, precision="double", probes=0, files=0, quantities="kinetic_energy",
          collision="trt", kind="periodic"):
    text = FLUID.format(n=n, end=steps, precision=precision, collision=collision, kind=kind)
    if probes:
        text += PROBES.format(every=probes, quantities=quantities)
    if files:
        text += FILES.format(every=files)
    return text


def strip(elements, probes):
    """A strip that bends in LAMMPS, without fluid."""
    return f"""
name: calibration
time: {{end: 20 ms, step: 100 us}}
bodies:
  strip:
    mesh: {{box: {{size: [3.7 mm, 1.5 mm, 0.185 mm], elements: {elements}}}}}
    element: assumed_strain
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
    magnetization: {{harmonic: {{amplitude: 62 kA/m, phase: 45 deg}}}}
magnetic_field: {{plane: xz, constant: {{magnitude: 5 mT, direction: 45 deg}}}}
probes: {{every: {probes}, bodies: [com, shape, energy]}}
output: {{structure: {{every: 1 ms}}}}
"""


def strip_in_fluid(n, steps):
    """The same in the middle of a closed cube of n cells a side, 24 and more."""
    side = 0.2 * n
    return f"""
name: calibration
time: {{end: {20 * steps} us, step: 20 us}}
bodies:
  strip:
    mesh: {{box: {{size: [3.7 mm, 1.5 mm, 0.185 mm], elements: [10, 4, 1]}}}}
    element: assumed_strain
    material: {{shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
    magnetization: {{harmonic: {{amplitude: 62 kA/m, phase: 45 deg}}}}
    initial: {{position: [{side / 2} mm, {side / 2} mm, {side / 2} mm]}}
magnetic_field: {{plane: xz, constant: {{magnitude: 5 mT, direction: 45 deg}}}}
fluid:
  box: [{side} mm, {side} mm, {side} mm]
  spacing: 0.2 mm
  density: 1000 kg/m3
  viscosity: 1 mm2/s
  expected_speed: 0.5 m/s
  collision: recursive_regularized
coupling: {{}}
"""


BEAM = TOP / "tutorials/beam/scene.yaml"
