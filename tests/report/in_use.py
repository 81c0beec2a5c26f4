# SPDX-License-Identifier: GPL-2.0-or-later
"""The page in headless Chromium as a person uses it: where it begins, values under the pointer, what is
saved, keys, following, runs of different length, equilibria, a magnet, a phone."""
import csv
import json
import re
import unittest
import xml.etree.ElementTree
from pathlib import Path

import browser
import kinds
import numpy as np
from in_a_browser import orange, pixels
from magfsi import plotting, runs, testing, units
from magfsi.drawing.stage import ensure_display
from magfsi.report import fields
from vtk.util.numpy_support import vtk_to_numpy

BEAM = testing.ROOT / "tutorials/beam"
COARSE = {"bodies.beam.mesh.box.elements": "[9, 2, 1]", "probes.every": "25 ms", "output.structure.every": "25 ms"}
NOW = "document.getElementById('now').textContent"
PLACE = "(({x, y, width, height}) => [x, y, width, height])(%s.getBoundingClientRect())"
PANEL = "drawn.find(p => p.name === '%s')"


@testing.needs("chromium")
class InUse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = browser.Browser()
        cls.swimmer = kinds.swimmer()
        cls.beam = testing.shared_run(BEAM, {**COARSE, "time.end": "400 ms"})

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, *folders, fragment="", **how):
        page = kinds.page(*folders, out=Path(testing.new_folder()) / "page.html")
        self.browser.open(f"file://{page}{fragment}", **how)
        self.addCleanup(lambda: self.assertEqual(self.browser.errors(), []))

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            self.browser("Input.dispatchKeyEvent", type=kind, key=key, **({"text": key} if len(key) == 1 else {}))

    def until(self, true):
        self.browser.run("new Promise(done => { (function look() { "
                         f"if ({true}) done(); else setTimeout(look, 10); }})(); }})")

    def to_sight(self, panel):
        """Until its curves are drawn; returns where its canvas is."""
        self.browser.run(f"{PANEL % panel}.figure.scrollIntoView({{block: 'center'}})")
        self.until(f"{PANEL % panel}.chart")
        self.browser.run("new Promise(requestAnimationFrame)")
        return self.browser.run(PLACE % (PANEL % panel + ".canvas"))

    def button(self, name):
        return self.browser.run(f"document.getElementById('{name}').click()")

    def test_begins_where_the_robot_is_furthest_from_its_start(self):
        self.open(self.swimmer.folder)
        frames = runs.frames(self.swimmer.folder)
        points = np.array([vtk_to_numpy(plotting.read_grid(file).GetPoints().GetData()) for _, file in frames])
        furthest = frames[int(np.abs(points - points[0]).max(axis=(1, 2)).argmax())][0]
        self.assertGreater(furthest, 0)
        self.assertAlmostEqual(self.browser.run("now"), furthest, delta=1e-9)

    def test_begins_framed_on_the_robot(self):
        for width in (1400, 420):
            self.open(self.swimmer.folder, fragment="#t=0&colour=body&flow=none", width=width)
            seen = np.nonzero(orange(pixels(self.browser.picture()))[130:])[1]
            self.assertGreater(np.ptp(seen), 0.3 * width)

    def test_values_under_the_pointer(self):
        self.open(self.swimmer.folder)
        x, y, w, h = self.to_sight("robot.com[m]")
        self.browser("Input.dispatchMouseEvent", type="mouseMoved", x=x + 0.6 * w, y=y + 0.5 * h)
        tip = f"{PANEL % 'robot.com[m]'}.chart.tooltip"
        self.until(f"{tip}.opacity")
        titles, lines = self.browser.run(f"[{tip}.title, {tip}.body.map(b => b.lines[0])]")
        probes = self.swimmer.probes()
        row = int(np.abs(np.array(probes["t[s]"]) - float(titles[0].split()[1]) * 1e-3).argmin())
        found = {line.split()[0]: float(line.split()[1]) for line in lines}
        unit = {"mm": 1e-3, "µm": 1e-6, "nm": 1e-9}[lines[0].split()[2]]
        for axis, value in found.items():
            course = probes[f"robot.com_{axis}[m]"]
            # Three digits of the value, and half a unit of the last of the time.
            self.assertAlmostEqual(unit * value, course[row] - course[0], delta=1e-2 * unit * max(1, abs(value)))
        self.assertIn("z", found)

    def test_saves_as_csv_svg_and_png(self):
        folder = Path(testing.new_folder())
        self.open(self.swimmer.folder)
        self.to_sight("robot.end_to_end[m]")
        self.browser("Page.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
        for kind in ("csv", "svg", "png"):
            self.browser.run(f"{PANEL % 'robot.end_to_end[m]'}.figure"
                             f".querySelector('button[title=\"save as {kind.upper()}\"]').click()")
            file = folder / f"robot.end_to_end.{kind}"
            self.assertTrue(testing.wait_until(file.exists, self.browser.process))
        rows = list(csv.reader((folder / "robot.end_to_end.csv").read_text().splitlines()))
        probes = self.swimmer.probes()
        self.assertEqual(rows[0], ["t[s]", "robot.end_to_end[m]"])
        for column, name in enumerate(rows[0]):  # single precision
            np.testing.assert_allclose([float(row[column]) for row in rows[1:]], probes[name], rtol=2e-7, atol=1e-12)
        drawing = xml.etree.ElementTree.parse(folder / "robot.end_to_end.svg")
        lines = drawing.iter("{http://www.w3.org/2000/svg}polyline")
        self.assertEqual([len(line.get("points").split()) for line in lines], [len(probes["t[s]"])])
        self.assertGreater(pixels((folder / "robot.end_to_end.png").read_bytes()).std(), 5)

    def test_keys(self):
        self.open(self.swimmer.folder, fragment="#t=0")
        self.key("ArrowRight")
        self.assertEqual(self.browser.run(NOW), "500 µs")
        self.key("ArrowRight")
        self.key("ArrowLeft")
        self.assertEqual(self.browser.run(NOW), "500 µs")
        self.key("End")
        self.assertEqual(self.browser.run(NOW), "2 ms")
        self.key(" ")
        self.assertTrue(self.browser.run("playing"))
        self.key(" ")
        self.assertFalse(self.browser.run("playing"))
        # Names for those who hear the page.
        self.assertEqual(self.browser.run("[...document.querySelectorAll('button, canvas, input, select')].filter(e => "
                                          "!(e.ariaLabel || e.textContent.trim() || e.labels?.length)).length"), 0)

    def test_words_of_a_search_are_not_keys(self):
        self.open(self.swimmer.folder)
        self.browser.run("document.getElementById('filter').focus()")
        for letter in "com f":
            self.key(letter)
        self.assertFalse(self.browser.run("playing"))
        self.browser.run("document.getElementById('filter').value = 'centre mass'; filter()")
        shown = self.browser.run("drawn.filter(p => !p.figure.hidden).map(p => p.name)")
        self.assertEqual(shown, ["robot.com[m]", "robot.speed[m/s]"])

    def test_follows_the_robot(self):
        self.open(self.swimmer.folder, fragment="#colour=body&flow=none")
        self.button("follow")
        x, y, w, h = (round(v) for v in self.browser.run(PLACE % "document.getElementById('view')"))
        for time in (0, 0.002):
            self.browser.run(f"magfsi.go({time})")
            seen = np.nonzero(orange(pixels(self.browser.picture()))[y + 120:y + h])
            middle = (seen[1].min() + seen[1].max()) / 2
            self.assertAlmostEqual(middle, x + w / 2, delta=0.02 * w)
        self.button("fit")  # the robot again, then the box
        self.button("fit")
        self.assertEqual(self.browser.run("magfsi.view.aim"), "box")

    def test_two_runs_of_different_length_at_the_same_instant(self):
        short = testing.good_run(BEAM, {**COARSE, "time.end": "200 ms",
                                        "bodies.beam.material.shear_modulus": "250 kPa"})
        self.open(self.beam.folder, short.folder)
        rows = self.browser.run("[...document.querySelectorAll('#ends tr')]"
                                ".map(r => [...r.children].map(c => c.textContent))")
        said = self.browser.run("document.getElementById('ends').textContent")
        self.assertIn("26.4 mT", said)  # 132 mT/s until 200 ms, where the shorter one ends
        first, second = self.beam.probes(), short.probes()
        a = first["tip_uz[m]"][first["t[s]"].index(0.2)]
        b = second["tip_uz[m]"][-1]
        largest = max(abs(v) for t, v in zip(first["t[s]"], first["tip_uz[m]"]) if t <= 0.2)
        row = next(r for r in rows if r[0] == "tip_uz")
        self.assertEqual(row[1].split()[0], f"{1e3 * a:.3g}")
        self.assertEqual(row[2].split()[0], f"{1e3 * b:.3g}")
        self.assertAlmostEqual(float(row[3].split("(")[1].split()[0]), 100 * (b - a) / largest, delta=0.06)
        # Nothing that is no curve is compared.
        self.assertFalse([r for r in rows if r[0] in ("tip_uy", "beam.energy_kinetic")])

    def test_units_are_typeset_as_in_figures(self):
        """Those of every column that a run may have, of the fluid's files, of an axis of equilibria and of a magnet: with
        raised powers, and the same on the page as magfsi.units writes them."""
        run = testing.good_run(testing.SMALL, {**kinds.FIELDS, "time.end": "1 ms", "probes.fluid": "[enstrophy, momentum]"})
        self.open(run.folder, fragment="#t=0.001&flow=vorticity")
        columns = re.findall(r"\[([^\]`]+)\]`", (testing.ROOT / "docs/probes.md").read_text())
        asked = sorted({*columns, *fields.UNITS.values(), "deg", "1", "A m2", "m2/s", "kg/m3"})
        self.assertGreater(len(asked), 15)
        shown = self.browser.run(f"{json.dumps(asked)}.map(typeset)")
        self.assertEqual(shown, [units.typeset(unit) for unit in asked])
        # No letter is followed by a digit, or by a digit's sign.
        self.assertEqual([unit for unit in shown if re.search(r"[A-Za-z]\^?[-0-9]|1/", unit)], [])
        self.assertEqual(self.browser.run(f"{PANEL % 'enstrophy[1/s^2]'}.title.textContent"), "enstrophy [s⁻²]")
        self.assertRegex(self.browser.run("document.getElementById('legend').textContent"), r"vorticity along y.* s⁻¹")
        self.assertNotRegex(self.browser.run("document.querySelector('main').innerText"), r"\^2|1/s\b")

    def test_equilibria_are_over_what_was_varied(self):
        self.open(self.beam.folder, fragment="#t=0.2")
        self.assertEqual(self.browser.run(NOW), "field 26.4 mT")
        self.to_sight("tip_u[m]")
        self.assertEqual(self.browser.run(f"{PANEL % 'tip_u[m]'}.chart.options.scales.x.title.text"), "field [mT]")
        turning = testing.shared_run(testing.ROOT / "tutorials/turning", {})
        self.open(turning.folder)  # its end is furthest from the start
        self.assertEqual(self.browser.run(NOW), "direction of the field in xz 90°")
        self.open(turning.folder, fragment="#t=0.25")
        self.assertRegex(self.browser.run(NOW), "xz 21[34]")  # of 225 to 180 in a second
        # Turned as a whole, all else is constant: a line, no panels of rounding.
        names = self.browser.run("drawn.map(p => p.name)")
        self.assertEqual(names, ["field[T]", "after_u[m]", "before_u[m]", "left_u[m]", "right_u[m]"])
        self.assertIn("strip.end_to_end 741 µm", self.browser.run("document.getElementById('constants').textContent"))

    def test_a_magnet_and_its_field_at_the_body(self):
        magnet = "{sources: {magnet: {dipole: {moment: [0 A m2, 0 A m2, 30 A m2]}, position: [40 mm, 2.5 mm, 200 mm]}}}"
        run = testing.good_run(BEAM, {**COARSE, "time.end": "25 ms", "magnetic_field": magnet,
                                      "bodies.beam.material.shear_modulus": "33 MPa",
                                      "bodies.beam.material.lame_lambda": "660 MPa",
                                      "probes.bodies": "[magnetic_load]"})
        self.open(run.folder)
        # The body as a whole is a dipole M V along x: its torque about y is -M V B_z. The field varies over
        # its length, 17.5 mm of 200 mm: (0.04)^2 times a few.
        moment = 100e3 * 17.5e-3 * 5e-3 * 1e-3
        field = self.browser.run("fieldNow()")
        torque = run.probes()["beam.magnetic_torque_y[N m]"][-1]
        self.assertAlmostEqual(field[2], -torque / moment, delta=0.03 * abs(field[2]))
        self.assertFalse(self.browser.run("drawn.some(p => p.name === 'field[T]')"))  # a law that is not there
        words = """(() => { const all = [], old = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function (text) { all.push(text); };
          magfsi.view.draw(); CanvasRenderingContext2D.prototype.fillText = old; return all; })()"""
        away = np.linalg.norm(np.array([40, 2.5, 200]) - [8.75, 2.5, 0.5])
        self.assertIn(f"magnet 30 A m², {away:.0f} mm away", self.browser.run(words))
        self.button("fit")  # all with the magnet: it is named at its place
        self.assertIn("magnet 30 A m²", self.browser.run(words))

    def test_another_plane_with_arrows(self):
        self.open(self.swimmer.folder, fragment="#t=0.002&flow=vorticity")
        before = pixels(self.browser.picture())
        self.browser.run("element('plane').value = '1'; element('plane').dispatchEvent(new Event('change'))")
        self.assertIn("flow at x = ", self.browser.run("document.getElementById('legend').textContent"))
        self.assertIn("vorticity along x", self.browser.run("document.getElementById('legend').textContent"))
        without = pixels(self.browser.picture())
        self.assertGreater((np.abs(without - before).max(axis=2) > 30).sum(), 1000)
        self.button("arrows")
        self.assertGreater((np.abs(pixels(self.browser.picture()) - without).max(axis=2) > 60).sum(), 200)

    def test_vortices_as_surfaces(self):
        flows = "[...document.getElementById('flow').options].map(o => o.text)"
        for dark in (False, True):
            self.open(self.swimmer.folder, fragment="#t=0.002&flow=none", dark=dark)
            self.assertEqual(self.browser.run(flows), ["speed", "vorticity", "pressure", "vortices", "none"])
            without = pixels(self.browser.picture())
            self.browser.run("element('flow').value = 'vortices'; element('flow').dispatchEvent(new Event('change'))")
            changed = np.abs(pixels(self.browser.picture()) - without).max(axis=2) > 12
            self.assertGreater(changed.sum(), 2000)
            self.assertIn("|curl u| at 2 ms", self.browser.run("document.getElementById('legend').textContent"))
            self.browser.run("magfsi.go(0.0009)")  # stored are 0, 1 and 2 ms
            self.assertIn("|curl u| at 1 ms", self.browser.run("document.getElementById('legend').textContent"))
            # What is chosen for a slice has nothing to choose here.
            self.assertTrue(self.browser.run("['plane-label', 'range-label', 'arrows-label'].every(n => element(n).hidden)"))
        self.open(self.beam.folder)
        self.assertNotIn("vortices", self.browser.run(flows))

    def test_a_phone(self):
        self.open(self.swimmer.folder, width=420, height=900)
        self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 420)
        # A swipe that begins on the robot scrolls the page.
        self.browser("Emulation.setTouchEmulationEnabled", enabled=True)
        self.browser("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": 200, "y": 300}])
        for y in range(280, 80, -20):
            self.browser("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": 200, "y": y}])
        self.browser("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.until("scrollY > 100")
        self.browser("Emulation.setTouchEmulationEnabled", enabled=False)

    def test_what_the_bar_says_is_what_is_drawn(self):
        """Water at rest at the box's corner has the colour of the bar's end."""
        for dark in (False, True):
            self.open(self.swimmer.folder, fragment="#t=0.002&colour=body&flow=speed", dark=dark)
            self.button("fit")
            corner = self.browser.run("""(() => {
              const f = shownRun.flow, r = magfsi.view.canvas.getBoundingClientRect();
              const p = magfsi.view.project([f.origin[0] + 0.03 * f.size[0], f.at, f.origin[1] + 0.97 * f.size[1]]);
              return [r.x + p[0], r.y + p[1]]; })()""")
            x, y, w, h = self.browser.run(PLACE % "[...document.querySelectorAll('.map')].at(-1)")
            picture = pixels(self.browser.picture())
            drawn, bar = picture[round(corner[1]), round(corner[0])], picture[round(y + h / 2), round(x) + 1]
            # The bar's first colours are blended.
            self.assertLess(np.abs(drawn - bar).max(), 6, f"{drawn} {bar}")


if __name__ == "__main__":
    ensure_display()
    unittest.main()
