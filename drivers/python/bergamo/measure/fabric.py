"""Directions of contacts."""

from __future__ import annotations

import numpy as np

from ..contacts import Contacts
from .stresses import deviatoric_stress


def fabric_tensor(contacts: Contacts) -> np.ndarray:
    """Mean of n (x) n of the contacts' normals, (3, 3) (Satake 1982): of trace one, a third of the identity where they
    have no preferred direction, zero without contacts.
    """
    if len(contacts) == 0:
        return np.zeros((3, 3))
    return np.einsum("ki,kj->ij", contacts.normal, contacts.normal) / len(contacts)


def anisotropy(fabric: np.ndarray) -> float:
    """15/2 sqrt(3/2 F':F') of a fabric tensor's deviator (Kanatani 1984; dem/measure/fabric.h). @param fabric (3, 3)"""
    return 7.5 * deviatoric_stress(fabric)
