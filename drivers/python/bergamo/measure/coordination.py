"""Contacts per grain, as the program counts them (dem/measure/coordination.h)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..contacts import Contacts
from ..grains import Grains

FEWEST = 4  # contacts that hold a sphere without friction


@dataclass(frozen=True)
class Coordination:
    """0 where no grain counts. Fixed grains support others and do not count themselves."""

    mean: float  # of all grains; 2 k / n without walls
    deviation: float  # standard deviation from grain to grain
    mechanical: float  # of grains with two contacts or more (Thornton 2000)
    without_rattlers: float  # of the grains that are no rattlers, from the contacts among them
    n_rattlers: int  # see is_rattler()
    of_grains: np.ndarray  # (n,) contacts of each grain, by row


def coordination_numbers(grains: Grains, contacts: Contacts) -> Coordination:
    """@param contacts of these grains; those with walls count where they are among them"""
    first, second = grains.rows_of(contacts.first), grains.rows_of(contacts.second)
    free = ~grains.is_fixed
    count = counted(len(grains), first, second)
    loose = is_rattler(grains, contacts)
    # Contacts with walls bear in any case; those of two grains where neither is loose.
    bearing = (second < 0) | ~(loose[first] | loose[second])
    of_bearing = counted(len(grains), first[bearing], second[bearing])
    chosen = count[free]
    return Coordination(mean_of(chosen), float(chosen.std()) if len(chosen) else 0., mean_of(chosen[chosen >= 2]),
                        mean_of(of_bearing[free & ~loose]), int((loose & free).sum()), count)


def is_rattler(grains: Grains, contacts: Contacts, fewest: int = FEWEST) -> np.ndarray:
    """Grains with fewer contacts than fewest, and again those that lose theirs to them, until none is left, (n,) bool by
    row (O'Hern et al. 2003).
    """
    first, second = grains.rows_of(contacts.first), grains.rows_of(contacts.second)
    free, loose = ~grains.is_fixed, np.zeros(len(grains), dtype=bool)
    while True:
        bearing = ~loose[first] & ((second < 0) | ~loose[second])
        now = free & (counted(len(grains), first[bearing], second[bearing]) < fewest)
        if (now == loose).all():
            return loose
        loose = now


def counted(n: int, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Contacts by row of the grains, (n,)."""
    return np.bincount(first, minlength=n) + np.bincount(second[second >= 0], minlength=n)


def mean_of(values: np.ndarray) -> float:
    return float(values.mean()) if len(values) else 0.
