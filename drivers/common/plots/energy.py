#!/usr/bin/python3
"""Draws the energy terms of a run over time, and below them the residual of their balance.

Reads the columns energy_*_J of history.csv and, where there is one, a residual: a column energy_residual_J (drawn in
joule) or energy_residual (without unit). Writes RUN_FOLDER/plots/energy.png.
"""

import argparse

import run_data
from run_data import COLOURS


def term_name(column):
    return column[len("energy_"):-len("_J")].replace("_", " ")


def suited_unit(largest):
    """A power of thousand for the energies, and its name."""
    for factor, unit in [(1e3, "kJ"), (1.0, "J"), (1e-3, "mJ"), (1e-6, "µJ")]:
        if largest >= factor:
            return factor, unit
    return 1e-9, "nJ"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    columns = run_data.read_history(folder)
    terms = [name for name in columns
             if name.startswith("energy_") and name.endswith("_J") and name != "energy_residual_J"]
    residual = next((name for name in ["energy_residual_J", "energy_residual"] if name in columns), None)
    if not terms:
        run_data.fail(f"history.csv in {folder} has no columns energy_*_J")

    time, time_unit = run_data.time_axis(columns["time_s"])
    factor, unit = suited_unit(max(abs(columns[name]).max() for name in terms))
    figure, all_axes = run_data.new_diagram(2 if residual else 1, [3, 1] if residual else None)
    axes = all_axes[0, 0]
    for i, name in enumerate(terms):
        axes.plot(time, columns[name] / factor, color=COLOURS[i % len(COLOURS)],
                  linestyle=["-", "--", ":"][i // len(COLOURS) % 3], label=term_name(name))
    axes.set_ylabel(f"energy in {unit}")
    axes.set_title(run_data.title_of(folder), loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    if residual:
        values, label = columns[residual], "residual"
        if residual.endswith("_J"):
            small_factor, small_unit = suited_unit(abs(values).max())
            values, label = values / small_factor, f"residual in {small_unit}"
        all_axes[1, 0].plot(time, values, color="#444444", linewidth=1.2)
        all_axes[1, 0].set_ylabel(label)
    for row in all_axes[:, 0]:
        run_data.mark_stages(row, time, columns)
        row.margins(x=0)
    all_axes[-1, 0].set_xlabel(f"time in {time_unit}")
    run_data.save_diagram(figure, folder, "energy.png")


if __name__ == "__main__":
    main()
