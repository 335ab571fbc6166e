#!/usr/bin/python3
"""Draws the block's faces at several times of a run of rubber_block, from the side and from below, coloured by the contact
pressure over the top pressure (after fig. 4.9c of the dissertation).

Reads RUN_FOLDER/surfaces_*.vtu and writes RUN_FOLDER/plots/rubber_block_pressure.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from surface_faces import add_view

N_TIMES = 4
HIGHEST = 5  # pressure over top pressure, of the colours


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    top = max(run_data.read_history(folder)["top_pressure_Pa"])
    series = run_data.pictures_of(folder, "surfaces")
    series = [series[k] for k in np.unique(np.linspace(0, len(series) - 1, N_TIMES + 1).astype(int)[1:])]
    run_data.new_diagram_look()
    from matplotlib import pyplot
    figure, panels = pyplot.subplots(len(series), 2, squeeze=False, figsize=(10, 2.3 * len(series)), layout="constrained")
    for row, block in zip(panels, series):
        for axes, axis in zip(row, (1, 2)):
            faces = add_view(axes, block.corners, block.smooth_pressure / top, axis, HIGHEST)
            axes.set_title(f"{block.time * 1e3:.2f} ms, from {'the side' if axis == 1 else 'below'}", fontsize=9)
            axes.set_xlabel("x in mm", fontsize=9)
    figure.colorbar(faces, ax=panels, label="pressure over top pressure", extend="max")
    run_data.save_diagram(figure, folder, "rubber_block_pressure.png")


if __name__ == "__main__":
    main()
