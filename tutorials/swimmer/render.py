"""Renders one instant of a run: the robot in its box of fluid, with its vortices.

    render.py RUN_FOLDER [--time "160 ms"] [--out render.png] [--levels 60,150]
              [--zoom 1.6] [--plain]

The robot is coloured by the component of its magnetisation along its own length (the cell
field `magnetization` of the .vtu, in the undeformed frame). Vortices are translucent
surfaces of equal |curl u|, in 1/s; without --levels at shares of its largest value. Needs
no display: without one it runs again under xvfb-run.
"""
import argparse
import os
import pathlib
import shutil
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from magfsi import plotting

SIZE = (1600, 1200)
SHARES_OF_MAXIMUM = (0.12, 0.3, 0.6)
OPACITIES = (0.13, 0.22, 0.4)
WATER = ((0.62, 0.80, 0.93), (0.25, 0.58, 0.82), (0.07, 0.31, 0.60))
NORTH, MIDDLE, SOUTH = (0.78, 0.16, 0.15), (0.93, 0.90, 0.86), (0.13, 0.25, 0.52)
PLAIN = (0.86, 0.45, 0.20)


def ensure_display():
    """VTK's OpenGL window wants an X server, also off screen."""
    if os.environ.get("DISPLAY"):
        return
    wrapper = shutil.which("xvfb-run")
    if wrapper is None:
        sys.exit("no DISPLAY, and xvfb-run is not installed (apt install xvfb xauth)")
    os.execv(wrapper, [wrapper, "-a", "-s", "-screen 0 1600x1200x24", sys.executable,
                       *sys.argv])


def files_at(folder, collection, time_s):
    """(time, files) of the instant of a .pvd nearest to time_s, or of the last."""
    entries = plotting.frames(folder, collection)
    if not entries:
        sys.exit(f"{folder / collection} names no file")
    times = [time for time, _ in entries]
    chosen = times[-1] if time_s is None else min(times, key=lambda t: abs(t - time_s))
    return chosen, [file for time, file in entries if time == chosen]


def actor(source, colour, opacity=1.0, ambient=0.15, diffuse=0.85, specular=0.0):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    shape = vtk.vtkActor()
    shape.SetMapper(mapper)
    look = shape.GetProperty()
    look.SetColor(colour)
    look.SetOpacity(opacity)
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(40)
    return shape


def north_south(largest):
    colours = vtk.vtkColorTransferFunction()
    colours.SetColorSpaceToLab()
    for value, colour in ((-largest, SOUTH), (0, MIDDLE), (largest, NORTH)):
        colours.AddRGBPoint(value, *colour)
    return colours


def robot(file, plain):
    """The skin of the body with sharp edges, coloured along its length."""
    grid = plotting.read_grid(file)
    smooth = vtk.vtkCellDataToPointData()  # colours flow over the elements
    smooth.SetInputData(grid)
    skin = vtk.vtkGeometryFilter()
    skin.SetInputConnection(smooth.GetOutputPort())
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(skin.GetOutputPort())
    normals.SetFeatureAngle(50)
    shape = actor(normals, PLAIN, ambient=0.25, diffuse=0.8, specular=0.25)
    magnetization = grid.GetCellData().GetArray("magnetization")
    if magnetization is None or plain:
        return shape
    largest = np.abs(vtk_to_numpy(magnetization)[:, 0]).max() or 1.0
    colours = north_south(largest)
    colours.SetVectorModeToComponent()
    colours.SetVectorComponent(0)
    mapper = shape.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("magnetization")
    mapper.SetLookupTable(colours)
    return shape


def vortex_strength(image):
    """|curl u| in the cells; from the velocity where no vorticity was stored."""
    if not image.GetCellData().HasArray("vorticity"):
        gradient = vtk.vtkGradientFilter()
        gradient.SetInputData(image)
        gradient.SetInputScalars(vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "velocity")
        gradient.ComputeGradientOff()
        gradient.ComputeVorticityOn()
        gradient.SetVorticityArrayName("vorticity")
        gradient.Update()
        image = gradient.GetOutput()
    vorticity = vtk_to_numpy(image.GetCellData().GetArray("vorticity"))
    return np.linalg.norm(vorticity, axis=1)


def vortices(image, levels):
    """A translucent surface for each level."""
    strength = vortex_strength(image)
    scalar = numpy_to_vtk(strength, deep=True)
    scalar.SetName("strength")
    image.GetCellData().SetScalars(scalar)
    points = vtk.vtkCellDataToPointData()
    points.SetInputData(image)
    levels = levels or [share * strength.max() for share in SHARES_OF_MAXIMUM]
    for level, colour, opacity in zip(levels, WATER, OPACITIES):
        surface = vtk.vtkContourFilter()
        surface.SetInputConnection(points.GetOutputPort())
        surface.SetInputArrayToProcess(0, 0, 0, 0, "strength")
        surface.SetValue(0, level)
        yield actor(surface, colour, opacity, ambient=0.35, diffuse=0.7, specular=0.15)


