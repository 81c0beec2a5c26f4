# SPDX-License-Identifier: GPL-2.0-or-later
"""A page holds what its runs hold, fetches nothing, and shows a scene's texts as text."""
import base64
import html.parser
import json
import struct
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

from magfsi import runs, testing
from magfsi.report import data, sources

FIELDS = {"time.end": "2 ms", "output.structure.every": "0.5 ms",
          "output.fluid": "{every: 1 ms, fields: [velocity]}"}
HOSTILE = "# </script><script>document.title='stolen'</script><img src=x onerror=alert(1)>\n"
FLOW = ("speed", "vorticity along y")


def report(*words):
    command = [sys.executable, "-m", "magfsi.report", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True)


class Page(html.parser.HTMLParser):
    """Elements and data of a page."""

    def __init__(self, file):
        super().__init__()
        self.elements, self.texts = [], {}
        self.feed(Path(file).read_text())
        self.runs = json.loads(self.texts["data"])

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_data(self, text):
        name = self.elements[-1][1].get("id") if self.elements else None
        if name:
            self.texts[name] = self.texts.get(name, "") + text


def unpacked(text, kind):
    raw = base64.b64decode(text)
    return struct.unpack(f"<{len(raw) // struct.calcsize(kind)}{kind}", raw)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Path(testing.new_folder())
        scene = folder / "scene.yaml"
        scene.write_text(HOSTILE + testing.SMALL.read_text())
        cls.run_ = testing.good_run(scene, FIELDS)
        cls.file = folder / "page.html"
        done = report(cls.run_.folder, "--out", cls.file)
        assert done.returncode == 0, done.stderr
        cls.page = Page(cls.file)
        cls.shown = cls.page.runs[0]

    def test_positions_are_those_of_the_fields(self):
        bodies = self.shown["bodies"]
        self.assertEqual(len(bodies["times"]), 5)
        points = unpacked(bodies["points"], "H")
        self.assertEqual(len(points), 5 * 3 * bodies["nodes"])
        ends = self.run_.probes()
        for axis, name in enumerate("xyz"):
            for frame in (0, 4):
                start = 3 * bodies["nodes"] * frame
                values = points[start + axis:start + 3 * bodies["nodes"]:3]
                middle = bodies["low"][axis] + bodies["step"] * sum(values) / len(values)
                row = ends["t[s]"].index(bodies["times"][frame]) if frame == 0 else -1
                # Nodes are no masses: half an element.
                self.assertAlmostEqual(middle, ends[f"robot.com_{name}[m]"][row], delta=1e-4)

    def test_slices_are_across_each_axis_through_the_robot(self):
        flows = [self.shown["flow"], *self.shown["other_flows"]]
        self.assertEqual([flow["axis"] for flow in flows], [1, 0, 2])  # the field's plane is x-z
        for flow in flows:
            self.assertAlmostEqual(flow["at"], self.shown["bodies"]["middle"][flow["axis"]], delta=1e-9)
            self.assertEqual([q["name"].split()[0] for q in flow["quantities"]], ["speed", "vorticity"])
            for axis, origin, size in zip({0, 1, 2} - {flow["axis"]}, flow["origin"], flow["size"]):
                self.assertAlmostEqual(origin, 0, delta=1e-9)
                self.assertAlmostEqual(size, self.shown["box"][axis], delta=1e-9)

    def test_curves_are_those_of_the_probes(self):
        columns = {c["name"]: c["base"] + np.array(unpacked(c["values"], "f"))
                   for c in self.shown["probes"]["columns"]}
        expected = self.run_.probes()
        self.assertEqual(set(columns), set(expected))
        for found, right in zip(columns["robot.com_z[m]"], expected["robot.com_z[m]"]):
            self.assertAlmostEqual(found, right, delta=1e-9)

    def test_checks_have_the_figures_of_the_summary(self):
        found = {check["name"]: check for check in self.shown["checks"]}
        boundary = self.run_.summary()["immersed_boundary"]
        self.assertEqual(found["leakage"]["value"], boundary["leakage"])
        self.assertEqual(found["leakage"]["good"], boundary["leakage"] <= 0.05)

    def test_texts_of_a_scene_are_text_and_nothing_is_fetched(self):
        tags = [tag for tag, _ in self.page.elements]
        self.assertEqual((tags.count("script"), tags.count("img")), (2, 0))
        self.assertIn("<img src=x", self.shown["scene"])
        for _, attributes in self.page.elements:
            self.assertFalse({"src", "href"} & set(attributes), attributes)


