#!/usr/bin/python3
"""Draws the last state of a run: its grains and its continuum together.

Reads the last grains_*.vtu (triangulated surfaces; cell data id, and weight where grains fade into the continuum) and
the last continuum_*.vtu (hexahedra; point data displacement) of the folder and writes RUN_FOLDER/plots/picture.png.
Needs no screen: without DISPLAY the script starts itself anew under xvfb-run.
"""

import argparse
import os
import shutil
import sys

import run_data
from run_data import bergamo

SIZE = (1600, 1200)  # pixels
SAND = [(0.84, 0.72, 0.53), (0.76, 0.62, 0.43), (0.90, 0.80, 0.63), (0.69, 0.57, 0.42), (0.87, 0.70, 0.47),
        (0.79, 0.69, 0.55), (0.93, 0.85, 0.71), (0.72, 0.54, 0.36)]
MESH_COLOUR = (0.60, 0.76, 0.93)
EDGE_COLOUR = (0.10, 0.20, 0.34)


def ensure_display():
    if os.environ.get("DISPLAY"):
        return
    xvfb_run = shutil.which("xvfb-run")
    if xvfb_run is None:
        run_data.fail("no screen and no xvfb-run to draw without one; install the package xvfb")
    os.execv(xvfb_run, [xvfb_run, "-a", "-s", "-screen 0 1280x1024x24", "/usr/bin/python3", "-B"] + sys.argv)


def numbered_files(folder, kind):
    """The files of this kind, by their numbers."""
    return [str(path) for path in run_data.pictures_of(folder, kind).paths]


def last_file(folder, kind):
    """The file of this kind with the highest number, or nothing."""
    files = numbered_files(folder, kind)
    return files[-1] if files else None


def read_vtu(path):
    """A file with cells as VTK's own object, to be cut and drawn by VTK."""
    try:
        grid = bergamo.read_grid(path)
    except bergamo.Error as error:
        run_data.fail(error)
    if grid.GetNumberOfCells() == 0:
        run_data.fail(f"{path} has no cells")
    return grid


def surface_of(grid):
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    surface = vtkGeometryFilter()
    surface.SetInputData(grid)
    surface.Update()
    return surface.GetOutput()


def cell_values(data, name):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    array = data.GetCellData().GetArray(name)
    return None if array is None else vtk_to_numpy(array)


def sand_colours(surface):
    """Colours (red, green, blue, opacity, 0 to 255) of the cells: a tint of sand by the grain's id."""
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk
    ids = cell_values(surface, "id")
    ids = np.zeros(surface.GetNumberOfCells(), int) if ids is None else ids.astype(int)
    mixed = (ids * 2654435761) % 2**32  # Knuth's multiplicative hash: neighbours in number differ in tint
    tint = np.array(SAND)[(mixed >> 16) % len(SAND)]
    brightness = 0.92 + 0.16 * ((mixed >> 8) % 256) / 255
    colours = np.ones((len(ids), 4))
    colours[:, :3] = np.clip(tint * brightness[:, None], 0, 1)
    array = numpy_to_vtk((255 * colours).round().astype(np.uint8), deep=True)
    array.SetName("sand")
    return array


def smooth(surface):
    """The surface with one normal a point; the edges of flat faces stay sharp."""
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
    clean = vtkCleanPolyData()
    clean.SetInputData(surface)
    clean.PointMergingOff()
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(clean.GetOutputPort())
    normals.SetFeatureAngle(50)
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def grains_actor(path):
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    surface = surface_of(read_vtu(path))
    surface.GetCellData().SetScalars(sand_colours(surface))
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(smooth(surface))
    mapper.SetScalarModeToUseCellData()
    actor = vtkActor()
    actor.SetMapper(mapper)
    shading = actor.GetProperty()
    shading.SetInterpolationToPhong()
    shading.SetAmbient(0.22)
    shading.SetDiffuse(0.80)
    shading.SetSpecular(0.10)
    shading.SetSpecularPower(20)
    return actor


def displaced(grid):
    """The mesh where it is now, if its displacement is known."""
    from vtkmodules.vtkFiltersGeneral import vtkWarpVector
    if grid.GetPointData().GetArray("displacement") is None:
        return grid
    grid.GetPointData().SetActiveVectors("displacement")
    warp = vtkWarpVector()
    warp.SetInputData(grid)
    warp.Update()
    return warp.GetOutput()


