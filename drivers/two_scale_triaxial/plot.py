#!/usr/bin/python3
"""Draws the principal stresses of a run over time, and beside them those of the other models where their runs lie next
to it: finished runs in folders named two-scale, two_scale_triaxial, grains or continuum. Draws how the stresses of both
models add up over the height of the cube at the end.

Reads history.csv and stress_profile.csv and writes RUN_FOLDER/plots/stresses.png, comparison.png and stress_profile.png;
see drivers/common/plots/stresses.py.
"""

import argparse
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
import stresses


def runs_beside(folder):
    beside = [Path(os.path.abspath(folder)).parent / kind for kind in ("two-scale", "two_scale_triaxial", "grains", "continuum")]
    return [str(other) for other in beside if (other / "summary.json").exists() and not os.path.samefile(other, folder)]


def draw_profile(folder):
    if not (Path(folder) / "stress_profile.csv").exists():
        return
    profile = run_data.read_table(folder, "stress_profile.csv")
    figure, [panels] = run_data.new_panels(1, 3)
    heights = [height * 1e3 for height in (*profile["low_m"], profile["high_m"][-1])]
    for number, axes in zip("123", panels):
        grains, continuum = (profile[f"{model}_stress_{number}_Pa"] / 1e3 for model in ("grains", "continuum"))
        for values, label, colour in ((grains, "grains", run_data.COLOURS[1]), (continuum, "continuum", run_data.COLOURS[0]),
                                      (grains + continuum, "both", run_data.COLOURS[6])):
            axes.stairs(values, heights, orientation="horizontal", baseline=None, color=colour, label=label)
        axes.set_xlabel(rf"$\sigma_{number}$ with the weights in kPa")
        axes.margins(y=0)
    panels[0].set_ylabel("height in mm")
    panels[0].legend()
    panels[0].set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "stress_profile.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    stresses.draw(folder, runs_beside(folder))
    draw_profile(folder)


if __name__ == "__main__":
    main()
