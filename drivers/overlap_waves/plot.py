#!/usr/bin/python3
"""Draws a run of overlap_waves: the velocity along the column at several times, one below the other, and beside it that of
the same pulse in grains alone where such a run lies next to it, in a folder "grains".

Reads RUN_FOLDER/waves.csv and writes RUN_FOLDER/plots/waves.png.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data

MODELS = ((0, "grains", run_data.COLOURS[1]), (1, "continuum", run_data.COLOURS[0]))


def grains_beside(folder):
    other = Path(os.path.abspath(folder)).parent / "grains"
    return str(other) if (other / "waves.csv").exists() and not os.path.samefile(other, folder) else None


def draw(folder):
    waves, summary = run_data.read_table(folder, "waves.csv"), run_data.read_summary(folder)
    other = grains_beside(folder)
    alone = run_data.read_table(other, "waves.csv") if other else None
    times = np.unique(waves["time_s"])
    scale = 0.45 / abs(waves["velocity_m_s"]).max()
    figure, [[axes]] = run_data.new_diagram()
    figure.set_figheight(1.2 + 0.8 * len(times))
    if "overlap_from_m" in summary:
        axes.axvspan(summary["overlap_from_m"] * 1e3, (summary["overlap_from_m"] + summary["overlap_m"]) * 1e3,
                     color="#DDDDDD", label="overlap")
    for row, time in enumerate(times):
        if alone is not None:
            nearest = np.unique(alone["time_s"])[np.argmin(abs(np.unique(alone["time_s"]) - time))]
            at = alone["time_s"] == nearest
            axes.plot(alone["place_m"][at] * 1e3, scale * alone["velocity_m_s"][at] - row, color="black", linewidth=2.6,
                      alpha=0.3, label="grains alone" if row == 0 else None)
        for number, name, colour in MODELS:
            at = (waves["time_s"] == time) & (waves["is_continuum"] == number)
            axes.plot(waves["place_m"][at] * 1e3, scale * waves["velocity_m_s"][at] - row, color=colour, linewidth=1,
                      label=name if row == 0 and at.any() else None)
    axes.set_yticks(-np.arange(len(times)), [f"{time * 1e6:.0f} µs" for time in times])
    axes.set_xlabel("place in mm; upwards: velocity")
    axes.grid(False)
    axes.margins(x=0.01)
    if "reflected_share" in summary:
        axes.set_title(f"{100 * summary['reflected_share']:.2g} % of the energy reflected", loc="left")
    axes.legend(fontsize=9, ncols=4, loc="upper right", bbox_to_anchor=(1, 1.12))
    run_data.save_diagram(figure, folder, "waves.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    draw(parser.parse_args().run_folder)


if __name__ == "__main__":
    main()
