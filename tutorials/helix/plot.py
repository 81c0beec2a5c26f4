# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws how far the helix is behind the field in some runs, and how fast all of them turned and swam.

    plot.py RUN [RUN ...] [--out figure.png]

Frequencies that no RUN has are those of reference.csv; --reference FILE writes what is drawn there.
"""
import argparse
import csv
import json
import math
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import surface
import theory
from magfsi import plotting
from surface import BOX, SHAPE

HERE = pathlib.Path(__file__).resolve().parent
VISCOSITY, MAGNETIZATION, FIELD = 0.01, 2e3, 1e-3
MOST_DEG = 800
COLUMNS = ("frequency[Hz]", "turns[Hz]", "speed[m/s]")
BLUE, ORANGE = "#0072b2", "#d55e00"
SLOW_TO_FAST = "viridis"  # dark to light, also for colour-blind readers


def course(folder):
    """(frequency, times, lag behind the field, place)"""
    scene = json.loads((folder / "scene.json").read_text())
    frequency = scene["magnetic_field"]["precession"]["frequency"]
    p = plotting.read_columns(folder / "probes.csv")
    return frequency, p["t[s]"], 2 * math.pi * frequency * p["t[s]"] - theory.angle_of(p), p["helix.com_x[m]"]


def means(frequency, time, lag, x):
    """Over the last turn, or over whole turns lost."""
    if lag[-1] > 5 * math.pi / 2:
        lost = math.floor((lag[-1] - math.pi / 2) / (2 * math.pi))
        begin, end = np.interp([math.pi / 2, math.pi / 2 + 2 * math.pi * lost], lag, time)
    else:
        begin, end = time[-1] - 1 / frequency, time[-1]
    rate = frequency - np.diff(np.interp([begin, end], time, lag))[0] / (2 * math.pi * (end - begin))
    return rate, np.diff(np.interp([begin, end], time, x))[0] / (end - begin)


def draw_lags(axes, runs, step_out):
    shades = plt.colormaps[SLOW_TO_FAST](np.linspace(0.05, 0.8, len(runs)))
    for number, ((frequency, time, lag, _), shade) in enumerate(zip(runs, shades)):
        shown = np.degrees(lag) <= MOST_DEG
        above = -3 if number == 0 else 6  # the first two end close to each other
        axes.plot(time[shown], np.degrees(lag)[shown], lw=1.4, color=shade)
        axes.annotate(f"{frequency:g} Hz", (time[shown][-1], np.degrees(lag)[shown][-1]), xytext=(4, above),
                      textcoords="offset points", color=shade, va="center")
        if frequency < step_out:
            axes.axhline(math.degrees(math.asin(frequency / step_out)), color="0.6", lw=0.8, ls="--", zorder=0)
    axes.set(xlabel="time [s]", ylabel="behind the field [degrees]", ylim=(-40, MOST_DEG))
    axes.set_xlim(0, 1.12 * axes.dataLim.x1)  # room for the frequencies beside the curves
    plotting.clean(axes)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folders", type=pathlib.Path, nargs="+")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    options.add_argument("--reference", type=pathlib.Path)
    chosen = options.parse_args()
    rows = {}
    with (HERE / "reference.csv").open() as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            rows[float(row[COLUMNS[0]])] = (float(row[COLUMNS[1]]), float(row[COLUMNS[2]]))
    runs = sorted((course(folder) for folder in chosen.folders), key=lambda run: run[0])
    rows.update({run[0]: means(*run) for run in runs})
    if chosen.reference:
        lines = [f"{f:g},{rate:.5g},{speed:.5g}" for f, (rate, speed) in sorted(rows.items())]
        chosen.reference.write_text("# Means of the runs of README.md.\n" + "\n".join([",".join(COLUMNS), *lines, ""]))
    plt.rcParams.update({"font.size": plotting.LETTERS_PT, "font.family": "DejaVu Sans"})
    figure, places = plt.subplot_mosaic([["lags", "lags"], ["rates", "speeds"]], constrained_layout=True,
                                        figsize=(plotting.WIDTH_IN, 6), height_ratios=(1, 1.1))
    lags, rates, speeds = (places[name] for name in ("lags", "rates", "speeds"))
    speed, torque = surface.limit()
    moment = MAGNETIZATION * SHAPE[3]**2 * SHAPE[2] * theory.wire(*SHAPE[:2])[0] * 1e-9
    step_out = moment * FIELD / (VISCOSITY * 1e-9 * torque) / (2 * math.pi)
    draw_lags(lags, runs, step_out)
    f = np.linspace(0, 3.2, 400)
    turning = theory.turns_with_the_field(f, step_out)
    found = np.array([[frequency, *rest] for frequency, rest in sorted(rows.items())])
    rates.plot(f, turning, color=ORANGE, lw=1.2, label="torque balance, wire's surface")
    speeds.plot(f, 2 * math.pi * turning * speed, color=ORANGE, lw=1.2, label="forces on the wire's surface")
    thin = theory.in_periodic_box(*SHAPE, BOX)[0]
    below = f <= step_out
    speeds.plot(f[below], 2 * math.pi * f[below] * thin, color=ORANGE, lw=1, ls=":", label="slender body")
    rates.plot(found[:, 0], found[:, 1], "o", color=BLUE, ms=4, label="simulated")
    speeds.plot(found[:, 0], 1e3 * found[:, 2], "o", color=BLUE, ms=4, label="simulated")
    for axes, label in ((rates, "turns of the helix [Hz]"), (speeds, "swims at [mm/s]")):
        axes.axvline(step_out, color="0.8", lw=0.8, zorder=0)
        axes.set(xlabel="turns of the field [Hz]", ylabel=label, xlim=(0, 3.2), ylim=(0, None))
        axes.legend(frameon=False, loc="lower left", bbox_to_anchor=(-0.02, 1.0), borderaxespad=0)
        plotting.clean(axes)
    figure.savefig(chosen.out, dpi=200)
    print(chosen.out)


if __name__ == "__main__":
    main()
