#!/usr/bin/python3
"""Whether a block of grains that grows downwards with the pile gives the resistance of one that is deep from the start.

For every seed the same sand settles in the same box, and blocks of the same width are cut out of it: deep from the start,
the same with steps of another length, as grains are chaotic and nothing can be nearer to the first than this, and less
deep but growing. What differs is given as domain_study.py does, to the whole way and to where grains part.

Writes FOLDER/growth.csv and FOLDER/plots/growth.png and prints the table. Runs that are finished are not run again.
Further settings NAME=VALUE of the driver hold for all runs.
"""

import csv
import statistics

import numpy as np
from domain_study import ANOTHER_STEP, arguments_of, differences, parting, run_check, run_data, smoothed, studies

DEEP = {"Model/block width": 0.022, "Model/block depth": 0.0125}
KINDS = {"deep": DEEP, "deep, another step": {**DEEP, "Pile/time step": ANOTHER_STEP},
         "growing": {"Model/block width": 0.022, "Model/block depth": 0.0077, "Model/growth depth": 0.0048,
                     "Model/growth distance": 0.0044}}
COLUMNS = ["largest_percent", "mean_percent", "smoothed_largest_percent", "smoothed_mean_percent", "work_percent"]


def folder_of(folder, kind, seed):
    return folder / f"{kind}-{seed}".replace(", ", "-").replace(" ", "-")


def measure(program, folder, seeds, common):
    """Rows of kind, seed, growths, account of the energy, and what differs from the deep block of the seed."""
    rows = []
    for seed in seeds:
        are_done = {kind: run_check(program, folder_of(folder, kind, seed), {**common, **settings, "Sand/seed": seed})
                    for kind, settings in KINDS.items()}
        if not all(are_done.values()):
            rows += [[kind, seed, *[""] * 13] for kind in KINDS]
            continue
        history = {kind: run_data.read_history(folder_of(folder, kind, seed)) for kind in KINDS}
        until = parting(history["deep, another step"], history["deep"])
        for kind in list(KINDS)[1:]:
            summary = run_data.read_summary(folder_of(folder, kind, seed))
            found = [*differences(history[kind], history["deep"]), *differences(history[kind], history["deep"], until)]
            rows.append([kind, seed, summary["block_growths"], f"{summary['energy_residual']:.2g}", f"{1e3 * until:.2f}",
                         *(f"{value:.2f}" for value in found)])
    return rows


def write_table(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["block", "seed", "growths", "energy_residual", "parting_mm", *COLUMNS,
                        *(f"{name}_before_parting" for name in COLUMNS)])
        table.writerows(rows)


def draw(folder, seeds):
    """Resistance of all seeds, smoothed over a tenth of the way."""
    figure, panels = run_data.new_panels(1, len(seeds))
    for axes, seed in zip(panels.ravel(), seeds):
        for kind, style in zip(KINDS, ("-", ":", "--")):
            if run_data.read_summary(folder_of(folder, kind, seed)):
                history = run_data.read_history(folder_of(folder, kind, seed))
                axes.plot(1e3 * smoothed(history), 1e3 * history["way_m"], style, label=kind)
        axes.set_xlabel("resistance of the head in mN")
        axes.set_title(f"packing {seed}", fontsize="medium")
        axes.invert_yaxis()
    panels.ravel()[0].set_ylabel("way of the pile in mm")
    panels.ravel()[0].legend(fontsize="x-small")
    run_data.save_diagram(figure, str(folder), "growth.png")


def main():
    program, folder, seeds, common = arguments_of(__doc__)
    rows = measure(program, folder, seeds, common)
    write_table(rows, folder / "growth.csv")
    print((folder / "growth.csv").read_text(), end="")
    for kind in list(KINDS)[1:]:
        works = [float(row[9]) for row in rows if row[0] == kind and row[9]]
        if len(works) > 1:
            print(f"{kind}: work of the pile differs by {statistics.mean(works):.1f} +- {statistics.stdev(works):.1f} %")
    draw(folder, seeds)


if __name__ == "__main__":
    main()
