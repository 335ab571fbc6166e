#!/usr/bin/python3
"""Draws how a Mohr-Coulomb continuum was fitted to an ensemble of triaxial tests, and the fitted continuum beside it.

Reads fit_mohr_coulomb.json, curves_grains.csv and curves_continuum.csv. Writes RUN_FOLDER/plots/fit_mohr_coulomb.png
(Wellmann's fig. 5.7: the elastic line of each pressure, the line of Poisson's ratio, Mohr's circles at the peak with
their tangent, the dilation line) and RUN_FOLDER/plots/fitted_continuum.png (grains and continuum on the same path).
"""

import argparse
import json
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from plot_ensemble import by_pressure, colour_of

LINE = {"color": "#000000", "linestyle": "--", "linewidth": 1.2, "zorder": 10}


def read_fit(folder):
    path = os.path.join(folder, "fit_mohr_coulomb.json")
    try:
        with open(path) as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        run_data.fail(f"{path}: {error}; name the folder of a fit")


def draw_elastic(axes, fit, groups):
    """Axial stress over the first strains, and the line of the fitted modulus from each isotropic state."""
    young = fit["young_modulus_Pa"]["mean"]
    reach = max(4 * fit["windows"]["elastic_axial_strain"],
                1.2 * (fit["peak_stress_ratio"]["mean"] - 1) * np.median([p for p, _ in groups]) / young)
    for i, (pressure, rows) in enumerate(groups):
        compression = -rows["axial_strain"]
        near = compression <= reach
        axes.plot(100 * compression[near], -rows["axial_stress_Pa"][near] / 1e3, color=colour_of(i))
        end = min(reach, (fit["peak_stress_ratio"]["mean"] - 1) * pressure / young)  # where it yields
        axes.plot([0, 100 * end], [pressure / 1e3, (pressure + young * end) / 1e3], **LINE,
                  label=f"E = {young / 1e6:.1f} MPa" if i == len(groups) - 1 else None)
    axes.axvspan(0, 100 * fit["windows"]["elastic_axial_strain"], color="#EEEEEE", zorder=0)
    axes.set_ylabel(r"axial stress $-\sigma_3$ in kPa")
    axes.set_title("a) Young's modulus", loc="left")
    axes.set_ylim(top=axes.get_ylim()[1] + 0.12 * np.diff(axes.get_ylim())[0])  # room for the legend
    axes.legend(loc="upper left")
    return reach


def draw_poisson(axes, fit, groups, reach):
    for i, (_, rows) in enumerate(groups):
        compression = -rows["axial_strain"]
        near = compression <= reach
        axes.plot(100 * compression[near], 100 * rows["volumetric_strain"][near], color=colour_of(i))
    poisson = fit["poisson_ratio"]["mean"]
    end = 0.5 * reach
    axes.plot([0, 100 * end], [0, -100 * (1 - 2 * poisson) * end], **LINE, label=f"ν = {poisson:.3f}")
    axes.axvspan(0, 100 * fit["windows"]["elastic_axial_strain"], color="#EEEEEE", zorder=0)
    axes.set_ylabel(r"volumetric strain $\epsilon_V$ in %")
    axes.set_title("b) Poisson's ratio", loc="left")
    axes.legend()


def draw_circles(axes, fit):
    angle, furthest = np.linspace(0, np.pi, 181), 0
    for i, group in enumerate(fit["pressures"]):
        axial, lateral = group["peak_axial_pressure_Pa"]["mean"], group["peak_lateral_pressure_Pa"]["mean"]
        centre, radius = 0.5 * (axial + lateral), 0.5 * (axial - lateral)
        axes.plot((centre + radius * np.cos(angle)) / 1e3, radius * np.sin(angle) / 1e3, color=colour_of(i))
        furthest = max(furthest, axial)
    friction = fit["friction_angle_deg"]["mean"]
    normal = np.array([0, 0.85 * furthest])
    axes.plot(normal / 1e3, (fit["cohesion_Pa"] + normal * np.tan(np.radians(friction))) / 1e3, **LINE,
              label=f"φ = {friction:.2f}°, c = {fit['cohesion_Pa']:.3g} Pa")
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel(r"normal stress $-\sigma$ in kPa")
    axes.set_ylabel(r"shear stress $\tau$ in kPa")
    axes.set_title("c) friction angle: circles at the peak", loc="left")
    axes.legend(loc="upper left")


def draw_dilation(axes, fit, groups):
    begin, end = fit["windows"]["dilation_from"], fit["windows"]["dilation_to"]
    middle = 0.5 * (begin + end)
    heights = []
    for i, (pressure, rows) in enumerate(groups):
        compression = -rows["axial_strain"]
        axes.plot(100 * compression, 100 * rows["volumetric_strain"], color=colour_of(i), label=f"{pressure / 1e3:g} kPa")
        heights.append(np.interp(middle, compression, rows["volumetric_strain"]))
    rate = fit["dilation_rate"]["mean"]
    reach = np.array([begin - (end - begin), end + (end - begin)])
    axes.plot(100 * reach, 100 * (np.mean(heights) + rate * (reach - middle)), **LINE,
              label=f"ψ = {fit['dilation_angle_deg']['mean']:.2f}°")
    axes.axvspan(100 * begin, 100 * end, color="#EEEEEE", zorder=0)
    axes.set_ylabel(r"volumetric strain $\epsilon_V$ in %")
    axes.set_title("d) dilation angle", loc="left")
    axes.legend()


def draw_continuum(folder, grains, continuum):
    from matplotlib.lines import Line2D
    figure, all_axes = run_data.new_panels(1, 2)
    for groups, style in [(grains, "-"), (continuum, "--")]:
        for i, (pressure, rows) in enumerate(groups):
            for axes, name, factor in [(all_axes[0, 0], "axial_stress_Pa", -1e-3),
                                       (all_axes[0, 1], "volumetric_strain", 100)]:
                axes.plot(-100 * rows["axial_strain"], factor * rows[name], color=colour_of(i), linestyle=style)
    all_axes[0, 0].set_ylabel(r"axial stress $-\sigma_3$ in kPa")
    all_axes[0, 1].set_ylabel(r"volumetric strain $\epsilon_V$ in %")
    for axes in all_axes[0]:
        axes.set_xlabel(r"axial compression $-\epsilon_3$ in %")
        axes.margins(x=0)
    handles = [Line2D([], [], color=colour_of(i), label=f"{p / 1e3:g} kPa") for i, (p, _) in enumerate(grains)]
    handles += [Line2D([], [], color="#555555", linestyle=style, label=label)
                for style, label in [("-", "grains"), ("--", "continuum")]]
    all_axes[0, 1].legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    run_data.save_diagram(figure, folder, "fitted_continuum.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    fit = read_fit(folder)
    grains = by_pressure(run_data.read_table(folder, "curves_grains.csv"))
    continuum = by_pressure(run_data.read_table(folder, "curves_continuum.csv"))
    figure, all_axes = run_data.new_panels(2, 2)
    reach = draw_elastic(all_axes[0, 0], fit, grains)
    draw_poisson(all_axes[0, 1], fit, grains, reach)
    draw_circles(all_axes[1, 0], fit)
    draw_dilation(all_axes[1, 1], fit, grains)
    for axes in (all_axes[0, 0], all_axes[0, 1], all_axes[1, 1]):
        axes.set_xlabel(r"axial compression $-\epsilon_3$ in %")
        axes.margins(x=0)
    run_data.save_diagram(figure, folder, "fit_mohr_coulomb.png")
    draw_continuum(folder, grains, continuum)


if __name__ == "__main__":
    main()
