#!/usr/bin/python3
"""Draws the samples of rve_triaxial.

Reads ensemble.csv and samples/NNNN/history.csv and writes into RUN_FOLDER/plots:
  rve_triaxial.png    stress ratio, solid fraction and volumetric strain over the axial compression of the last stage,
                      a thin line a sample, a thick one the mean of those that differ in the seed alone, with the
                      deviation as a band (Wellmann's fig. 5.5)
  rve_generation.png  solid fraction after the generation over the friction it was made with (fig. 5.4), where there
                      is more than one friction
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common" / "plots"))
import run_data
from run_data import COLOURS

LABELS = {"edge_m": (1e3, "L = {:g} mm"), "generation_friction": (1, "μ = {:g}"),
          "confining_pressure_Pa": (1e-3, "p = {:g} kPa")}


def groups_of(ensemble):
    """Numbers of the finished samples by edge, friction and pressure."""
    groups = {}
    for i in range(len(ensemble["sample"])):
        if ensemble["finished"][i] == 1:
            groups.setdefault(tuple(ensemble[name][i] for name in LABELS), []).append(int(ensemble["sample"][i]))
    return groups


def label_of(group, groups):
    """What tells this group from the others."""
    texts = [text.format(factor * group[k]) for k, (factor, text) in enumerate(LABELS.values())
             if len({other[k] for other in groups}) > 1]
    return ", ".join(texts) or "mean"


def last_stage(folder, number):
    columns = run_data.read_history(os.path.join(folder, "samples", f"{number:04d}"))
    rows = columns["stage"] == columns["stage"][-1]
    columns = {name: values[rows] for name, values in columns.items()}
    across = 0.5 * (columns["stress_xx_Pa"] + columns["stress_yy_Pa"])
    return {"compression": -100 * columns["strain_z"],
            "ratio": columns["stress_zz_Pa"] / np.where(across == 0, np.nan, across),
            "solid_fraction": columns["solid_fraction"], "volumetric_strain": 100 * columns["volumetric_strain"]}


def draw_tests(folder, groups):
    figure, panels = run_data.new_panels(1, 3)
    names = {"ratio": r"stress ratio $\sigma_3/\sigma_1$", "solid_fraction": r"solid fraction $\Phi$",
             "volumetric_strain": r"volumetric strain $\epsilon_V$ in %"}
    for k, (group, numbers) in enumerate(groups.items()):
        colour = COLOURS[k % len(COLOURS)]
        samples = [last_stage(folder, number) for number in numbers]
        shared = np.linspace(0, min(np.max(s["compression"]) for s in samples), 400)
        for axes, name in zip(panels[0], names):
            curves = []
            for s in samples:
                order = np.argsort(s["compression"], kind="stable")
                curves.append(np.interp(shared, s["compression"][order], s[name][order]))
                axes.plot(s["compression"], s[name], color=colour, linewidth=0.4, alpha=0.5)
            mean = np.mean(curves, axis=0)
            axes.plot(shared, mean, color=colour, label=f"{label_of(group, groups)} ({len(samples)})")
            if len(samples) > 1:
                deviation = np.std(curves, axis=0, ddof=1)
                axes.fill_between(shared, mean - deviation, mean + deviation, color=colour, alpha=0.2, linewidth=0)
    for axes, text in zip(panels[0], names.values()):
        axes.set_xlabel(r"axial compression $-\epsilon_3$ in %")
        axes.set_ylabel(text)
        axes.margins(x=0)
    panels[0, 0].legend(loc="lower right")
    run_data.save_diagram(figure, folder, "rve_triaxial.png")


def draw_generation(folder, ensemble):
    finished = ensemble["finished"] == 1
    frictions = np.unique(ensemble["generation_friction"][finished])
    if len(frictions) < 2:
        return
    figure, axes = run_data.new_diagram()
    axes = axes[0, 0]
    values = [ensemble["generated_solid_fraction"][finished & (ensemble["generation_friction"] == friction)]
              for friction in frictions]
    axes.plot(frictions, [np.mean(v) for v in values], marker="o", color=COLOURS[0])
    for friction, v in zip(frictions, values):
        axes.plot(np.full(len(v), friction), v, ".", color=COLOURS[1], markersize=3)
    axes.set_xscale("symlog", linthresh=0.05)
    axes.set_xlim(left=0)
    axes.set_xlabel("friction during the generation")
    axes.set_ylabel(r"solid fraction $\Phi$")
    run_data.save_diagram(figure, folder, "rve_generation.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_folder", metavar="RUN_FOLDER")
    folder = parser.parse_args().run_folder
    ensemble = run_data.read_table(folder, "ensemble.csv")
    groups = groups_of(ensemble)
    if not groups:
        run_data.fail(f"{folder} has no finished sample yet")
    draw_tests(folder, groups)
    draw_generation(folder, ensemble)


if __name__ == "__main__":
    main()
