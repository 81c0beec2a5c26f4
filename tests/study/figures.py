# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of the shipped studies, of the stability map and of the shipped search follow from their tables:
all runs are read back, no two series look alike or have one name, no panel lies over another."""
import csv
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from magfsi import testing  # noqa: E402
from magfsi.optimize import result  # noqa: E402
from magfsi.optimize.search_file import read_search  # noqa: E402
from magfsi.study import figure, marked, tables  # noqa: E402
from magfsi.study.study_file import read_study  # noqa: E402
from PIL import Image  # noqa: E402

ACCURACY = testing.ROOT / "docs/accuracy"
STABILITY = testing.ROOT / "docs/stability"
GAIT = testing.ROOT / "tutorials/gait"
sys.path.insert(0, str(testing.ROOT / "tests/stability"))
import draw_map  # noqa: E402
import map_panel  # noqa: E402


def kept(draw, *words):
    """The figure that a function draws and saves, still there."""
    with mock.patch.object(plt, "close"), mock.patch.object(matplotlib.figure.Figure, "savefig"):
        draw(*words)
        return plt.gcf()


class Studies(unittest.TestCase):
    def test_all_of_their_runs_are_read_back(self):
        studies = sorted(ACCURACY.glob("*/study.yaml"))
        self.assertGreaterEqual(len(studies), 8)
        for file in studies:
            study = read_study(file)
            with open(file.parent / "runs.csv", newline="") as table:
                rows = list(csv.DictReader(table))
            runs = tables.read_csv(study, file.parent / "runs.csv")
            self.assertEqual(len(runs), len(rows), file)
            for run, row in zip(runs, rows):
                for norm in study.norms:
                    self.assertEqual(f"{run.errors[norm.name]:.6g}" if norm.name in run.errors else "",
                                     row[tables.error_column(study, norm)])

    def test_series_are_told_apart(self):
        for file in sorted(ACCURACY.glob("*/study.yaml")):
            study = read_study(file)
            looks = figure._looks(study, tables.read_csv(study, file.parent / "runs.csv"))
            for part in ([look[1:] for look in looks.values()], [look[0] for look in looks.values()]):
                self.assertEqual(len(set(map(str, part))), len(looks), file)
            for words, *_ in looks.values():
                self.assertNotRegex(words, r"(^|, )[\d.]+(,|$)", file)  # a number has its axis beside it

    def test_a_table_of_another_study_is_refused(self):
        with self.assertRaises(marked.InputError):
            tables.read_csv(read_study(ACCURACY / "beam/study.yaml"), self.other())

    def other(self):
        path = Path(tempfile.mkdtemp()) / "runs.csv"
        text = (ACCURACY / "beam/runs.csv").read_text()
        path.write_text(text.replace("assumed_strain,1,4,1", "assumed_strain,1,5,1"))
        return path

    def test_names_of_series_are_in_the_picture(self):
        study = read_study(ACCURACY / "swimmer/study.yaml")
        made = kept(figure.draw, study, tables.read_csv(study, ACCURACY / "swimmer/runs.csv"), "none.png")
        for axes in made.axes:
            for text in axes.texts:
                box = text.get_window_extent()
                self.assertLessEqual(box.x1, made.bbox.x1 + 1, text.get_text())
                self.assertGreaterEqual(box.x0, 0, text.get_text())
        plt.close("all")


class Map(unittest.TestCase):
    def test_the_stored_map_is_that_of_its_table(self):
        studies = draw_map.stored(STABILITY / "cells.csv")
        with open(STABILITY / "cells.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual(sum(len(s.cells) for s in studies.values()), len(rows))
        self.assertEqual(set(studies), {name for names in draw_map.PICTURES.values() for name in names})
        self.assertEqual(studies["substeps"].axes, ["substeps", "step [\u00b5s]", "scheme"])
        self.assertEqual(studies["contact"].cells[0][0], ["20", "16", "serial, 3-point"])
        for study in studies.values():
            # A tile for each run: no two on one place.
            self.assertEqual(len({tuple(values) for values, _, _ in study.cells}), len(study.cells), study.name)

    def test_panels_have_room_and_fill_the_picture(self):
        studies = draw_map.stored(STABILITY / "cells.csv")
        for name, members in draw_map.PICTURES.items():
            made = kept(map_panel.draw, [studies[m] for m in members], draw_map.CAUSES, "none.png")
            made.canvas.draw()
            boxes = [axes.get_tightbbox() for axes in made.axes]
            for i, box in enumerate(boxes):
                self.assertGreaterEqual(box.x0, 0, name)
                self.assertLessEqual(box.x1, made.bbox.x1, name)
                self.assertFalse(any(box.overlaps(other) for other in boxes[:i]), name)
            share = sum(box.width * box.height for box in boxes) / (made.bbox.width * made.bbox.height)
            self.assertGreater(share, 0.3, name)
            plt.close("all")


class Search(unittest.TestCase):
    def test_the_shipped_search_is_as_high_as_a_page(self):
        search = read_search(GAIT / "search.yaml")
        points = result.read_points(search, GAIT / "runs.csv")
        with open(GAIT / "runs.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual((len(points), sum(p.good for p in points)), (len(rows), sum(r["good"] == "1" for r in rows)))
        self.assertAlmostEqual(points[0].values["recovery"], 1e-3 * float(rows[0]["recovery[ms]"]), delta=1e-12)
        best = result.ranked(points, search)[0]
        self.assertEqual(best.number + 1, 36)  # README.md
        made = kept(result.draw, search, points, "none.png")
        self.assertEqual([axes.get_xlabel() for axes in made.axes[1:4]], ["recovery [ms]", "hold [ms]", "power [ms]"])
        with Image.open(GAIT / "search.png") as picture:
            self.assertLess(picture.width, 3 * picture.height)
            self.assertGreater(np.array(picture.convert("L")).std(), 10)
        plt.close("all")


if __name__ == "__main__":
    unittest.main()
