"""Profiles along an axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Union

import numpy as np

from ..contacts import Contacts
from ..errors import BadArgument
from ..grains import Grains
from .stresses import checked_box, stress_in_box

Axis = Union[int, str]


@dataclass(frozen=True)
class Profile:
    """Means over slices along an axis; b slices."""

    edge: np.ndarray  # (b + 1,) [m]
    mean: np.ndarray  # (b,) or (b, components) by volume; nan where no grain is
    n_grains: np.ndarray  # (b,) whose centres lie in the slice
    volume: np.ndarray  # (b,) of these grains [m^3]

    @property
    def middle(self) -> np.ndarray:
        """Of the slices, (b,) [m]."""
        return 0.5 * (self.edge[1:] + self.edge[:-1])


def profile(grains: Grains, values: np.ndarray | str, axis: Axis = "z", slices: int | Sequence[float] = 20) -> Profile:
    """Means of the grains' values over slices across an axis, each grain with its volume, in the slice of its centre.

    @param values (n,) or (n, components), or the name of a field; @param axis "x", "y", "z" or 0, 1, 2
    @param slices their number over all grains, or their edges, ascending [m]; the last edge belongs to the last slice
    """
    data = np.asarray(grains[values] if isinstance(values, str) else values, dtype=float)
    if len(data) != len(grains):
        raise BadArgument(f"there are {len(data)} values for {len(grains)} grains; give one a grain")
    place = grains.position[:, number_of(axis)]
    if isinstance(slices, int) and slices < 1:
        raise BadArgument(f"{slices} slices are none; give a number above 0, or edges [m]")
    edges = np.histogram_bin_edges(place, slices) if isinstance(slices, int) else np.asarray(slices, dtype=float)
    if len(edges) < 2 or (np.diff(edges) <= 0).any():
        raise BadArgument(f"the edges {slices} make no slices; give them ascending [m]")
    slice_of = np.where(place == edges[-1], len(edges) - 2, np.searchsorted(edges, place, side="right") - 1)
    inside = (slice_of >= 0) & (slice_of < len(edges) - 1)
    at, weight = slice_of[inside], grains.volume[inside]
    volume = np.bincount(at, weight, len(edges) - 1)
    columns = data.reshape(len(data), -1)[inside].T
    with np.errstate(invalid="ignore"):
        mean = np.stack([np.bincount(at, weight * column, len(volume)) / volume for column in columns], axis=1)
    return Profile(edges, mean.reshape(len(volume), *data.shape[1:]), np.bincount(at, minlength=len(volume)), volume)


def stress_profile(contacts: Contacts, low: np.ndarray, high: np.ndarray, axis: Axis = "z", n: int = 10) -> np.ndarray:
    """Mean stresses of n equal slices of a box across an axis, (n, 3, 3) [Pa], by the shares of branches that lie in them
    (stress_in_box): the mean of the slices is the stress of the box. @param low, high corners of the box, (3,) [m]
    """
    low, high = checked_box(low, high)
    if n < 1:
        raise BadArgument(f"{n} slices are none")
    along = number_of(axis)
    edges = np.linspace(low[along], high[along], n + 1)
    result = np.empty((n, 3, 3))
    for k in range(n):
        lower, upper = low.copy(), high.copy()
        lower[along], upper[along] = edges[k], edges[k + 1]
        result[k] = stress_in_box(contacts, lower, upper)
    return result


def number_of(axis: Axis) -> int:
    names: dict[Axis, int] = {"x": 0, "y": 1, "z": 2, 0: 0, 1: 1, 2: 2}
    if axis not in names:
        raise BadArgument(f"the axis is '{axis}'; choose 'x', 'y' or 'z'")
    return names[axis]
