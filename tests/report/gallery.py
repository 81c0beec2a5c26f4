# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi gallery: an index of tutorials, each with its page, a frame of its film and its cost; runs
that are there are not made again, and one that fails is named and left out."""
import contextlib
import html
import io
import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from magfsi import gallery, testing
from magfsi.drawing.stage import ensure_display
from PIL import Image

ONLY = ("beam", "turning")
# Of both: as little as there can be.
SHORT = ("time.end=50 ms", "output.structure.every=25 ms", "probes.every=25 ms")


def made(folder, *more):
    words = ["--runs", folder / "runs", "--out", folder / "docs/index.html", "--only", *ONLY]
    for setting in SHORT + more:
        words += ["--set", setting]
    out, err = io.StringIO(), io.StringIO()
    with mock.patch.object(sys, "argv", ["magfsi gallery", *map(str, words)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = gallery.main()
    return code, out.getvalue(), err.getvalue()


class Index(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(testing.new_folder())
        cls.code, cls.said, cls.faults = made(cls.folder)
        cls.costs = {name: gallery.cost(cls.folder / "runs" / name) for name in ONLY}
        cls.text = (cls.folder / "docs/index.html").read_text()

    def test_every_tutorial_has_page_picture_and_cost(self):
        self.assertEqual((self.code, self.faults), (0, ""))
        self.assertEqual(self.text.count("<article>"), len(ONLY))
        for name in ONLY:
            page = (self.folder / f"docs/gallery/{name}.html").read_text()
            self.assertIn("</html>", page)
            self.assertIn(f'href="gallery/{name}.html"', self.text)
            self.assertIn(f'src="gallery/{name}.png"', self.text)
            with Image.open(self.folder / f"docs/gallery/{name}.png") as picture:
                image = np.array(picture.convert("RGB"))
            self.assertEqual(image.shape, (720, 960, 3))
            self.assertGreater(image.std(), 10)  # something is to be seen
            title, words = gallery.about(gallery.TUTORIALS / name)
            self.assertIn(html.escape(title), self.text)
            self.assertIn(html.escape(words), self.text)
            self.assertIn(html.escape(self.costs[name]), self.text)
        self.assertRegex(self.costs["beam"], r"^[\d.]+ s · 2 steps · ranks: structure 1")

    def test_fetches_nothing(self):
        for outside in ("http:", "https:", "<script", "url("):
            self.assertNotIn(outside, self.text)

    def test_all_tutorials_are_in_it_by_default(self):
        self.assertEqual(gallery.tutorials(), sorted(
            file.parent.name for file in gallery.TUTORIALS.glob("*/scene.yaml")))
        for name in gallery.tutorials():
            title, words = gallery.about(gallery.TUTORIALS / name)
            self.assertTrue(title and len(words) > 40, name)
            self.assertNotRegex(words, r"[*`]|\]\(", name)

    def test_again_it_makes_no_run_and_names_what_fails(self):
        (self.folder / "runs/turning/summary.json").unlink()
        code, said, faults = made(self.folder, "gravity.acceleration=1 m")
        self.assertNotIn("beam: runs", said)
        self.assertIn("turning: runs", said)
        self.assertIn("turning: ", faults)
        self.assertIn("gravity.acceleration", faults)
        self.assertEqual(code, 1)


if __name__ == "__main__":
    ensure_display()
    unittest.main()
