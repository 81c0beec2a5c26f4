# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid parts without a fluid: free turns, a heavy top, a compass needle, a beam with a magnet."""

import math
import unittest
from pathlib import Path

import numpy as np

from magfsi import testing

HERE = Path(__file__).resolve().parent
BRICK, BEAM = HERE / "brick.yaml", HERE / "beam.yaml"
G = 9.81


def moments(size_m, density):
    """Mass and principal moments of a brick."""
    a, b, c = size_m
    mass = density * a * b * c
    return mass, [mass * (b * b + c * c) / 12, mass * (a * a + c * c) / 12,
                  mass * (a * a + b * b) / 12]


def turned(q, v):
    """A vector turned by a unit quaternion."""
    w, u = q[0], q[1:]
    t = [2 * x for x in cross(u, v)]
    return [v[i] + w * t[i] + cross(u, t)[i] for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rows_of(probes, body, *names):
    return list(zip(*(probes[f"{body}.rigid_{name}"] for name in names)))


def zero_crossings(times, values):
    return [times[i] - (times[i + 1] - times[i]) * values[i] / (values[i + 1] - values[i])
            for i in range(len(values) - 1) if values[i] * values[i + 1] < 0]


class FreeTurns(unittest.TestCase):
    def test_100_turns_about_the_middle_axis_keep_energy_and_momentum(self):
        settings = {"time.end": "1 s", "time.step": "5 us", "probes.every": "5 ms",
                    "bodies.brick.initial.angular_velocity":
                        "[0.6283 rad/s, 628.3185307 rad/s, 0.6283 rad/s]"}
        probes = testing.good_run(BRICK, settings).probes()
        _, inertia = moments([3e-3, 2e-3, 1e-3], 2000)
        spins = rows_of(probes, "brick", "spin_x[rad/s]", "spin_y[rad/s]", "spin_z[rad/s]")
        turns = rows_of(probes, "brick", "q_w[1]", "q_x[1]", "q_y[1]", "q_z[1]")
        momenta, flips = [], []
        for spin, q in zip(spins, turns):
            back = turned([q[0], -q[1], -q[2], -q[3]], spin)
            momenta.append(turned(q, [i * w for i, w in zip(inertia, back)]))
            flips.append(turned(q, [0, 1, 0])[1])
        energy = probes["brick.energy_kinetic[J]"]
        off = max(abs(e / energy[0] - 1) for e in energy)
        length = math.dist(momenta[0], [0, 0, 0])
        turned_off = max(math.dist(m, momenta[0]) for m in momenta) / length
        testing.report(f"100 turns: energy {off:.2g}, angular momentum {turned_off:.2g}, "
                       f"least of its axis along y {min(flips):.2f}")
        self.assertLess(min(flips), -0.9)  # unstable: it has flipped
        self.assertLess(off, 1e-8)
        self.assertLess(turned_off, 1e-8)


class HeavyTop(unittest.TestCase):
    def test_precesses_as_the_closed_form_says(self):
        """A square prism, held 6 mm below its middle, tilted by 30 degrees:
        I1 cos(a) W^2 - I3 s W + M g l = 0."""
        size, density, arm, tilt, rate = [3e-3, 3e-3, 1e-3], 2000, 6e-3, math.pi / 6, 60.0
        mass, (across, _, along) = moments(size, density)
        across += mass * arm**2
        spin = (across * math.cos(tilt) * rate**2 + mass * G * arm) / (along * rate)
        # The frame's z turns from z towards x: the plane zx.
        axis = [math.sin(tilt), 0, math.cos(tilt)]
        own = spin - rate * math.cos(tilt)
        omega = [own * axis[0], 0, own * axis[2] + rate]
        text = ", ".join(f"{w:.12g} rad/s" for w in omega)
        place = ", ".join(f"{1e3 * arm * x:.12g} mm" for x in axis)
        # Eight rows in a period, of whole steps.
        periods, every = 2, 2 * math.pi / rate / 8
        step = every / round(every / (4e-3 / spin))
        settings = {"bodies.brick.mesh.box": "{size: [3 mm, 3 mm, 1 mm], elements: [2, 2, 1]}",
                    "bodies.brick.initial": f"{{position: [{place}], rotation: {{plane: zx, "
                                            f"angle: 30 deg}}, angular_velocity: [{text}]}}",
                    "bodies.brick.pivot": "{about: [0 mm, 0 mm, 0 mm]}",
                    "gravity": "{acceleration: 9.81 m/s2}",
                    "time.end": f"{periods * 2 * math.pi / rate:.12g} s",
                    "time.step": f"{step:.15g} s", "probes.every": f"{every:.15g} s"}
        probes = testing.good_run(BRICK, settings).probes()
        x, y, z = (probes[f"brick.rigid_{d}[m]"] for d in "xyz")
        expected = [rate * t for t in probes["t[s]"]]
        off = max(abs(math.remainder(math.atan2(y[i], x[i]) - expected[i], 2 * math.pi))
                  for i in range(len(x))) / expected[-1]
        nod = max(abs(h / z[0] - 1) for h in z)
        testing.report(f"heavy top: precession off by {off:.2g}, height by {nod:.2g}, "
                       f"spin {spin:.0f} rad/s")
        self.assertGreater(len(x), 8 * periods - 1)
        self.assertLess(off, 1e-4)
        self.assertLess(nod, 1e-4)


class Compass(unittest.TestCase):
    def test_swings_at_the_frequency_of_the_closed_form(self):
        """sqrt(M B V / I), at 1 degree slower by theta^2 / 16, with the step that the program
        chooses."""
        mass, inertia = moments([3e-3, 2e-3, 1e-3], 2000)
        volume = mass / 2000
        theta = math.radians(1)
        theory = math.sqrt(50e3 * volume * 2e-3 / inertia[1]) / (2 * math.pi) * (1 - theta**2 / 16)
        settings = {"bodies.brick.magnetization": "{uniform: [50 kA/m, 0 A/m, 0 A/m]}",
                    "bodies.brick.initial": "{rotation: {plane: xz, angle: 1 deg}}",
                    "magnetic_field": "{constant: {magnitude: 2 mT, direction: 0 deg}}",
                    "probes.every": f"{1 / theory / 50:.6g} s", "time.end": f"{20.5 / theory:.6g} s"}
        for name, more in (("free", {}), ("on a hinge", {
                "bodies.brick.hinge": "{axis: [0, 1, 0], about: [1.5 mm, 1 mm, 0.5 mm]}"})):
            probes = testing.good_run(BRICK, {**settings, **more}).probes()
            crossings = zero_crossings(probes["t[s]"], probes["brick.rigid_pitch[rad]"])
            found = (len(crossings) - 1) / (2 * (crossings[-1] - crossings[0]))
            testing.report(f"compass needle {name}: {found:.6g} Hz, off by {found / theory - 1:.2g}")
            self.assertAlmostEqual(found / theory, 1, delta=1e-5)


def frequency(times, values):
    """Of the strongest swing [Hz]: the peak of the spectrum under Hann's window."""
    t, x = np.array(times), np.array(values)
    x = (x - x.mean()) * np.hanning(len(x))

    def strength(f):
        return abs(np.sum(x * np.exp(-2j * np.pi * f * t)))
    best, wide = max(np.arange(20.0, 200, 1), key=strength), 1.0
    while wide > 1e-5:
        wide /= 10
        best = max(best + wide * np.arange(-10, 11), key=strength)
    return best


class BeamWithAMagnet(unittest.TestCase):
    """Against the same with a tip of a thousand times the stiffness: shape, time, and cost."""

    STIFF = {"bodies.beam.material_regions":
                 "[{region: magnet, shear_modulus: 300 MPa, lame_lambda: 1.2 GPa, "
                 "density: 1200 kg/m3}]"}
    RIGID = {"bodies.beam.rigid": "magnet"}

    def both(self, settings):
        return [testing.good_run(BEAM, {**tip, **settings}) for tip in (self.RIGID, self.STIFF)]

    def test_bends_as_with_a_stiff_tip(self):
        """All the way to rest."""
        rigid, stiff = (run.probes() for run in self.both(
            {"damping": "{rate: 300 1/s}", "time.end": "100 ms"}))
        for point in ("tip_uz[m]", "tip_ux[m]", "half_uz[m]"):
            largest = max(map(abs, stiff[point]))
            off = max(abs(a - b) for a, b in zip(rigid[point], stiff[point])) / largest
            testing.report(f"{point}: up to {1e3 * largest:.3f} mm, off by {100 * off:.3f} % at most, "
                           f"by {100 * (rigid[point][-1] / stiff[point][-1] - 1):.4f} % in the end")
            self.assertLess(off, 1e-3)

    def test_swings_as_with_a_stiff_tip(self):
        rigid, stiff = (frequency(p["t[s]"], p["tip_uz[m]"]) for p in (run.probes() for run in self.both(
            {"magnetic_field.vector": "[0 T, 0 T, 0.02 mT]", "time.end": "150 ms"})))
        testing.report(f"swings at {rigid:.4f} Hz, off by {100 * (rigid / stiff - 1):.4f} %")
        self.assertAlmostEqual(rigid / stiff, 1, delta=1e-3)

    def test_takes_a_tenth_of_the_time(self):
        rigid, stiff = (run.summary() for run in self.both({}))
        testing.report(f"steps {rigid['substeps']} against {stiff['substeps']}, "
                       f"{rigid['wall_s']:.2f} s against {stiff['wall_s']:.2f} s")
        self.assertGreater(stiff["substeps"], 10 * rigid["substeps"])
        # On a busy machine times are not as sure as steps.
        self.assertGreater(stiff["wall_s"], 5 * rigid["wall_s"])

    def test_its_energy_balance_closes(self):
        probes = testing.good_run(BEAM, self.RIGID).probes()
        work = max(map(abs, probes["audit.work_field[J]"]))
        residual = max(map(abs, probes["audit.residual[J]"]))
        testing.report(f"residual {residual / work:.2g} of the field's work")
        self.assertLess(residual, 1e-2 * work)


if __name__ == "__main__":
    unittest.main()
