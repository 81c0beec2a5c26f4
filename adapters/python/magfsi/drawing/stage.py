# SPDX-License-Identifier: GPL-2.0-or-later
"""A run on a stage: the same bodies, box, obstacles and flow at any time, in two looks.

page     as the page shows it: without perspective, a slice of the flow, the field as an arrow
picture  with perspective and light, vortices as translucent surfaces
"""
import os
import shutil
import sys
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi.drawing import actors
from magfsi.report import data, fields

YAW, PITCH = -0.35, 0.2  # of the page's view (report/view.js)
SHARE_OF_VIEW = 0.85
ROOM = 20e6  # bytes of fields: a film has more of them than a page
PAPER, INK, FIELD = (0.957, 0.957, 0.957), (0.1, 0.1, 0.1), (0.63, 0.29, 0.0)


def ensure_display():
    """VTK's OpenGL window wants an X server, also off screen: without one this program runs again
    under xvfb-run."""
    if os.environ.get("DISPLAY"):
        return
    wrapper = shutil.which("xvfb-run")
    if wrapper is None:
        sys.exit("no DISPLAY, and xvfb-run is not installed (apt install xvfb xauth)")
    # As this program was started: `-P -m magfsi.render` is not in its own arguments.
    command = Path("/proc/self/cmdline").read_bytes().rstrip(b"\0").split(b"\0")
    os.execv(wrapper, [wrapper, "-a", "-s", "-screen 0 1600x1200x24", *map(os.fsdecode, command)])


