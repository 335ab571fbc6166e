"""Force chains: the contacts that bear more than the mean, joined where they share a grain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..contacts import Contacts
from ..errors import BadArgument


@dataclass(frozen=True)
class ForceChains:
    """Chains of strong contacts, the one of most contacts first; k contacts."""

    is_strong: np.ndarray  # (k,) bool: the normal force is above the threshold
    chain: np.ndarray  # (k,) number of the chain; -1 for weak contacts
    n_contacts: np.ndarray  # of each chain
    n_grains: np.ndarray  # of each chain
    threshold: float  # [N]
    strong_share: float  # of the sum of normal forces that the strong contacts bear

    def __len__(self) -> int:
        return len(self.n_contacts)


def force_chains(contacts: Contacts, over_mean: float = 1.) -> ForceChains:
    """Strong contacts, whose normal force is above over_mean times the mean of all (Radjai et al. 1998 for 1), and their
    chains: two strong contacts belong together where they share a grain. Walls join nothing.
    """
    if not over_mean >= 0:
        raise BadArgument(f"the threshold over the mean force is {over_mean}; it must not be negative")
    force = contacts.normal_force
    threshold = over_mean * (float(force.mean()) if len(force) else 0.)
    is_strong = force > threshold
    first, second = contacts.first[is_strong], contacts.second[is_strong]
    ids, rows = np.unique(np.concatenate([first, second[second >= 0]]), return_inverse=True)
    begin, end = rows[:len(first)], rows[:len(first)].copy()
    end[second >= 0] = rows[len(first):]
    root = roots(len(ids), begin, end)
    names, chain, sizes = np.unique(root[begin], return_inverse=True, return_counts=True)
    order = np.argsort(-sizes, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    of_contacts = np.full(len(force), -1)
    of_contacts[is_strong] = rank[chain]
    grains = np.bincount(rank[np.searchsorted(names, root)], minlength=len(names))
    total = float(force.sum())
    return ForceChains(is_strong, of_contacts, sizes[order], grains, threshold,
                       float(force[is_strong].sum()) / total if total > 0 else 0.)


def roots(n: int, begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """The least node that each of n nodes is connected with. @param begin, end nodes that links join"""
    least = np.arange(n)
    while True:
        lower = np.minimum(least[begin], least[end])
        joined = least.copy()
        np.minimum.at(joined, least[begin], lower)
        np.minimum.at(joined, least[end], lower)
        joined = joined[joined]
        if (joined == least).all() and (least[begin] == least[end]).all():
            return least
        least = joined
