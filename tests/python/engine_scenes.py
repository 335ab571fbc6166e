"""Small simulations for the tests of bergamo.engine."""

import os
from pathlib import Path

import numpy as np
from small_runs import ROOT

from bergamo import engine

BUILD = Path(os.environ.get("BERGAMO_BUILD", ROOT / "build" / "release"))
SOFT = engine.Material(young_modulus=5e6, poisson_ratio=0.3)


def parameters(**changes):
    given = {"materials": (SOFT, SOFT), "law": engine.Law(friction=0.4, damping_ratio=0.2), "gravity": (0, 0, -9.81),
             "time_step": 2e-5, **changes}
    return engine.Parameters(**given)


def loose(n_edge=4, seed=1):
    """n_edge^3 grains of two shapes, spheres among them, in a lattice that does not touch, each turned at random."""
    random = np.random.default_rng(seed)
    place = np.stack(np.meshgrid(*[np.arange(n_edge)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    n = len(place)
    grains = engine.Grains()
    half_axes = np.where(np.arange(n)[:, None] % 3 == 0, 1e-3, random.uniform(0.8e-3, 1.1e-3, (n, 3)))
    exponents = np.where(np.arange(n)[:, None] % 3 == 0, 1., random.uniform(0.7, 1.1, (n, 2)))
    turn = random.normal(size=(n, 4))
    grains.add(2.5e-3 * (place + 0.5) + random.uniform(-1e-4, 1e-4, (n, 3)), half_axes, exponents=exponents,
               quaternion=turn)
    grains.set_velocity(random.uniform(-0.05, 0.05, (n, 3)))
    return grains


def falling(n_edge=4, **changes):
    """These in a box of planes, that fall upon a floor of triangles."""
    edge = 2.5e-3 * n_edge
    low, high = np.zeros(3), np.array([edge, edge, 2 * edge])
    floor = engine.Surface([(0, 0, 0), (edge, 0, 0), (edge, edge, 0), (0, edge, 0)], [(0, 1, 2), (0, 2, 3)])
    walls = [plane for plane in engine.box_planes(low, high) if plane.normal[2] == 0]
    return engine.Simulation(parameters(**changes), loose(n_edge), walls, [floor])


def sphere_of_radius(radius=1e-3, height=1.5e-3, **changes):
    grains = engine.Grains()
    grains.add((0, 0, height), radius)
    return engine.Simulation(parameters(**changes), grains, [engine.Plane()])
