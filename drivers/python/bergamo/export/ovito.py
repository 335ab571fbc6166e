"""Grains for OVITO, which draws them as superquadrics: LAMMPS' text dumps and extended XYZ."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..grains import Grains
from .files import EXACT, write_rows

# OVITO takes a column of a dump for the property of its own that has this name without blanks. LAMMPS' names would not do:
# shapex is halved, and quat1 of LIGGGHTS or c_orient[1] of LAMMPS may be the scalar, which comes last in OVITO.
DUMP = ("id type mol x y z vx vy vz AsphericalShape.X AsphericalShape.Y AsphericalShape.Z Orientation.X Orientation.Y "
        "Orientation.Z Orientation.W SuperquadricRoundness.Phi SuperquadricRoundness.Theta")
XYZ = ("species:I:1:pos:R:3:id:I:1:molecule:I:1:velo:R:3:aspherical_shape:R:3:orientation:R:4:"
       "SuperquadricRoundness:R:2")


def write_dump(grains: Grains, path: Path, cell: np.ndarray | None = None) -> Path:
    """A dump of one time step. @param cell (3,) edges of a periodic cell from the origin [m]"""
    low, high = bounds(grains, cell)
    kind = " ".join("pp" if repeats else "ff" for repeats in repeating(cell))
    edges = "".join(f"{EXACT} {EXACT}\n" % (a, b) for a, b in zip(low, high))
    number, material, carrier = names_of_parts(grains)
    head = (f"ITEM: TIME\n{EXACT % time_of(grains)}\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(grains.parts)}\n"
            f"ITEM: BOX BOUNDS {kind}\n{edges}ITEM: ATOMS {DUMP}\n")
    parts = grains.parts
    return write_rows(path, head, [number, material, carrier, parts.centre, velocity_of(grains), parts.half_axes,
                                   parts.quaternion, parts.exponents], " ")


def write_xyz(grains: Grains, path: Path, cell: np.ndarray | None = None) -> Path:
    """Extended XYZ of one time. @param cell see write_dump()"""
    low, high = bounds(grains, cell)
    a, b, c = (EXACT % edge for edge in high - low)
    number, material, carrier = names_of_parts(grains)
    periodic = " ".join("T" if repeats else "F" for repeats in repeating(cell))
    head = (f"{len(grains.parts)}\nLattice=\"{a} 0 0 0 {b} 0 0 0 {c}\" Origin=\"{' '.join(EXACT % x for x in low)}\" "
            f"Properties={XYZ} Time={EXACT % time_of(grains)} pbc=\"{periodic}\"\n")
    parts = grains.parts
    return write_rows(path, head, [material, parts.centre, number, carrier, velocity_of(grains), parts.half_axes,
                                   parts.quaternion, parts.exponents], " ")


def names_of_parts(grains: Grains) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Identifier (the grain's id, for clumps the part's number), type from 1 and the grain's id, (m,) each."""
    parts = grains.parts
    carrier = grains.id[parts.grain].astype(np.int64)
    number = carrier if len(parts) == len(grains) else np.arange(len(parts))
    material = np.zeros(len(parts), dtype=np.int64) if parts.material is None else parts.material
    return number, material + 1, carrier


def velocity_of(grains: Grains) -> np.ndarray:
    """Of the grains that carry the parts, (m, 3) [m/s]."""
    return grains.velocity[grains.parts.grain].astype(float)


def time_of(grains: Grains) -> float:
    return grains.time if np.isfinite(grains.time) else 0.  # of a picture without an index


def bounds(grains: Grains, cell: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """Corners, (3,) each [m], of the periodic cell, along axes without one of a box about all grains."""
    low, high = np.zeros(3), np.ones(3)
    if len(grains) > 0:
        reach = np.linalg.norm(grains.parts.half_axes, axis=1)[:, None]  # no point of a superquadric is farther
        low, high = (grains.parts.centre - reach).min(axis=0), (grains.parts.centre + reach).max(axis=0)
    repeats = repeating(cell)
    return np.where(repeats, 0., low), np.where(repeats, cell, high) if repeats.any() else high


def repeating(cell: np.ndarray | None) -> np.ndarray:
    """Whether a cell repeats itself along x, y and z, (3,)."""
    return np.zeros(3, dtype=bool) if cell is None else np.isfinite(cell)
