#!/usr/bin/python3
"""Draws silos that ran out: mass and mass flow over time, beads behind the front coloured by the height they began at
(Wellmann's fig. 3.22), the mean downward velocity and its profiles (fig. 3.23); over several orifices Beverloo's law.

Reads discharges.csv and summary.json where there are any, and of each discharge history.csv, mass_flow.csv,
profiles.csv, mean_velocity.vtu and grains_*.vtu. Writes discharge.png, velocity.png and grains.png into the folder plots
beside each history.csv, and RUN_FOLDER/plots/beverloo.png.
"""

import argparse
import glob
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS, bergamo

CHOI, DISSERTATION = 141.1, 132.6  # g/s, section 3.5
SLOT = 1.5  # power of the effective width in Beverloo's law
USUAL = 1.03, 1.4  # its constants for slots and spheres


def rows_of(folder, name):
    """The columns of a file of a discharge; nothing where it has not been written yet."""
    return run_data.read_table(folder, name) if os.path.exists(os.path.join(folder, name)) else None


def draw_discharge(folder, has_choi_orifice):
    history, windows = run_data.read_history(folder), rows_of(folder, "mass_flow.csv")
    figure, [[left, right]] = run_data.new_panels(1, 2)
    time = history["time_s"]
    left.plot(time, history["discharged_mass_kg"] * 1e3, color=COLOURS[0])
    left.set_ylabel("discharged mass in g")
    right.plot(time, history["mass_flow_kg_s"] * 1e3, color="#BBBBBB", linewidth=0.8, label="between samples")
    if windows is not None:
        edges = np.append(windows["begin_s"], windows["end_s"][-1])
        right.stairs(windows["mass_flow_kg_s"] * 1e3, edges, baseline=None, color=COLOURS[0], linewidth=2,
                     label="steady flow, windows", zorder=3)
    if has_choi_orifice:
        right.axhline(CHOI, color=COLOURS[1], linestyle="--", label="measured by Choi et al.")
        right.axhline(DISSERTATION, color=COLOURS[2], linestyle="-.", label="dissertation")
    right.set_ylabel("mass flow in g/s")
    right.legend(fontsize=8)
    for axes in (left, right):
        axes.set_xlabel("time in s")
        axes.set_ylim(bottom=0)
        axes.margins(x=0)
    left.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "discharge.png")


def middle_of_field(path):
    """Places x, z and velocities of the nodes behind the front and before the back, the mean of both, and where there
    are grains."""
    field = bergamo.read_vtu(path)
    places, velocity, solid = field.points, field["velocity"], field["solid_fraction"]
    x, y, z = (np.unique(places[:, d]) for d in range(3))
    shape = len(z), len(y), len(x)
    return x, z, velocity.reshape(*shape, 3).mean(axis=1), solid.reshape(shape).mean(axis=1)


def draw_velocity(folder):
    profiles, path = rows_of(folder, "profiles.csv"), os.path.join(folder, "mean_velocity.vtu")
    if profiles is None or not os.path.exists(path):
        return
    figure, [[left, right]] = run_data.new_panels(1, 2)
    x, z, velocity, solid = middle_of_field(path)
    down = np.ma.masked_where(solid < 0.05, -velocity[:, :, 2])
    levels = max(down.max(), 1e-6) * np.array([0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1])
    from matplotlib.colors import BoundaryNorm
    filled = left.contourf(x * 1e2, z * 1e2, down * 1e2, levels * 1e2, cmap="viridis", extend="min",
                           norm=BoundaryNorm(levels * 1e2, 256))
    figure.colorbar(filled, ax=left, label="downward velocity in cm/s", format="%.2g", ticks=levels * 1e2)
    left.set_aspect("equal")
    left.grid(False)
    left.set_xlabel("x in cm")
    left.set_ylabel("z in cm")
    left.set_title(run_data.title_of(folder), loc="left")
    for height, colour in zip(np.unique(profiles["height_m"]), COLOURS):
        rows = profiles["height_m"] == height
        left.axhline(height * 1e2, color=colour, linestyle="--", linewidth=1)
        right.plot(profiles["x_m"][rows] * 1e2, -profiles["velocity_z_m_s"][rows] * 1e2, "o-", markersize=3,
                   color=colour, label=f"z = {height * 1e3:.1f} mm")
    right.axhline(0, color="#999999", linewidth=0.8)
    right.set_xlabel("x in cm")
    right.set_ylabel("downward velocity in cm/s")
    right.legend(fontsize=8)
    run_data.save_diagram(figure, folder, "velocity.png")


def front_beads(beads, depth):
    """Places x, z, diameters and starting heights of the first layer of beads behind the front, in cm."""
    places, diameter, height = beads.position, beads.diameter, beads["start_height"]
    front = np.flatnonzero(places[:, 1] < -0.5 * depth + diameter.max())
    front = front[np.argsort(-places[front, 1])]  # the nearest are drawn last
    return places[front][:, [0, 2]] * 1e2, diameter[front] * 1e2, height[front] * 1e2


