"""What a plane cuts out of grains and surfaces, for the scripts that draw sections."""

import numpy as np

from picture import cell_values, read_vtu


def cut_at(path, y):
    """The lines in which a plane y = const [m] cuts the cells of a file."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersCore import vtkCutter
    cutter, plane = vtkCutter(), vtkPlane()
    plane.SetNormal(0, 1, 0)
    plane.SetOrigin(0, y, 0)
    cutter.SetInputData(read_vtu(path))
    cutter.SetCutFunction(plane)
    cutter.Update()
    return cutter.GetOutput()


def segments_of(cut):
    """Ends of the lines of a cut, x and z, in mm: an array of [line, end, 2]."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    places = vtk_to_numpy(cut.GetPoints().GetData())[:, [0, 2]] * 1e3
    return places[vtk_to_numpy(cut.GetLines().GetConnectivityArray()).reshape(-1, 2)]


def slice_of(path, fields, y=0):
    """Outlines of the grains in the plane, x and z in mm, and an array for each of the fields, in their order."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    cut = cut_at(path, y)
    ends = segments_of(cut)
    data = cut.GetCellData()
    ids = vtk_to_numpy(data.GetArray("id"))
    outlines, first_rows = [], []
    order = np.argsort(ids, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(ids[order])) + 1):
        outline = ends[rows].reshape(-1, 2)
        around = outline - outline.mean(axis=0)  # a convex grain's section is convex
        outlines.append(outline[np.argsort(np.arctan2(around[:, 1], around[:, 0]))])
        first_rows.append(rows[0])
    return outlines, [vtk_to_numpy(data.GetArray(field))[first_rows] for field in fields]


def chains_near(contacts, thickness):
    """Branches of the contacts within a slab about y = 0, x and z in mm, and their normal forces."""
    places = np.stack([contacts.start, contacts.start + contacts.branch], axis=1) * 1e3
    near = np.abs(places[:, :, 1]).max(axis=1) < 0.5 * thickness
    return places[near][:, :, [0, 2]], contacts.normal_force[near]


def grid_of(path, field):
    """Of a grid with one layer of cells along y: its planes across x and z in mm, and a field by row and column."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    grid = read_vtu(path)
    places = np.round(vtk_to_numpy(grid.GetPoints().GetData()) * 1e3, 9)
    x, z = np.unique(places[:, 0]), np.unique(places[:, 2])
    return x, z, cell_values(grid, field).reshape(len(z) - 1, len(x) - 1)
