#!/usr/bin/python3
"""Draws the pressure under a strip footing over its settlement beside the closed form, and the ground at the end:
its deformed mesh, coloured by the equivalent plastic strain.

Reads history.csv, summary.json and the last continuum_*.vtu and writes RUN_FOLDER/plots/strip_footing.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS


def last_mesh(folder):
    """Faces of the front (four corners each, x and z), and the plastic strain of their elements."""
    series = run_data.pictures_of(folder, "continuum")
    if not series:
        run_data.fail(f"{folder} has no continuum_*.vtu")
    ground, faces = series[-1], []
    places = ground.reference
    for element in ground.element:
        corners = element[:8]  # they come first in quadratic cells, too
        front = corners[np.argsort(places[corners, 1], kind="stable")[:4]]
        x, z = places[front, 0], places[front, 2]
        around = np.argsort(np.arctan2(z - z.mean(), x - x.mean()))
        faces.append(ground.node[front[around]][:, [0, 2]])
    return np.array(faces), ground["equivalent_plastic_strain"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    columns = run_data.read_history(folder)
    summary = run_data.read_summary(folder)
    figure, panels = run_data.new_panels(1, 2)
    curve, ground = panels[0]
    curve.plot(columns["settlement_m"] * 1e3, columns["footing_pressure_Pa"] / 1e3, color=COLOURS[0], label="continuum")
    if "limit_pressure_Pa" in summary:
        curve.axhline(summary["limit_pressure_Pa"] / 1e3, color=COLOURS[1], linestyle="--", label="closed form")
    curve.set_xlabel("settlement in mm")
    curve.set_ylabel("mean pressure under the footing in kPa")
    curve.set_ylim(bottom=0)
    curve.legend(loc="lower right")
    curve.set_title(run_data.title_of(folder), loc="left")

    from matplotlib.collections import PolyCollection
    faces, strain = last_mesh(folder)
    mesh = PolyCollection(faces, array=strain * 100, cmap="YlOrRd", edgecolors="#00000030", linewidths=0.2)
    mesh.set_clim(0, np.quantile(strain, 0.98) * 100 or None)
    ground.add_collection(mesh)
    ground.set_aspect("equal")
    ground.set_xlim(faces[:, :, 0].min(), faces[:, :, 0].max())
    ground.set_ylim(faces[:, :, 1].min(), faces[:, :, 1].max() + 0.05)
    ground.grid(False)
    ground.set_xlabel("distance from the axis in m")
    ground.set_ylabel("height in m")
    figure.colorbar(mesh, ax=ground, label="equivalent plastic strain in %", shrink=0.7)
    run_data.save_diagram(figure, folder, "strip_footing.png")


if __name__ == "__main__":
    main()
