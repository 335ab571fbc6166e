"""Superquadrics |x/a|^(2/e1) + |y/b|^(2/e1) to the power e1/e2, + |z/c|^(2/e2) = 1 (Wellmann, eq. 3.1)."""

from __future__ import annotations

from dataclasses import dataclass
from math import lgamma

import numpy as np

from . import rotation
from .errors import DamagedFile
from .mesh import TRIANGLE, Mesh


@dataclass(frozen=True)
class Parts:
    """Superquadrics on grains, m of them; plain grains have one each, clumps several. Global frame, SI units."""

    grain: np.ndarray  # (m,) row of the grain that carries the part
    centre: np.ndarray  # (m, 3) [m]
    quaternion: np.ndarray  # (m, 4) (x, y, z, w), the part's frame to the global one
    half_axes: np.ndarray  # (m, 3) [m]
    exponents: np.ndarray  # (m, 2) e1 in the plane of the first two axes, e2 along the third
    material: np.ndarray | None = None  # (m,) number in the simulation's table; pictures do not tell

    def __len__(self) -> int:
        return len(self.centre)

    @property
    def volume(self) -> np.ndarray:
        """(m,) [m^3]"""
        return volume(self.half_axes, self.exponents)

    def is_inside(self, part: int, points: np.ndarray) -> np.ndarray:
        """Which points lie in a part. @param points (k, 3), global [m]; @return (k,) bool"""
        turn = rotation.matrices(self.quaternion[part:part + 1])[0]
        return inside_outside((points - self.centre[part]) @ turn, self.half_axes[part], self.exponents[part]) <= 1


def volume(half_axes: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """Volumes of superquadrics (Wellmann, eq. 3.4). @param half_axes (n, 3) [m]; @param exponents (n, 2); @return (n,)"""
    def beta(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.array([np.exp(lgamma(a) + lgamma(b) - lgamma(a + b)) for a, b in zip(x, y)])

    e1, e2 = np.asarray(exponents, dtype=float).T
    return np.prod(half_axes, axis=1) * e1 * e2 * beta(e1 / 2, e1 / 2) * beta(e2 / 2, e2 + 1)


def inside_outside(points: np.ndarray, half_axes: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """F of one superquadric at points of the body frame: below 1 inside, above 1 outside. @param points (k, 3) [m]"""
    x = np.abs(points) / half_axes
    e1, e2 = exponents
    return (x[:, 0] ** (2 / e1) + x[:, 1] ** (2 / e1)) ** (e1 / e2) + x[:, 2] ** (2 / e2)


def parts_of_surfaces(mesh: Mesh, ids: np.ndarray) -> Parts:
    """Shapes and poses from the surfaces of a picture, to its single precision: a surface has points on the body's axes
    and half-way between them, and the shape follows from these (dem/io/vtu.cc has their order).

    @param mesh of a grains_*.vtu with surfaces; @param ids of the grains, (n,), in the file's order
    """
    points_of, faces = globe(mesh)
    first_face = np.arange(0, len(mesh.types), faces)
    steps = np.flatnonzero(mesh.types[:faces] != TRIANGLE)[0] // 4  # a quarter turn
    point = mesh.points.astype(float).reshape(-1, points_of, 3)

    def ring(latitude: int, longitude: int) -> np.ndarray:
        """At a latitude and longitude, in steps."""
        return point[:, 1 + (steps - 1 - latitude) * 4 * steps + longitude % (4 * steps)]

    centre = 0.5 * (point[:, 0] + point[:, -1])
    axes = [0.5 * (ring(0, 0) - ring(0, 2 * steps)), 0.5 * (ring(0, steps) - ring(0, 3 * steps)),
            0.5 * (point[:, 0] - point[:, -1])]
    half_axes = np.stack([np.linalg.norm(axis, axis=1) for axis in axes], axis=1)
    turn = np.stack([axis / length[:, None] for axis, length in zip(axes, half_axes.T)], axis=2)
    half = steps // 2  # 45 degrees: x/a = cos(45)^e1 on the equator, z/c = sin(45)^e2 on the meridian

    def exponent(place: np.ndarray, axis: int) -> np.ndarray:
        share = np.einsum("nd,nd->n", place - centre, turn[:, :, axis]) / half_axes[:, axis]
        return -2 * np.log2(np.abs(share))

    exponents = np.stack([exponent(ring(0, half), 0), exponent(ring(half, 0), 2)], axis=1)
    row = {int(number): k for k, number in enumerate(ids)}
    grain = np.array([row[int(number)] for number in mesh.cell_data["id"][first_face]], dtype=np.int64)
    return Parts(grain, centre, rotation.quaternions(turn), half_axes, exponents)


def globe(mesh: Mesh) -> tuple[int, int]:
    """Points and faces of each part's surface: triangles about the poles, quadrilaterals between."""
    others = np.flatnonzero(mesh.types != TRIANGLE)
    round_pole = int(others[0]) if len(others) else 0  # longitudes
    steps = round_pole // 4
    faces, points = round_pole * 2 * steps, (2 * steps - 1) * round_pole + 2
    if steps < 2 or len(mesh.types) % faces or len(mesh.points) * faces != points * len(mesh.types):
        raise DamagedFile(f"{mesh.path} holds no surfaces of grains")
    return points, faces
