"""Cells that repeat themselves along some axes: edges from the origin, infinite along the others."""

from __future__ import annotations

import itertools

import numpy as np


def cell_of_edges(edges: np.ndarray) -> np.ndarray | None:
    """The edges, (3,) [m]; none where nothing repeats itself along any axis."""
    return edges if np.isfinite(edges).any() else None


def image_shifts(cell: np.ndarray | None) -> list[np.ndarray]:
    """Shifts of the images beside the cell and of the cell itself, (3,) each [m]; none but zero without one.

    @param cell edges, (3,) [m]
    """
    edges = np.full(3, np.inf) if cell is None else np.asarray(cell, dtype=float)
    along = [(-edge, 0., edge) if np.isfinite(edge) else (0.,) for edge in edges]
    return [np.array(shift) for shift in itertools.product(*along)]
