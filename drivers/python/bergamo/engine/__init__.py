"""Builds and steps simulations of grains: Bergamo's engine, from Python.

    from bergamo import engine
    grains = engine.Grains()
    grains.add(position, half_axes=(1e-3, 8e-4, 6e-4), exponents=(0.8, 0.8))     # (n, 3) [m]
    simulation = engine.Simulation(engine.Parameters(gravity=(0, 0, -9.81), time_step=2e-6), grains, [engine.Plane()])
    simulation.step(10000)
    simulation.position, simulation.velocity      # (n, 3), in place
    simulation.contacts().force                   # (k, 3) [N]
    simulation.save("results/mine/snapshot.h5")   # bergamo.open("results/mine"), engine.Simulation.load(...)

SI units, global frame, tension positive, quaternions (x, y, z, w), body to global. Needs NumPy, and the compiled part:
`ninja -C build/release bergamo_engine`. ImportError, saying so, where that is not built. docs/python.md has examples.
"""

from .bodies import Plane, Surface, box_planes, read_surface
from .errors import Busy, ConfigError, RunError, StaleView
from .grains import Clump, Grains
from .library import library
from .loading import Compression, Loading
from .packing import GaussianSizes, Packing, SieveCurve, Space, UniformSizes, pack
from .parameters import (GRAIN, WALL, Law, Material, Parameters, damping_ratio_of, relaxation_time, restitution,
                         restitution_of_ratio)
from .simulation import Simulation
from .threads import pack_width, set_threads, threads
from .views import View

library()

__all__ = [
    "Busy", "Clump", "Compression", "ConfigError", "GRAIN", "GaussianSizes", "Grains", "Law", "Loading", "Material",
    "Packing", "Parameters", "Plane", "RunError", "SieveCurve", "Simulation", "Space", "StaleView", "Surface",
    "UniformSizes", "View", "WALL", "box_planes", "damping_ratio_of", "pack", "pack_width", "read_surface",
    "relaxation_time", "restitution", "restitution_of_ratio", "set_threads", "threads",
]
