"""Frames of a film of the installation: bands of the height at first, pressure, force chains, all with the same limits,
colours and size."""

import os

import numpy as np

import panels
import run_data
from ground import Ground, numbers_of

SIZE = (9, 10.8)  # inches
RESOLUTION = 100  # dots an inch: an even number of both, as video wants it


def picture_times(folder):
    """Simulated times of the pictures in s, from the collection for ParaView."""
    from xml.etree import ElementTree
    return [float(entry.get("timestep")) for entry in ElementTree.parse(os.path.join(folder, "grains.pvd")).iter("DataSet")]


class Limits:
    """Over all pictures of a run."""

    def __init__(self, folder):
        self.top, self.pressure, self.force = 0, 0, 0
        self.side, self.bottom = 0, np.inf
        for number in numbers_of(folder):
            ground = Ground(folder, number)
            self.top = max(self.top, ground.surface() + 1.5)
            self.pressure = max(self.pressure, np.nanmax(ground.stress()[2]) / 1e3)
            self.force = max(self.force, ground.chains()[1].max())
            x, z, _ = ground.stress()
            self.side, self.bottom = max(self.side, x[-1]), min(self.bottom, z[0])


def draw_frame(ground, planes, limits, title):
    figure, [[bands], [pressure], [chains]] = run_data.new_panels(3, 1)
    figure.set_size_inches(SIZE)
    panels.draw_bands(bands, ground, planes)
    shown = panels.draw_field(pressure, panels.scaled(ground.stress(), 1e-3), panels.PRESSURES, (0, limits.pressure))
    panels.draw_outlines(pressure, ground, grains=False)
    panels.draw_chains(chains, ground, limits.force)
    for axes in (bands, pressure, chains):
        panels.frame(axes, ground, limits.top)
        axes.set_xlim(-limits.side, limits.side)
        axes.set_ylim(limits.bottom, limits.top)
    panels.colour_bar(pressure, shown, "pressure in kPa")
    panels.no_bar(bands)
    panels.no_bar(chains)
    chains.set_xlabel("x in mm")
    bands.set_title(title, loc="left", family="monospace")
    return figure


def draw(folder):
    from matplotlib import pyplot
    planes, limits = panels.bands_of(Ground(folder, 0)), Limits(folder)
    start = Ground(folder, 0).tip()
    for number, time in enumerate(picture_times(folder)):
        ground = Ground(folder, number)
        title = f"{1e3 * time:7.1f} ms, way {start - ground.tip():5.2f} mm"
        figure = draw_frame(ground, planes, limits, title)
        run_data.save_diagram(figure, folder, os.path.join("film", f"frame_{number:04d}.png"), RESOLUTION)
        pyplot.close(figure)
