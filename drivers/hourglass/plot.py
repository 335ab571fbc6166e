#!/usr/bin/python3
"""Draws sand in an hourglass: the mass that has passed the neck and its flow, what the glass weighs, and the grains in a
slice through the axis, coloured by the height they began at (Wellmann's fig. 3.15).

Reads history.csv, mass_flow.csv, summary.json and grains_*.vtu and writes RUN_FOLDER/plots/hourglass.png and
RUN_FOLDER/plots/grains.png.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS
from slices import slice_of


def draw_flow(folder):
    history, summary = run_data.read_history(folder), run_data.read_summary(folder)
    figure, [[mass, flow, load]] = run_data.new_panels(1, 3)
    time, unit = run_data.time_axis(history["time_s"])
    factor = 1e3 if unit == "ms" else 1
    mass.plot(time, history["discharged_mass_kg"] * 1e3, color=COLOURS[0])
    mass.set_ylabel("mass below the neck in g")
    flow.plot(time, history["mass_flow_kg_s"] * 1e3, color="#BBBBBB", linewidth=0.8, label="between samples")
    if os.path.exists(os.path.join(folder, "mass_flow.csv")):
        windows = run_data.read_table(folder, "mass_flow.csv")
        edges = np.append(windows["begin_s"], windows["end_s"][-1]) * factor
        flow.stairs(windows["mass_flow_kg_s"] * 1e3, edges, baseline=None, color=COLOURS[0], linewidth=2,
                    label="steady flow, windows")
    if "usual_beverloo_flow_kg_s" in summary:
        flow.axhline(summary["usual_beverloo_flow_kg_s"] * 1e3, color=COLOURS[1], linestyle="--",
                     label="Beverloo, C = 0.58, k = 1.4")
    flow.set_ylabel("mass flow in g/s")
    flow.legend(fontsize=8)
    load.plot(time, history["load_over_weight"], color=COLOURS[2], linewidth=0.8)
    load.axhline(1, color="#999999", linewidth=0.8)
    load.set_ylabel("load on the glass over the sand's weight")
    for axes in (mass, flow, load):
        axes.set_xlabel(f"time in {unit}")
        axes.margins(x=0)
        axes.set_ylim(bottom=0)
    mass.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "hourglass.png")


def glass_profile(parameters):
    """Radius and height of the glass, from the floor to the top, in mm."""
    import math
    neck, chamber, cylinder = (1e3 * float(parameters[f"Glass/{name}"])
                               for name in ("neck radius", "chamber radius", "cylinder height"))
    cone = (chamber - neck) / math.tan(math.radians(float(parameters["Glass/half angle"])))
    radius = np.array([0, chamber, chamber, neck, chamber, chamber])
    return radius, np.array([-cone - cylinder, -cone - cylinder, -cone, 0, cone, cone + cylinder])


def draw_grains(folder):
    from matplotlib.collections import PolyCollection
    files = run_data.pictures_of(folder, "grains").paths
    if not files:
        return
    shown = [files[k] for k in np.unique(np.linspace(0, len(files) - 1, 4).round().astype(int))]
    radius, height = glass_profile(run_data.read_parameters(folder))
    figure, panels = run_data.new_panels(1, len(shown))
    figure.set_size_inches(1 + 2.2 * len(shown), 6)
    highest = None
    for axes, path in zip(panels[0], shown):
        outlines, [heights] = slice_of(path, ["start_height"])
        heights = heights * 1e3
        highest = highest or heights.max()
        axes.add_collection(PolyCollection(outlines, array=heights, cmap="turbo", clim=(0, highest), linewidths=0))
        for side in (-1, 1):
            axes.plot(side * radius, height, color="#444444", linewidth=1)
        axes.set_aspect("equal")
        axes.grid(False)
        axes.set_xlabel("x in mm")
    panels[0, 0].set_ylabel("z in mm")
    panels[0, 0].set_title("grains by their first height", loc="left", fontsize=9)
    run_data.save_diagram(figure, folder, "grains.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    draw_flow(folder)
    draw_grains(folder)


if __name__ == "__main__":
    main()