class Facts(unittest.TestCase):
    def test_a_box_with_openings_is_not_closed(self):
        def closed(side):
            return data.is_closed({"fluid": {"boundaries": {"x_min": "no_slip", "x_max": side}}})
        for side in {"velocity_inlet": {}}, {"pressure_outlet": {}}:
            self.assertFalse(closed(side), side)
        for side in "periodic", "free_slip", {"no_slip": {"velocity": [1, 0, 0]}}:
            self.assertTrue(closed(side), side)


class Sources(unittest.TestCase):
    """The field that the page shows, against closed forms on the axis; laws of motion at known times."""

    def field(self, source, at, time=0.0):
        full = {"position": [0.0, 0.0, 0.0], **source}
        scene = {"magnetic_field": {"sources": {"a": full}}}
        return sources.of_scene(scene, np.array([time]), np.array([at], float))[2][0]

    def test_magnets_and_coils(self):
        radius, length, z = 0.01, 0.02, 0.03
        cylinder = {"diameter": 2 * radius, "height": length, "axis": [0, 0, 1], "remanence": [0, 0, 1.2]}
        right = 0.6 * sum(s * (z + s * length / 2) / np.hypot(z + s * length / 2, radius) for s in (-1, 1))
        # Cut into a thousand dipoles, two of its radii away from its face.
        np.testing.assert_allclose(self.field({"cylinder": cylinder}, [0, 0, z]), [0, 0, right], rtol=0.01, atol=1e-6)
        loop = {"diameter": 0.2, "axis": [1, 0, 0], "current": 2.0, "turns": 50}
        right = 4e-7 * np.pi * 100 * 0.1**2 / 2 / np.hypot(0.1, 0.05)**3
        # A polygon of 96 sides.
        np.testing.assert_allclose(self.field({"coil": loop}, [0.05, 0, 0]), [right, 0, 0], rtol=2e-3, atol=1e-12)
        pair = {**loop, "distance": 0.1, "opposed": False}
        right = 0.8**1.5 * 4e-7 * np.pi * 100 / 0.1
        np.testing.assert_allclose(self.field({"coil_pair": pair}, [0, 0, 0]), [right, 0, 0], rtol=2e-3, atol=1e-12)
        self.assertLess(np.abs(self.field({"coil_pair": {**pair, "opposed": True}}, [0, 0, 0])).max(), 1e-12)

    def test_sources_of_every_kind_are_those_of_the_run(self):
        """A small strip is a dipole M V along x in the field at its middle: the program's own torque
        on it, which has closed forms, tells the components across it."""
        folder = Path(testing.new_folder())
        scene = (testing.ROOT / "docs/examples/scenes/field_sources.yaml").read_text()
        scene = scene.replace("    map:\n      grid: {file: magnets_grid.csv}\n", "")
        self.assertNotIn("grid", scene)
        (folder / "scene.yaml").write_text(scene)
        size = [0.4e-3, 0.1e-3, 0.1e-3]
        run = testing.good_run(folder / "scene.yaml", {
            "time.end": "0.2 ms", "bodies.strip.mesh.box.size": "[0.4 mm, 0.1 mm, 0.1 mm]",
            "bodies.strip.mesh.box.elements": "[4, 1, 1]",
            "bodies.strip.material.shear_modulus": "33 MPa",  # a soft one turns, and its moment with it
            "bodies.strip.material.lame_lambda": "660 MPa", "output": "{structure: {every: 0.1 ms}}",
            "magnetic_field.gradient": "{matrix: [[0.2 T/m, 0 T/m, 0 T/m], [0 T/m, 0 T/m, 0 T/m], "
                                       "[0 T/m, 0 T/m, -0.2 T/m]], origin: [0 mm, 0 mm, -10 mm]}"})
        shown = data.read_run(run.folder, 1e6)
        vectors = np.array(unpacked(shown["field"]["vectors"], "f")).reshape(-1, 3)
        moment, probes = 30e3 * np.prod(size), run.probes()
        self.assertEqual(len(shown["sources"]), 6)
        for row in 0, -1:
            # Magnets cut into dipoles, three radii away.
            self.assertAlmostEqual(vectors[row, 2], -probes["strip.magnetic_torque_y[N m]"][row] / moment,
                                   delta=0.01 * np.linalg.norm(vectors[row]))
            self.assertAlmostEqual(vectors[row, 1], probes["strip.magnetic_torque_z[N m]"][row] / moment,
                                   delta=0.01 * np.linalg.norm(vectors[row]))

    def test_laws_of_time(self):
        dipole = {"dipole": {"moment": [0.0, 0.0, 1.0]}}
        on_axis = 2e-7 / 0.1**3
        moved = {**dipole, "motion": {"ramp": {"displacement": [0.0, 0.0, 0.1], "duration": 2.0}}}
        np.testing.assert_allclose(self.field(moved, [0, 0, 0.2], 2.0), [0, 0, on_axis])
        turned = {**dipole, "turning": {"axis": [0, 1, 0], "frequency": 0.25}}  # z to x in a second
        np.testing.assert_allclose(self.field(turned, [0.1, 0, 0], 1.0), [on_axis, 0, 0], atol=1e-12)
        half = {**dipole, "strength": {"table": {"time": [0.0, 2.0], "factor": [0.0, 1.0], "repeat": False}}}
        np.testing.assert_allclose(self.field(half, [0, 0, 0.1], 1.0), [0, 0, on_axis / 2])
        unknown = {**dipole, "strength": {"formula": "sin(t)"}}
        self.assertTrue(np.isnan(self.field(unknown, [0, 0, 0.1])).all())


