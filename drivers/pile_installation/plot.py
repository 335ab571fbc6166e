#!/usr/bin/python3
"""Draws the installation of a pile, from history.csv, summary.json and the numbered files of the run:

resistance.png   of head, tip and shaft over depth, beside that of grains alone where a finished run of them lies next to
                 it in a folder "grains"; pressure on the tip over time; energies
section.png      grains and elements at the end, coloured by how far they have moved, by the height at which they were at
                 first, and by their pressure
fields.png       solid fraction and pressure at the start and at the end; how far the ground beside the shaft has gone up
                 or down
chains.png       contacts at the end as lines whose width goes with the normal force
film/            with --film: a frame of each picture of the run

They go to RUN_FOLDER/plots.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import film
import panels
import run_data
from ground import Ground, numbers_of
from heave import draw_heave
from run_data import COLOURS


def draw_resistance(folder):
    history = run_data.read_history(folder)
    figure, [[force, pressure, energy]] = run_data.new_panels(1, 3)
    depth = history["depth_m"] * 1e3
    for name, colour in (("head", COLOURS[6]), ("tip", COLOURS[0]), ("shaft", COLOURS[1])):
        force.plot(history[f"{name}_resistance_N"], depth, color=colour, label=name)
    beside = Path(os.path.abspath(folder)).parent / "grains"
    if (beside / "summary.json").exists() and not os.path.samefile(beside, folder):
        alone = run_data.read_history(beside)
        force.plot(alone["head_resistance_N"], alone["depth_m"] * 1e3, color="#999999", label="head, grains alone")
    force.set_xlabel("resistance in N")
    for name, label, colour in (("pile_work_J", "work of the pile", COLOURS[6]),
                                ("energy_friction_loss_J", "friction", COLOURS[1]),
                                ("energy_plastic_loss_J", "plastic flow of the elements", COLOURS[0])):
        if name in history:
            energy.plot(1e6 * history[name], depth, color=colour, label=label)
    energy.set_xlabel("energy in µJ")
    for axes in (force, energy):
        axes.set_ylim(depth.max(), min(0, depth.min()))
        axes.set_xlim(left=0)
        axes.set_ylabel("depth of the tip in mm")
        axes.legend(fontsize=8)
    time, unit = run_data.time_axis(history["time_s"])
    pressure.plot(time, history["tip_pressure_Pa"] / 1e3, color=COLOURS[0])
    pressure.set_xlabel(f"time in {unit}")
    pressure.set_ylabel("pressure on the tip in kPa")
    below = pressure.twinx()
    below.plot(time, history["solid_fraction_below_tip"], color=COLOURS[1])
    below.set_ylabel("solid fraction below the tip", color=COLOURS[1])
    below.grid(False)
    force.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "resistance.png")


def draw_section(folder, ground, first):
    figure, rows = run_data.new_panels(3, 1)
    figure.set_size_inches(9, 11)
    elements = ground.elements
    moved, pressure = [
        panels.draw_both(axes, ground, values, colours, (0, np.quantile(values[0], most)))
        for axes, values, colours, most in
        ((rows[0][0], (ground.moved, elements and elements.moved), "viridis", 0.98),
         (rows[2][0], (ground.pressure / 1e3, elements and elements.pressure / 1e3), panels.PRESSURES, 0.97))]
    panels.draw_bands(rows[1][0], ground, panels.bands_of(first))
    for [axes] in rows:
        panels.frame(axes, ground, ground.surface() + 1.5)
    panels.colour_bar(rows[0][0], moved, "moved by, in mm")
    panels.colour_bar(rows[2][0], pressure, "pressure in kPa")
    panels.no_bar(rows[1][0])
    rows[1][0].set_title("bands of the height at first", loc="left", fontsize=10)
    rows[2][0].set_xlabel("x in mm")
    rows[0][0].set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "section.png")


def draw_fields(folder, first, last):
    figure, rows = run_data.new_panels(3, 2)
    figure.set_size_inches(13, 9)
    top = last.surface() + 1.5
    greatest = np.nanmax(last.stress()[2]) / 1e3
    for column, (ground, when) in enumerate(((first, "at the start"), (last, "at the end"))):
        fraction = panels.draw_field(rows[0][column], ground.solid_fraction(), "viridis", panels.FRACTIONS)
        pressure = panels.draw_field(rows[1][column], panels.scaled(ground.stress(), 1e-3), panels.PRESSURES, (0, greatest))
        for axes, shown, name in ((rows[0][column], fraction, "solid fraction"),
                                  (rows[1][column], pressure, "pressure in kPa")):
            panels.draw_outlines(axes, ground, grains=False)
            panels.frame(axes, ground, top)
            axes.set_title(f"{name} {when}", loc="left", fontsize=10)
            panels.colour_bar(axes, shown, name)
            axes.set_xlabel("x in mm")
    draw_heave(rows[2], last, first)
    run_data.save_diagram(figure, folder, "fields.png")


def draw_chains(folder, ground):
    figure, [[axes]] = run_data.new_panels(1, 1)
    figure.set_size_inches(9, 4.6)
    greatest = ground.chains()[1].max()
    panels.draw_chains(axes, ground, greatest)
    panels.frame(axes, ground, ground.surface() + 1.5)
    axes.set_xlabel("x in mm")
    axes.set_title(f"{run_data.title_of(folder)}: contacts, the widest line is {1e3 * greatest:.3g} mN", loc="left",
                   fontsize=10)
    run_data.save_diagram(figure, folder, "chains.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    parser.add_argument("--film", action="store_true", help="draw the frames of a film, too")
    arguments = parser.parse_args()
    folder = arguments.run_folder
    draw_resistance(folder)
    pictures = numbers_of(folder)
    if not pictures:
        return
    first, last = Ground(folder, pictures[0]), Ground(folder, pictures[-1])
    draw_section(folder, last, first)
    draw_fields(folder, first, last)
    draw_chains(folder, last)
    if arguments.film:
        film.draw(folder)


if __name__ == "__main__":
    main()
