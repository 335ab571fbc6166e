#!/usr/bin/python3
"""Plots runs of membrane_triaxial: stress ratio and solid fraction over the axial strain (after fig. 4.11 of the
dissertation), and where the work of the first one goes.

Reads history.csv in every RUN_FOLDER and writes plots/membrane_triaxial.png in the first one. With --cell the samples of
a run of rve_triaxial are drawn beside them, as thin lines.
"""

import argparse
import glob
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS

PEAK = 0.03, 2.5  # Wellmann, section 4.3.4: of the model, strain and ratio
FINAL_SOLID_FRACTION = {"dissertation's model": 0.60, "laboratory": 0.58}


def draw_test(axes, folder, colour, label):
    """Stress ratio and solid fraction of a run."""
    ratio, fraction = axes
    history = run_data.read_history(folder)
    strain = 100 * history["axial_strain"]
    ratio.plot(strain, history["stress_ratio"], color=colour, linewidth=1, label=label)
    fraction.plot(strain, history["solid_fraction"], color=colour)
    return history


def draw_cells(axes, folder, last_strain):
    """The strained stage of every sample of rve_triaxial."""
    ratio, fraction = axes
    for k, sample in enumerate(sorted(glob.glob(os.path.join(folder, "samples", "*")))):
        history = run_data.read_history(sample)
        strained = history["stage"] == history["stage"].max()
        strain = -100 * history["strain_z"]
        seen = strained & (strain <= last_strain)
        across = 0.5 * (history["stress_xx_Pa"] + history["stress_yy_Pa"])
        label = "periodic cell" if k == 0 else None
        ratio.plot(strain[seen], history["stress_zz_Pa"][seen] / across[seen], color="#777777", linewidth=0.8, label=label)
        fraction.plot(strain[seen], history["solid_fraction"][seen], color="#777777", linewidth=0.8)


def draw_energies(axes, history):
    start = {name: values - values[0] for name, values in history.items()}
    put_in = start["work_plates_J"] + start["work_rims_J"] + start["work_pressure_J"] + start["energy_gravity_work_J"]
    strain = 100 * history["axial_strain"]
    axes.plot(strain, put_in * 1e3, color=COLOURS[6], label="work of plates, pressure and weight")
    for column, label, colour in (("energy_friction_loss_J", "friction", COLOURS[1]),
                                  ("energy_viscous_loss_J", "damping", COLOURS[0]),
                                  ("energy_grains_elastic_J", "contacts", COLOURS[2]),
                                  ("energy_membrane_elastic_J", "membrane", COLOURS[3])):
        axes.plot(strain, start[column] * 1e3, color=colour, label=label)
    axes.plot(strain, start["energy_residual_J"] * 1e3, "k:", linewidth=0.9, label="missing")
    axes.set_ylabel("energy in mJ")
    axes.legend(fontsize=8, loc="upper left")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folders", metavar="RUN_FOLDER", nargs="+")
    parser.add_argument("--labels", nargs="+", help="of the runs, instead of their folders' names")
    parser.add_argument("--cell", metavar="FOLDER", help="of a run of rve_triaxial")
    arguments = parser.parse_args()
    folders = arguments.run_folders
    labels = arguments.labels or [run_data.folder_name(folder) for folder in folders]
    figure, panels = run_data.new_diagram(3)
    ratio, fraction, energies = panels[:, 0]
    figure.set_size_inches(8, 9.5)
    histories = [draw_test((ratio, fraction), *run) for run in zip(folders, COLOURS, labels)]
    last_strain = 100 * max(history["axial_strain"][-1] for history in histories)
    if arguments.cell:
        draw_cells((ratio, fraction), arguments.cell, last_strain)
    ratio.plot(100 * PEAK[0], PEAK[1], "kx", label="dissertation's peak")
    for (name, value), style in zip(FINAL_SOLID_FRACTION.items(), (":", "--")):
        fraction.axhline(value, color="k", linewidth=0.8, linestyle=style, label=f"{name}, final")
    ratio.set_ylabel("axial stress over lateral pressure")
    ratio.set_ylim(0.9, 3)
    fraction.set_ylabel("solid fraction")
    ratio.legend(fontsize=8, loc="upper right", ncols=2)
    fraction.legend(fontsize=8, loc="best")
    draw_energies(energies, histories[0])
    ratio.set_title(run_data.title_of(folders[0]), loc="left")
    energies.set_xlabel("axial strain in %")
    run_data.save_diagram(figure, folders[0], "membrane_triaxial.png")


if __name__ == "__main__":
    main()
