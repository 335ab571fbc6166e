"""What draws the faces of a run's surfaces: reading surfaces_*.vtu, and views of their triangles."""

import os
import re
from pathlib import Path

import numpy as np

import run_data


def read_series(folder):
    """Times [s] and files of the surfaces."""
    path = os.path.join(folder, "surfaces.pvd")
    try:
        text = Path(path).read_text()
    except OSError as error:
        run_data.fail(f"{path}: {error.strerror}; name the folder of a run")
    entries = re.findall(r'timestep="([^"]*)"[^>]*file="([^"]*)"', text)
    return [(float(time), os.path.join(folder, file)) for time, file in entries]


def read_surface(path):
    """Corners of the triangles, (n, 3, 3) [m], and their pressures [Pa], each the mean of those of its nodes: a node has
    the forces of its triangles over their areas."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    places = vtk_to_numpy(grid.GetPoints().GetData())
    triangles = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3)
    corners = places[triangles]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    forces = vtk_to_numpy(grid.GetCellData().GetArray("pressure")) * areas
    of_nodes = [np.bincount(triangles.ravel(), np.repeat(values, 3), len(places)) for values in (forces, areas)]
    return corners, (of_nodes[0] / of_nodes[1])[triangles].mean(axis=1)


def add_view(axes, corners, values, axis, highest, looks=-1):
    """Triangles that look along an axis, or against it (looks = -1), seen along it or against it [m]."""
    from matplotlib.collections import PolyCollection
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = np.flatnonzero(looks * normals[:, axis] > 0)
    seen = seen[np.argsort(-corners[seen][:, :, axis].mean(axis=1))]  # the near ones last
    plane = [0, 2 if axis == 1 else 1]
    faces = PolyCollection(corners[seen][:, :, plane] * 1e3, array=values[seen], cmap="viridis", linewidth=0.15,
                           edgecolor="#999999")
    faces.set_clim(0, highest)
    axes.add_collection(faces)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.grid(False)
    return faces
