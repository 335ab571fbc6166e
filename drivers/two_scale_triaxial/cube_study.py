#!/usr/bin/python3
"""The other studies of Wellmann's section 6.4 on the two-scale cube: which way it is pressed (figure 6.6b), how the faces of
the overlap go (6.7), and whether the forces between the grains are those of grains alone (6.8).

Path 3 of figure 6.4b on the default cube. The error of a principal stress is its largest difference from grains alone,
pressed the same way, over their largest stress. Forces are those at the end, between grains above the overlap; two
distributions differ by the largest difference of their cumulated shares (Kolmogorov and Smirnov). Groups A, B and C of
forces are those below the mean, up to twice of it, and above.

Writes FOLDER/cube.csv and FOLDER/plots/directions.png, interfaces.png and forces.png, and prints the table. Runs that are
finished are not run again.
"""

import concurrent.futures
import csv

import numpy as np
from study_runs import STRESSES, argument_parser, errors, run, run_data, same_packing

AXES = {f"axis {axis}": {"Loading/axis": axis} for axis in "zxy"}
# A step needs a layer more below it; corners of it have little mass, so a softer penalty keeps the time step.
SHAPES = {"inclined": {"Model/interface": "inclined"}, "curved": {"Model/interface": "curved"},
          "stepped": {"Model/interface": "stepped", "Model/continuum layers": 4, "Coupling/penalty": 1e14,
                      "Loading/time step": 6e-8}}
PROJECTIONS = {"consistent": {"Coupling/projection": "consistent"}}
GROUPS = {"A": (0, 1), "B": (1, 2), "C": (2, np.inf)}  # forces over their mean


def jobs_of(common):
    """Settings by name of the run; those of grains alone begin with it."""
    alone = {f"grains alone, {name}": {"Model/kind": "grains", **settings} for name, settings in AXES.items()}
    return {name: {**common, **settings} for name, settings in {**alone, **AXES, **SHAPES, **PROJECTIONS}.items()}


def reference_of(name):
    return f"grains alone, {name if name in AXES else 'axis z'}"


def forces_of(folder):
    table = run_data.read_table(str(folder), "contact_forces.csv")
    return table["force_N"], table["angle_to_z_deg"]


def largest_difference(a, b):
    """Of the cumulated shares of two samples."""
    places = np.sort(np.concatenate([a, b]))
    share = lambda sample: np.searchsorted(np.sort(sample), places, side="right") / len(sample)
    return abs(share(a) - share(b)).max()


def write_table(folder, names, path_of):
    with open(folder / "cube.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["run", *(f"error_{k}_percent" for k in (1, 2, 3)), "forces", "difference_of_magnitudes",
                        "difference_of_directions", "stress_3_unevenness", "energy_residual", "stable_time_step_s"])
        for name in names:
            reference = path_of(reference_of(name))
            found = errors(run_data.read_history(path_of(name)), run_data.read_history(reference), False)
            summary = run_data.read_summary(path_of(name))
            (mine, direction), (theirs, their_direction) = forces_of(path_of(name)), forces_of(reference)
            table.writerow([name, *(f"{error:.2f}" for error in found or ()), len(mine),
                            f"{largest_difference(mine / mine.mean(), theirs / theirs.mean()):.3f}",
                            f"{largest_difference(direction, their_direction):.3f}",
                            *(f"{summary[figure]:.3g}" for figure in ("stress_3_unevenness", "energy_residual",
                                                                      "stable_time_step_s"))])


def draw_stresses(folder, shown, file_name):
    figure, all_axes = run_data.new_diagram()
    axes = all_axes[0, 0]
    for (label, path), style in zip(shown.items(), ("-", "--", "-.", ":", (0, (5, 1)), (0, (1, 1)))):
        history = run_data.read_history(path)
        for k, name in enumerate(STRESSES):
            axes.plot(1e3 * history["time_s"], 1e-6 * history[name], linestyle=style, color=run_data.COLOURS[k],
                      label=f"σ{k + 1}, {label}")
    axes.set_xlabel("time in ms")
    axes.set_ylabel("principal stress in MPa")
    axes.legend(fontsize="x-small")
    run_data.save_diagram(figure, str(folder), file_name)