class Others(unittest.TestCase):
    def test_without_fluid_or_fields_diverged_and_two(self):
        bare = testing.good_run(testing.SMALL, {
            "time.end": "1 ms", "fluid": "", "probes": "{every: 0.1 ms, bodies: [com]}"})
        diverged = testing.run(testing.SMALL,
                               {**FIELDS, "magnetic_field.constant.magnitude": "9 T"})
        self.assertEqual(diverged.code, 3)
        done = report(bare.folder, diverged.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = Page(bare.folder / "report.html").runs
        self.assertEqual((first["bodies"], first["flow"], first["checks"]), (None, None, []))
        self.assertIsNotNone(first["field"])
        self.assertEqual(second["outcome"], "diverged")
        self.assertIn("inverted", second["cause"])

    def test_frames_are_thinned_out_to_the_room(self):
        from magfsi.report import fields
        run = testing.shared_run(testing.SMALL, FIELDS)
        stored = len(runs.frames(run.folder))
        whole = fields.bodies(run.folder, 1e9)
        self.assertEqual(len(whole["times"]), stored)
        faces = len(base64.b64decode(whole["faces"])) // 16
        # Bytes of base64, and the instant and the middle as decimals.
        room = 3 * ((7 * whole["nodes"] + faces) * 4 / 3 + fields.DECIMALS)
        part = fields.bodies(run.folder, room)
        self.assertEqual((len(part["times"]), part["times"][-1]), (3, whole["times"][-1]))
        taken = sum(len(json.dumps(part[name])) for name in ("times", "centres", "points"))
        taken += sum(len(c["values"]) for c in part["colours"] if c["frames"] > 1)
        self.assertLess(taken, room + 100)  # quotes and padding

    def test_a_peak_of_one_row_is_not_lost(self):
        columns = {"t[s]": [1e-3 * i for i in range(50000)], "a[m]": [0.0] * 50000}
        columns["a[m]"][31234] = 1.0
        shown = data.probes(columns, data.rows_shown(columns))
        self.assertLessEqual(shown["rows"], data.MOST_ROWS)
        self.assertEqual(max(unpacked(shown["columns"][1]["values"], "f")), 1.0)

    def test_colours_have_the_values_of_the_fields(self):
        from magfsi import plotting
        from magfsi.report import fields
        from vtk.util.numpy_support import vtk_to_numpy
        run = testing.shared_run(testing.SMALL, FIELDS)
        shown = {c["name"]: c for c in fields.bodies(run.folder, 1e9)["colours"]}
        self.assertEqual(set(shown), {"magnetisation along z at rest", "largest strain", "speed"})
        last = plotting.read_grid(runs.frames(run.folder)[-1][1])
        strains = np.abs(vtk_to_numpy(last.GetCellData().GetArray("stretches[1]")) - 1).max(axis=1)
        strain = shown["largest strain"]
        values = np.frombuffer(base64.b64decode(strain["values"]), "u1").reshape(5, -1)[-1]
        _, elements, _ = fields.surface(last)
        step = (strain["high"] - strain["low"]) / 255
        np.testing.assert_allclose(strain["low"] + step * values, strains[elements],
                                   atol=0.51 * step)

    def test_obstacles_and_platform_are_lines_in_their_place(self):
        run = testing.good_run(testing.SMALL, {
            **FIELDS, "time.end": "0.5 ms", "platform": "{point: [0 mm, 0 mm, 1 mm]}",
            "fluid.obstacles": "{ball: {sphere: {centre: [2 mm, 2 mm, 6 mm], diameter: 1 mm}}, "
                               "rod: {cylinder: {centre: [6 mm, 2 mm, 6 mm], diameter: 0.8 mm, "
                               "axis: y}}, block: {box: [[1 mm, 1 mm, 1 mm], [2 mm, 2 mm, 2 mm]]}}"})
        self.assertEqual(report(run.folder).returncode, 0)
        lines = [np.array(line) for line in Page(run.folder / "report.html").runs[0]["wires"]]
        ball, block, rod, plane = lines[:3], lines[3:15], lines[15:21], lines[21:]
        for line in ball:
            np.testing.assert_allclose(np.linalg.norm(line - [2e-3, 2e-3, 6e-3], axis=1), 5e-4,
                                       atol=2e-9)
        for line in rod:
            np.testing.assert_allclose(np.linalg.norm(line[:, ::2] - 6e-3, axis=1), 4e-4, atol=2e-9)
        self.assertEqual({y for line in rod for y in line[:, 1]}, {0.0, 4e-3})
        self.assertEqual({x for line in block for x in line.flat}, {1e-3, 2e-3})
        self.assertEqual({round(z, 12) for line in plane for z in line[:, 2]}, {1e-3})

    def test_flow_of_a_refined_grid_is_that_of_the_finest_cells(self):
        run = testing.good_run(testing.SMALL, {
            **FIELDS, "time.end": "1 ms", "fluid.refinement": "{levels: 1, margin: 0.75 mm}"})
        self.assertEqual(report(run.folder).returncode, 0)
        flow = Page(run.folder / "report.html").runs[0]["flow"]
        self.assertEqual((flow["columns"], flow["rows"]), (64, 64))  # of 0.125 mm in 8 mm
        self.assertEqual(tuple(q["name"] for q in flow["quantities"]), FLOW)
        values = np.frombuffer(base64.b64decode(flow["quantities"][0]["values"]), "u1")
        last = values.reshape(len(flow["times"]), 64, 64)[-1].astype(int)
        # Far from the robot four pixels have one coarse cell's value; near it they differ.
        blocks = last.reshape(32, 2, 32, 2).swapaxes(1, 2).reshape(32, 32, 4)
        spread = np.ptp(blocks, axis=2)
        self.assertEqual(spread[:8].max(), 0)
        self.assertGreater(spread[12:20, 12:20].max(), 0)

    def test_vorticity_is_the_curl_of_a_known_flow(self):
        """Without stored vorticity it comes from the slice's velocities: that of a rotation is
        twice its rate."""
        from magfsi.report.fields import Level, arrows
        level = Level.__new__(Level)
        level.axis, level.spacing = 1, (1e-3, 1e-3, 1e-3)
        z, x = 1e-3 * np.indices((12, 10)).astype(float)
        # Rotation about y with the rate 3: u = 3 z along x, w = -3 x along z.
        level.plane = lambda *names: np.array([3 * z, 0 * x, -3 * x]) if "velocity[m/s]" in names \
            else None
        found = level.quantities()
        np.testing.assert_allclose(found["vorticity"], 6, rtol=1e-12)
        shown = arrows([found])  # the same as arrows
        values = np.array(unpacked(shown["values"], "b")).reshape(2, 12, 10) * shown["largest"] / 127
        np.testing.assert_allclose(values, [3 * z, -3 * x], atol=0.51 * shown["largest"] / 127 + 1e-5)

    def test_several_bodies_have_names(self):
        run = testing.good_run(testing.SMALL, {
            **FIELDS, "time.end": "0.5 ms", "bodies.second": "{mesh: {box: {size: [1 mm, 1 mm, "
            "0.2 mm], elements: [4, 4, 1]}}, element: assumed_strain, material: {shear_modulus: 33 kPa, "
            "lame_lambda: 660 kPa, density: 1860 kg/m3}, initial: {position: [2 mm, 2 mm, 6 mm]}}"})
        self.assertEqual(report(run.folder).returncode, 0)
        bodies = Page(run.folder / "report.html").runs[0]["bodies"]
        self.assertEqual(bodies["names"], ["robot", "second"])
        self.assertEqual(set(base64.b64decode(bodies["body"])), {0, 1})

    def test_what_is_no_run_is_refused(self):
        folder = Path(testing.new_folder())
        done = report(folder)
        self.assertEqual((done.returncode, len(done.stderr.strip().splitlines())), (2, 1))
        self.assertIn("found no scene.json", done.stderr)
        self.assertEqual(list(folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
