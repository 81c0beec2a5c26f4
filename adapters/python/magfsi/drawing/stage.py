# SPDX-License-Identifier: GPL-2.0-or-later
"""A run on a stage: the same bodies, box, obstacles and flow at any time, in two looks.

page     as the page shows it: without perspective, a slice of the flow, the field as an arrow
picture  with perspective and light, vortices as translucent surfaces
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from magfsi.drawing import actors
from magfsi.drawing.camera import VIEWS, Camera, axes
from magfsi.drawing.clock import Clock
from magfsi.drawing.labels import Labels
from magfsi.drawing.magnetisation import Arrows, Magnetisation
from magfsi.report import data, fields, shapes
from magfsi.report.colours import colour_table

ROOM = 20e6  # bytes of fields: a film has more of them than a page
PAPER, INK = (0.957, 0.957, 0.957), (0.1, 0.1, 0.1)


# hwloc, in MPI programs, asks the displays :0 to :9 for graphics cards when it starts; a display that ends
# at that moment ends the program.
FIRST_DISPLAY, DISPLAYS = 100, 400


def started_display(number):
    """Whether there is an Xvfb of this number now, which ends with this program. -noreset: otherwise it
    starts anew when a window is closed, and meanwhile refuses the next one."""
    told, tells = os.pipe()
    subprocess.Popen(["setpriv", "--pdeathsig", "TERM", "Xvfb", f":{number}", "-displayfd", str(tells),
                      "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"], pass_fds=[tells],
                     start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(tells)
    with os.fdopen(told) as file:  # Xvfb tells its number when it is ready
        return file.readline().strip() == str(number)


def ensure_display():
    """VTK's OpenGL window wants an X server, also off screen: without one this program starts Xvfb. Of two
    programs under xvfb-run both may take the same."""
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("Xvfb") is None:
        sys.exit("no DISPLAY, and Xvfb is not installed (apt install xvfb)")
    for tried in range(20):
        number = FIRST_DISPLAY + (os.getpid() + tried) % DISPLAYS
        if started_display(number):
            os.environ["DISPLAY"] = f":{number}"
            return
    sys.exit(f"no DISPLAY, and Xvfb ends at once; see what it says: Xvfb :{FIRST_DISPLAY}")


class Stage:
    """Raises data.NotARun where nothing can be drawn. `hidden`: of PARTS; `view`: (yaw, pitch) [rad];
    `obstacles`: cut, glass or whole; colour: what magfsi.report has, or `direction`."""

    def __init__(self, folder, look="page", size=(1400, 620), colour="magnetisation", flow="speed",
                 levels=None, zoom=1.0, view=None, frame=None, obstacles="cut", hidden=()):
        self.folder, self.look, self.size, self.hidden = Path(folder), look, size, hidden
        self.flow_name, self.obstacles = flow, obstacles
        self.picture = look == "picture"
        self.scene = data.read_json(self.folder / "scene.json", {})
        self.run = data.read_run(self.folder, ROOM, surfaces=False)
        if not self.run["bodies"] and not self.run["flow"]:
            raise data.NotARun(f"{folder}: nothing to draw: no fields; output.structure in the "
                               "scene writes them")
        self.box = tuple(map(np.array, data.shown_box(self.scene, self.run["bodies"])))
        ends = self.run["bodies"]
        self.course = (np.array(ends["low"]), np.array(ends["high"])) if ends else None
        self.robot = actors.Robot(ends) if ends else None
        view = VIEWS["corner" if self.picture else "page"] if view is None else view
        self.axes = axes(*view)
        self.flows = fields.flow_frames(self.folder) if self.picture and "vortices" not in hidden else []
        self.renderer, self.above = vtk.vtkRenderer(), vtk.vtkRenderer()
        self.levels, self.moving, self.shown_flow = levels, [], None
        self._colour(colour)
        self._furnish()
        self._window()
        self.camera = Camera(self.renderer, np.array(size), view, self.picture,
                             frame or ("auto" if self.picture else "course"), zoom, self.box,
                             self.course or self.box)
        self._write_labels()

    def _colour(self, colour):
        """By direction where the files tell it; the arrows then, too."""
        self.colour, self.magnetisation, self.arrows = colour, None, None
        if colour != "direction" or not self.robot:
            return
        self.colour = ""
        field = self.run["field"]
        found = Magnetisation(self.folder, self.scene, None if field is None else self._field_vectors(field))
        if found.largest:
            self.magnetisation = found
            if "arrows" not in self.hidden:
                self.arrows = Arrows(self._centres(found.times[0]))
                self.above.AddActor(self.arrows.actor)

    def _centres(self, time):
        """Of the faces."""
        return self.robot.points(time)[self.robot.quads].mean(axis=1)

    def times(self):
        """Of the first and the last frame."""
        every = [t for part in (self.run["bodies"], self.run["flow"]) if part
                 for t in (part["times"][0], part["times"][-1])]
        return min(every), max(every)

    def _furnish(self):
        add = self.renderer.AddActor
        if self.picture:
            self.renderer.GradientBackgroundOn()
            self.renderer.SetBackground(0.93, 0.95, 0.97)  # below
            self.renderer.SetBackground2(1, 1, 1)
            self._light()
        else:
            self.renderer.SetBackground(PAPER)
        opened, wires = False, self.run["wires"]
        if "obstacles" in self.hidden:
            wires = []
        elif self.picture:
            found, opened = actors.solids(self.scene, self.obstacles, self.axes[2], self.course)
            wires = shapes.wires({k: v for k, v in self.scene.items() if k == "platform"}, *self.box)
            for shape in found:
                add(shape)
        if wires:
            add(actors.lines(wires, INK, 1, 0.6))
        if self.run["box"] and "box" not in self.hidden:
            add(actors.lines(actors.edges(*self.box), INK, 1.5, 0.6 if self.picture else 0.35))
            if self.picture and not opened:  # in a vessel a floor says nothing
                add(actors.floor(*self.box))
        self.sources = [actors.Source(found) for found in self.run["sources"]
                        if found.get("lines") and "sources" not in self.hidden]
        for source in self.sources:
            add(source.actor)
        if self.robot:
            self.body = self._robot_actor()
            add(self.body)
        if self.run["flow"] and not self.picture and self.flow_name != "none":
            self.slice = actors.slice_actor(self.run["flow"])
            add(self.slice)

    def _robot_actor(self):
        if self.picture:
            normals = vtk.vtkPolyDataNormals()
            normals.SetInputData(self.robot.data)
            normals.SetFeatureAngle(50)
            shape = actors.actor(normals, (1, 1, 1), ambient=0.25, diffuse=0.8, specular=0.25)
        else:
            shape = actors.actor(self.robot.data, (1, 1, 1), ambient=1, diffuse=0)
        shape.GetMapper().ScalarVisibilityOn()
        shape.GetMapper().SetScalarModeToUseCellData()
        return shape

    def _write_labels(self):
        run = self.run
        self.labels, self.clock = Labels(self.size), Clock(run)
        if "bars" not in self.hidden:
            chosen = self.robot and self.robot.chosen(self.colour)
            if chosen:
                self._bar(chosen, "signed" if chosen["signed"] else "magnitude")
            if self.magnetisation:
                found = self.magnetisation
                self.labels.wheel(found.plane, found.largest, found.carried)
            if run["flow"] and not self.picture and self.flow_name != "none":
                shown = actors.quantity(run["flow"], self.flow_name)
                self._bar(shown, "signed" if shown["signed"] else "flow")
        self.field = None if "field" in self.hidden else run["field"]
        if self.field:
            self.labels.arrow_of_field(f"\nat {self.field['at']}" if self.field["at"] else "")

    def _bar(self, quantity, table):
        self.labels.bar(quantity["name"], colour_table(table), quantity["low"], quantity["high"], quantity["unit"],
                        quantity["beyond"])

    def _levels(self):
        """Of the vortices, the same over a film; known when the first are drawn."""
        if not isinstance(self.levels, tuple):
            self.levels = tuple(actors.levels_of(self.flows[-1][1], self.levels))
            if self.levels and "bars" not in self.hidden:
                self.labels.surfaces("vortices: |curl u|", "1/s", self.levels)
        return self.levels

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
        # What is over all is in a layer of its own, seen by the same camera.
        self.window.SetNumberOfLayers(2)
        self.above.SetLayer(1)
        self.above.SetActiveCamera(self.renderer.GetActiveCamera())
        self.window.AddRenderer(self.renderer)
        self.window.AddRenderer(self.above)
        self.renderer.SetUseDepthPeeling(1)
        self.renderer.SetMaximumNumberOfPeels(12)
        self.renderer.UseFXAAOn()

    def _show_robot(self, time):
        """Lowest and highest corner of the bodies."""
        points = self.robot.points(time)
        if self.magnetisation:
            colours = self.magnetisation.face_colours(time)
            if self.arrows:
                self.arrows.move(self._centres(time), self.magnetisation.of_faces(time), self.magnetisation.largest)
        else:
            colours = self.robot.face_colours(time, self.colour)
        # What has a bar of colours is not lit: the bar says what is drawn.
        if not self.picture and not self.magnetisation and not self.robot.chosen(self.colour):
            a, b, _, d = (points[self.robot.quads[:, i]] for i in range(4))
            normal = np.cross(b - a, d - a)
            towards = np.abs(normal @ self.axes[2])
            length = np.linalg.norm(normal, axis=1)
            colours = colours * (0.62 + 0.38 * towards / np.where(length > 0, length, 1))[:, None]
        self.robot.move(time, np.round(colours))
        return points.min(axis=0), points.max(axis=0)

    def _show_vortices(self, time):
        if not self.flows:
            return
        files = min(self.flows, key=lambda item: abs(item[0] - time))[1]
        if files == self.shown_flow:
            return
        for shape in self.moving:
            self.renderer.RemoveActor(shape)
        self.shown_flow = files
        self.moving = list(actors.vortices(files, self._levels()))
        for shape in self.moving:
            self.renderer.AddActor(shape)

    @staticmethod
    def _field_vectors(field):
        return actors.unpacked(field["vectors"], "<f4").reshape(-1, 3)

    def _show_field(self, time):
        """The field now as an arrow in the upper left corner; a circle is its largest."""
        if not self.field:
            return
        t = actors.unpacked(self.field["times"], "<f4")
        row = max(0, int(np.searchsorted(t, time * (1 + 1e-6), "right")) - 1)
        vector = self._field_vectors(self.field)[row]
        self.labels.show_field(self.axes[:2] @ vector / self.field["largest"], float(np.linalg.norm(vector)))

    def draw(self, time):
        """(height, width, 3) of that time, from 0 to 255."""
        ends = self._show_robot(time) if self.robot else self.box
        if self.picture:
            self._show_vortices(time)
        elif self.run["flow"] and self.flow_name != "none":
            actors.show_slice(self.slice, self.run["flow"], self.flow_name, time)
        for source in self.sources:
            source.move(time)
        self._show_field(time)
        if "time" not in self.hidden:
            self.labels.time.set_text(self.clock.text(time))
        self.camera.aim(ends)
        if "scale" not in self.hidden:
            self.labels.scale_bar(self.camera.pixels_a_metre((ends[0] + ends[1]) / 2))
        return self.labels.over(self._pixels())

    def _pixels(self):
        self.window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = grab.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars())
        return pixels.reshape(height, width, -1)[::-1, :, :3]

    def share_of_width(self, time):
        """(width, height) of the pixels that the bodies change, as shares of the picture's width."""
        self.draw(time)
        shown = self._pixels().astype(int)
        for shape in (self.body, self.arrows and self.arrows.actor):
            if shape:
                shape.VisibilityOff()
        changed = np.abs(shown - self._pixels()).sum(axis=2) > 30
        for shape in (self.body, self.arrows and self.arrows.actor):
            if shape:
                shape.VisibilityOn()
        return tuple((np.ptp(np.nonzero(changed)[axis]) + 1) / self.size[0] if changed.any() else 0.0
                     for axis in (1, 0))