def draw_directions(folder, path_of):
    """Each cube turned so that it is pressed along 3: what is left is the direction of the interface."""
    figure, all_axes = run_data.new_panels(1, len(AXES))
    turned = {"z": (0, 1, 2), "x": (1, 2, 0), "y": (2, 0, 1)}
    for axes, name in zip(all_axes.ravel(), AXES):
        for label, style, path in (("grains alone", "-", path_of(reference_of(name))), ("two scales", "--", path_of(name))):
            history = run_data.read_history(path)
            for k, column in enumerate(turned[name[-1]]):
                axes.plot(1e3 * history["time_s"], 1e-6 * history[STRESSES[column]], style, color=run_data.COLOURS[k],
                          label=f"σ{'xyz'[column]}, {label}")
        axes.set_title(f"pressed along {name[-1]}, the interface across z", fontsize="medium")
        axes.set_xlabel("time in ms")
        axes.legend(fontsize="x-small")
    all_axes.ravel()[0].set_ylabel("principal stress in MPa")
    run_data.save_diagram(figure, str(folder), "directions.png")


def draw_forces(folder, shown):
    figure, all_axes = run_data.new_panels(1, 1 + len(GROUPS))
    panels = all_axes.ravel()
    for number, (label, path) in enumerate(shown.items()):
        force, direction = forces_of(path)
        colour, share = run_data.COLOURS[number], force / force.mean()
        panels[0].stairs(*np.histogram(share, np.linspace(0, 5, 26), density=True), color=colour, label=label)
        for axes, (group, (low, high)) in zip(panels[1:], GROUPS.items()):
            chosen = direction[(share >= low) & (share < high)]
            edges = np.linspace(0, 90, 10)
            # over the bin's share of the half sphere: 1 for forces without a direction
            solid_angle = np.cos(np.radians(edges[:-1])) - np.cos(np.radians(edges[1:]))
            axes.stairs(np.histogram(chosen, edges)[0] / len(chosen) / solid_angle, edges, color=colour)
            axes.set_title(f"group {group}: {low:g} to {high:g} of the mean", fontsize="medium")
            axes.set_xlabel("angle to the loading in degrees")
    panels[0].set_xlabel("force over the mean")
    panels[0].set_ylabel("density")
    panels[0].legend(fontsize="x-small")
    run_data.save_diagram(figure, str(folder), "forces.png")


def main():
    parser = argument_parser(__doc__, over_packings=False)
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="of the driver, for all runs")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    folder, program = arguments.folder.resolve(), arguments.program.resolve()
    path_of = lambda name: folder / name.replace(",", "").replace(" ", "-")
    jobs = jobs_of(dict(text.split("=", 1) for text in getattr(arguments, "set")))
    first, *others = jobs
    is_done = run(program, path_of(first), jobs[first])
    packing = same_packing(path_of(first))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        done = list(pool.map(lambda name: run(program, path_of(name), {**jobs[name], **packing}), others))
    if not (is_done and all(done)):
        raise SystemExit("error: not all runs have ended; see above, then call again")
    write_table(folder, [name for name in jobs if not name.startswith("grains alone")], path_of)
    print((folder / "cube.csv").read_text(), end="")
    alone = path_of(reference_of("axis z"))
    draw_directions(folder, path_of)
    draw_stresses(folder, {"grains alone": alone, "flat": path_of("axis z"), **{name: path_of(name) for name in SHAPES}},
                  "interfaces.png")
    draw_forces(folder, {"grains alone": alone, "two scales, lumped": path_of("axis z"),
                         "two scales, consistent": path_of("consistent")})


if __name__ == "__main__":
    main()
