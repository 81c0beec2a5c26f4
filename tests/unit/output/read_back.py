# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads with VTK's own readers what write_vtk_samples wrote: read_back.py PROGRAM FOLDER."""
import os
import subprocess
import sys
import xml.etree.ElementTree

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing.name} for /usr/bin/python3 is missing (apt install python3-vtk9)")
    sys.exit(77)

errors = []


def read(reader, path):
    """VTK reports a broken file to an observer, not by an exception."""
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path)
    reader.Update()
    assert not errors, f"VTK cannot read {errors}"
    return reader.GetOutput()


def array(data, name):
    values = vtk_to_numpy(data.GetArray(name))
    assert np.isfinite(values).all(), name
    return values


def check_block(path):
    grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
    assert grid.GetNumberOfPoints() == 60 and grid.GetNumberOfCells() == 24
    k, j, i = np.meshgrid(range(3), range(4), range(5), indexing="ij")
    x, y, z = 0.5 * i.ravel(), 1.0 * j.ravel(), 2.0 * k.ravel()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert points.dtype == np.float64
    assert (points == np.stack([x + 0.25 * z, y, z], axis=1)).all()
    displacement = array(grid.GetPointData(), "displacement")
    assert (displacement == np.stack([0.25 * z, 0 * z, 0 * z - 1e-300], axis=1)).all()
    scalar = array(grid.GetPointData(), "a < b & c")
    assert scalar.dtype == np.float32 and (scalar == (x + 10 * y + 100 * z)).all()

    cells = np.arange(24)
    assert (array(grid.GetCellData(), "energy") == 1.0 / (1 + cells)).all()
    magnetization = array(grid.GetCellData(), "magnetization")
    assert magnetization.dtype == np.float32
    indices = np.stack([cells % 4, 2 * (cells // 4 % 3), 3 * (cells // 12)], axis=1)
    assert (magnetization == indices).all()

    # Sheared bricks of 0.5 x 1 x 2: shear keeps the volume 1. A wrong node order gives
    # negative or zero Jacobians.
    quality = vtk.vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetHexQualityMeasureToJacobian()
    quality.Update()
    jacobian = array(quality.GetOutput().GetCellData(), "Quality")
    size = vtk.vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    volume = array(size.GetOutput().GetCellData(), "Volume")
    # Sums of numbers of order 1 in double: rounding stays below 1e-12.
    assert np.abs(jacobian - 1).max() < 1e-12, jacobian
    assert np.abs(volume - 1).max() < 1e-12, volume
    print(f"vtu: 24 cells, Jacobian {jacobian.min():g} to {jacobian.max():g}, "
          f"volume {volume.min():g} to {volume.max():g}")


def check_image(image, low, high):
    k, j, i = np.meshgrid(*(range(low[d], high[d]) for d in (2, 1, 0)), indexing="ij")
    i, j, k = i.ravel(), j.ravel(), k.ravel()
    assert image.GetExtent() == tuple(v for d in range(3) for v in (low[d], high[d]))
    assert image.GetOrigin() == (-1, 0, 0.1) and image.GetSpacing() == (0.25, 0.5, 0.1)
    velocity = array(image.GetCellData(), "velocity")
    assert velocity.dtype == np.float32
    assert (velocity == np.stack([i, j, k], axis=1)).all()
    density = array(image.GetCellData(), "density")
    assert (density == 1000 + 1.0 / (1 + i + 10 * j + 100 * k)).all()


def main(program, folder):
    subprocess.run([program, folder], check=True)
    series = xml.etree.ElementTree.parse(os.path.join(folder, "block.pvd"))
    entries = [(float(e.get("timestep")), e.get("file")) for e in series.iter("DataSet")]
    assert entries == [(0.1, "block/0.vtu")], entries
    check_block(os.path.join(folder, entries[0][1]))
    piece = read(vtk.vtkXMLImageDataReader(), os.path.join(folder, "image_2.vti"))
    check_image(piece, (2, 0, 1), (6, 5, 4))
    whole = read(vtk.vtkXMLPImageDataReader(), os.path.join(folder, "image.pvti"))
    check_image(whole, (0, 0, 0), (6, 5, 4))
    print("vti, pvti: 120 cells equal")


main(*sys.argv[1:])
