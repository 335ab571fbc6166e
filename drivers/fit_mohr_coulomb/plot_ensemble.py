#!/usr/bin/python3
"""Draws the mean stress ratio and volumetric strain of an ensemble of triaxial tests over the axial compression, with
the deviation over the samples as error bars, one colour a confining pressure (Wellmann's fig. 5.5c, d).

Reads curves_grains.csv (columns confining_pressure_Pa, n_samples, axial_strain, stress_ratio, volumetric_strain and the
deviations of both) and writes RUN_FOLDER/plots/triaxial_ensemble.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS


def by_pressure(columns):
    """The rows of each pressure as columns of their own, in rising order."""
    pressures = columns["confining_pressure_Pa"]
    return [(pressure, {name: values[pressures == pressure] for name, values in columns.items()})
            for pressure in np.unique(pressures)]


def colour_of(i):
    return COLOURS[i % len(COLOURS)]


def draw_mean(axes, rows, name, factor, i):
    """The mean curve of the i-th pressure with twelve error bars; none where a single sample has no deviation.

    The bars of each pressure stand a little beside those of the others, so that equal curves can be told apart.
    """
    compression, values = -rows["axial_strain"], factor * rows[name]
    n = int(rows["n_samples"][0])
    axes.plot(100 * compression, values, color=colour_of(i),
              label=f"{rows['confining_pressure_Pa'][0] / 1e3:g} kPa, {n} sample{'s' if n > 1 else ''}")
    if n > 1:
        places = compression[-1] * (np.arange(1, 13) - 0.12 * (i % len(COLOURS))) / 12
        axes.errorbar(100 * places, np.interp(places, compression, values),
                      yerr=np.interp(places, compression, factor * rows[name + "_deviation"]), fmt="none", capsize=2.5,
                      elinewidth=1, color=colour_of(i))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    groups = by_pressure(run_data.read_table(folder, "curves_grains.csv"))
    figure, all_axes = run_data.new_panels(1, 2)
    for i, (_, rows) in enumerate(groups):
        draw_mean(all_axes[0, 0], rows, "stress_ratio", 1, i)
        draw_mean(all_axes[0, 1], rows, "volumetric_strain", 100, i)
    all_axes[0, 0].set_ylabel(r"stress ratio $\sigma_3/\sigma_1$")
    all_axes[0, 1].set_ylabel(r"volumetric strain $\epsilon_V$ in %")
    for axes in all_axes[0]:
        axes.set_xlabel(r"axial compression $-\epsilon_3$ in %")
        axes.margins(x=0)
    all_axes[0, 0].legend(loc="lower right")
    run_data.save_diagram(figure, folder, "triaxial_ensemble.png")


if __name__ == "__main__":
    main()
