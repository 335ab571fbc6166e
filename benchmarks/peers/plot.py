#!/usr/bin/python3
"""Draws what `peers --output FOLDER` writes: the answers of all programs over one another, one panel a case, and how many
million beads each program steps in a second, a dot for each turn and a line at their median."""

import argparse
import csv
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "drivers", "common", "plots"))
from run_data import COLOURS, fail, new_panels, read_table

CASES = {"silo": "beads above the orifice", "drum": "mixing, Lacey's index",
         "penetration": "depth of the ball's lowest point in mm"}
COLOUR = {"Bergamo": COLOURS[0], "LIGGGHTS": COLOURS[1], "YADE": COLOURS[2]}
STYLE = {"Bergamo": "-", "LIGGGHTS": "--", "YADE": ":"}


def program_of(column):
    return column.split(",")[0]


def draw_answers(panel, folder, case):
    table = read_table(folder, f"{case}.csv")
    time = table.pop("time_s")
    for column, values in table.items():
        program = program_of(column)
        twin = column != program
        panel.plot(time, values, STYLE[program], color=COLOURS[4] if twin else COLOUR[program],
                   linewidth=0.8 if twin else 1.4, label=column, zorder=1 if twin else 2)
    panel.set_title(case)
    panel.set_xlabel("time in s")
    panel.set_ylabel(CASES[case])


def draw_times(panel, folder, cases):
    for x, case in enumerate(cases):
        with open(os.path.join(folder, f"{case}_times.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        for k, program in enumerate(COLOUR):
            rates = [1e-6 * float(row["bead_steps"]) / float(row["seconds"]) for row in rows if row["program"] == program]
            if rates:
                at = x + 0.22 * (k - 1)
                panel.semilogy([at] * len(rates), rates, ".", color=COLOUR[program], markersize=4,
                               label=program if x == 0 else None)
                panel.semilogy([at - 0.09, at + 0.09], [np.median(rates)] * 2, color=COLOUR[program])
    panel.set_xticks(range(len(cases)), cases)
    panel.set_title("speed")
    panel.set_ylabel("million bead-steps/s on one core")
    panel.set_yticks([0.1, 0.2, 0.5, 1, 2, 5, 10], minor=False)
    panel.yaxis.set_major_formatter("{x:g}")
    panel.yaxis.set_minor_formatter("")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("picture", metavar="PICTURE.png")
    options = parser.parse_args()
    answered = [case for case in CASES if os.path.exists(os.path.join(options.folder, f"{case}.csv"))]
    timed = [case for case in CASES if os.path.exists(os.path.join(options.folder, f"{case}_times.csv"))]
    if not answered and not timed:
        fail(f"{options.folder} holds no case; name the folder of `peers --output`")
    figure, panels = new_panels(2, 2)
    places = iter(panels.flat)
    for case in answered:
        draw_answers(next(places), options.folder, case)
    if timed:
        draw_times(next(places), options.folder, timed)
    panels[0][0].legend()  # colours are those of all panels
    for unused in places:
        unused.set_visible(False)
    figure.savefig(options.picture, dpi=90)


if __name__ == "__main__":
    main()
