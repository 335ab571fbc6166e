"""What grains touch beside one another: planes, and surfaces of triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .errors import ConfigError
from .library import library
from .parameters import WALL


@dataclass(frozen=True)
class Plane:
    """Rigid plane, infinite in extent. Where it is one of a simulation, the state at its time."""

    point: Sequence[float] = (0., 0., 0.)  # any of it [m]
    normal: Sequence[float] = (0., 0., 1.)  # unit, towards the grains
    velocity: Sequence[float] = (0., 0., 0.)  # [m/s]
    material: int = WALL


def box_planes(low: ArrayLike, high: ArrayLike, material: int = WALL) -> list[Plane]:
    """Six planes of a box, towards its inside, in the order x-, x+, y-, y+, z-, z+. @param low, high corners, (3,) [m]"""
    corners = [tuple(map(float, np.asarray(corner).ravel())) for corner in (low, high)]
    if any(len(corner) != 3 for corner in corners) or not all(a < b for a, b in zip(*corners)):
        raise ConfigError(f"the box from {low!r} to {high!r}: its corners must be three numbers each, the first below")
    return [Plane(corners[side], tuple((1. - 2. * side) * (axis == d) for d in range(3)), material=material)
            for axis in range(3) for side in (0, 1)]


class Surface:
    """Surface of triangles that grains touch on the side of its normals, at rest.

    @param nodes (m, 3) places [m]; @param triangles (t, 3) numbers of nodes, anticlockwise as seen from the grains
    @param material of the simulation's; @param offset grains touch what lies this far in front of it [m], >= 0
    @param is_rigid its nodes will move as those of one rigid body, if at all: its contacts then cost less
    ConfigError for triangles that make no surface: an edge of three of them, neighbours that face different sides, ...
    """

    def __init__(self, nodes: ArrayLike, triangles: ArrayLike, *, material: int = WALL, offset: float = 0.,
                 is_rigid: bool = False) -> None:
        places, corners = np.asarray(nodes, dtype=float), np.asarray(triangles)
        for name, array, in (("nodes", places), ("triangles", corners)):
            if array.ndim != 2 or array.shape[1] != 3:
                raise ConfigError(f"{name} has the shape {array.shape}: it must be (n, 3)")
        if not np.issubdtype(corners.dtype, np.integer) or ((corners < 0) | (corners >= len(places))).any():
            raise ConfigError(f"triangles must be whole numbers of nodes, in [0, {len(places)})")
        self._surface = library().Surface(places, corners)
        self._set(material, offset, is_rigid)

    @classmethod
    def _of(cls, surface: Any) -> Surface:
        made = cls.__new__(cls)
        made._surface = surface
        return made

    def _set(self, material: int, offset: float, is_rigid: bool) -> None:
        self._surface.material, self._surface.offset, self._surface.is_rigid = material, offset, is_rigid

    @property
    def nodes(self) -> np.ndarray:
        """Places, (m, 3) [m]; a copy."""
        return self._surface.nodes

    @property
    def triangles(self) -> np.ndarray:
        """(t, 3) numbers of nodes; a copy."""
        return self._surface.triangles

    @property
    def velocity(self) -> np.ndarray:
        """Of the nodes in the step to come, (m, 3) [m/s]; (0, 3) where it stays at rest."""
        return self._surface.velocity

    @property
    def work(self) -> float:
        """Done by it on the grains up to its last forces [J]."""
        return self._surface.work

    @property
    def material(self) -> int:
        return self._surface.material

    @property
    def offset(self) -> float:
        """[m]"""
        return self._surface.offset

    @property
    def is_rigid(self) -> bool:
        return self._surface.is_rigid

    def __repr__(self) -> str:
        return f"<Surface: {len(self.nodes)} nodes, {len(self.triangles)} triangles>"


def read_surface(path: str | PathLike[str], *, unit: float = 1., flip: bool = False, use: str = "sheet",
                 merge_tolerance: float = 1e-6, material: int = WALL, offset: float = 0.,
                 is_rigid: bool = False) -> Surface:
    """A surface from STL (.stl), a mesh of Gmsh (.msh) or a VTK grid (.vtu); quadrilaterals are cut in two.

    @param unit of the file's places [m]: 0.001 for millimetres; @param flip grains are on the side that the file's
    normals do not point to; @param use "sheet": open or closed; "body": closed, grains outside; "vessel": closed, grains
    inside; @param merge_tolerance nodes that are nearer become one [longest side of the surface]
    ConfigError, with the file's name, for what cannot be read or makes no such surface.
    """
    how = {"unit": unit, "flip": flip, "merge_tolerance": merge_tolerance}
    surface = Surface._of(library().read_surface(fspath(path), use, how))
    surface._set(material, offset, is_rigid)
    return surface