class Stage:
    """Raises data.NotARun where nothing can be drawn."""

    def __init__(self, folder, look="page", size=(1400, 620), colour="magnetisation", flow="speed",
                 levels=None, zoom=1.0, yaw=YAW, pitch=PITCH):
        self.folder, self.look, self.size, self.levels = Path(folder), look, size, levels
        self.colour, self.flow_name, self.zoom = colour, flow, zoom
        self.yaw, self.pitch = yaw, pitch
        self.scene = data.read_json(self.folder / "scene.json", {})
        self.run = data.read_run(self.folder, ROOM)
        if not self.run["bodies"] and not self.run["flow"]:
            raise data.NotARun(f"{folder}: nothing to draw: no fields; output.structure in the "
                               "scene writes them")
        self.low, self.high = map(np.array, data.shown_box(self.scene, self.run["bodies"]))
        # What fills the view: the bodies over their whole course, as on the page.
        ends = self.run["bodies"] or {"low": self.low, "high": self.high}
        self.frame = np.array(ends["low"]), np.array(ends["high"])
        self.renderer = vtk.vtkRenderer()
        self.robot = actors.Robot(self.run["bodies"]) if self.run["bodies"] else None
        self.moving, self.shown_flow = [], None
        self._furnish()
        self._window()

    def times(self):
        """Of the first and the last frame."""
        every = [t for part in (self.run["bodies"], self.run["flow"]) if part
                 for t in (part["times"][0], part["times"][-1])]
        return min(every), max(every)

    def _furnish(self):
        add, picture = self.renderer.AddActor, self.look == "picture"
        if picture:
            self.renderer.GradientBackgroundOn()
            self.renderer.SetBackground(0.93, 0.95, 0.97)  # below
            self.renderer.SetBackground2(1, 1, 1)
            self._light()
        else:
            self.renderer.SetBackground(PAPER)
        if self.run["box"]:
            add(actors.lines(actors.edges(self.low, self.high), INK, 1.5, 0.6 if picture else 0.35))
            if picture:
                add(actors.floor(self.low, self.high))
        if picture:
            for shape in actors.solids(self.scene):
                add(shape)
        if self.run["wires"]:
            add(actors.lines(self.run["wires"], INK, 1, 0.6))
        if self.robot:
            add(self._robot_actor(picture))
        if self.run["flow"] and not picture and self.flow_name != "none":
            self.slice = actors.slice_actor(self.run["flow"])
            add(self.slice)
        self._write_captions()

    def _robot_actor(self, picture):
        if picture:
            normals = vtk.vtkPolyDataNormals()
            normals.SetInputData(self.robot.data)
            normals.SetFeatureAngle(50)
            shape = actors.actor(normals, (1, 1, 1), ambient=0.25, diffuse=0.8, specular=0.25)
        else:
            shape = actors.actor(self.robot.data, (1, 1, 1), ambient=1, diffuse=0)
        shape.GetMapper().ScalarVisibilityOn()
        shape.GetMapper().SetScalarModeToUseCellData()
        return shape

    def _write_captions(self):
        unit = self.size[1] / 620
        self.caption = vtk.vtkTextActor()
        self.caption.SetPosition(24 * unit, 20 * unit)
        self.renderer.AddActor2D(self.caption)
        look = self.caption.GetTextProperty()
        look.SetFontFamilyToArial()
        look.SetFontSize(round(17 * unit))
        look.SetColor(0.3, 0.33, 0.37)
        self.arrow = vtk.vtkPolyData()
        mapper = vtk.vtkPolyDataMapper2D()
        mapper.SetInputData(self.arrow)
        shape = vtk.vtkActor2D()
        shape.SetMapper(mapper)
        shape.GetProperty().SetColor(FIELD)
        shape.GetProperty().SetLineWidth(2.5 * unit)
        self.renderer.AddActor2D(shape)

    def _light(self):
        """Key from the upper left, fill from the right, both fixed to the camera."""
        self.renderer.AutomaticLightCreationOff()
        for position, strength in (((-1.2, 1.6, 2.0), 0.9), ((1.8, 0.2, 1.2), 0.35)):
            lamp = vtk.vtkLight()
            lamp.SetLightTypeToCameraLight()
            lamp.SetPosition(position)
            lamp.SetIntensity(strength)
            self.renderer.AddLight(lamp)

    def _window(self):
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetSize(*self.size)
        self.window.SetMultiSamples(0)  # not together with depth peeling
        self.window.SetAlphaBitPlanes(1)
        self.window.AddRenderer(self.renderer)
        self.renderer.SetUseDepthPeeling(1)
        self.renderer.SetMaximumNumberOfPeels(12)
        self.renderer.UseFXAAOn()

    def axes_of_view(self, yaw=None, pitch=None):
        """Unit vectors to the right, up and towards the viewer."""
        yaw, pitch = self.yaw if yaw is None else yaw, self.pitch if pitch is None else pitch
        cy, sy, cp, sp = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
        return np.array([[cy, sy, 0], [-sp * sy, sp * cy, cp], [cp * sy, -cp * cy, sp]])

    def pixels_a_metre(self):
        """As the page: what is framed fills its share of the first view."""
        right, up, _ = self.axes_of_view(YAW, PITCH)
        size = np.maximum(self.frame[1] - self.frame[0], 1e-9)
        return self.zoom * SHARE_OF_VIEW * min(self.size[0] / (np.abs(right) @ size),
                                               self.size[1] / (np.abs(up) @ size))

    def _aim(self, centre):
        camera = self.renderer.GetActiveCamera()
        if self.look == "picture":
            return self._aim_with_perspective(camera, centre)
        middle = (self.frame[0] + self.frame[1]) / 2
        _, up, towards = self.axes_of_view()
        far = 10 * np.linalg.norm(self.high - self.low) + 1e-6
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(middle)
        camera.SetPosition(middle + far * towards)
        camera.SetViewUp(up)
        camera.SetParallelScale(self.size[1] / 2 / self.pixels_a_metre())
        self.renderer.ResetCameraClippingRange()

    def _aim_with_perspective(self, camera, centre):
        """From the front, a little from the right and above. The picture holds the box at zoom 1,
        then smaller parts of it, ever closer around the bodies."""
        middle, half = (self.low + self.high) / 2, np.maximum((self.high - self.low) / 2, 1e-9)
        middle = middle + (centre - middle) * (1 - 1 / self.zoom)
        low, high = middle - half / self.zoom, middle + half / self.zoom
        camera.SetFocalPoint(middle)
        camera.SetPosition(middle + np.array([0.45, -1.0, 0.27]) * np.linalg.norm(half))
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(20)
        camera.SetWindowCenter(0, 0)
        self.renderer.ResetCamera(np.stack([low, high], axis=1).ravel())
        to_view = camera.GetCompositeProjectionTransformMatrix(self.size[0] / self.size[1], -1, 1)
        corners = np.array([to_view.MultiplyPoint((x, y, z, 1)) for x in (low[0], high[0])
                            for y in (low[1], high[1]) for z in (low[2], high[2])])
        seen = corners[:, :2] / corners[:, 3:]  # -1 to 1 across the picture
        offset = (seen.min(axis=0) + seen.max(axis=0)) / 2
        zoom = 0.94 / (np.ptp(seen, axis=0) / 2).max()
        camera.Zoom(zoom)
        camera.SetWindowCenter(*(offset * zoom))
        self.renderer.ResetCameraClippingRange()

    def _show_robot(self, time):
        colours = self.robot.face_colours(time, self.colour)
        points = self.robot.points(time)
        # What has a bar of colours is not lit: the bar says what is drawn.
        if self.look == "page" and not self.robot.chosen(self.colour):  # lit by how far a face looks towards the viewer
            a, b, _, d = (points[self.robot.quads[:, i]] for i in range(4))
            normal = np.cross(b - a, d - a)
            towards = np.abs(normal @ self.axes_of_view()[2])
            length = np.linalg.norm(normal, axis=1)
            colours = colours * (0.62 + 0.38 * towards / np.where(length > 0, length, 1))[:, None]
        self.robot.move(time, np.round(colours))
        return (points.min(axis=0) + points.max(axis=0)) / 2

    def _show_vortices(self, time):
        stored = [(t, files[0]) for t, files in fields.stored_frames(self.folder, "fluid.pvd")]
        if not stored:
            return
        nearest = min(stored, key=lambda item: abs(item[0] - time))
        if nearest[1] == self.shown_flow:
            return
        for shape in self.moving:
            self.renderer.RemoveActor(shape)
        self.shown_flow = nearest[1]
        self.moving = list(actors.vortices(nearest[1], self.levels))
        for shape in self.moving:
            self.renderer.AddActor(shape)

    def _show_field(self, time):
        """The field now as an arrow in the upper left corner; a circle is its largest."""
        field = self.run["field"]
        if not field or self.look == "picture":
            return
        t = actors.unpacked(field["times"], "<f4")
        row = max(0, int(np.searchsorted(t, time * (1 + 1e-6), "right")) - 1)
        vector = actors.unpacked(field["vectors"], "<f4").reshape(-1, 3)[row]
        right, up, _ = self.axes_of_view()
        unit = self.size[1] / 620
        middle = np.array([62 * unit, self.size[1] - 62 * unit])
        tip = 38 * unit * np.array([vector @ right, vector @ up]) / field["largest"]
        points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
        turn = np.linspace(0, 2 * np.pi, 49)
        ring = middle + 46 * unit * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        head = [tip + 0.3 * (np.array([[c, -s], [s, c]]) @ -tip)
                for c, s in ((0.9, 0.43), (0.9, -0.43))]
        for line in (ring, [middle - tip, middle + tip],
                     [middle + head[0], middle + tip, middle + head[1]]):
            cells.InsertNextCell(len(line))
            for x, y in line:
                cells.InsertCellPoint(points.InsertNextPoint(x, y, 0))
        self.arrow.SetPoints(points)
        self.arrow.SetLines(cells)

    def draw(self, time):
        """(height, width, 3) of that time, from 0 to 255."""
        centre = (self.low + self.high) / 2
        if self.robot:
            centre = self._show_robot(time)
        if self.look == "picture":
            self._show_vortices(time)
        elif self.run["flow"] and self.flow_name != "none":
            actors.show_slice(self.slice, self.run["flow"], self.flow_name, time)
        self._show_field(time)
        self.caption.SetInput(f"t = {1e3 * time:.4g} ms")
        self._aim(centre)
        self.window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = grab.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars())
        return pixels.reshape(height, width, -1)[::-1, :, :3]
