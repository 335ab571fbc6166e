#!/usr/bin/python3
"""Whether two scales give the resistance of grains alone, over the size of the grains' domain.

For every seed the same sand settles in the same box; it is penetrated as it is, grains alone, and with blocks of three
sizes cut out of it and elements beyond. What differs is the largest difference of the head's resistance and the mean one
(root of the mean square) over the largest resistance of grains alone, as they are and smoothed over a tenth of the pile's
way, as single grains that slip make most of the difference from moment to moment; and the work of the pile. Grains are
chaotic: how far grains alone differ from themselves with steps of another length is what no model can be nearer than. So
the differences are given, too, of the way before these two part by a twentieth of the largest resistance: what is left
there is the model's. Beside it stand tip and shaft by themselves, and how the ground about the pile differs at each
millimetre of its way: motion, solid fraction and pressure.

Writes FOLDER/domains.csv, FOLDER/fields.csv and FOLDER/plots/domains.png and prints the tables. Runs that are finished
are not run again. Further settings NAME=VALUE of the driver hold for all runs.
"""

import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common" / "plots"))
import run_data
import studies
from field_differences import COLUMNS, all_differences

BLOCKS = {"small": (0.016, 0.0125), "middle": (0.022, 0.0125), "large": (0.03, 0.0145)}  # width and depth [m]
ANOTHER_STEP = 5.5e-6  # beside 6e-6 of the parameter file [s]
PARTED = 0.05  # of the largest resistance
SMOOTHED_OVER = 0.1  # of the way
PICTURES = 6  # at each millimetre


def smoothed(history):
    """Mean of the resistance about each sample, over a tenth of the way."""
    way, force = history["way_m"], history["head_resistance_N"]
    width = SMOOTHED_OVER * way[-1]
    return np.array([force[np.abs(way - w) <= width / 2].mean() for w in way])


def differences(history, alone, until=np.inf):
    """Largest and mean difference of the resistance up to a way [m], as it is and smoothed, over the largest of grains
    alone up to there, and that of the pile's work [%]; none of a run that has ended early."""
    if history["way_m"][-1] < 0.999 * alone["way_m"][-1]:
        return None
    found, way = [], alone["way_m"]
    here = lambda values: np.interp(way, history["way_m"], values)[way <= until]  # of another step samples lie elsewhere
    for value in (lambda h: h["head_resistance_N"], smoothed):
        difference, scale = here(value(history)) - value(alone)[way <= until], np.abs(value(alone)[way <= until]).max()
        found += [100 * np.abs(difference).max() / scale, 100 * np.sqrt((difference**2).mean()) / scale]
    return found + [100 * (here(history["pile_work_J"])[-1] / alone["pile_work_J"][way <= until][-1] - 1)]


def parts(history, alone):
    """Mean of tip and shaft over the way beside those of grains alone, over the mean of the head's [%]."""
    head = alone["head_resistance_N"].mean()
    return [100 * (history[name].mean() - alone[name].mean()) / head for name in ("tip_resistance_N", "shaft_resistance_N")]


def parting(again, alone):
    """Way at which grains alone and the same with another step part [m]."""
    force = alone["head_resistance_N"]
    apart = np.abs(np.interp(alone["way_m"], again["way_m"], again["head_resistance_N"]) - force) > PARTED * force.max()
    return alone["way_m"][max(0, np.argmax(apart) - 1)] if apart.any() else np.inf


def run_check(program, folder, settings):
    """Runs the driver on its small ground; false where it fails."""
    return studies.run(program, folder, settings, [HERE / "pile_installation_check.prm"])


