#!/usr/bin/python3
"""Plots a run of rubber_block: forces on the block and its friction coefficient, pressure below it over place and time,
and where the work goes (after fig. 4.9 of the dissertation).

Reads history.csv and pressure.csv in RUN_FOLDER and writes RUN_FOLDER/plots/rubber_block.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS


def draw_forces(axes, time, history):
    axes.plot(time, history["contact_force_z_N"], color=COLOURS[0], label="ground on block, upright")
    axes.plot(time, -history["contact_force_x_N"], color=COLOURS[1], label="ground on block, against the pull")
    axes.plot(time, history["pulling_force_N"], color=COLOURS[2], linewidth=0.8, label="pulling force")
    axes.set_ylabel("force in N")
    axes.legend(fontsize=8, loc="upper left")


def draw_pressure(axes, time, strips, top):
    """A picture of pressure over place and time, in the top pressure."""
    values = np.array([strips[name] for name in strips if name.startswith("strip_")]) / top
    edges = np.append(time, time[-1])
    mesh = axes.pcolormesh(edges, np.linspace(0, 1, len(values) + 1), values, cmap="viridis", vmin=0,
                           vmax=max(1, np.quantile(values, 0.995)), rasterized=True)
    axes.figure.colorbar(mesh, ax=axes, label="pressure over top pressure", pad=0.01)
    axes.grid(False)
    axes.set_ylabel("rear to front of the block")


def draw_energies(axes, time, history):
    put_in = history["work_pull_J"] + history["work_pressure_J"]
    axes.plot(time, put_in * 1e3, color=COLOURS[6], label="work of pull and pressure")
    for column, label, colour in (("energy_friction_loss_J", "friction", COLOURS[1]),
                                  ("energy_grains_kinetic_J", "motion of grains", COLOURS[0]),
                                  ("energy_block_kinetic_J", "motion of block", COLOURS[4]),
                                  ("energy_block_elastic_J", "strain of block", COLOURS[2])):
        axes.plot(time, history[column] * 1e3, color=colour, label=label)
    axes.plot(time, history["energy_residual_J"] * 1e3, "k:", linewidth=0.9, label="missing")
    axes.set_ylabel("energy in mJ")
    axes.legend(fontsize=8, loc="upper left")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    history = run_data.read_history(folder)
    strips = run_data.read_table(folder, "pressure.csv")
    time, unit = run_data.time_axis(history["time_s"])
    figure, panels = run_data.new_diagram(3)
    forces, pressure, energies = panels[:, 0]
    figure.set_size_inches(8, 8.5)
    draw_forces(forces, time, history)
    draw_pressure(pressure, time[:len(strips["time_s"])], strips, max(history["top_pressure_Pa"]))
    draw_energies(energies, time, history)
    forces.set_title(run_data.title_of(folder), loc="left")
    energies.set_xlabel(f"time in {unit}")
    run_data.save_diagram(figure, folder, "rubber_block.png")


if __name__ == "__main__":
    main()
