#!/usr/bin/python3
"""Draws the laws of Mohr and Coulomb and of sand over the grains that both are fitted to: stress ratio and volumetric
strain of the shears, a column for each generation friction, a colour for each pressure, with the misfit of each law.

Reads curves_laws.csv and sand.json and writes RUN_FOLDER/plots/laws.png.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from plot_ensemble import by_pressure, colour_of

LAWS = [("grains", "-", 2.2, 0.45), ("mohr_coulomb", ":", 1.2, 1), ("sand", "--", 1.2, 1)]


def draw(axes, rows, name, factor):
    for i, (_, test) in enumerate(by_pressure(rows)):
        for law, style, width, strength in LAWS:
            axes.plot(-100 * test["axial_strain"], factor * test[f"{name}_{law}"], color=colour_of(i), linestyle=style,
                      linewidth=width, alpha=strength)


def main():
    from matplotlib.lines import Line2D
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    table = run_data.read_table(folder, "curves_laws.csv")
    misfit = json.loads((Path(folder) / "sand.json").read_text())["misfit"]
    shears = {name: values[table["is_shear"] == 1] for name, values in table.items()}
    frictions = np.unique(shears["generation_friction"])
    figure, all_axes = run_data.new_panels(2, len(frictions))
    for column, friction in enumerate(frictions):
        rows = {name: values[shears["generation_friction"] == friction] for name, values in shears.items()}
        draw(all_axes[0, column], rows, "stress_ratio", 1)
        draw(all_axes[1, column], rows, "volumetric_strain", 100)
        all_axes[0, column].set_title(f"generation friction {friction:g}", loc="left")
        all_axes[1, column].set_xlabel(r"axial compression $-\epsilon_3$ in %")
    all_axes[0, 0].set_ylabel(r"stress ratio $\sigma_3/\sigma_1$")
    all_axes[1, 0].set_ylabel(r"volumetric strain $\epsilon_V$ in %")
    for axes in all_axes.flat:
        axes.margins(x=0)
    handles = [Line2D([], [], color=colour_of(i), label=f"{p / 1e3:g} kPa") for i, (p, _) in enumerate(by_pressure(shears))]
    labels = ["grains", f"Mohr–Coulomb, misfit {misfit['mohr_coulomb']['all']:.3f}", f"sand, misfit {misfit['sand']['all']:.3f}"]
    handles += [Line2D([], [], color="#555555", linestyle=style, linewidth=width, alpha=strength, label=label)
                for (_, style, width, strength), label in zip(LAWS, labels)]
    all_axes[0, -1].legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    run_data.save_diagram(figure, folder, "laws.png")


if __name__ == "__main__":
    main()