def overlap_mask(grid, grains):
    """Which cells of the mesh hold grains: those with a vertex of a grain's surface in them."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    mask = np.zeros(grid.GetNumberOfCells(), bool)
    if grains is None:
        return mask
    from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
    locator = vtkStaticCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    for point in vtk_to_numpy(grains.GetPoints().GetData())[::4]:
        cell = locator.FindCell(point)
        if cell >= 0:
            mask[cell] = True
    return mask


def cells_where(grid, mask):
    import numpy as np
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkFiltersExtraction import vtkExtractCells
    cells = vtkIdList()
    for i in np.flatnonzero(mask):
        cells.InsertNextId(int(i))
    extract = vtkExtractCells()
    extract.SetInputData(grid)
    extract.SetCellList(cells)
    extract.Update()
    return extract.GetOutput()


def mesh_actors(grid, opacity):
    """The mesh's faces, and all its edges above them."""
    from vtkmodules.vtkFiltersExtraction import vtkExtractEdges
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    surface = surface_of(grid)
    faces_mapper = vtkPolyDataMapper()
    faces_mapper.SetInputData(surface)
    faces_mapper.ScalarVisibilityOff()
    faces = vtkActor()
    faces.SetMapper(faces_mapper)
    faces.GetProperty().SetColor(MESH_COLOUR)
    faces.GetProperty().SetOpacity(opacity)
    faces.GetProperty().SetAmbient(0.45)
    faces.GetProperty().SetDiffuse(0.60)
    edges_filter = vtkExtractEdges()
    edges_filter.SetInputData(surface)
    edges_mapper = vtkPolyDataMapper()
    edges_mapper.SetInputConnection(edges_filter.GetOutputPort())
    edges_mapper.ScalarVisibilityOff()
    edges_mapper.SetResolveCoincidentTopologyToPolygonOffset()
    edges_mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1, -4)
    edges = vtkActor()
    edges.SetMapper(edges_mapper)
    edges.GetProperty().SetColor(EDGE_COLOUR)
    edges.GetProperty().SetLineWidth(3.0)
    edges.GetProperty().LightingOff()
    return [faces, edges]


def add_lights(renderer):
    """A warm main light from above the camera's left, a cool fill from the right, a light from behind for the rims."""
    from vtkmodules.vtkRenderingCore import vtkLight
    renderer.AutomaticLightCreationOff()
    for position, focus_colour, strength in [((-1.2, 1.8, 2.0), (1.0, 0.97, 0.92), 0.85),
                                             ((2.0, 0.4, 1.2), (0.90, 0.95, 1.0), 0.45),
                                             ((0.0, 1.5, -2.0), (1.0, 1.0, 1.0), 0.30)]:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(position)
        light.SetFocalPoint(0, 0, 0)
        light.SetColor(focus_colour)
        light.SetIntensity(strength)
        renderer.AddLight(light)


def place_camera(renderer):
    """Three-quarter view with z upwards, the whole scene filling the picture."""
    import math
    bounds = renderer.ComputeVisiblePropBounds()
    centre = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    azimuth, elevation = math.radians(-55), math.radians(22)
    direction = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth),
                 math.sin(elevation))
    size = math.dist(bounds[0::2], bounds[1::2])
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(centre)
    camera.SetPosition([c + 3 * size * d for c, d in zip(centre, direction)])
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(24)
    renderer.ResetCamera(bounds)
    camera.Zoom(0.94 / farthest_from_middle(renderer, bounds))
    renderer.ResetCameraClippingRange()


def farthest_from_middle(renderer, bounds):
    """How far the corners of the scene's box are from the picture's middle: 1 is on its rim."""
    import itertools
    camera = renderer.GetActiveCamera()
    transform = camera.GetCompositeProjectionTransformMatrix(SIZE[0] / SIZE[1], -1, 1)
    farthest = 0.0
    for corner in itertools.product(bounds[0:2], bounds[2:4], bounds[4:6]):
        x, y, _, w = transform.MultiplyPoint((*corner, 1.0))
        farthest = max(farthest, abs(x / w), abs(y / w))
    return farthest


def render(actors, path):
    from vtkmodules.vtkImagingCore import vtkImageShrink3D
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    renderer.SetUseDepthPeeling(True)
    renderer.SetMaximumNumberOfPeels(30)
    renderer.SetOcclusionRatio(0.0)
    add_lights(renderer)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetAlphaBitPlanes(True)
    window.SetMultiSamples(0)
    window.SetSize(2 * SIZE[0], 2 * SIZE[1])  # drawn at twice the size, then halved: smooth edges everywhere
    window.AddRenderer(renderer)
    place_camera(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    halved = vtkImageShrink3D()
    halved.SetInputConnection(image.GetOutputPort())
    halved.SetShrinkFactors(2, 2, 1)
    halved.AveragingOn()
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(halved.GetOutputPort())
    writer.Write()


def scene(grains_path, continuum_path):
    actors = []
    if grains_path:
        actors.append(grains_actor(grains_path))
    if continuum_path:
        grid = displaced(read_vtu(continuum_path))
        mask = overlap_mask(grid, read_vtu(grains_path) if grains_path else None)
        if mask.any():
            actors += mesh_actors(cells_where(grid, mask), 0.22)
        if not mask.all():
            actors += mesh_actors(cells_where(grid, ~mask), 1.0)
    return actors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    grains_path, continuum_path = last_file(folder, "grains"), last_file(folder, "continuum")
    if not grains_path and not continuum_path:
        run_data.fail(f"{folder} has neither grains_*.vtu nor continuum_*.vtu")
    ensure_display()
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (before any actor is made: it brings what draws them)
    path = run_data.picture_path(folder, "picture.png")
    part = path + ".part"
    render(scene(grains_path, continuum_path), part)
    if not os.path.exists(part):
        run_data.fail(f"{path} could not be written; free some space")
    os.replace(part, path)
    print(path)


if __name__ == "__main__":
    main()
