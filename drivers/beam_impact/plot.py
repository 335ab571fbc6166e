#!/usr/bin/python3
"""Plots a run of beam_impact: displacements of sphere and beam, and the contact force, beside both closed forms (after
fig. 4.7b of the dissertation).

Reads RUN_FOLDER/history.csv and writes RUN_FOLDER/plots/beam_impact.png.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS

THEORIES = (("slender", "k--", "slender beam (Timoshenko 1913)"), ("thick", "k:", "beam that shears"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    history = run_data.read_history(folder)
    time, unit = run_data.time_axis(history["time_s"])
    figure, panels = run_data.new_diagram(2, [3, 2])
    displacements, forces = panels[:, 0]
    for name, colour in (("sphere", COLOURS[1]), ("beam", COLOURS[0])):
        displacements.plot(time, history[f"{name}_displacement_m"] * 1e6, color=colour, label=name)
    forces.plot(time, history["contact_force_N"], color=COLOURS[2], label="contact force")
    for theory, line, label in THEORIES:
        for name in ("sphere", "beam"):
            displacements.plot(time, history[f"{theory}_{name}_displacement_m"] * 1e6, line, linewidth=0.9,
                               label=label if name == "sphere" else None)
        forces.plot(time, history[f"{theory}_contact_force_N"], line, linewidth=0.9)
    displacements.set_ylabel("displacement in µm")
    displacements.set_title(run_data.title_of(folder), loc="left")
    displacements.legend(fontsize=9)
    forces.set_ylabel("contact force in N")
    forces.set_xlabel(f"time in {unit}")
    run_data.save_diagram(figure, folder, "beam_impact.png")


if __name__ == "__main__":
    main()
