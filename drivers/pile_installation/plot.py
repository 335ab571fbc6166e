#!/usr/bin/python3
"""Draws the installation of a pile: resistance of head, tip and shaft over depth, beside that of grains alone where a
finished run of them lies next to it in a folder "grains"; and a section through grains and elements, coloured by how far
the ground has moved, by the height at which it was at first, and by its pressure.

Reads history.csv, summary.json and the last grains_*.vtu, surfaces_*.vtu and continuum_*.vtu and writes
RUN_FOLDER/plots/resistance.png and RUN_FOLDER/plots/section.png.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from picture import last_file, read_vtu
from run_data import COLOURS
from slices import cut_at, segments_of, slice_of


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
    pressure.plot(history["tip_pressure_Pa"] / 1e3, depth, color=COLOURS[0])
    pressure.set_xlabel("pressure on the tip in kPa")
    for name, label, colour in (("pile_work_J", "work of the pile", COLOURS[6]),
                                ("energy_friction_loss_J", "friction", COLOURS[1]),
                                ("energy_plastic_loss_J", "plastic flow of the elements", COLOURS[0])):
        if name in history:
            energy.plot(1e6 * history[name], depth, color=colour, label=label)
    energy.set_xlabel("energy in µJ")
    for axes in (force, pressure, energy):
        axes.set_ylim(depth.max(), min(0, depth.min()))
        axes.set_xlim(left=0)
        axes.set_ylabel("depth of the tip in mm")
    force.legend(fontsize=8)
    energy.legend(fontsize=8)
    force.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "resistance.png")


def front_of(path):
    """Faces of the elements that lie in front, moved along, x and z in mm; how far their corners have moved and the
    heights at which they were [mm], means over each face, and the pressure of each element [Pa]."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    grid = read_vtu(path)
    start = vtk_to_numpy(grid.GetPoints().GetData()) * 1e3
    moved = vtk_to_numpy(grid.GetPointData().GetArray("displacement")) * 1e3
    pressure = vtk_to_numpy(grid.GetPointData().GetArray("pressure"))
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
    front = np.abs(start[:, 1] - start[:, 1].min()) < 1e-6
    outlines, motion, height, pressures = [], [], [], []
    for cell in cells:
        corners = cell[front[cell]]
        if len(corners) != 4:
            continue
        around = start[corners][:, [0, 2]] - start[corners][:, [0, 2]].mean(axis=0)
        corners = corners[np.argsort(np.arctan2(around[:, 1], around[:, 0]))]
        outlines.append((start + moved)[corners][:, [0, 2]])
        motion.append(np.linalg.norm(moved[corners], axis=1).mean())
        height.append(start[corners, 2].mean())
        pressures.append(pressure[cell].mean())
    return outlines, np.array(motion), np.array(height), np.array(pressures)


def draw_section(folder):
    from matplotlib.collections import LineCollection, PolyCollection
    grains, surfaces, continuum = (last_file(folder, kind) for kind in ("grains", "surfaces", "continuum"))
    if not grains or not surfaces:
        return
    outlines, (moved, height, pressure) = slice_of(grains, ["displacement", "initial_height", "pressure"])
    pile = segments_of(cut_at(surfaces, 0))
    elements = front_of(continuum) if continuum else ([], [], [], [])
    figure, panels = run_data.new_panels(3, 1)
    figure.set_size_inches(9, 11)
    deciles = np.linspace(0, 1e3 * height.max(), 11)  # bands of the height at first show how the ground has moved
    band = lambda values: np.digitize(values, deciles) % 2 + 0.5 * np.digitize(values, deciles) / len(deciles)
    for axes, values, of_elements, colours, limits, label in (
            (panels[0][0], 1e3 * moved, elements[1], "viridis", (0, np.quantile(1e3 * moved, 0.98)), "moved by, in mm"),
            (panels[1][0], band(1e3 * height), band(elements[2]), "copper", (0, 1.5), "bands of the height at first"),
            (panels[2][0], pressure / 1e3, np.array(elements[3]) / 1e3, "YlOrRd",
             (0, np.quantile(pressure, 0.97) / 1e3), "pressure in kPa")):
        if len(elements[0]):
            axes.add_collection(PolyCollection(elements[0], array=of_elements, cmap=colours, clim=limits, linewidths=0.4,
                                               edgecolors="#666666"))
        cells = PolyCollection(outlines, array=values, cmap=colours, clim=limits, linewidths=0.2, edgecolors="#666666")
        axes.add_collection(cells)
        axes.add_collection(LineCollection(pile, colors="#222222", linewidths=1.5))
        figure.colorbar(cells, ax=axes, label=label, shrink=0.8)
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.set_ylim(top=max(outline[:, 1].max() for outline in outlines) + 1.5)
        axes.grid(False)
        axes.set_ylabel("z in mm")
    panels[2][0].set_xlabel("x in mm")
    panels[0][0].set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "section.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    draw_resistance(folder)
    draw_section(folder)


if __name__ == "__main__":
    main()
