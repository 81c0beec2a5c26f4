# SPDX-License-Identifier: GPL-2.0-or-later
"""Where a picture is seen from, and what of the run fills it.

auto     the box, or as much of it as leaves the bodies a good share of the picture
bodies   the bodies at the instant
course   the bodies over their whole course, as the page does at first
box      the whole box
"""
import numpy as np

FRAMES = ("auto", "bodies", "course", "box")
# Turned to the right, and up [rad]; (0, 0) looks along y, with x to the right and z up.
VIEWS = {"page": (-0.35, 0.2),  # report/view.js
         "corner": (0.423, 0.2415), "front": (0.0, 0.0), "side": (np.pi / 2, 0.0), "top": (0.0, np.pi / 2)}
SHARE_OF_VIEW = 0.85  # of what is framed without perspective
FILLS = 0.94  # and with it
BODIES_WIDE, BODIES_HIGH = 0.34, 0.62  # of the picture that auto gives to the bodies
VIEW_ANGLE_DEG = 20


def axes(yaw, pitch):
    """Unit vectors to the right, up and towards the viewer."""
    cy, sy, cp, sp = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    return np.array([[cy, sy, 0], [-sp * sy, sp * cy, cp], [cp * sy, -cp * cy, sp]])


def corners(low, high):
    return np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                     for z in (low[2], high[2])])


class Camera:
    """Aims a VTK renderer. box, course: lowest and highest corners."""

    def __init__(self, renderer, size, view, perspective, frame, zoom, box, course):
        self.renderer, self.size, self.frame, self.zoom = renderer, size, frame, zoom
        self.axes, self.perspective = axes(*view), perspective
        self.box, self.course = box, course
        self.share = None  # of the box that auto shows; the same over a film

    def aim(self, ends):
        """ends: of the bodies now; of the box where there are none."""
        low, high = {"bodies": ends, "course": self.course}.get(self.frame, self.box)
        if self.frame == "auto":
            low, high = self._auto(ends)
        half = np.maximum((np.array(high) - low) / 2, 1e-9) / self.zoom
        middle = (np.array(low) + high) / 2
        if self.zoom > 1 and self.frame in ("auto", "box"):  # closer, ever more around the bodies
            middle += ((np.array(ends[0]) + ends[1]) / 2 - middle) * (1 - 1 / self.zoom)
        self._fit(middle - half, middle + half)

    def _auto(self, ends):
        """The box shrinks around the bodies until these are large enough."""
        if self.share is None:
            self.share = 1.0
            for _ in range(4):  # perspective is not quite in proportion
                self._fit(*self._part(ends))
                wide, high = np.ptp(self.pixels(corners(*ends)), axis=0) / self.size
                grow = min(BODIES_WIDE / max(wide, 1e-9), BODIES_HIGH / max(high, 1e-9))
                self.share = min(1.0, self.share / grow)
        return self._part(ends)

    def _part(self, ends):
        """That share of the box: around the bodies, but inside the box."""
        low, high = map(np.array, self.box)
        half = self.share * (high - low) / 2
        middle = np.clip((np.array(ends[0]) + ends[1]) / 2, low + half, high - half)
        return middle - half, middle + half

    def _fit(self, low, high):
        camera = self.renderer.GetActiveCamera()
        middle, diagonal = (low + high) / 2, np.linalg.norm(high - low)
        _, up, towards = self.axes
        camera.SetFocalPoint(middle)
        camera.SetViewUp(up)
        camera.SetWindowCenter(0, 0)
        camera.SetPosition(middle + 10 * diagonal * towards)
        if self.perspective:
            self._fit_with_perspective(camera, low, high)
        else:
            camera.ParallelProjectionOn()
            right, up = np.abs(self.axes[:2]) @ (high - low)
            scale = SHARE_OF_VIEW * min(self.size[0] / max(right, 1e-12), self.size[1] / max(up, 1e-12))
            camera.SetParallelScale(self.size[1] / 2 / scale)
        self.renderer.ResetCameraClippingRange()

    def _fit_with_perspective(self, camera, low, high):
        camera.ParallelProjectionOff()
        camera.SetViewAngle(VIEW_ANGLE_DEG)
        self.renderer.ResetCamera(np.stack([low, high], axis=1).ravel())
        seen = self._seen(corners(low, high))
        offset = (seen.min(axis=0) + seen.max(axis=0)) / 2
        zoom = FILLS / (np.ptp(seen, axis=0) / 2).max()
        camera.Zoom(zoom)
        camera.SetWindowCenter(*(offset * zoom))

    def _seen(self, points):
        """From -1 to 1 across the picture."""
        matrix = self.renderer.GetActiveCamera().GetCompositeProjectionTransformMatrix(
            self.size[0] / self.size[1], -1, 1)
        places = np.array([matrix.MultiplyPoint((*point, 1)) for point in points])
        return places[:, :2] / places[:, 3:]

    def pixels(self, points):
        """Of points in space, from the lower left corner."""
        return (self._seen(points) + 1) / 2 * self.size

    def pixels_a_metre(self, at):
        """Across the view, in the depth of a point."""
        step = 1e-3 * np.linalg.norm(np.array(self.box[1]) - self.box[0])
        both = self.pixels([at, np.array(at) + step * self.axes[0]])
        return np.linalg.norm(both[1] - both[0]) / step
