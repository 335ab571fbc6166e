#!/usr/bin/python3
"""Draws how the sample of a run of membrane_triaxial bulges: its outline at several strains, and the membrane from the
side, coloured by the pressure of the beads on it over that around it (after fig. 4.10b of the dissertation).

Reads history.csv, shape.csv and surfaces_*.vtu in RUN_FOLDER and writes RUN_FOLDER/plots/membrane_triaxial_shape.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from surface_faces import add_view

N_TIMES = 5
HIGHEST = 2  # pressure over lateral pressure, of the colours


def draw_outlines(axes, shape, strains):
    """Mean radius over height."""
    from matplotlib import colormaps
    radii = np.array([shape[name] for name in shape if name.startswith("radius_")]) * 1e3
    for k in np.linspace(0, len(strains) - 1, N_TIMES).astype(int):
        height = np.linspace(-0.5, 0.5, len(radii)) * shape["height_m"][k] * 1e3
        axes.plot(radii[:, k], height, color=colormaps["viridis"](0.9 * k / len(strains)),
                  label=f"{100 * strains[k]:.0f} %")
    axes.set_xlabel("mean radius in mm")
    axes.set_ylabel("height in mm, rings evenly")
    axes.legend(title="axial strain", fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    history, shape = run_data.read_history(folder), run_data.read_table(folder, "shape.csv")
    series = run_data.pictures_of(folder, "surfaces")
    run_data.new_diagram_look()
    from matplotlib import pyplot
    figure, (outlines, first, last) = pyplot.subplots(1, 3, figsize=(11, 5.5), layout="constrained")
    draw_outlines(outlines, shape, history["axial_strain"][:len(shape["time_s"])])
    for axes, membrane in ((first, series[0]), (last, series[-1])):
        share = membrane.smooth_pressure / history["lateral_pressure_Pa"][-1]
        faces = add_view(axes, membrane.corners, share, 1, HIGHEST, looks=1)
        strain = np.interp(membrane.time, history["time_s"], history["axial_strain"])
        axes.set_title(f"axial strain {100 * strain:.1f} %", fontsize=10)
        axes.set_xlabel("x in mm")
    for axes in (first, last):
        axes.set_xlim(last.get_xlim())
        axes.set_ylim(first.get_ylim())
    figure.colorbar(faces, ax=[first, last], label="pressure of the beads over lateral pressure", extend="max")
    run_data.save_diagram(figure, folder, "membrane_triaxial_shape.png")


if __name__ == "__main__":
    main()
