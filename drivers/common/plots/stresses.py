#!/usr/bin/python3
"""Draws the principal stresses of a run over time, and those of several runs together.

Reads history.csv (columns time_s, stress_1_Pa, stress_2_Pa, stress_3_Pa, and stage where there is one; tension is
positive) and writes RUN_FOLDER/plots/stresses.png; with --compare also RUN_FOLDER/plots/comparison.png, where a colour
is a model and a line style a principal stress.
"""

import argparse

import run_data
from run_data import COLOURS

STRESSES = ["stress_1_Pa", "stress_2_Pa", "stress_3_Pa"]
NAMES = [r"$\sigma_1$", r"$\sigma_2$", r"$\sigma_3$"]
STYLES = ["-", "--", ":"]


def read_stresses(folder):
    columns = run_data.read_history(folder)
    missing = [name for name in ["time_s"] + STRESSES if name not in columns]
    if missing:
        run_data.fail(f"history.csv in {folder} has no column {missing[0]}")
    return columns


def label_axes(axes, unit, title):
    axes.set_xlabel(f"time in {unit}")
    axes.set_ylabel("principal stress in kPa (tension positive)")
    axes.set_title(title, loc="left")
    axes.margins(x=0)


def draw_one(folder, columns):
    figure, all_axes = run_data.new_diagram()
    axes = all_axes[0, 0]
    time, unit = run_data.time_axis(columns["time_s"])
    marker = "o" if len(time) == 1 else None
    for stress, name, colour, style in zip(STRESSES, NAMES, COLOURS, ["-", "--", "-"]):  # equal ones stay visible
        axes.plot(time, columns[stress] / 1e3, color=colour, linestyle=style, label=name, marker=marker)
    run_data.mark_stages(axes, time, columns)
    label_axes(axes, unit, run_data.title_of(folder))
    axes.legend()
    run_data.save_diagram(figure, folder, "stresses.png")


def distinct_labels(folders):
    """The models' names; with the folder's name where two runs have the same model."""
    models = [run_data.model_of(folder) for folder in folders]
    return [model if models.count(model) == 1 else f"{model} ({run_data.folder_name(folder)})"
            for model, folder in zip(models, folders)]


def draw_comparison(folders, runs):
    from matplotlib.lines import Line2D
    figure, all_axes = run_data.new_diagram()
    axes = all_axes[0, 0]
    longest = max((run["time_s"] for run in runs), key=lambda time: time[-1])
    unit = run_data.time_axis(longest)[1]
    handles = []
    for i, (label, run) in enumerate(zip(distinct_labels(folders), runs)):
        colour = COLOURS[i % len(COLOURS)]
        time = run["time_s"] * (1e3 if unit == "ms" else 1)
        for stress, style in zip(STRESSES, STYLES):
            axes.plot(time, run[stress] / 1e3, color=colour, linestyle=style)
        handles.append(Line2D([], [], color=colour, label=label))
    handles += [Line2D([], [], color="#555555", linestyle=style, label=name) for style, name in zip(STYLES, NAMES)]
    label_axes(axes, unit, "Comparison of models")
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    run_data.save_diagram(figure, folders[0], "comparison.png")


def draw(folder, others):
    """The stresses of a run, and beside those of others where there are any."""
    folders = [folder] + others
    runs = [read_stresses(f) for f in folders]
    draw_one(folder, runs[0])
    if others:
        draw_comparison(folders, runs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    parser.add_argument("--compare", nargs="+", default=[], metavar="FOLDER", help="runs to draw together with it")
    arguments = parser.parse_args()
    draw(arguments.run_folder, arguments.compare)


if __name__ == "__main__":
    main()
