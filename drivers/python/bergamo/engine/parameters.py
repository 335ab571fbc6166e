"""Materials, what is between them, and how a simulation is stepped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .errors import ConfigError
from .library import library

GRAIN, WALL = 0, 1  # numbers of materials: the first are those that grains, and planes and surfaces, have by default


@dataclass(frozen=True)
class Material:
    """Elastic material of grains or walls. The mass of a grain follows from the density that it is added with."""

    young_modulus: float = 50e9  # [Pa]
    poisson_ratio: float = 0.2
    density: float = 2650.  # [kg/m^3]


@dataclass(frozen=True)
class Law:
    """How two materials rub and lose energy where they touch: Hertz and Mindlin with Coulomb's friction and a dashpot.
    damping_ratio_of() has the ratio for a coefficient of restitution.
    """

    friction: float = 0.24  # Coulomb's coefficient
    damping_ratio: float = 0.9  # of the dashpot, share of critical damping
    relaxation_time: float = 0.  # A of the viscoelastic law (Brilliantov et al. 1996), beside the dashpot [s]


@dataclass(frozen=True)
class Parameters:
    """Physics and numerics of a simulation. ConfigError, where one is made, for a value out of its range."""

    materials: Sequence[Material] = (Material(), Material())  # by number
    law: Law = Law()  # between any two
    laws: Mapping[tuple[int, int], Law] = field(default_factory=dict)  # between two by number, in either order
    gravity: Sequence[float] = (0., 0., 0.)  # [m/s^2]
    time_step: float = 2.5e-7  # [s]; Simulation.stable_time_step() tells what contacts bear
    verlet_distance: float = 0.1  # up to which grains are neighbours, over the mean bounding radius
    sort_interval: int = 100  # renewals of the neighbours between two sorts of the grains by place
    overlap_tolerance: float = 3e-5  # error over the overlap at which a contact is searched anew; 0: at every step
    curvature_bound: float = 0.1  # radii of curvature are bounded to [bound r_min, r_max / bound]

    def __post_init__(self) -> None:
        for pair in self.laws:
            if len(pair) != 2 or not all(0 <= number < len(self.materials) for number in pair):
                raise ConfigError(f"a law is between the materials {pair}: they must be two of the {len(self.materials)} "
                                  "materials, counted from 0")
            if pair != pair[::-1] and pair[::-1] in self.laws and self.laws[pair[::-1]] != self.laws[pair]:
                raise ConfigError(f"there are two laws between the materials {pair}: give one, in either order")
        library().check_parameters(self)

    @property
    def _materials(self) -> np.ndarray:
        return np.array([[one.young_modulus, one.poisson_ratio, one.density] for one in self.materials],
                        dtype=float).reshape(-1, 3)

    @property
    def _pairs(self) -> np.ndarray:
        """In one row: (0, 0), (0, 1), (1, 1), (0, 2), ..."""
        pairs = [(low, high) for high in range(len(self.materials)) for low in range(high + 1)]
        laws = [self.laws.get(pair, self.laws.get(pair[::-1], self.law)) for pair in pairs]
        return np.array([[one.friction, one.damping_ratio, one.relaxation_time] for one in laws],
                        dtype=float).reshape(-1, 3)


def parameters_of(data: dict[str, Any]) -> Parameters:
    """What the compiled part says."""
    data = dict(data)
    materials, rows = (data.pop(name) for name in ("materials", "pairs"))
    pairs = [(low, high) for high in range(len(materials)) for low in range(high + 1)]
    data["gravity"] = tuple(data["gravity"].tolist())
    return Parameters(materials=tuple(Material(*row) for row in materials.tolist()),
                      laws={pair: Law(*row) for pair, row in zip(pairs, rows.tolist())}, **data)


def text_of(parameters: Parameters) -> str:
    """As parameters.prm has them, for readers of a snapshot."""
    lines = ["subsection Simulation"]
    lines += [f"  set {name.replace('_', ' ')} = {getattr(parameters, name)!r}" for name in
              ("time_step", "verlet_distance", "sort_interval", "overlap_tolerance", "curvature_bound")]
    lines += [f"  set gravity = {', '.join(map(repr, map(float, parameters.gravity)))}", "end"]
    for number, material in enumerate(parameters.materials):
        lines += [f"subsection Material {number}", f"  set Young's modulus = {material.young_modulus!r}",
                  f"  set Poisson's ratio = {material.poisson_ratio!r}", f"  set density = {material.density!r}", "end"]
    pairs = [(low, high) for high in range(len(parameters.materials)) for low in range(high + 1)]
    for (low, high), row in zip(pairs, parameters._pairs.tolist()):
        lines += [f"subsection Law {low} {high}", f"  set friction = {row[0]!r}", f"  set damping ratio = {row[1]!r}",
                  f"  set relaxation time = {row[2]!r}", "end"]
    return "\n".join(lines) + "\n"


def damping_ratio_of(restitution: float) -> float:
    """The dashpot's ratio for a coefficient of restitution in [0.01, 1] (Wellmann 3.27-3.31)."""
    return library().damping_ratio_of(restitution)


def restitution_of_ratio(damping_ratio: float) -> float:
    """Coefficient of restitution of two bodies that meet head on under the dashpot; of no speed, mass or stiffness."""
    return library().restitution_of_ratio(damping_ratio)


def restitution(relaxation_time: float, normal_stiffness: float, reduced_mass: float, speed: float) -> float:
    """Coefficient of restitution under the viscoelastic law. @param relaxation_time A [s]; normal_stiffness k of
    f = k overlap^1.5 [N/m^1.5]; reduced_mass m1 m2 / (m1 + m2) [kg]; speed of approach [m/s]
    """
    return library().restitution(relaxation_time, normal_stiffness, reduced_mass, speed)


def relaxation_time(restitution: float, normal_stiffness: float, reduced_mass: float, speed: float) -> float:
    """The other way round: A [s] for a coefficient of restitution in [0.01, 1] at a speed."""
    return library().relaxation_time(restitution, normal_stiffness, reduced_mass, speed)
