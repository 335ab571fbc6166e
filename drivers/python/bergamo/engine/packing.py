"""Packings of random grains, made by geometry alone: drawn, placed at random and tightened."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from .errors import ConfigError
from .grains import Clump, Grains
from .library import library


@dataclass(frozen=True)
class GaussianSizes:
    """Half-axes Gaussian about half the mean large, intermediate and small dimension, within bounds; exponents uniform.
    The defaults are Leighton Buzzard sand, fraction B.
    """

    mean_half_axes: Sequence[float] = (0.57e-3, 0.395e-3, 0.305e-3)  # [m]
    relative_deviation: float = 0.2  # standard deviation over mean
    smallest_half_axis: float = 0.25e-3  # [m]
    largest_half_axis: float = 0.75e-3  # [m]
    smallest_exponent: float = 0.6
    largest_exponent: float = 1.2
    kind: ClassVar[str] = "gaussian"


@dataclass(frozen=True)
class UniformSizes:
    """Diameters of the spheres of equal volume uniform by number between two bounds; half-axes uniform in
    [1, elongation], exponents in [1 - angularity, 1 + angularity].
    """

    smallest_diameter: float = 0.5e-3  # [m]
    largest_diameter: float = 1e-3  # [m]
    elongation: float = 1.5  # >= 1; 1: spheres, with an angularity of 0
    angularity: float = 0.3  # in [0, 1)
    kind: ClassVar[str] = "uniform"


@dataclass(frozen=True)
class SieveCurve:
    """Sizes by mass, as sieving gives them: pairs of a grain's intermediate diameter [m] and the share of the mass that
    passes, ascending from 0 to 1, linear in the logarithm of the size between. Shapes as UniformSizes has them.
    """

    points: Sequence[tuple[float, float]]
    elongation: float = 1.5
    angularity: float = 0.3
    kind: ClassVar[str] = "sieves"


@dataclass(frozen=True)
class Space:
    """Where grains are packed; by box(), cylinder(), polyhedron() or periodic()."""

    kind: str
    data: tuple[object, ...]

    @staticmethod
    def box(low: ArrayLike, high: ArrayLike) -> Space:
        """@param low, high corners, (3,) [m]"""
        return Space("box", (low, high))

    @staticmethod
    def periodic(edges: ArrayLike, repeats: Sequence[bool] = (True, True, True)) -> Space:
        """A box from the origin that repeats itself along some axes and has walls across the others: the grains get it as
        their cell, with infinite edges where there are walls. @param edges (3,) [m]; repeats along x, y and z
        """
        if len(repeats) != 3 or not any(repeats):
            raise ConfigError(f"the axes along which a periodic box repeats itself are {tuple(repeats)}: give three values, "
                              "one of them true; Space.box() repeats itself along none")
        return Space("periodic", ((0., 0., 0.), edges, tuple(bool(one) for one in repeats)))

    @staticmethod
    def cylinder(base: ArrayLike, radius: float, height: float) -> Space:
        """Upright about z. @param base centre of its bottom, (3,) [m]; radius, height [m]"""
        return Space("cylinder", (base, float(radius), float(height)))

    @staticmethod
    def polyhedron(normals: ArrayLike, offsets: Sequence[float]) -> Space:
        """The points x with normal . x <= offset for all. @param normals (k, 3) away from the grains; offsets (k,) [m]"""
        return Space("polyhedron", (np.asarray(normals, dtype=float), [float(offset) for offset in offsets]))


@dataclass(frozen=True)
class Packing:
    """What came out of pack()."""

    grains: Grains  # at rest, free of contacts
    solid_fraction: float  # reached
    has_reached_target: bool  # within 0.001
    size_factor: float  # of all drawn grains, so that whole ones make up the solid volume
    smallest_size: float  # over the size that a grain should have: 1, all are as drawn
    iterations: int  # of the tightening


def pack(sizes: GaussianSizes | UniformSizes | SieveCurve, space: Space, *, solid_fraction: float = 0.55,
         start_solid_fraction: float = 0.26, density: float = 2650., seed: int = 1, clump: Clump | None = None,
         max_iterations: int = 2000) -> Packing:
    """Fills a space with grains of material 0: draws them, places them at random at a reduced size and tightens the packing
    until they have their full size (Wellmann 3.4.4). Denser ones come from stepping: Simulation.compress_box(),
    load_cell(). The same bits for the same seed on any number of threads. Ctrl-C ends the tightening.

    @param solid_fraction wanted, in (0, 0.7]; of clumps, which are not tightened, at most 0.35, some 0.25 for most
    @param start_solid_fraction that is placed at random, in (0, 0.35]; @param density [kg/m^3]
    @param clump that takes the place of each grain, in its volume (sieves: in its size); @param max_iterations of the
    tightening, which ends early below its target where it gets stuck: see has_reached_target
    ConfigError for a space too small for the grains, or where they find no place.
    """
    if seed < 0:
        raise ConfigError(f"the seed of a packing is {seed}: it must be at least 0")
    options = {"solid_fraction": solid_fraction, "start_solid_fraction": start_solid_fraction, "density": density,
               "max_iterations": max_iterations, "clump": clump._clump if clump else None}
    particles, report = library().pack(sizes, (space.kind, *space.data), options, seed)
    return Packing(Grains._of(particles), **report)
