#!/usr/bin/python3
"""Draws what `packing --curves CURVES --sizes SIZES` writes: trials for each placed grain and the share of the grains
still to be placed over the rounds of the random addition (Wellmann's fig. 3.18b), the solid fraction over the
iterations of the tightening (fig. 3.20), and the sizes of the grains as drawn and as packed (fig. 3.21)."""

import argparse
import csv
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "drivers", "common", "plots"))
from run_data import COLOURS, fail, new_panels


def read_rows(path):
    try:
        with open(path, newline="") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        fail(f"{path}: {error.strerror}; name a file that `packing` wrote")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("curves", metavar="CURVES")
    parser.add_argument("sizes", metavar="SIZES")
    parser.add_argument("picture", metavar="PICTURE.png")
    options = parser.parse_args()
    rows = read_rows(options.curves)
    sizes = read_rows(options.sizes)

    figure, panels = new_panels(1, 3)
    addition, tightening, distribution = panels[0]

    rounds = [row for row in rows if row["stage"] == "addition"]
    number = [int(row["iteration"]) for row in rounds]
    tried = [(n, float(row["trials_per_placed_grain"])) for n, row in zip(number, rounds)
             if row["trials_per_placed_grain"]]
    addition.loglog(*zip(*tried), ".", color=COLOURS[0], markersize=3, label="trials for each placed grain")
    remaining = [(n, 100 * float(row["remaining_share"])) for n, row in zip(number, rounds)
                 if float(row["remaining_share"]) > 0]
    addition.loglog(*zip(*remaining), color=COLOURS[1], label="grains still to be placed, %")
    addition.set_xlabel("round of the random addition")
    addition.legend()

    steps = [row for row in rows if row["stage"] == "tightening"]
    tightening.plot([int(row["iteration"]) for row in steps], [float(row["solid_fraction"]) for row in steps],
                    color=COLOURS[0])
    tightening.set_xlabel("iteration of the tightening")
    tightening.set_ylabel(r"solid fraction $\Phi$")

    radius = [1e3 * float(row["radius_m"]) for row in sizes]
    for name, style, colour, label in (("density_drawn_per_m", "-", COLOURS[0], "as drawn"),
                                       ("density_packed_per_m", "--", COLOURS[1], "as packed")):
        distribution.plot(radius, [1e-3 * float(row[name]) for row in sizes], style, color=colour, label=label)
    distribution.set_xlabel("radius of the sphere of equal volume in mm")
    distribution.set_ylabel("density in 1/mm")
    distribution.set_xlim(min(r for r, row in zip(radius, sizes) if float(row["density_drawn_per_m"]) > 0))
    distribution.legend()
    figure.savefig(options.picture, dpi=110)


if __name__ == "__main__":
    main()
