"""The continuum at one time, from a picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from .errors import unknown_name
from .mesh import Mesh

OF_NODES = ("displacement", "velocity")


@dataclass(frozen=True)
class Continuum:
    """nn nodes and ne elements at one time, but for absent elements; global frame, SI units, single precision as pictures
    are.

    `continuum["velocity"]` and `["displacement"]` are by node, (nn, 3); all else is the volume average of each element:
    stress_xx .. stress_zx, principal_stress_1 .. 3, pressure, deviatoric_stress, yield_function [Pa],
    equivalent_plastic_strain, elastic_energy_density [J/m^3], material_id, and void_ratio of laws that have one; of
    membranes principal_stress_1, 2, thickness [m], elastic_energy_density. Tension is positive but in pressure.
    """

    time: float  # [s]
    mesh: Mesh  # each element has points of its own there

    @property
    def source(self) -> Path:
        return self.mesh.path

    @cached_property
    def _nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """First point of every node, and node of every point: points at one place are one node."""
        _, first, node = np.unique(self.mesh.points, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(first, kind="stable")  # nodes in the order in which elements name them
        rank = np.empty_like(order)
        rank[order] = np.arange(len(order))
        return first[order], rank[node]

    @property
    def reference(self) -> np.ndarray:
        """Places of the nodes in the reference configuration, (nn, 3) [m]."""
        return self.mesh.points[self._nodes[0]].astype(float)

    @property
    def displacement(self) -> np.ndarray:
        """(nn, 3) [m]"""
        return self["displacement"]

    @property
    def velocity(self) -> np.ndarray:
        """(nn, 3) [m/s]"""
        return self["velocity"]

    @property
    def node(self) -> np.ndarray:
        """Places of the nodes now, (nn, 3) [m]."""
        return self.reference + self.displacement

    @cached_property
    def element(self) -> np.ndarray:
        """Nodes of each element, (ne, 8) or (ne, 27) in VTK's order, whose corners come first; of membranes (ne, 4)."""
        return self._nodes[1][self.mesh.cells]

    @property
    def centre(self) -> np.ndarray:
        """Means of the elements' corners now, (ne, 3) [m]."""
        return self.node[self.element[:, :8]].mean(axis=1)

    @property
    def stress(self) -> np.ndarray:
        """Cauchy stress, tension positive, (ne, 3, 3) [Pa]."""
        xx, yy, zz, xy, yz, zx = (self[f"stress_{c}"] for c in ("xx", "yy", "zz", "xy", "yz", "zx"))
        return np.stack([xx, xy, zx, xy, yy, yz, zx, yz, zz], axis=-1).reshape(-1, 3, 3)

    @property
    def names(self) -> list[str]:
        return list(self.mesh.point_data)

    def __getitem__(self, name: str) -> np.ndarray:
        """Values by node, (nn, 3), or by element, (ne,), see the class; UnknownName with the nearest names."""
        if name not in self.mesh.point_data:
            raise unknown_name(f"{self.source}: no field", name, self.names)
        values = self.mesh.point_data[name].astype(float)
        return values[self._nodes[0]] if name in OF_NODES else values[self.mesh.connectivity[self.mesh.offsets[:-1]]]

    def at_nodes(self, values: np.ndarray) -> np.ndarray:
        """Means over the elements around each node. @param values (ne, ...) by element; @return (nn, ...)"""
        n_corners = self.element.shape[1]
        count = np.bincount(self.element.ravel(), minlength=len(self._nodes[0]))
        flat = np.asarray(values, dtype=float).reshape(len(self.element), -1)
        sums = [np.bincount(self.element.ravel(), np.repeat(column, n_corners), len(count)) for column in flat.T]
        return (np.stack(sums, axis=1) / count[:, None]).reshape(len(count), *np.shape(values)[1:])

    def at_elements(self, values: np.ndarray) -> np.ndarray:
        """Means over the nodes of each element. @param values (nn, ...) by node; @return (ne, ...)"""
        return np.asarray(values)[self.element].mean(axis=1)
