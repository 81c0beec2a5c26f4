# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the swimmer's figure from a run folder.

    plot.py RUN_FOLDER [--out figure.png] [--period "40 ms"] [--body robot] [--reference CSV]

(a) side views of the robot at even instants of the last full period, to scale, under the
    course of the field; (b) the height of its centre of mass, and the rise a period, beside
    that of a finer run (reference.csv of this folder, given with --reference).
"""
import argparse
import pathlib
import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from magfsi import plotting
from magfsi.plotting import GREY, INK, LETTERS_PT, SMALL_PT, WIDTH_IN, clean

INSTANTS = 9  # both ends of the period: the same phase twice shows the net rise
PALE = "0.9"
LEFT_IN, RIGHT_IN = 0.84, 0.16


def last_period(time_s, period_s):
    """Start of the last period that the run covers from end to end."""
    count = int(np.floor((time_s[-1] - time_s[0]) / period_s + 1e-6))
    if count < 1:
        sys.exit(f"the run lasts {1e3 * (time_s[-1] - time_s[0]):g} ms; "
                 f"one period of {1e3 * period_s:g} ms is needed")
    return time_s[0] + (count - 1) * period_s


class Row:
    """Side views on a common height axis, each at its time: x = (t - start) mm_per_s."""

    def __init__(self, probes, body, frames, start_s, period_s):
        self.start_s, self.period_s = start_s, period_s
        self.times = np.array([time for time, _ in frames])
        centre = 1e3 * np.interp(self.times, probes["t[s]"],
                                 plotting.column(probes, f"{body}.com_x[m]"))
        self.views = [plotting.side_view_mm(file) - [x, 0] for (_, file), x in zip(frames, centre)]
        reach = max(np.abs(view[:, :, 0]).max() for view in self.views)
        pitch = 2 * reach + 0.45  # mm between neighbours, so that they never touch
        self.mm_per_s = pitch * (INSTANTS - 1) / period_s
        self.x_limits = (-pitch / 2, pitch * (INSTANTS - 0.5))
        low = min(view[:, :, 1].min() for view in self.views)
        high = max(view[:, :, 1].max() for view in self.views)
        self.z_limits = (low - 0.75, high + 0.3)  # the key and the scale lie below

    def x(self, time_s):
        return (np.asarray(time_s) - self.start_s) * self.mm_per_s

    def height_in(self):
        scale = (WIDTH_IN - LEFT_IN - RIGHT_IN) / (self.x_limits[1] - self.x_limits[0])
        return scale * (self.z_limits[1] - self.z_limits[0])


def draw_field(axes, probes, row):
    end_s = row.start_s + row.period_s
    field = 1e3 * plotting.column(probes, "field[T]")
    time = probes["t[s]"]
    inside = (time >= row.start_s - 1e-9) & (time <= end_s + 1e-9)
    axes.axhline(0, color=GREY, lw=0.5)
    axes.plot(row.x(time[inside]), field[inside], color=INK, lw=1.2)
    axes.plot(row.x(row.times), np.interp(row.times, time, field), "o", ms=4, color=INK,
              clip_on=False)
    peak = np.ceil(np.abs(field).max())
    axes.set(xlim=row.x_limits, ylim=(-1.1 * peak, 1.1 * peak), xticks=[],
             yticks=[-peak, 0, peak], ylabel="field\n[mT]")
    clean(axes, "bottom")


def draw_views(axes, probes, body, row):
    time = probes["t[s]"]
    inside = (time >= row.start_s - 1e-9) & (time <= row.start_s + row.period_s + 1e-9)
    height = 1e3 * plotting.column(probes, f"{body}.com_z[m]")
    axes.plot(row.x(time[inside]), height[inside], color="0.6", lw=0.8, zorder=1)
    for time_s, view in zip(row.times, row.views):
        axes.axvline(row.x(time_s), color=PALE, lw=0.6, zorder=0)
        plotting.draw_faces(axes, view + [row.x(time_s), 0], zorder=2)
    keys_z = row.z_limits[0] + 0.25
    key_x, bar_x = row.x_limits[0] + 0.4, row.x_limits[1] - 3.2
    for x, text, style in ((key_x, "centre of mass", {"color": "0.6", "lw": 0.8}),
                           (bar_x, "1 mm", {"color": INK, "lw": 2})):
        axes.plot([x, x + 1], [keys_z, keys_z], solid_capstyle="butt", **style)
        axes.text(x + 1.2, keys_z, text, va="center", fontsize=SMALL_PT, color=GREY,
                  bbox={"color": "white", "pad": 1})
    since_start_ms = np.abs(np.round(1e3 * (row.times - row.start_s), 2))
    axes.set(xlim=row.x_limits, ylim=row.z_limits, ylabel="z [mm]",
             xlabel="time in the period [ms]", xticks=row.x(row.times),
             xticklabels=[f"{ms:g}" for ms in since_start_ms])
    axes.yaxis.set_major_locator(matplotlib.ticker.MultipleLocator(1))
    axes.tick_params(axis="x", length=0)
    clean(axes, "bottom")


def draw_height(axes, probes, body, row, reference):
    time_ms = 1e3 * probes["t[s]"]
    height = 1e3 * plotting.column(probes, f"{body}.com_z[m]")
    period_ms = 1e3 * row.period_s
    marks = np.arange(time_ms[0], time_ms[-1] + 1e-6 * period_ms, period_ms)
    at_marks = np.interp(marks, time_ms, height)
    highest = height.max()
    if reference:
        highest = max(highest, 1e3 * plotting.column(reference, f"{body}.com_z[m]").max())
    top = highest + 0.22 * np.ptp(height)
    start_ms = 1e3 * row.start_s
    axes.axvspan(start_ms, start_ms + period_ms, color="0.93", lw=0)
    axes.text(start_ms + period_ms / 2, height.min() - 0.03 * np.ptp(height),
              "shown in (a)", ha="center", va="bottom", fontsize=SMALL_PT, color=GREY)
    for mark in marks:
        axes.axvline(mark, color="0.75", lw=0.6)
    if reference:
        fine_ms, fine = 1e3 * reference["t[s]"], 1e3 * plotting.column(reference, f"{body}.com_z[m]")
        inside = fine_ms <= time_ms[-1] + 1e-6 * period_ms
        axes.plot(fine_ms[inside], fine[inside], color=GREY, lw=0.9, ls="--")
        axes.text(0.65, 0.04, "dashed: converged.yaml", transform=axes.transAxes,
                  fontsize=SMALL_PT, color=GREY, ha="right", va="bottom")
    axes.plot(time_ms, height, color=INK, lw=1.2)
    axes.plot(marks, at_marks, "o", ms=4, color=INK, clip_on=False)
    for left, rise in zip(marks, np.diff(at_marks)):
        label = f"{rise:+.2f} mm".replace("-", "\N{MINUS SIGN}")
        axes.text(left + period_ms / 2, top, label, ha="center", va="top", fontsize=LETTERS_PT)
    axes.set(xlim=(time_ms[0], time_ms[-1]),
             ylim=(height.min() - 0.05 * np.ptp(height), top), xlabel="time [ms]",
             ylabel="height of the\ncentre of mass [mm]")
    axes.set_xticks(marks)
    clean(axes)


def draw(probes, body, row, out, reference):
    plt.rcParams.update({"font.size": LETTERS_PT, "font.family": "DejaVu Sans",
                         "axes.linewidth": 0.6, "xtick.major.width": 0.6,
                         "ytick.major.width": 0.6})
    field_in, views_in, height_in = 0.7, row.height_in(), 2.0
    gaps = {"top": 0.22, "field": 0.12, "views": 0.85, "bottom": 0.5}  # inches, downwards
    total = field_in + views_in + height_in + sum(gaps.values())
    figure = plt.figure(figsize=(WIDTH_IN, total))

    def room(bottom, size):
        return figure.add_axes([LEFT_IN / WIDTH_IN, bottom / total,
                                (WIDTH_IN - LEFT_IN - RIGHT_IN) / WIDTH_IN, size / total])

    views_at = gaps["bottom"] + height_in + gaps["views"]
    field_axes = room(views_at + views_in + gaps["field"], field_in)
    draw_field(field_axes, probes, row)
    draw_views(room(views_at, views_in), probes, body, row)
    draw_height(room(gaps["bottom"], height_in), probes, body, row, reference)
    plotting.letters(figure, {"a": (0.01, 1 - 0.14 / total),
                              "b": (0.01, (gaps["bottom"] + height_in + 0.14) / total)})
    figure.align_ylabels()
    figure.savefig(out, dpi=200)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("run_folder", type=pathlib.Path)
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("figure.png"))
    options.add_argument("--period", type=plotting.seconds, default="40 ms")
    options.add_argument("--body", default="robot")
    options.add_argument("--reference", type=pathlib.Path)
    chosen = options.parse_args()
    probes = plotting.read_columns(chosen.run_folder / "probes.csv")
    start_s = last_period(plotting.column(probes, "t[s]"), chosen.period)
    instants = start_s + np.linspace(0, chosen.period, INSTANTS)
    frames = plotting.nearest_frames(plotting.frames(chosen.run_folder), instants)
    row = Row(probes, chosen.body, frames, start_s, chosen.period)
    reference = plotting.read_columns(chosen.reference) if chosen.reference else None
    draw(probes, chosen.body, row, chosen.out, reference)
    print(chosen.out)


if __name__ == "__main__":
    main()
