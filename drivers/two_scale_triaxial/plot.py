#!/usr/bin/python3
"""Draws the principal stresses of a run over time, and beside them those of the other models where their runs lie next
to it: finished runs in folders named two-scale, two_scale_triaxial, grains or continuum.

Reads history.csv and writes RUN_FOLDER/plots/stresses.png and comparison.png; see drivers/common/plots/stresses.py.
"""

import argparse
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import stresses


def runs_beside(folder):
    beside = [Path(os.path.abspath(folder)).parent / kind for kind in ("two-scale", "two_scale_triaxial", "grains", "continuum")]
    return [str(other) for other in beside if (other / "summary.json").exists() and not os.path.samefile(other, folder)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    stresses.draw(folder, runs_beside(folder))


if __name__ == "__main__":
    main()
