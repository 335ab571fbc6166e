"""Grains before they are part of a simulation, and clumps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .errors import ConfigError
from .library import library
from .parameters import GRAIN

UPRIGHT = (0., 0., 0., 1.)  # no turn, as a quaternion (x, y, z, w)


def rows_of(name: str, values: ArrayLike, n: int, columns: int) -> np.ndarray:
    """(n, columns) from one row for all or from n; columns 0: (n,). ConfigError for another shape, or no numbers."""
    shape = (n, columns) if columns else (n,)
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ConfigError(f"{name} is {values!r}: it must be numbers") from None
    if array.shape not in (shape, shape[1:]):
        one = f"({columns},)" if columns else "one number"
        raise ConfigError(f"{name} has the shape {array.shape}: it must be {one} or {shape}")
    return np.broadcast_to(array, shape)


def n_rows(*arrays: tuple[ArrayLike, int]) -> int:
    """How many bodies are meant: the longest of the arrays, each with the number of its dimensions if it had rows."""
    lengths = [np.shape(array)[0] for array, dimensions in arrays if np.ndim(array) == dimensions]
    return max(lengths, default=1)


class Clump:
    """A rigid body of several superquadrics, which may overlap: the body is their union. It is taken to its centre of mass
    and principal axes once; scaled() gives other sizes. A row a part, k parts; ConfigError for impossible shapes.

    @param half_axes (k, 3) [m]; position (k, 3) of the parts' centres in the clump's frame [m]; exponents (k, 2) or (2,);
    quaternion (k, 4) or (4,), (x, y, z, w), part to clump; tolerance of the integrals over what overlaps
    """

    def __init__(self, half_axes: ArrayLike, position: ArrayLike, exponents: ArrayLike = (1., 1.),
                 quaternion: ArrayLike = UPRIGHT, tolerance: float = 1e-6) -> None:
        k = n_rows((half_axes, 2), (position, 2))
        poses = np.hstack([rows_of("position", position, k, 3), rows_of("quaternion", quaternion, k, 4)])
        shapes = np.hstack([rows_of("half_axes", half_axes, k, 3), rows_of("exponents", exponents, k, 2)])
        self._clump = library().Clump(poses, shapes, tolerance)

    def scaled(self, factor: float) -> Clump:
        """The same body, larger or smaller by a factor > 0."""
        other = Clump.__new__(Clump)
        other._clump = self._clump.scaled(factor)
        return other

    @property
    def volume(self) -> float:
        """Of the union of the parts [m^3]."""
        return self._clump.volume

    @property
    def bounding_radius(self) -> float:
        """About the centre of mass [m]."""
        return self._clump.bounding_radius

    @property
    def inertia_per_density(self) -> np.ndarray:
        """Principal moments, (3,) [m^5]."""
        return self._clump.inertia_per_density


class Grains:
    """n grains for a simulation: rigid bodies at rest, fixed or moving, with their shapes. Global frame, SI units.

    @param cell edges of a periodic cell from the origin, (3,) [m]; None or inf for an axis along which nothing repeats
    itself, None for all
    """

    def __init__(self, cell: ArrayLike | None = None) -> None:
        self._particles = library().Particles()
        self.cell = cell

    @classmethod
    def _of(cls, particles: Any) -> Grains:
        grains = cls.__new__(cls)
        grains._particles = particles
        return grains

    def add(self, position: ArrayLike, half_axes: float | ArrayLike, *, exponents: ArrayLike = (1., 1.),
            quaternion: ArrayLike = UPRIGHT, density: ArrayLike = 2650., material: ArrayLike = GRAIN) -> slice:
        """Adds superquadrics at rest, one or a row each. All or none: ConfigError for a shape or a number that cannot be.

        @param position (3,) or (n, 3) centres [m]
        @param half_axes (3,) or (n, 3) along the body's axes [m]; one number: a sphere's radius
        @param exponents (2,) or (n, 2) in (0, 2): towards 0 a box, 1 an ellipsoid, towards 2 an octahedron
        @param quaternion (4,) or (n, 4) in the order (x, y, z, w), body to global; made unit
        @param density one or (n,) [kg/m^3]; @param material one or (n,) numbers of materials
        @return their rows
        """
        if np.ndim(half_axes) == 0:
            half_axes = np.full(3, half_axes)
        n = n_rows((position, 2), (half_axes, 2), (exponents, 2), (quaternion, 2), (density, 1), (material, 1))
        shapes = np.hstack([rows_of("half_axes", half_axes, n, 3), rows_of("exponents", exponents, n, 2)])
        begin = len(self)
        self._particles.add(poses_of(position, quaternion, n), shapes, matter_of(density, material, n))
        return slice(begin, len(self))

    def add_clumps(self, clump: Clump, position: ArrayLike, *, quaternion: ArrayLike = UPRIGHT,
                   density: ArrayLike = 2650., material: ArrayLike = GRAIN) -> slice:
        """Adds clumps of one kind and size at rest, as add(). @param position of their centres of mass [m]; @param
        quaternion of their principal frames
        """
        n = n_rows((position, 2), (quaternion, 2), (density, 1), (material, 1))
        begin = len(self)
        self._particles.add_clumps(clump._clump, poses_of(position, quaternion, n), matter_of(density, material, n))
        return slice(begin, len(self))

    def append(self, others: Grains) -> None:
        """Adds the grains of another one."""
        self._particles.append(others._particles)

    def fix(self, rows: int | slice | Sequence[int] | np.ndarray) -> None:
        """Holds grains where they are, parts of rough walls: their mass is infinite."""
        self._particles.fix(np.atleast_1d(np.arange(len(self))[rows]).astype(np.int64))

    def set_velocity(self, velocity: ArrayLike) -> None:
        """Of all grains, (3,) or (n, 3) [m/s]: of the half step before the first step."""
        self._particles.set_motion(rows_of("velocity", velocity, len(self), 3), self["angular_momentum"])

    def set_angular_momentum(self, angular_momentum: ArrayLike) -> None:
        """Of all grains about their centres, global frame, (3,) or (n, 3) [kg m^2/s]: likewise."""
        self._particles.set_motion(self["velocity"], rows_of("angular_momentum", angular_momentum, len(self), 3))

    @property
    def cell(self) -> np.ndarray | None:
        """Edges of the periodic cell, (3,) [m], infinite along axes where nothing repeats itself; or none."""
        return self._particles.cell

    @cell.setter
    def cell(self, edges: ArrayLike | None) -> None:
        if edges is not None and not isinstance(edges, np.ndarray):
            edges = [np.inf if edge is None else edge for edge in edges]
        self._particles.cell = edges

    def __len__(self) -> int:
        return len(self._particles)

    def __getitem__(self, name: str) -> np.ndarray:
        """A copy of an array: position, orientation, velocity, angular_momentum, mass, volume, inertia, ..."""
        return self._particles.copy_of(name)

    @property
    def position(self) -> np.ndarray:
        """Centres, (n, 3) [m]; a copy."""
        return self["position"]

    def __repr__(self) -> str:
        return f"<Grains: {len(self)}>"


def poses_of(position: ArrayLike, quaternion: ArrayLike, n: int) -> np.ndarray:
    return np.hstack([rows_of("position", position, n, 3), rows_of("quaternion", quaternion, n, 4)])


def matter_of(density: ArrayLike, material: ArrayLike, n: int) -> np.ndarray:
    return np.stack([rows_of("density", density, n, 0), rows_of("material", material, n, 0)], axis=1)
