#!/usr/bin/python3
"""Draws spheres that went down a plane and a cycloid made of facets: their ways with few and with many facets, their
coordinates over time beside the closed form (Wellmann's fig. 4.8), and the deviations over the number of facets.

Reads slides.csv and slides/*/history.csv and writes RUN_FOLDER/plots/brachistochrone.png.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS

DISSERTATION = {"plane": 5e-6, "cycloid": 7e-3}  # m, section 4.3.2


def slide(folder, curve, facets):
    return run_data.read_history(os.path.join(folder, "slides", f"{curve}_{facets:.0f}"))


def draw_ways(axes, folder, facets):
    for n, colour in zip((facets[-1], facets[0]), COLOURS):
        way = slide(folder, "cycloid", n)
        axes.plot(way["x_m"] * 1e2, way["z_m"] * 1e2, color=colour, label=f"{n:.0f} facets")
    plane, exact = slide(folder, "plane", facets[-1]), slide(folder, "cycloid", facets[-1])
    axes.plot(plane["x_m"] * 1e2, plane["z_m"] * 1e2, color=COLOURS[2], label="plane")
    axes.plot(exact["exact_x_m"] * 1e2, exact["exact_z_m"] * 1e2, "k--", linewidth=0.8, label="closed form")
    axes.set_xlabel("x of the centre in cm")
    axes.set_ylabel("z of the centre in cm")
    axes.set_aspect("equal")


def draw_motions(axes, folder, facets):
    for curve, colour in zip(DISSERTATION, (COLOURS[2], COLOURS[0])):
        motion = slide(folder, curve, facets[-1])
        for coordinate, line in (("x", "-"), ("z", "-.")):
            axes.plot(motion["time_s"], motion[f"{coordinate}_m"] * 1e2, line, color=colour,
                      label=f"{coordinate}, {curve}")
            axes.plot(motion["time_s"], motion[f"exact_{coordinate}_m"] * 1e2, "k--", linewidth=0.8)
    axes.set_xlabel("time in s")
    axes.set_ylabel("coordinate in cm")


def draw_deviations(axes, slides):
    for number, (curve, limit) in enumerate(DISSERTATION.items()):
        rows = slides["cycloid"] == number
        facets, colour = slides["facets"][rows], COLOURS[2 * (1 - number)]
        distance = np.maximum(slides["distance_above_path_m"], slides["distance_below_path_m"])[rows]
        axes.loglog(facets, slides["z_difference_m"][rows], "o-", color=colour, label=f"z at the same time, {curve}")
        axes.loglog(facets, distance, "x:", color=colour, label=f"distance from the path, {curve}")
        axes.axhline(limit, color=colour, linestyle="--", linewidth=0.8, label=f"dissertation, {curve}")
        if number == 1:
            axes.loglog(facets, slides["z_difference_m"][rows][0] * (facets[0] / facets)**2, color="#999999",
                        linewidth=0.8, label="second order")
    axes.set_xlabel("facets")
    axes.set_ylabel("largest deviation in m")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    slides = run_data.read_table(folder, "slides.csv")
    facets = np.unique(slides["facets"])
    figure, panels = run_data.new_panels(1, 3)
    ways, motions, deviations = panels[0]
    draw_ways(ways, folder, facets)
    draw_motions(motions, folder, facets)
    draw_deviations(deviations, slides)
    for axes in panels[0]:
        axes.legend(fontsize=8)
    ways.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "brachistochrone.png")


if __name__ == "__main__":
    main()