def box(image):
    """The outline as thin tubes, and a floor that gives the picture a ground."""
    outline = vtk.vtkOutlineFilter()
    outline.SetInputData(image)
    tube = vtk.vtkTubeFilter()
    tube.SetInputConnection(outline.GetOutputPort())
    tube.SetRadius(0.0010 * image.GetLength())
    tube.SetNumberOfSides(12)
    yield actor(tube, (0.45, 0.48, 0.52), ambient=0.5, diffuse=0.5)
    x0, x1, y0, y1, z0, _ = image.GetBounds()
    floor = vtk.vtkPlaneSource()
    floor.SetOrigin(x0, y0, z0)
    floor.SetPoint1(x1, y0, z0)
    floor.SetPoint2(x0, y1, z0)
    yield actor(floor, (0.90, 0.93, 0.95), 0.8, ambient=0.6, diffuse=0.4)


def part_in_view(image, target, zoom):
    """Lowest and highest corner of what the picture must hold: the box at zoom 1, then
    smaller parts of it, ever closer around the target."""
    bounds = np.array(image.GetBounds()).reshape(3, 2)
    centre, half = bounds.mean(axis=1), np.ptp(bounds, axis=1) / 2
    centre = centre + (np.asarray(target) - centre) * (1 - 1 / zoom)
    return centre - half / zoom, centre + half / zoom


def aim(renderer, low, high):
    """From the front, a little from the right and above, filling the picture."""
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint((low + high) / 2)
    camera.SetPosition((low + high) / 2 + [0.45, -1.0, 0.27])
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(20)
    renderer.ResetCamera(np.stack([low, high], axis=1).ravel())
    to_view = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1, 1)
    corners = np.array([to_view.MultiplyPoint((x, y, z, 1)) for x in (low[0], high[0])
                        for y in (low[1], high[1]) for z in (low[2], high[2])])
    seen = corners[:, :2] / corners[:, 3:]  # -1 to 1 across the picture
    middle = (seen.min(axis=0) + seen.max(axis=0)) / 2
    zoom = 0.94 / (np.ptp(seen, axis=0) / 2).max()
    camera.Zoom(zoom)
    camera.SetWindowCenter(*(middle * zoom))
    renderer.ResetCameraClippingRange()


def light(renderer):
    """Key from the upper left, fill from the right, both fixed to the camera."""
    renderer.AutomaticLightCreationOff()
    for position, strength in (((-1.2, 1.6, 2.0), 0.9), ((1.8, 0.2, 1.2), 0.35)):
        lamp = vtk.vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(position)
        lamp.SetIntensity(strength)
        renderer.AddLight(lamp)


def caption(time_s):
    text = vtk.vtkTextActor()
    text.SetInput(f"t = {1e3 * time_s:.4g} ms")
    text.SetPosition(48, 40)
    look = text.GetTextProperty()
    look.SetFontFamilyToArial()
    look.SetFontSize(34)
    look.SetColor(0.3, 0.33, 0.37)
    return text


def save(renderer, out):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*SIZE)
    window.SetMultiSamples(0)  # not together with depth peeling
    window.SetAlphaBitPlanes(1)
    window.AddRenderer(renderer)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(12)
    renderer.UseFXAAOn()
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(str(out))
    writer.Write()


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("run_folder", type=pathlib.Path)
    options.add_argument("--time", type=plotting.seconds, help="nearest stored instant; the last")
    options.add_argument("--out", type=pathlib.Path, default=pathlib.Path("render.png"))
    options.add_argument("--levels", help="up to three, in 1/s, rising: 60,150,300",
                         type=lambda text: [float(level) for level in text.split(",")])
    options.add_argument("--zoom", type=float, default=1.0, help="1 shows the whole box")
    options.add_argument("--plain", action="store_true", help="robot in one colour")
    chosen = options.parse_args()
    ensure_display()

    time_s, images = files_at(chosen.run_folder, "fluid.pvd", chosen.time)
    _, bodies = files_at(chosen.run_folder, "structure.pvd", time_s)
    image = plotting.read_grid(images[0])
    renderer = vtk.vtkRenderer()
    renderer.GradientBackgroundOn()
    renderer.SetBackground(0.93, 0.95, 0.97)  # below
    renderer.SetBackground2(1, 1, 1)
    robots = [robot(body, chosen.plain) for body in bodies]
    for shape in (*box(image), *robots, *vortices(image, chosen.levels)):
        renderer.AddActor(shape)
    renderer.AddActor2D(caption(time_s))
    light(renderer)
    aim(renderer, *part_in_view(image, robots[0].GetCenter(), chosen.zoom))
    save(renderer, chosen.out)
    print(chosen.out)


if __name__ == "__main__":
    main()
