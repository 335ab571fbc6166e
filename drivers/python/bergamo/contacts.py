"""Touching contacts at one time, from a picture or a snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from .errors import MissingData, unknown_name
from .mesh import Mesh

NO_GRAIN = -1  # the second body of a contact with a wall or a surface


@dataclass(frozen=True)
class Contacts:
    """k touching contacts at one time; global frame, SI units. Forces count with the contacts' weights, which are 1 but
    where grains share their place with a continuum.
    """

    time: float  # [s]
    first: np.ndarray  # (k,) id of the first grain
    second: np.ndarray  # (k,) id of the second one; -1 for walls and surfaces
    start: np.ndarray  # (k, 3) centre of the first grain [m]
    branch: np.ndarray  # (k, 3) from there to the centre of the second one, or to the contact on a wall [m]
    normal_force: np.ndarray  # (k,) >= 0 [N]
    tangential_force: np.ndarray  # (k, 3) on the first grain [N]
    overlap: np.ndarray  # (k,) [m]
    direction: np.ndarray | None = None  # (k, 3), see normal
    place: np.ndarray | None = None  # (k, 3), see point
    cell: np.ndarray | None = None  # (3,) edges of a snapshot's periodic cell at this time, from the origin [m]
    fields: Mapping[str, np.ndarray] = field(default_factory=dict)  # of snapshots: weight, wall, feature, law, kind
    source: Path | None = None

    def __len__(self) -> int:
        return len(self.first)

    def __getitem__(self, name: str) -> np.ndarray:
        """A field of a snapshot, (k,); UnknownName where there is none of this name.

        weight; wall or feature: numbers of the plane wall, or of the feature of the surfaces, that is the second body,
        else -1; law: number of the pair of materials; kind: "grain_grain", "sphere_sphere", "grain_plane" or
        "grain_surface".
        """
        try:
            return self.fields[name]
        except KeyError:
            raise unknown_name(f"{self.source or 'these contacts'}: no field", name, self.fields) from None

    @property
    def normal(self) -> np.ndarray:
        """Unit normals from the first body to the second, (k, 3)."""
        if self.direction is None:
            raise MissingData(f"{self.source} has no normals: an older version wrote it; a snapshot has them")
        return self.direction

    @property
    def point(self) -> np.ndarray:
        """Places of the contacts, (k, 3) [m]; in a periodic cell beside the first grain, maybe outside of the cell."""
        if self.place is None:
            raise MissingData(f"{self.source} has no places of contacts: an older version wrote it; a snapshot has them")
        return self.place

    @property
    def force(self) -> np.ndarray:
        """Forces on the first grains, (k, 3) [N]; on the second bodies the opposite."""
        return self.tangential_force - self.normal_force[:, None] * self.normal

    @property
    def is_with_wall(self) -> np.ndarray:
        """(k,) bool: the second body is a wall or a surface."""
        return self.second == NO_GRAIN

    def where(self, mask: np.ndarray) -> Contacts:
        """Some of them. @param mask (k,) bool, or their numbers"""
        names = ("first", "second", "start", "branch", "normal_force", "tangential_force", "overlap")
        arrays = {name: getattr(self, name)[mask] for name in names}
        for name in ("direction", "place"):
            values = getattr(self, name)
            arrays[name] = None if values is None else values[mask]
        return replace(self, **arrays, fields={name: values[mask] for name, values in self.fields.items()})

    @property
    def between_grains(self) -> Contacts:
        """Those without walls and surfaces."""
        return self.where(~self.is_with_wall)


def contacts_of_picture(mesh: Mesh, time: float) -> Contacts:
    """@param mesh of a contacts_*.vtu; @param time [s]"""
    ends = mesh.points.astype(float).reshape(-1, 2, 3)

    def data(name: str, *shape: int) -> np.ndarray:
        return mesh.cell_data[name].astype(float) if name in mesh.cell_data else np.zeros((0, *shape))

    is_whole = "normal" in mesh.cell_data
    first, second = (mesh.cell_data.get(name, np.zeros(0, dtype=np.int64)) for name in ("first", "second"))
    return Contacts(time, first, second, ends[:, 0], ends[:, 1] - ends[:, 0], data("normal_force"),
                    data("tangential_force", 3), data("overlap"), data("normal", 3) if is_whole else None,
                    data("point", 3) if is_whole else None, source=mesh.path)