def draw_grains(folder, depth):
    from matplotlib.collections import EllipseCollection
    series = run_data.pictures_of(folder, "grains")
    if not series:
        return
    shown = [series[k] for k in np.unique(np.linspace(0, len(series) - 1, 4).round().astype(int))]
    run_data.new_diagram_look()
    from matplotlib import pyplot
    beads = [front_beads(grains, depth) for grains in shown]
    limits = np.array([beads[0][0].min(axis=0), beads[0][0].max(axis=0)]) + beads[0][1].max() * np.array([[-1], [1]])
    wide, high = limits[1] - limits[0]
    figure, panels = pyplot.subplots(1, len(shown), squeeze=False, sharey=True, layout="constrained",
                                     figsize=(1 + len(shown) * min(3.5, max(1.5, 6 * wide / high)), 6))
    for axes, (places, diameter, height) in zip(panels[0], beads):
        axes.add_collection(EllipseCollection(diameter, diameter, np.zeros(len(diameter)), units="xy", offsets=places,
                                              transOffset=axes.transData, array=height, cmap="turbo",
                                              clim=(0, beads[0][2].max()), linewidths=0))
        axes.set_xlim(*limits[:, 0])
        axes.set_ylim(limits[0, 1] - 2, limits[1, 1])
        axes.set_aspect("equal")
        axes.grid(False)
        axes.set_xlabel("x in cm")
    panels[0, 0].set_ylabel("z in cm")
    panels[0, 0].set_title("beads at the front by their first height", loc="left", fontsize=9)
    run_data.save_diagram(figure, folder, "grains.png")


def draw_beverloo(folder, discharges, summary):
    figure, [[flows, straight]] = run_data.new_panels(1, 2)
    width, flow = discharges["orifice_width_m"] * 1e3, discharges["mass_flow_kg_s"] * 1e3
    deviation = discharges["mass_flow_deviation_kg_s"] * 1e3
    parameters = run_data.read_parameters(folder)
    diameter = 0.5e3 * sum(float(parameters[f"Grains/Uniform/{which} diameter"]) for which in ("smallest", "largest"))
    unit = (summary["bulk_density_kg_m3"] * float(parameters["Silo/gravity"])**0.5
            * float(parameters["Silo/depth"]) * 1e3 * 1e-3**SLOT)  # g/s and mm
    fine = np.linspace(0, 1.1 * width.max(), 200)
    laws = [(*USUAL, "C = {:.3g}, k = {:.3g}, as usual", "--")]
    if "beverloo_c" in summary:
        laws.append((summary["beverloo_c"], summary["beverloo_k"], "C = {:.3g}, k = {:.3g}, fitted", "-"))
    for (c, k, label, line), colour in zip(laws, COLOURS[1:]):
        law = c * unit * np.maximum(0, fine - k * diameter)**SLOT
        flows.plot(fine, law, line, color=colour, label=label.format(c, k))
        straight.plot(fine, law**(1 / SLOT), line, color=colour)
    flows.errorbar(width, flow, deviation, fmt="o", color=COLOURS[0], capsize=3, label="discharges")
    straight.plot(width, np.maximum(flow, 0)**(1 / SLOT), "o", color=COLOURS[0])
    if summary.get("choi_mass_flow_kg_s"):
        flows.plot([16], [CHOI], "^", color="k", label="measured by Choi et al.")
        flows.plot([16], [DISSERTATION], "v", color="k", fillstyle="none", label="dissertation")
    flows.set_ylabel("mass flow in g/s")
    straight.set_ylabel("(mass flow in g/s)$^{2/3}$")
    for axes in (flows, straight):
        axes.set_xlabel("width of the slot in mm")
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
    flows.legend(fontsize=8)
    flows.set_title(run_data.title_of(folder), loc="left")
    run_data.save_diagram(figure, folder, "beverloo.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    parameters = run_data.read_parameters(folder)
    widths = [float(width) for width in parameters.get("Silo/orifice widths", "").split(",") if width.strip()]
    depth = float(parameters["Silo/depth"])
    summary, discharges = run_data.read_summary(folder), rows_of(folder, "discharges.csv")
    several = sorted(glob.glob(os.path.join(glob.escape(folder), "discharges", "*mm")))
    for one in several or [folder]:
        width = float(os.path.basename(one)[:-2]) * 1e-3 if several else widths[0]
        draw_discharge(one, abs(width - 0.016) < 1e-9 and abs(depth - 0.025) < 1e-9)
        draw_velocity(one)
        draw_grains(one, depth)
    if several and discharges is not None and "bulk_density_kg_m3" in summary:
        draw_beverloo(folder, discharges, summary)


if __name__ == "__main__":
    main()