def measure(program, folder, seeds, common):
    """A row a run, with the differences from grains alone of the same seed."""
    rows = []
    for seed in seeds:
        kinds = {"grains alone": {"Model/kind": "grains"},
                 "grains another step": {"Model/kind": "grains", "Pile/time step": ANOTHER_STEP}}
        kinds |= {f"{name} block": {"Model/kind": "two-scale", "Model/block width": width, "Model/block depth": depth}
                  for name, (width, depth) in BLOCKS.items()}
        folders = {kind: folder / f"{kind}-{seed}".replace(" ", "-") for kind in kinds}
        are_done = {kind: run_check(program, folders[kind], {**common, **settings, "Sand/seed": seed})
                    for kind, settings in kinds.items()}
        for kind, is_done in are_done.items():
            summary = run_data.read_summary(folders[kind])
            if not (is_done and are_done["grains alone"] and are_done["grains another step"]):
                rows.append([kind, seed, *[""] * 18])
                continue
            history, alone, again = (run_data.read_history(folders[name])
                                     for name in (kind, "grains alone", "grains another step"))
            until = parting(again, alone)
            found = [value for some in (differences(history, alone), differences(history, alone, until))
                     for value in some or [np.nan] * 5]
            rows.append([kind, seed, summary["particles"], summary.get("elements", 0),
                         *(f"{value:.2f}" for value in found + parts(history, alone)), f"{1e3 * until:.2f}",
                         f"{summary['wall_time_s']:.1f}", f"{3600 * summary['core_hours']:.1f}",
                         f"{summary['energy_residual']:.2g}"])
    return rows


def write_table(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["ground", "seed", "grains", "elements", "largest_percent", "mean_percent",
                        "smoothed_largest_percent", "smoothed_mean_percent", "work_percent",
                        *(f"{name}_percent_before_parting" for name in ("largest", "mean", "smoothed_largest",
                                                                        "smoothed_mean", "work")),
                        "tip_percent", "shaft_percent", "parting_mm", "wall_time_s", "processor_time_s", "energy_residual"])
        table.writerows(rows)


def write_fields(rows, path):
    """@param rows of the runs, as measure() gives them"""
    folder_of = lambda kind, seed: path.parent / f"{kind}-{seed}".replace(" ", "-")
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["ground", "seed", *COLUMNS])
        for kind, seed, n_grains, *_ in rows:
            if kind != "grains alone" and n_grains:
                for row in all_differences(folder_of(kind, seed), folder_of("grains alone", seed)):
                    table.writerow([kind, seed, *(f"{value:.4g}" for value in row)])


def draw(folder, seed):
    figure, [panels] = run_data.new_panels(1, 2)
    for kind, colour in zip(["grains alone", "grains another step", *(f"{name} block" for name in BLOCKS)],
                            ["#000000", "#999999", *run_data.COLOURS]):
        run_folder = folder / f"{kind}-{seed}".replace(" ", "-")
        if not run_data.read_summary(run_folder):
            continue
        history = run_data.read_history(run_folder)
        for axes, values in zip(panels, (history["head_resistance_N"], smoothed(history))):
            axes.plot(values, 1e3 * history["way_m"], color=colour, label=kind)
    for axes, label in zip(panels, ("resistance of the head in N", "the same, smoothed over a tenth of the way, in N")):
        axes.set_xlabel(label)
        axes.set_ylabel("way of the pile in mm")
        axes.invert_yaxis()
        axes.set_xlim(left=0)
    panels[0].legend(fontsize=8)
    run_data.save_diagram(figure, str(folder), "domains.png")


def arguments_of(description):
    """Program, folder, seeds and settings for all runs, from the command line of a study of this driver."""
    parser = studies.argument_parser(description, "pile_installation")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="of the driver, for all runs")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    common = dict(text.split("=", 1) for text in getattr(arguments, "set"))
    return arguments.program.resolve(), arguments.folder.resolve(), range(1, arguments.seeds + 1), common


def main():
    program, folder, seeds, common = arguments_of(__doc__)
    rows = measure(program, folder, seeds, {"Output/pictures": PICTURES, **common})
    write_table(rows, folder / "domains.csv")
    write_fields(rows, folder / "fields.csv")
    for name in ("domains.csv", "fields.csv"):
        print((folder / name).read_text(), end="")
    draw(folder, seeds[0])


if __name__ == "__main__":
    main()
