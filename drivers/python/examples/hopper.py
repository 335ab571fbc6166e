"""Sand that settles in a hopper and runs out of it: `/usr/bin/python3 drivers/python/examples/hopper.py [FOLDER]`, with
drivers/python in PYTHONPATH; half a minute of a core. ParaView and bergamo.open(FOLDER) show what it writes.
"""

import sys

import numpy as np

from bergamo import engine

folder = sys.argv[1] if len(sys.argv) > 1 else "results/hopper"

# A cylinder, a funnel and a pipe, between rings of 32 nodes; triangles are anticlockwise as seen from inside.
n = 32
angle = 2 * np.pi * np.arange(n) / n
rings = [(0.03, 0.08), (0.03, 0.03), (0.01, 0.005), (0.01, 0.)]  # radius, height [m]
nodes = np.concatenate([np.stack([r * np.cos(angle), r * np.sin(angle), np.full(n, z)], axis=1) for r, z in rings])
here, beside = np.arange(n), np.roll(np.arange(n), -1)
band = np.concatenate([np.stack([here, beside, n + here], axis=1), np.stack([beside, n + beside, n + here], axis=1)])
hopper = engine.Surface(nodes, np.concatenate([band + k * n for k in range(len(rings) - 1)]))

law = engine.Law(friction=0.4, damping_ratio=engine.damping_ratio_of(0.5))
soft = engine.Material(young_modulus=5e6, poisson_ratio=0.3)
parameters = engine.Parameters([soft, soft], law, gravity=(0, 0, -9.81), time_step=2.5e-5)
sizes = engine.UniformSizes(3e-3, 3.6e-3, elongation=1.4, angularity=0.3)
sand = engine.pack(sizes, engine.Space.cylinder((0, 0, 0.03), 0.029, 0.05), solid_fraction=0.4)
simulation = engine.Simulation(parameters, sand.grains, [engine.Plane()], [hopper])
weight = 9.81 * simulation.mass.sum()
print(f"{len(simulation)} grains of {weight:.3f} N settle")
simulation.every(1000, lambda: simulation.draw(folder, ["grains", "surfaces"]))
simulation.run_until(0.2)
print(f"the hopper bears {-simulation.surface_forces[0, 2]:.3f} N, its floor {-simulation.plane_force(0)[2]:.3f} N")
simulation.remove_plane(0)
simulation.every(200, lambda: simulation.remove(simulation.position[:, 2] < -0.04))
for end in (0.25, 0.3, 0.35, 0.4, 0.45, 0.5):
    simulation.run_until(end)
    print(f"{simulation.time:.2f} s: {len(simulation)} grains, the hopper bears {-simulation.surface_forces[0, 2]:.3f} N")
simulation.save(f"{folder}/snapshot.h5")
