"""Surfaces of triangles at one time, from a picture or a snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .errors import unknown_name
from .mesh import Mesh


@dataclass(frozen=True)
class Surfaces:
    """All surfaces of a run at one time: nn nodes, nt triangles; global frame, SI units. Grains are on the side from
    which the corners go round counter-clockwise.
    """

    time: float  # [s]
    node: np.ndarray  # (nn, 3) [m]
    triangle: np.ndarray  # (nt, 3) nodes
    surface: np.ndarray  # (nt,) number of each triangle's surface, from 0
    velocity: np.ndarray  # (nn, 3) of the nodes over the step before [m/s]
    fields: Mapping[str, np.ndarray] = field(default_factory=dict)
    source: Path | None = None

    def __len__(self) -> int:
        """The number of triangles."""
        return len(self.triangle)

    def __getitem__(self, name: str) -> np.ndarray:
        """A field; UnknownName, with the nearest names, where the file has none of this name.

        Of pictures, by triangle: pressure, shear_stress (nt,) and traction (nt, 3) [Pa], friction_work (nt,) [J/m^2]. Of
        snapshots, by node: force (nn, 3) [N], where the surface moves.
        """
        try:
            return self.fields[name]
        except KeyError:
            raise unknown_name(f"{self.source or 'these surfaces'}: no field", name, self.fields) from None

    @property
    def corners(self) -> np.ndarray:
        """(nt, 3 corners, 3) [m]"""
        return self.node[self.triangle]

    @property
    def area_vector(self) -> np.ndarray:
        """Area times the normal on the grains' side, (nt, 3) [m^2]."""
        corners = self.corners
        return 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

    @property
    def area(self) -> np.ndarray:
        """(nt,) [m^2]"""
        return np.linalg.norm(self.area_vector, axis=1)

    @property
    def pressure(self) -> np.ndarray:
        """Of the grains on each triangle, compression positive, (nt,) [Pa]."""
        return self["pressure"]

    @property
    def smooth_pressure(self) -> np.ndarray:
        """Mean of each triangle's nodes, (nt,) [Pa]; a node has the forces of its triangles over their areas."""
        area = self.area
        force, around = (np.bincount(self.triangle.ravel(), np.repeat(values, 3), len(self.node))
                         for values in (self.pressure * area, area))
        return (force / np.where(around > 0, around, 1))[self.triangle].mean(axis=1)

    def force_on(self, surface: int) -> np.ndarray:
        """Sum of what grains exert on a surface of a picture, (3,) [N]."""
        mask = self.surface == surface
        return (self["traction"][mask] * self.area[mask, None]).sum(axis=0)


def surfaces_of_picture(mesh: Mesh, time: float) -> Surfaces:
    """@param mesh of a surfaces_*.vtu; @param time [s]"""
    data = {name: values.astype(float) for name, values in mesh.cell_data.items() if name != "surface"}
    velocity = mesh.point_data.get("velocity", np.zeros_like(mesh.points))
    return Surfaces(time, mesh.points, mesh.cells.reshape(-1, 3), mesh.cell_data.get("surface", np.zeros(0, dtype=int)),
                    velocity.astype(float), data, mesh.path)
