"""Grains at one time, from a picture or a snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from .errors import BadArgument, MissingData, unknown_name
from .mesh import VERTEX, Mesh
from .shapes import Parts, globe, parts_of_surfaces


@dataclass(frozen=True)
class Grains:
    """n grains at one time; global frame, SI units, arrays by grain in the order of the file.

    Pictures are of single precision, snapshots to the last bit. What else the file has is in `fields`, and by
    `grains["weight"]`: of pictures what their driver draws (pressure, start_height, ...), of snapshots mass, inertia,
    force (without the grain's weight), torque, angular_momentum, drift_velocity, weight (the share of a grain that a
    continuum shares its place with), ... as dem/state/particles.h explains them.
    """

    time: float  # [s]
    id: np.ndarray  # (n,) identity that survives every sort
    position: np.ndarray  # (n, 3) centre of mass [m]; of a clump in a picture the mean of its parts by volume
    velocity: np.ndarray  # (n, 3) of the half step before [m/s]
    volume: np.ndarray  # (n,) of the solid [m^3]; of a clump in a picture what overlaps counts twice
    fields: Mapping[str, np.ndarray] = field(default_factory=dict)  # (n,) or (n, components)
    shape: Parts | None = None  # none where a picture has points alone
    source: Path | None = None

    def __len__(self) -> int:
        return len(self.id)

    def __getitem__(self, name: str) -> np.ndarray:
        """A field, (n,) or (n, components); UnknownName, with the nearest names, where the file has none of this name."""
        try:
            return self.fields[name]
        except KeyError:
            raise unknown_name(f"{self.source or 'these grains'}: no field", name, self.fields) from None

    @property
    def diameter(self) -> np.ndarray:
        """Of the spheres of equal volume, (n,) [m]."""
        return np.cbrt(6 / np.pi * self.volume)

    @property
    def angular_velocity(self) -> np.ndarray:
        """Mean over the step before, (n, 3) [1/s]."""
        return self["angular_velocity"]

    @property
    def parts(self) -> Parts:
        """The superquadrics that the grains are made of; MissingData for a picture of points."""
        if self.shape is None:
            raise MissingData(f"{self.source} shows grains as points and has no shapes; a snapshot has them")
        return self.shape

    @property
    def half_axes(self) -> np.ndarray:
        """(n, 3) [m]; MissingData for points, and for clumps, whose parts have them."""
        return self._of_plain_grains(self.parts.half_axes)

    @property
    def exponents(self) -> np.ndarray:
        """(n, 2): towards 0 a box, 1 an ellipsoid, towards 2 an octahedron; as half_axes."""
        return self._of_plain_grains(self.parts.exponents)

    @property
    def quaternion(self) -> np.ndarray:
        """(n, 4) in the order (x, y, z, w), body to global; of clumps in a snapshot that of the principal frame."""
        if "orientation" in self.fields:
            return self.fields["orientation"]
        return self._of_plain_grains(self.parts.quaternion)

    @property
    def is_fixed(self) -> np.ndarray:
        """Grains of infinite mass, which are walls, (n,) bool; pictures do not tell: none."""
        return np.isinf(self.fields["mass"]) if "mass" in self.fields else np.zeros(len(self), dtype=bool)

    def rows_of(self, ids: np.ndarray) -> np.ndarray:
        """Rows of grains by their ids; -1, no grain, stays -1. BadArgument for an id that is not there."""
        ids = np.asarray(ids)
        order = self._order
        if len(self) == 0 and (ids == -1).all():
            return ids
        rows = order[np.searchsorted(self.id, ids, sorter=order).clip(max=len(self) - 1)]
        if len(self) == 0 or ((self.id[rows] != ids) & (ids != -1)).any():
            raise BadArgument(f"{self.source or 'these grains'}: ids that are not among the {len(self)} grains; take "
                              "contacts and grains of the same time")
        return np.where(ids == -1, -1, rows)

    @cached_property
    def _order(self) -> np.ndarray:
        return np.argsort(self.id, kind="stable")

    def _of_plain_grains(self, values: np.ndarray) -> np.ndarray:
        if len(self.parts) != len(self):
            raise MissingData(f"{self.source}: {len(self)} grains have {len(self.parts)} parts; see parts")
        return values


def grains_of_picture(mesh: Mesh, time: float) -> Grains:
    """Grains as a picture shows them, as surfaces or as points. @param mesh of a grains_*.vtu; @param time [s]"""
    if len(mesh.types) == 0 or (mesh.types == VERTEX).all():
        data = {name: values.astype(float) for name, values in mesh.point_data.items() if name != "id"}
        diameter = data.get("diameter", np.zeros(0))
        return Grains(time, mesh.point_data.get("id", np.zeros(0, dtype=np.int64)), mesh.points.astype(float),
                      data.pop("velocity", np.zeros((0, 3))), np.pi / 6 * diameter ** 3, data, None, mesh.path)
    _, faces = globe(mesh)
    of_parts = {name: values[::faces] for name, values in mesh.cell_data.items()}
    ids, first = np.unique(of_parts["id"], return_index=True)
    first = np.sort(first)  # the file's order; parts of a clump follow one another
    ids = of_parts["id"][first]
    parts = parts_of_surfaces(mesh, ids)
    volume = np.bincount(parts.grain, parts.volume, len(ids))
    moment = np.stack([np.bincount(parts.grain, parts.volume * x, len(ids)) for x in parts.centre.T], axis=1)
    position = moment / volume[:, None] if len(parts) != len(ids) else parts.centre
    data = {name: values[first].astype(float) for name, values in of_parts.items() if name != "id"}
    return Grains(time, ids, position, data.pop("velocity"), volume, data, parts, mesh.path)
