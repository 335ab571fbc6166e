"""The last picture of a run, drawn for the page by matplotlib: no screen, no VTK window."""

from __future__ import annotations

import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import MissingData
from ..mesh import HEXAHEDRON, HEXAHEDRON_27, Mesh, read_vtu

DRAWN = ("grains", "continuum", "surfaces")  # those of these that a run has, in one picture; else any other
MOST_BYTES = 400_000_000  # of a file that is read while somebody waits
MOST_FACES = 400_000  # that are painted
FACES_OF_HEXAHEDRON = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
SAND = np.array([(0.84, 0.72, 0.53), (0.76, 0.62, 0.43), (0.90, 0.80, 0.63), (0.69, 0.57, 0.42), (0.87, 0.70, 0.47),
                 (0.79, 0.69, 0.55), (0.93, 0.85, 0.71), (0.72, 0.54, 0.36)])
OPACITY = {"continuum": 0.3, "surfaces": 0.15}  # of what is around grains
OTHER = np.array((0.60, 0.76, 0.93))
AZIMUTH, ELEVATION = np.radians(-55), np.radians(20)  # of the eye
LIGHT = np.array([0.3, -0.6, 0.75])


class Picture:
    """Draws a picture once: the next one of the same files costs nothing."""

    def __init__(self) -> None:
        self._drawn: tuple[str, bytes] | None = None

    def draw(self, files: Mapping[str, Path]) -> bytes:
        """PNG; MissingData where files are too large or have nothing to see, else errors as read_vtu().

        @param files by the names of their series
        """
        stamp = stamp_of(files)
        if self._drawn is None or self._drawn[0] != stamp:
            size = sum(os.stat(path).st_size for path in files.values())
            if size > MOST_BYTES:
                raise MissingData(f"{', '.join(map(str, files.values()))}: {size // 1_000_000} MB are too many to draw on "
                                  "the way; open them in ParaView")
            self._drawn = stamp, png_of({series: read_vtu(path) for series, path in files.items()})
        return self._drawn[1]


def stamp_of(files: Mapping[str, Path]) -> str:
    """Another one as soon as a file is another."""
    return " ".join(f"{path.name}-{os.stat(path).st_mtime_ns}" for path in files.values())


def png_of(meshes: Mapping[str, Mesh]) -> bytes:
    """A three-quarter view, z upwards, the near faces over the far ones; what is around grains lets them be seen."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    parts = [faces_of(mesh, series, OPACITY[series] if "grains" in meshes and series in OPACITY else 1.)
             for series, mesh in meshes.items()]
    corners, colours = (np.concatenate(arrays) for arrays in zip(*parts))
    if len(corners) == 0:
        raise MissingData(f"{', '.join(str(mesh.path) for mesh in meshes.values())}: nothing to see")
    if len(corners) > MOST_FACES:
        raise MissingData(f"{len(corners)} faces are too many to draw on the way; open the pictures in ParaView")
    across, upright, towards = axes_of_view()
    order = np.argsort((corners.mean(axis=1)) @ towards, kind="stable")
    seen = np.stack([corners[order] @ across, corners[order] @ upright], axis=-1)
    figure = Figure(figsize=(9, 7), dpi=110)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.01, 0.01, 0.98, 0.98))
    axes.set_axis_off()
    axes.set_aspect("equal")
    has_edges = "grains" not in meshes and len(corners) < 20_000
    axes.add_collection(PolyCollection(seen, facecolors=colours[order], linewidths=0.4 if has_edges else 0.1,
                                       edgecolors="#1A3357" if has_edges else "face"))
    axes.autoscale_view()
    file = io.BytesIO()
    figure.savefig(file, format="png", transparent=True, bbox_inches="tight", pad_inches=0.05)
    return file.getvalue()


def axes_of_view() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """To the right, upwards and towards the eye."""
    towards = np.array([np.cos(ELEVATION) * np.cos(AZIMUTH), np.cos(ELEVATION) * np.sin(AZIMUTH), np.sin(ELEVATION)])
    across = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.])
    return across, np.cross(towards, across), towards


def faces_of(mesh: Mesh, series: str, opacity: float) -> tuple[np.ndarray, np.ndarray]:
    """Those that look to the eye, (n, 4, 3) [m], and their colours, (n, 4)."""
    faces, cell = quadrilaterals_of(mesh)
    points = mesh.points.astype(float)
    if "displacement" in mesh.point_data:
        points = points + mesh.point_data["displacement"]
    corners = points[faces]
    diagonals = corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1]
    normal = np.cross(*diagonals)
    length = np.linalg.norm(normal, axis=1)
    normal /= np.where(length > 0, length, 1)[:, None]
    if is_closed(mesh, series):
        seen = normal @ axes_of_view()[2] > 0
        corners, normal, cell = corners[seen], normal[seen], cell[seen]
    brightness = 0.55 + 0.45 * np.abs(normal @ (LIGHT / np.linalg.norm(LIGHT)))
    colours = np.clip(tints(mesh, series, cell) * brightness[:, None], 0, 1)
    return corners, np.hstack([colours, np.full((len(colours), 1), opacity)])


def quadrilaterals_of(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Points of each face, (n, 4), the last one twice in triangles, and the cell it belongs to, (n,); of hexahedra those
    faces that no other one has.
    """
    if len(mesh.types) == 0 or mesh.types[0] not in (HEXAHEDRON, HEXAHEDRON_27):
        sizes = np.diff(mesh.offsets)
        flat = np.flatnonzero(sizes >= 3)  # points and lines are nothing to paint
        corner = np.minimum(np.arange(4), sizes[flat, None] - 1)
        return mesh.connectivity[mesh.offsets[flat][:, None] + corner], flat
    _, node = np.unique(mesh.points, axis=0, return_inverse=True)  # each element has points of its own
    faces = mesh.cells[:, FACES_OF_HEXAHEDRON].reshape(-1, 4)
    _, first, count = np.unique(np.sort(node[faces], axis=1), axis=0, return_index=True, return_counts=True)
    outer = np.sort(first[count == 1])
    return faces[outer], outer // 6


def is_closed(mesh: Mesh, series: str) -> bool:
    """Whether faces that look away are behind others: of bodies, not of walls of one layer."""
    return series == "grains" or len(mesh.types) > 0 and mesh.types[0] in (HEXAHEDRON, HEXAHEDRON_27)


def tints(mesh: Mesh, series: str, cell: np.ndarray) -> Any:
    if series != "grains" or "id" not in mesh.cell_data:
        return np.broadcast_to(OTHER, (len(cell), 3))
    mixed = (mesh.cell_data["id"][cell].astype(np.uint64) * 2654435761) % 2**32  # Knuth's: neighbours differ
    return SAND[(mixed >> 16) % len(SAND)]
