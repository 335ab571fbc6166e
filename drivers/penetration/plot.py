#!/usr/bin/python3
"""Draws a penetration: resistance of tip and shaft over depth with the state of the sand, and the force chains under the
tip in a section through it, on grains coloured by their mean pressure and by how far they have sunk.

Reads history.csv, summary.json and the last grains_*.vtu, contacts_*.vtu and surfaces_*.vtu and writes
RUN_FOLDER/plots/penetration.png and RUN_FOLDER/plots/force_chains.png.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from picture import last_file
from run_data import COLOURS
from slices import chains_near, cut_at, segments_of, slice_of


def draw_resistance(folder):
    history, summary = run_data.read_history(folder), run_data.read_summary(folder)
    figure, [[force, pressure, sand]] = run_data.new_panels(1, 3)
    depth = history["depth_m"] * 1e3
    for name, colour in (("resistance", COLOURS[6]), ("tip_resistance", COLOURS[0]), ("shaft_resistance", COLOURS[1])):
        force.plot(history[f"{name}_N"], depth, color=colour, label={"resistance": "total"}.get(name, name.split("_")[0]))
    force.plot(np.hypot(history["lateral_force_x_N"], history["lateral_force_y_N"]), depth, color="#999999",
               linewidth=0.8, label="sideways")
    force.set_xlabel("force in N")
    pressure.plot(history["tip_pressure_Pa"] / 1e3, depth, color=COLOURS[0], label="tip")
    if "bearing_factor" in summary:
        line = summary["bearing_factor"] * summary["bulk_weight_N_m3"] * np.array([0, depth.max() * 1e-3])
        pressure.plot(line / 1e3, [0, depth.max()], color="#999999", linestyle="--",
                      label=f"{summary['bearing_factor']:.0f} times the weight above")
    pressure.set_xlabel("pressure on the tip in kPa")
    mean, deviation = history["coordination_number"], history["coordination_number_deviation"]
    sand.fill_betweenx(depth, mean - deviation, mean + deviation, color=COLOURS[4], alpha=0.25, linewidth=0,
                       label="deviation from grain to grain")
    sand.plot(mean, depth, color=COLOURS[0], label="contacts a grain")
    sand.plot(history["coordination_number_without_rattlers"], depth, color=COLOURS[2], label="without rattlers")
    sand.plot(10 * history["solid_fraction_below_tip"], depth, color=COLOURS[1], label="10 × solid fraction below the tip")
    sand.set_xlabel("coordination number")
    for axes in (force, pressure, sand):
        axes.set_ylim(depth.max(), min(0, depth.min()))
        axes.set_xlim(left=0)
        axes.set_ylabel("depth of the tip in mm")
        axes.legend(fontsize=8)
    force.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "penetration.png")


def draw_chains(folder):
    from matplotlib.collections import LineCollection, PolyCollection
    grains, contacts, surfaces = (last_file(folder, kind) for kind in ("grains", "contacts", "surfaces"))
    if not grains or not contacts or not surfaces:
        return
    outlines, [pressure, sinking] = slice_of(grains, ["pressure", "sinking"])
    size = np.median([np.ptp(outline, axis=0).max() for outline in outlines])
    branches, force = chains_near(run_data.pictures_of(folder, "contacts")[-1], 3 * size)
    intruder = segments_of(cut_at(surfaces, 0))
    figure, [panels] = run_data.new_panels(1, 2)
    figure.set_size_inches(14, 4.2)
    limit = np.quantile(np.abs(sinking), 0.98) * 1e3
    for axes, values, colours, limits, label in (
            (panels[0], pressure / 1e3, "YlOrRd", (0, np.quantile(pressure, 0.99) / 1e3), "pressure in the grains in kPa"),
            (panels[1], sinking * 1e3, "RdBu_r", (-limit, limit), "sunk by, in mm")):
        cells = PolyCollection(outlines, array=values, cmap=colours, clim=limits, linewidths=0.2, edgecolors="#999999")
        axes.add_collection(cells)
        axes.add_collection(LineCollection(intruder, colors="#333333", linewidths=1.5))
        figure.colorbar(cells, ax=axes, label=label, shrink=0.8)
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.set_ylim(top=max(outline[:, 1].max() for outline in outlines) + 2 * size)
        axes.grid(False)
        axes.set_xlabel("x in mm")
    strong = force > 0.02 * force.max()
    panels[0].add_collection(LineCollection(branches[strong], colors="#222222", capstyle="round",
                                            linewidths=4 * force[strong] / force.max()))
    panels[0].set_ylabel("z in mm")
    panels[0].set_title("force chains: width by the normal force", loc="left", fontsize=10)
    run_data.save_diagram(figure, folder, "force_chains.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    draw_resistance(folder)
    draw_chains(folder)


if __name__ == "__main__":
    main()
