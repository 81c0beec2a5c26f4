# SPDX-License-Identifier: GPL-2.0-or-later
"""The page in headless Chromium: no errors, plays, goes to a time, shows the robot where VTK draws it,
at 400 and 1400 pixels, light and dark; pages of every kind of run; hostile names stay text."""
import io
import json
import time
import unittest
from pathlib import Path

import browser
import kinds
import numpy as np
from kinds import FIELDS, PLAY
from magfsi import testing
from magfsi.drawing.stage import Stage, ensure_display
from PIL import Image

OPENS_IN_S = 2  # of processor time: a second on two processors
FRAMES_A_S = 20  # of processor time
TRIES = 3


def pixels(picture):
    return np.array(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)


def orange(image):
    """Where the plain robot is: red well above blue, in any light."""
    return (image[..., 0] - image[..., 2] > 60) & (image[..., 0] > image[..., 1] + 30)


def slow_machine():
    """How much more processor time a fixed piece of work takes than on a core of 2020."""
    began = time.process_time()
    sum(i * i for i in range(3_000_000))
    return max(1.0, (time.process_time() - began) / 0.25)


@testing.needs("chromium")
class Looked(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.run_ = kinds.swimmer()
        cls.page = kinds.page(cls.run_.folder)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, file, fragment="", **how):
        self.browser.open(f"file://{file}{fragment}", **how)
        self.assertEqual(self.browser.errors(), [])

    def test_scrubs_to_a_time(self):
        self.open(self.page, "#t=0.0015")
        self.assertEqual(self.browser.run("document.getElementById('now').textContent"), "1.5 ms")
        self.browser.run("const range = document.getElementById('time'); range.value = 0.5; "
                         "range.dispatchEvent(new Event('input')); 1")
        self.assertEqual(self.browser.run("document.getElementById('now').textContent"), "1 ms")
        # The cursor of a curve stands at half of its width between the axes.
        self.browser.run("drawn[0].drawCurves(); magfsi.go(now)")
        place = self.browser.run("drawn[0].cursor.getBoundingClientRect().x - "
                                 "drawn[0].canvas.getBoundingClientRect().x")
        left, right = self.browser.run("[drawn[0].chart.chartArea.left, drawn[0].chart.chartArea.right]")
        self.assertAlmostEqual(place, (left + right) / 2, delta=1)

    def in_time(self, page):
        """Whether it opens, as far as its first curve, and plays so fast, once. By the processor time of the browser: the time
        of the clock is that of all that runs on this machine."""
        slow, began = slow_machine(), self.browser.processor_s()
        self.open(page)
        # Curves are drawn when they come into sight: until the first one is.
        self.browser.run("document.getElementById('curves').scrollIntoView(); new Promise(done => { (function look() { "
                         "if (!drawn.length || drawn.some(panel => panel.chart)) requestAnimationFrame(done); "
                         "else requestAnimationFrame(look); })(); })")
        opened = self.browser.processor_s()
        self.browser.run("scrollTo(0, 0)")
        self.browser.run(PLAY % 40)
        opening, playing = opened - began, self.browser.processor_s() - opened
        testing.report(f"processor time: opens with a curve in {opening:.2f} s, {40 / playing:.0f} frames a second, "
                       f"the machine {slow:.1f} times slow")
        return opening < slow * OPENS_IN_S and playing < slow * 40 / FRAMES_A_S

    def opens_and_plays(self, page):
        """A slow page is so each time."""
        self.assertTrue(any(self.in_time(page) for _ in range(TRIES)))

    def test_plays_fast_enough_and_opens_soon(self):
        self.opens_and_plays(self.page)
        self.assertNotEqual(self.browser.run("document.getElementById('now').textContent"), "0")

    def test_robot_is_where_vtk_draws_it(self):
        for time_s, width, dark in ((0, 1400, False), (0.002, 1400, True), (0.002, 400, False)):
            self.open(self.page, f"#t={time_s}&colour=body&flow=none", width=width, dark=dark)
            box = self.browser.run("(({x, y, width, height}) => [x, y, width, height])"
                                   "(document.getElementById('view').getBoundingClientRect())")
            x, y, w, h = (round(v) for v in box)
            # Where the field's arrow is no robot is.
            found = orange(pixels(self.browser.picture())[y:y + h, x:x + w])
            found[:120, :240] = False
            right = orange(Stage(self.run_.folder, "page", (w, h), "", "none").draw(time_s).astype(int))
            right[:120, :240] = False
            self.assertGreater(right.sum(), 200)
            both = (found & right).sum() / (found | right).sum()
            testing.report(f"t = {time_s} s, {width} pixels: {100 * both:.1f} % of the pixels agree")
            # A pixel along the outline: both smooth edges, each in its own way.
            self.assertGreater(both, 0.85)
            for axis in (0, 1):
                self.assertAlmostEqual(np.nonzero(found)[axis].mean(),
                                       np.nonzero(right)[axis].mean(), delta=1)

    def test_narrow_and_dark(self):
        for width in (400, 1400):
            for dark in (False, True):
                self.open(self.page, width=width, dark=dark)
                self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
                paper = self.browser.run("getComputedStyle(document.body).backgroundColor")
                bright = sum(int(v) for v in paper[4:-1].split(",")) > 380
                self.assertEqual(bright, not dark)

    def test_labels_do_not_overlap(self):
        """What is written into a canvas is noted: no two texts of it meet."""
        for width in (400, 1400):
            self.open(self.page, width=width)
            self.check_labels()

    def check_labels(self):
        boxes = self.browser.run("""(() => {
          const all = [], old = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            const m = this.measureText(text), w = m.width, by = this.getTransform();
            const right = { left: 0, center: 0.5, right: 1 }[this.textAlign];
            x += by.e; y += by.f;
            all.push([this.canvas.parentElement.parentElement.dataset.panel || "view", text,
                      x - right * w, x + (1 - right) * w,
                      y - m.actualBoundingBoxAscent, y + m.actualBoundingBoxDescent]);
            return old.call(this, text, x - by.e, y - by.f);
          };
          drawn.forEach(panel => { if (!panel.chart) panel.drawCurves(); });
          all.length = 0; drawn.forEach(panel => panel.chart.draw()); magfsi.view.draw();
          CanvasRenderingContext2D.prototype.fillText = old;
          return all; })()""")
        self.assertGreater(len(boxes), 50)
        for i, (panel, text, left, right, top, bottom) in enumerate(boxes):
            for other, with_, l, r, t, b in boxes[:i]:
                apart = panel != other or right <= l or r <= left or bottom <= t or b <= top
                self.assertTrue(apart, f"{panel}: '{text}' over '{with_}'")

    def test_hostile_texts_are_text(self):
        folder = Path(testing.new_folder()) / "x<img src=x onerror=alert(1)>&"
        scene = Path(testing.new_folder()) / "scene.yaml"
        hostile = "</script><script>document.title='stolen'</script><img src=x onerror=alert(1)>"
        scene.write_text(f"# {hostile}\n" + testing.SMALL.read_text())
        run = testing.good_run(scene, {"time.end": "0.5 ms", **{k: v for k, v in FIELDS.items()
                                                                if k != "time.end"}}, folder=folder)
        for file in ("scene.json", "run.json", "summary.json"):  # as a stranger may have sent them
            held = json.loads((run.folder / file).read_text())
            for part in held if isinstance(held, list) else [held]:
                for key in ("name", "command", "machine", "cause", "outcome"):
                    if key in part or key == "cause":
                        part[key] = hostile
            (run.folder / file).write_text(json.dumps(held))
        self.open(kinds.page(run.folder))
        self.assertEqual(self.browser.run("document.querySelectorAll('img').length"), 0)
        self.assertEqual(self.browser.run("document.scripts.length"), 2)
        self.assertNotEqual(self.browser.run("document.title"), "stolen")
        self.assertIn("<img src=x", self.browser.run("document.getElementById('title').textContent"))
        self.assertIn(hostile, self.browser.run("document.querySelector('pre').textContent"))

    def test_colour_maps_are_read_in_grey_and_by_colour_blind_readers(self):
        """Lightness (of CIE 1976) of magnitudes goes one way from end to end, that of what has two signs
        up to the middle and down again, also as protanopes and deuteranopes see it (matrices of Machado
        et al. 2009, linear sRGB), who tell the two ends apart."""
        blind = {"all": np.eye(3), "protan": np.array([[0.152286, 1.052583, -0.204868],
                 [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
                 "deutan": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                                     [-0.011820, 0.042940, 0.968881]])}
        self.open(self.page)
        tables = self.browser.run("Object.fromEntries(Object.entries(magfsi.TABLES)"
                                  ".map(([kind, table]) => [kind, Array.from(table)]))")
        self.assertEqual(set(tables), {"magnitude", "signed", "flow"})
        for name, values in tables.items():
            rgb = np.array(values).reshape(256, 3)
            linear = np.where(rgb <= 10.3, rgb / 3294.6, ((rgb / 255 + 0.055) / 1.055)**2.4)
            for who, matrix in blind.items():
                seen = np.clip(linear @ matrix.T, 0, 1)
                lightness = 116 * np.cbrt(np.maximum(seen @ [0.2126, 0.7152, 0.0722], 1e-9)) - 16
                steps = np.diff(lightness[::8])
                if name == "signed":
                    self.assertTrue((steps[:14] > 0).all() and (steps[17:] < 0).all(), f"{name}, {who}")
                    self.assertGreater(np.abs(seen[0] - seen[-1]).max(), 0.3, who)  # of linear light
                else:
                    self.assertTrue((steps > 0).all() or (steps < 0).all(), f"{name}, {who}")
                    self.assertGreater(np.ptp(lightness), 70, f"{name}, {who}")

    def test_every_kind_of_run(self):
        for run, with_view in ((kinds.without_fields(), False), (kinds.structure_alone(), True),
                               (kinds.two_robots(), True), (kinds.diverged(), None)):
            self.opens_and_plays(kinds.page(run.folder))
            if run.code == 3:  # before a second instant was written
                self.assertEqual(self.browser.run("magfsi.go(1); document.getElementById('now').textContent"), "0 s")
            hidden = self.browser.run("document.getElementById('no-fields').hidden")
            if with_view is not None:
                self.assertEqual(hidden, with_view)

    def test_two_runs_laid_over_each_other(self):
        both = Path(testing.new_folder()) / "both.html"
        coarse = testing.good_run(testing.SMALL, {**FIELDS, "fluid.spacing": "0.4 mm"})
        kinds.page(self.run_.folder, coarse.folder, out=both)
        self.open(both, "#t=0.002&colour=speed&flow=none")
        self.assertEqual(self.browser.run("magfsi.view.shapes.length"), 2)
        # The second has the colour of its curves, which the first's colours do not have.
        seen = np.abs(pixels(self.browser.picture())[200:640] - (0xc8, 0x50, 0)).max(axis=2) < 40
        self.assertGreater(seen.sum(), 100)
        self.browser.run("document.getElementById('differ').click(); 1")
        # Steps differ, and so do the instants of rows: the first run's course in between.
        first, second = self.run_.probes(), coarse.probes()
        first_z = np.array(first["robot.com_z[m]"]) - first["robot.com_z[m]"][0]  # as it is drawn
        at_end = np.interp(second["t[s]"][-1], first["t[s]"], first_z)
        shown = self.browser.run("""(() => { const p = drawn.find(p => p.name === "robot.com[m]");
            return p.lines.find(l => l.part === "z").values.at(-1); })()""")
        moved = second["robot.com_z[m]"][-1] - second["robot.com_z[m]"][0]
        self.assertAlmostEqual(shown, moved - at_end, delta=1e-8)
        self.assertEqual(self.browser.errors(), [])

    def test_magnitude_and_components_differ(self):
        """A field that changes its sign: three lines, no two of the same colour and dashes, nor six of two runs;
        the one with the sign does not call itself a magnitude."""
        run = testing.good_run(testing.SMALL, {
            "time.end": "1 ms", "fluid": "", "probes": "{every: 0.1 ms, bodies: [com]}",
            "magnetic_field": "{plane: xz, table: {time: [0 ms, 1 ms], magnitude: [-17 mT, 17 mT], "
                              "direction: 30 deg}}"})
        self.open(kinds.page(run.folder))
        drawn = self.browser.run("""(() => { const p = drawn.find(p => p.name === "field[T]");
          p.drawCurves(); return p.chart.data.datasets.map(d => [d.label, `${d.borderColor} ${d.borderDash}`]); })()""")
        self.assertEqual([label for label, _ in drawn], ["with its sign", "x", "z"])
        self.assertEqual(len({look for _, look in drawn}), 3)
        self.open(kinds.page(run.folder, run.folder, out=run.folder / "both.html"))
        looks = self.browser.run("""(() => { const p = drawn.find(p => p.name === "field[T]");
          p.drawCurves(); return p.chart.data.datasets.map(d => `${d.borderColor} ${d.borderDash}`); })()""")
        self.assertEqual((len(looks), len(set(looks))), (6, 6))

    def test_an_orientation_is_one_panel(self):
        """A rigid brick that turns about x and y: its quaternion's four curves, then its three angles, each with a
        look of its own and an explanation."""
        run = testing.good_run(testing.ROOT / "tests/validation/rigid/brick.yaml", {
            "time.end": "10 ms", "bodies.brick.initial.angular_velocity": "[100 rad/s, 50 rad/s, 20 rad/s]"})
        self.open(kinds.page(run.folder))
        for key, labels in ("brick.rigid_q[1]", ["w", "x", "y", "z"]), \
                ("brick.rigid_angles[rad]", ["pitch", "roll", "yaw"]):
            drawn = self.browser.run(f"""(() => {{ const p = drawn.find(p => p.name === "{key}");
              p.drawCurves(); return [p.chart.data.datasets.map(d => [d.label, `${{d.borderColor}} ${{d.borderDash}}`]),
                explained(plain(p.name), {{points: {{}}}})]; }})()""")
            self.assertEqual(sorted(label for label, _ in drawn[0]), labels)
            self.assertEqual(len({look for _, look in drawn[0]}), len(labels))
            self.assertIn("turn", drawn[1])

    def test_many_rows_and_frames(self):
        page = kinds.page(kinds.long_course(self.run_))
        testing.report(f"page of 100,000 rows: {page.stat().st_size / 1e6:.2f} MB")
        self.assertLess(page.stat().st_size, 2e6)
        self.opens_and_plays(page)
        self.assertGreater(self.browser.run("shownRun.probes.stored"), 99999)
        self.assertTrue(self.browser.run("!!(shownRun.flow && shownRun.vortices)"))
        self.assertGreater(self.browser.run("magfsi.view.shapes[0].bodies.times.length"), 30)


if __name__ == "__main__":
    ensure_display()
    unittest.main()
