"""How a periodic cell, or a box between planes, is loaded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Loading:
    """One stage of the loading of a periodic cell; its axis is z. Stages under stresses alone (isotropic, true_triaxial)
    end when these are reached and the grains rest, strained ones when their strain is.

    path is "isotropic": the same pressure on all axes; "triaxial": strained along z, the pressure across kept;
    "true_triaxial": a stress of its own on every axis; "constant_volume", "constant_pressure": strained along z.
    """

    path: str = "isotropic"
    pressure: float = 25e3  # see the path; it also sets the rate [Pa]
    friction: float = 0.24  # between grains, materials 0 and 0, from the stage on
    stresses: Sequence[float] = (0., 0., 0.)  # of true_triaxial, compression positive [Pa]
    inertial_number: float = 1e-3  # of the strain rate at that pressure
    axial_strain: float = -0.2  # change of L_z over L_z at the start; negative is compression
    n_cycles: int = 0  # of the axial strain, to the one given, its opposite and back; 0 goes there once
    time_step: float = 2.5e-7  # at most [s]; it follows the stable one
    overlap_tolerance: float = 3e-5  # see Parameters
    stress_tolerance: float = 0.005  # over the pressure
    force_tolerance: float = 0.01  # mean unbalanced over mean contact force
    longest_time: float = 1.  # [s]


@dataclass(frozen=True)
class Compression:
    """Of the grains of a box between its six planes, which are pistons, to an isotropic pressure."""

    pressure: float = 1000.  # in every direction [Pa]
    largest_rate: float = 40.  # strain rate of the planes [1/s]
    pressure_tolerance: float = 0.01
    force_tolerance: float = 0.01  # mean unbalanced over mean contact force
    longest_time: float = 0.5  # of the simulation, from its start [s]
