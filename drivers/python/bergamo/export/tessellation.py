"""Surfaces of superquadrics as points and faces."""

from __future__ import annotations

import numpy as np

from .. import rotation
from ..shapes import Parts

FINEST, COARSEST = 6, 2  # steps a quarter turn; at 45 degrees are the edges and corners of boxes, so they are even


def steps_by_size(half_axes: np.ndarray, finest: int = FINEST) -> np.ndarray:
    """Steps a quarter turn, (m,), so that all grains have faces of about one length: the largest one has the finest. A grain
    of a third of its size is drawn with 26 points where it would have 266.
    """
    size = half_axes.max(axis=1)
    steps = finest * size / size.max() if len(size) else size
    return np.clip(2 * np.ceil(steps / 2 - 1e-9), COARSEST, finest).astype(int)


def globe(steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Latitudes and longitudes of the points (p, 2) [rad], poles first and last, and the corners of the faces (f, 4),
    counter-clockwise from outside; those at the poles have one corner twice.
    """
    round_pole, rings = 4 * steps, 2 * steps - 1
    latitude = np.pi / 2 - np.pi / 2 / steps * np.arange(1, rings + 1)
    longitude = np.pi / 2 / steps * np.arange(round_pole)
    inner = np.stack(np.meshgrid(latitude, longitude, indexing="ij"), axis=-1).reshape(-1, 2)
    angles = np.concatenate([[[np.pi / 2, 0.]], inner, [[-np.pi / 2, 0.]]])
    here, ring = np.arange(round_pole), np.arange(rings)[:, None]
    west = 1 + ring * round_pole + here
    east = 1 + ring * round_pole + (here + 1) % round_pole
    south = np.full(round_pole, len(angles) - 1)
    north = np.zeros(round_pole, dtype=int)
    faces = [np.stack([north, west[0], east[0], north], axis=1)]
    faces += [np.stack([west[k], west[k + 1], east[k + 1], east[k]], axis=1) for k in range(rings - 1)]
    faces.append(np.stack([west[-1], south, south, east[-1]], axis=1))
    return angles, np.concatenate(faces)


def surface_points(angles: np.ndarray, half_axes: np.ndarray, exponents: np.ndarray) -> np.ndarray:
    """Points by Barr's (1981) angles in the body frame. @param angles (p, 2); half_axes (m, 3); exponents (m, 2); @return
    (m, p, 3) [m]
    """
    def power(values: np.ndarray, exponent: np.ndarray) -> np.ndarray:
        values = np.where(np.abs(values) < 1e-12, 0., values)  # cos(90 degrees)
        return np.sign(values) * np.abs(values) ** exponent[:, None]

    latitude, longitude = angles.T
    e1, e2 = exponents.T
    across = power(np.cos(latitude), e2)
    unit = np.stack([across * power(np.cos(longitude), e1), across * power(np.sin(longitude), e1),
                     power(np.sin(latitude), e2)], axis=-1)
    return unit * half_axes[:, None, :]


def tessellated(parts: Parts, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Global points (m, p, 3) [m] of single precision, and the faces of one part (f, 4)."""
    angles, faces = globe(steps)
    body = surface_points(angles, parts.half_axes, parts.exponents)
    points = np.einsum("mij,mpj->mpi", rotation.matrices(parts.quaternion), body) + parts.centre[:, None, :]
    return points.astype(np.float32), faces
