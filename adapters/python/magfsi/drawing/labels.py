# SPDX-License-Identifier: GPL-2.0-or-later
"""What is written over a picture, by matplotlib: time, scale, field, bars and a wheel of colours."""
import matplotlib
import numpy as np
from matplotlib import patheffects
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Patch

from magfsi import units
from magfsi.drawing import magnetisation

INK, GREY, FIELD = "#262a30", "#5a606a", "#a14a00"
DPI = 100
STEPS = (1, 2, 5)  # of the scale's length, with powers of ten


class Labels:
    """unit: pixels of which a letter is 15 high. Places are pixels from the lower left corner."""

    def __init__(self, size):
        self.size, self.unit = size, min(size[0] / 900, size[1] / 620)
        # Matplotlib cuts off what follows the point: 1020 / 100 * 100 would be 1019 pixels.
        self.figure = Figure(figsize=[(pixels + 0.01) / DPI for pixels in size], dpi=DPI)
        self.figure.patch.set_alpha(0)
        self.canvas = FigureCanvasAgg(self.figure)
        self.halo = [patheffects.withStroke(linewidth=3 * self.points(1), foreground="#ffffffb0")]
        self.below = 24.0  # of what stands next on the right, in units
        self.moving, self.still = [], None  # what each picture of a film has anew; the rest, drawn once
        self.time = self._each_time(self.text(24, 24, "", 17))
        self.scale = None

    def _each_time(self, artist):
        artist.set_animated(True)
        self.moving.append(artist)
        return artist

    def points(self, units_):
        return units_ * self.unit * 72 / DPI

    def text(self, x, y, words, height=13, colour=INK, **more):
        return self.figure.text(x * self.unit / self.size[0], y * self.unit / self.size[1], words,
                                fontsize=self.points(height), color=colour, path_effects=self.halo, **more)

    def _axes(self, left, low, wide, high, **more):
        w, h = self.size
        return self.figure.add_axes([left * self.unit / w, low * self.unit / h, wide * self.unit / w,
                                     high * self.unit / h], **more)

    def _right(self):
        return self.size[0] / self.unit - 24

    def bar(self, name, table, low, high, unit, beyond=False):
        """Of the colours of a quantity; beyond: some of it has more than what the bar shows."""
        factor, shown = units.scaled(max(abs(low), abs(high)), unit)
        wide = 210
        axes = self._axes(self._right() - wide, self.below + 18, wide, 12)
        extend = ("both" if low < 0 else "max") if beyond else "neither"
        bar = self.figure.colorbar(ScalarMappable(Normalize(factor * low, factor * high), ListedColormap(table / 255)),
                                   cax=axes, orientation="horizontal", extend=extend, extendfrac=0.04)
        bar.set_ticks([factor * low, factor * (low + high) / 2, factor * high])
        bar.ax.set_xticklabels([f"{factor * v:.3g}" for v in (low, (low + high) / 2, high)])
        bar.ax.tick_params(labelsize=self.points(11), length=self.points(3), width=self.points(0.8), pad=self.points(2),
                           colors=INK)
        bar.outline.set_linewidth(self.points(0.6))
        axes.set_title(name + (f" [{shown}]" if shown else ""), fontsize=self.points(12.5), color=INK, loc="right",
                       pad=self.points(4), path_effects=self.halo)
        for label in axes.get_xticklabels():
            label.set_path_effects(self.halo)
        self.below += 66
        self.still = None

    def surfaces(self, title, unit, levels):
        """levels: [(value, colour, opacity)] of surfaces of an equal value."""
        patches = [Patch(facecolor=(*colour, min(1, 2 * opacity)), edgecolor=GREY, linewidth=self.points(0.5),
                         label=f"{value:.4g}") for value, colour, opacity in levels]
        legend = self.figure.legend(
            handles=patches, ncols=len(patches), title=f"{title} [{units.typeset(unit)}]", frameon=False,
            loc="lower right", bbox_to_anchor=((self._right() + 6) * self.unit / self.size[0],
                                               self.below * self.unit / self.size[1]), borderpad=0, borderaxespad=0,
            fontsize=self.points(11), title_fontsize=self.points(12.5), handlelength=1.6, columnspacing=1.2,
            handletextpad=0.5, labelcolor=INK)
        legend.get_title().set_path_effects(self.halo)
        self.below += 56
        self.still = None

    def wheel(self, plane, largest, carried):
        """Colours of the directions in a plane."""
        wide = 74
        left, low = self._right() - wide - 14, self.size[1] / self.unit - wide - 76
        axes = self._axes(left, low, wide, wide, projection="polar")
        turn, strong = np.meshgrid(np.linspace(0, 2 * np.pi, 145), np.linspace(0, 1, 13))
        middle = (turn[:-1, :-1] + turn[1:, 1:]) / 2, (strong[:-1, :-1] + strong[1:, 1:]) / 2
        rgb = magnetisation.colours(middle[1] * np.cos(middle[0]), middle[1] * np.sin(middle[0]), 1.0) / 255
        axes.grid(False)
        mesh = axes.pcolormesh(turn, strong, np.zeros(rgb.shape[:2]), linewidth=0)
        mesh.set_array(None)  # colours of its own: matplotlib 3.6 takes none in its call
        mesh.set_facecolor(rgb.reshape(-1, 3))
        axes.set_yticks([])
        axes.set_xticks([0, np.pi / 2], [plane[0], plane[1]], fontsize=self.points(12), color=INK)
        axes.tick_params(pad=-2)
        axes.spines["polar"].set_linewidth(self.points(0.6))
        axes.set_title(f"magnetisation{'' if carried else ' at rest'}\nup to {units.with_unit(largest, 'A/m')}",
                       fontsize=self.points(12.5), color=INK, pad=self.points(8), path_effects=self.halo)

    def arrow_of_field(self, where):
        """Its circle is the largest value. where: words after the value."""
        at = 62 * self.unit, self.size[1] - 62 * self.unit
        self.field_at, self.field_where = np.array(at), where
        more = {"transform": None, "figure": self.figure}
        self.figure.add_artist(Circle(at, 40 * self.unit, fill=False, edgecolor=FIELD, linewidth=self.points(0.8),
                                      alpha=0.5, **more))
        self.field = FancyArrowPatch(at, at, arrowstyle="-|>", color=FIELD, linewidth=self.points(2.6),
                                     mutation_scale=self.points(15), shrinkA=0, shrinkB=0, **more)
        self.figure.add_artist(self._each_time(self.field))
        self.strength = self._each_time(self.text(62, self.size[1] / self.unit - 104, "", 13, FIELD, ha="center",
                                                  va="top", linespacing=1.3))

    def show_field(self, share, tesla):
        """share: of the largest value, to the right and up."""
        half = 37 * self.unit * np.array(share)
        self.field.set_visible(np.linalg.norm(half) > 2 * self.unit)
        self.field.set_positions(self.field_at - half, self.field_at + half)
        self.strength.set_text(f"B = {units.with_unit(tesla, 'T')}{self.field_where}")

    def scale_bar(self, pixels_a_metre, most=0.16):
        """A length of 1, 2 or 5 with a unit, at most that share of the width."""
        room = most * self.size[0] / pixels_a_metre
        size = max(step * 10.0**power for power in range(-9, 3) for step in STEPS if step * 10.0**power <= room)
        if self.scale is None:
            self.scale = matplotlib.lines.Line2D([], [], color=INK, linewidth=self.points(2.2), transform=None,
                                                 figure=self.figure, path_effects=self.halo, solid_capstyle="butt")
            self.figure.add_artist(self._each_time(self.scale))
            self.length = self._each_time(self.text(24, 66, "", 13))
        x, y = 24 * self.unit, 58 * self.unit
        self.scale.set_data([x, x + size * pixels_a_metre], [y, y])
        self.length.set_text(units.with_unit(size, "m"))

    def over(self, pixels):
        """The picture (height, width, 3) with what is written."""
        if self.still is None:
            self.canvas.draw()
            self.still = self.canvas.copy_from_bbox(self.figure.bbox)
        self.canvas.restore_region(self.still)
        for artist in self.moving:
            self.figure.draw_artist(artist)
        ours, made = np.asarray(self.canvas.buffer_rgba()), pixels.copy()
        written = ours[..., 3] > 0
        share = ours[written][:, 3:].astype(np.float32) / 255
        made[written] = np.round(pixels[written] * (1 - share) + ours[written][:, :3] * share)
        return made
