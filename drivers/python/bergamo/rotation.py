"""Rotations: quaternions in the order (x, y, z, w), as Eigen stores and SciPy's Rotation.from_quat() takes them."""

from __future__ import annotations

import numpy as np


def matrices(quaternions: np.ndarray) -> np.ndarray:
    """Matrices that take body vectors to global ones. @param quaternions (n, 4), unit; @return (n, 3, 3)"""
    x, y, z, w = np.asarray(quaternions, dtype=float).T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                     2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                     2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=-1).reshape(-1, 3, 3)


def quaternions(rotations: np.ndarray) -> np.ndarray:
    """The unit quaternions with w >= 0 of rotations. @param rotations (n, 3, 3); @return (n, 4)

    The largest of the four components comes from the diagonal, the others by division through it (Shepperd 1978).
    """
    m = np.asarray(rotations, dtype=float)
    diagonal = np.einsum("nii->ni", m)
    trace = diagonal.sum(axis=1)
    squares = np.concatenate([1 - trace[:, None] + 2 * diagonal, 1 + trace[:, None]], axis=1)  # 4 q_i^2
    products = np.empty((len(m), 4, 4))  # 4 q_i q_j
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[:, i, i] = squares[:, i]
        products[:, i, j] = products[:, j, i] = m[:, i, j] + m[:, j, i]
        products[:, i, 3] = products[:, 3, i] = m[:, k, j] - m[:, j, k]
    products[:, 3, 3] = squares[:, 3]
    rows = products[np.arange(len(m)), squares.argmax(axis=1)]
    rows /= np.linalg.norm(rows, axis=1, keepdims=True)
    return rows * np.where(rows[:, 3:] < 0, -1, 1)


def products(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Quaternions of the rotations that turn by second, then by first. @param first, second (n, 4); @return (n, 4)"""
    a, b = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    vector = a[:, 3:] * b[:, :3] + b[:, 3:] * a[:, :3] + np.cross(a[:, :3], b[:, :3])
    return np.concatenate([vector, a[:, 3:] * b[:, 3:] - (a[:, :3] * b[:, :3]).sum(axis=1, keepdims=True)], axis=1)
