"""Mean stresses from contact forces (Love 1927, Weber 1966). Tension is positive."""

from __future__ import annotations

import numpy as np

from ..contacts import Contacts
from ..errors import BadArgument
from ..periodic import image_shifts


def force_moment(contacts: Contacts) -> np.ndarray:
    """Sum over the contacts of branch (x) force on the first grain: the mean stress times the volume, (3, 3) [N m]. First
    index the branch, second the force. Forces count with the contacts' weights.
    """
    return np.einsum("ki,kj->ij", contacts.branch, contacts.force)


def stress(contacts: Contacts, volume: float | None = None) -> np.ndarray:
    """Mean Cauchy stress of a volume from all its contacts, (3, 3) [Pa], as the program measures a periodic cell or a
    packing between walls (dem/measure/stress.h). Grains at rest: what accelerates them adds to it.

    @param contacts in a periodic cell those between grains, in a box those with walls, too
    @param volume [m^3]; that of the contacts' periodic cell where none is given. BadArgument where neither is there.
    """
    if volume is None:
        if contacts.cell is None:
            raise BadArgument("these contacts are in no periodic cell: give the volume of the stress [m^3]")
        if not np.isfinite(contacts.cell).all():
            raise BadArgument(f"the cell of these contacts has the edges {contacts.cell} and so no volume: give that of the "
                              "stress [m^3]")
        volume = float(np.prod(contacts.cell))
    if not 0 < volume < np.inf:
        raise BadArgument(f"the volume of the stress is {volume}; it must be positive and finite [m^3]")
    return force_moment(contacts) / volume


def stress_in_box(contacts: Contacts, low: np.ndarray, high: np.ndarray, share: str = "branch") -> np.ndarray:
    """Mean stress of a box, (3, 3) [Pa].

    "branch": a contact counts with the share of its branch that lies in the box: the mean over planes across the box of
    the forces that branches carry through them. Boxes side by side add up to the whole, and slices across a whole packing
    at rest bear exactly what is above them. Branches go straight on through a periodic cell's faces. "point": a contact counts wholly where its place is in the box, lower faces included, as the
    program does (Wellmann 6.4): less exact in a box of few grains.

    @param low, high corners of the box, (3,) [m]
    """
    low, high = checked_box(low, high)
    if share == "branch":
        shares = sum(share_in_box(contacts.start + shift, contacts.branch, low, high) for shift in images(contacts))
    elif share == "point":
        places = [contacts.point + shift for shift in images(contacts)]
        shares = sum(((low <= place) & (place < high)).all(axis=1).astype(float) for place in places)
    else:
        raise BadArgument(f"the share of contacts in a box is '{share}'; choose 'branch' or 'point'")
    return np.einsum("k,ki,kj->ij", shares, contacts.branch, contacts.force) / np.prod(high - low)


def share_in_box(start: np.ndarray, branch: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Share of each line that lies in a box, (k,) in [0, 1]. @param start, branch (k, 3), low, high (3,) [m]"""
    with np.errstate(divide="ignore", invalid="ignore"):
        begin, end = (low - start) / branch, (high - start) / branch
    is_along = branch == 0  # never reaches these two faces: inside of them wholly or not at all
    inside = (low <= start) & (start < high)
    first = np.where(is_along, np.where(inside, -np.inf, np.inf), np.minimum(begin, end)).max(axis=1)
    last = np.where(is_along, np.where(inside, np.inf, -np.inf), np.maximum(begin, end)).min(axis=1)
    return (np.minimum(last, 1) - np.maximum(first, 0)).clip(min=0)


def images(contacts: Contacts) -> list[np.ndarray]:
    """Shifts of the images of a periodic cell, (3,) each [m]; none but zero without one."""
    return image_shifts(contacts.cell)


def checked_box(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    if low.shape != (3,) or high.shape != (3,) or not (low < high).all() or not np.isfinite([low, high]).all():
        raise BadArgument(f"a box from {low} to {high} is none; give two corners of three numbers, the lower one first "
                          "[m]")
    return low, high


def pressure(tensor: np.ndarray) -> float:
    """Minus the mean normal stress: compression positive [Pa]. @param tensor (3, 3)"""
    return float(-np.trace(tensor) / 3)


def principal_stresses(tensor: np.ndarray) -> np.ndarray:
    """Of the symmetric part, the most compressive first, (3,) [Pa]. @param tensor (3, 3)"""
    return np.linalg.eigvalsh(0.5 * (tensor + tensor.T))


def deviatoric_stress(tensor: np.ndarray) -> float:
    """sqrt(3/2 s:s) of the symmetric deviator s: |a - b| for principal stresses a, b, b [Pa]. @param tensor (3, 3)"""
    symmetric = 0.5 * (tensor + tensor.T)
    deviator = symmetric - np.trace(symmetric) / 3 * np.eye(3)
    return float(np.sqrt(1.5 * (deviator * deviator).sum()))
