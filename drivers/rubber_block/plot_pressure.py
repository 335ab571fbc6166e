#!/usr/bin/env python3
"""Draws the block's faces at several times of a run of rubber_block, from the side and from below, coloured by the contact
pressure over the top pressure (after fig. 4.9c of the dissertation).

Reads RUN_FOLDER/surfaces_*.vtu and writes RUN_FOLDER/plots/rubber_block_pressure.png.
"""

import argparse
import glob
import os
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data

N_TIMES = 4
HIGHEST = 5  # pressure over top pressure, of the colours


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


def add_view(axes, corners, values, axis, highest):
    """Triangles that look against an axis (1: from the side, 2: from below)."""
    from matplotlib.collections import PolyCollection
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = np.flatnonzero(normals[:, axis] < 0)
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    top = max(run_data.read_history(folder)["top_pressure_Pa"])
    series = read_series(folder)
    series = [series[k] for k in np.unique(np.linspace(0, len(series) - 1, N_TIMES + 1).astype(int)[1:])]
    run_data.new_diagram_look()
    from matplotlib import pyplot
    figure, panels = pyplot.subplots(len(series), 2, squeeze=False, figsize=(10, 2.3 * len(series)), layout="constrained")
    for row, (time, path) in zip(panels, series):
        corners, pressure = read_surface(path)
        for axes, axis in zip(row, (1, 2)):
            faces = add_view(axes, corners, pressure / top, axis, HIGHEST)
            axes.set_title(f"{time * 1e3:.2f} ms, from {'the side' if axis == 1 else 'below'}", fontsize=9)
            axes.set_xlabel("x in mm", fontsize=9)
    figure.colorbar(faces, ax=panels, label="pressure over top pressure", extend="max")
    run_data.save_diagram(figure, folder, "rubber_block_pressure.png")


if __name__ == "__main__":
    main()
