# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi figure: as wide as asked, letters and lines of a size for print, fonts embedded, curves where
the probes are, the same bytes again; what it refuses."""
import contextlib
import io
import re
import sys
import types
import unittest
import zlib
from pathlib import Path
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np
from magfsi import figure, testing

BEAM = testing.ROOT / "tutorials/beam"
COARSE = {"time.end": "100 ms", "bodies.beam.mesh.box.elements": "[9, 2, 1]"}
FINER = {**COARSE, "bodies.beam.mesh.box.elements": "[12, 3, 1]"}
PT_A_MM = 72 / 25.4


def made(*words):
    out, err, code = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", ["magfsi figure", *map(str, words)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = figure.main()
        except SystemExit as ended:
            code = ended.code
    return types.SimpleNamespace(code=code, out=out.getvalue(), err=err.getvalue())


def drawn(*words):
    chosen = figure.parsed([str(word) for word in words])
    return figure.draw(chosen.runs, chosen.columns, chosen)


def streams(pdf):
    """What the compressed parts of a PDF say."""
    parts = re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.S)
    texts = []
    for part in parts:
        with contextlib.suppress(zlib.error):
            texts.append(zlib.decompress(part))
    return texts


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = testing.shared_run(BEAM, COARSE)
        cls.out = Path(testing.new_folder()) / "rise"
        cls.done = made(cls.run_.folder, "--columns", "tip_ux,tip_uz,beam.energy_elastic", "--width", "85mm",
                        "--out", cls.out)

    def test_both_are_as_wide_as_asked(self):
        self.assertEqual(self.done.code, 0, self.done.err)
        self.assertEqual(self.done.out.split(), [f"{self.out}.pdf", f"{self.out}.svg"])
        svg = self.out.with_suffix(".svg").read_text()
        self.assertAlmostEqual(float(re.search(r'width="([\d.]+)pt"', svg)[1]), 85 * PT_A_MM, places=3)
        pdf = self.out.with_suffix(".pdf").read_bytes()
        box = re.search(rb"/MediaBox \[ *0 0 ([\d.]+) ([\d.]+) *\]", pdf)
        self.assertAlmostEqual(float(box[1]), 85 * PT_A_MM, places=3)

    def test_letters_and_lines_have_the_size_of_print(self):
        svg = self.out.with_suffix(".svg").read_text()  # a unit is a point
        sizes = {float(size) for size in re.findall(r"font(?:-size)?: ([\d.]+)px", svg)}
        self.assertEqual(sizes, {7.2, 8.0})
        self.assertIn(">field [mT]</text>", svg)  # text stays text
        self.assertIn("\u00b5J", svg)
        widths = {float(width) for width in re.findall(r"stroke-width: ([\d.]+)", svg)}
        self.assertGreaterEqual(min(widths), 0.5)  # journals' least
        self.assertLessEqual(max(widths), 1.5)
        wider = drawn(self.run_.folder, "--columns", "tip_uz", "--width", "170mm", "--font-size", "9pt")
        self.assertEqual({t.get_fontsize() for t in (wider.axes[0].xaxis.label, wider.axes[0].yaxis.label)}, {9.0})
        plt.close(wider)

    def test_the_fonts_are_in_the_file(self):
        pdf = self.out.with_suffix(".pdf").read_bytes()
        whole = pdf + b"".join(streams(pdf))
        self.assertIn(b"/FontFile2", whole)
        self.assertNotIn(b"/Type3", whole)

    def test_the_same_run_gives_the_same_bytes(self):
        again = Path(testing.new_folder()) / "again"
        made(self.run_.folder, "--columns", "tip_ux,tip_uz,beam.energy_elastic", "--out", again)
        for kind in (".pdf", ".svg"):
            self.assertEqual(self.out.with_suffix(kind).read_bytes(), again.with_suffix(kind).read_bytes(), kind)


class Curves(unittest.TestCase):
    def test_curves_are_the_probes(self):
        run = testing.shared_run(BEAM, COARSE)
        probes = run.probes()
        made_ = drawn(run.folder, "--columns", "tip_u[xz],beam.energy_elastic[J]")
        displacement, energy = made_.axes
        self.assertEqual((displacement.get_ylabel(), energy.get_xlabel()), ("lengths [mm]", "field [mT]"))
        for line, name in zip(displacement.lines, ("tip_ux[m]", "tip_uz[m]")):
            np.testing.assert_allclose(line.get_ydata(), 1e3 * np.array(probes[name]))
            np.testing.assert_allclose(line.get_xdata(), 1e3 * np.array(probes["field[T]"]), rtol=1e-6)
        self.assertEqual(energy.get_ylabel().split()[0], "beam:")
        made_.canvas.draw()
        legend = displacement.get_legend().get_window_extent()
        self.assertGreaterEqual(legend.y0, displacement.get_window_extent().y1 - 1)  # above the curves
        plt.close(made_)

    def test_two_runs_are_dashes_of_one_colour(self):
        first, second = testing.shared_run(BEAM, COARSE), testing.shared_run(BEAM, FINER)
        made_ = drawn(first.folder, second.folder, "--columns", "tip_uz", "--names", "coarse,finer")
        a, b = made_.axes[0].lines
        self.assertEqual(a.get_color(), b.get_color())
        self.assertNotEqual(a.get_linestyle(), b.get_linestyle())
        self.assertEqual([text.get_text() for text in made_.axes[0].get_legend().texts], ["coarse", "finer"])
        plt.close(made_)

    def test_a_time_is_in_the_unit_of_the_scene(self):
        run = testing.shared_run(testing.SMALL, {"time.end": "500 us"})
        made_ = drawn(run.folder, "--columns", "*com_z", "--from", "100 us", "--to", "400 us")
        self.assertEqual(made_.axes[0].get_xlabel(), "time [\u00b5s]")
        x = made_.axes[0].lines[0].get_xdata()
        self.assertGreaterEqual(x[0], 99.9)
        self.assertLessEqual(x[-1], 400.1)
        plt.close(made_)


class Refused(unittest.TestCase):
    def test_what_cannot_be_drawn_or_written(self):
        run = testing.shared_run(BEAM, COARSE)
        other = testing.shared_run(testing.SMALL, {"time.end": "500 us"})
        for words, code, says in (
                ((testing.new_folder(), "--columns", "a"), 2, "found no scene.json"),
                ((run.folder,), 2, "allowed are field[T]"), ((run.folder, "--columns", "tip_zu"), 2, "did you mean tip_"),
                ((run.folder, "--columns", "tip_uz", "--from", "2 s"), 2, "no rows"),
                ((run.folder, other.folder, "--columns", "*z"), 2, "is over time"),
                ((run.folder, "--columns", "tip_uz", "--out", "/proc/none/a.pdf"), 1, "/proc/none")):
            done = made(*words)
            self.assertEqual((done.code, len(done.err.strip().splitlines())), (code, 1), done.err)
            self.assertIn(says, done.err)
        for words, says in ((("--width", "5mm"), "20mm to 500mm"), (("--width", "85"), "20mm to 500mm"),
                            (("--out", "a.gif"), ".pdf, .svg"), (("--font-size", "80"), "4 to 24"),
                            (("--names", "a,b"), "one for each")):
            done = made(run.folder, "--columns", "tip_uz", *words)
            self.assertEqual(done.code, 2)
            self.assertIn(says, done.err)


if __name__ == "__main__":
    unittest.main()
