#!/usr/bin/python3
"""Whether two scales give the stresses of grains alone, on the three strain paths of Wellmann's figure 6.4b and in an
oedometer, all after an isotropic compression.

For every packing, which is made once, grains alone take the paths, and a Mohr-Coulomb continuum whose stiffness grows with the pressure and
whose friction is mobilised by plastic strain is fitted to their stresses on all of them (least squares, then least
sixth powers: nearly the least largest error). Then the continuum alone and the two-scale cube with the same grains take
the same paths. The error of a principal stress is its largest difference from grains alone over the path, over the
largest stress of grains alone: that of the continuum alone is the law's. The upper grains are a sample of their own, so
in each packing the two-scale cube differs from the whole one by chance; the error of the mean of the differences over
the packings is what that leaves.

Writes FOLDER/paths.csv, FOLDER/continuum-SEED.json and FOLDER/plots/paths.png, and prints the table. Runs that are
finished are not run again. Further settings NAME=VALUE of the driver hold for all runs.
"""

import concurrent.futures
import csv
import json
import statistics
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares
from study_runs import STRESSES, argument_parser, differences, run, run_data, same_packing

PATHS = {"unloading": {"Loading/path": "unloading"}, "constant volume": {"Loading/path": "constant volume"},
         "compression": {"Loading/path": "compression"},
         "oedometer": {"Loading/path": "compression", "Loading/axial strain": -0.005,
                       "Loading/volumetric strain change": 0.005}}
TITLES = ["path 1: unloading", "path 2: constant volume", "path 3: compression", "oedometer"]
MODELS = {"continuum alone": {"Model/kind": "continuum"}, "lumped projection": {},
          "consistent projection": {"Coupling/projection": "consistent"}}

# What is fitted: name, start, bounds. The modulus is that at 1 MPa. What spans decades is taken by its logarithm.
UNKNOWNS = [("Continuum/Young's modulus", 8e8, 5e7, 5e9), ("Continuum/stiffness exponent", 0.33, 0.01, 0.99),
            ("Continuum/Poisson's ratio", 0.08, 0, 0.45), ("Continuum/friction angle", 21, 8, 50),
            ("Continuum/dilation angle", -1, -15, 5), ("Continuum/hardening strain", 1e-3, 1e-5, 0.1)]


class Common(NamedTuple):
    """What holds for all runs."""

    settings: dict
    jobs: int  # at a time


def settings_of(scaled):
    """Of the driver, from unknowns that run from 0 to 1 between their bounds."""
    settings = {"Continuum/reference pressure": 1e6}
    for x, (name, _, low, high) in zip(scaled, UNKNOWNS):
        settings[name] = float(low * (high / low) ** x if spans_decades(low, high) else low + x * (high - low))
    return settings


def spans_decades(low, high):
    return low > 0 and high > 50 * low


def fit(program, common, alone, pool):
    """The continuum that is nearest to histories of grains alone, by path. @param pool of threads, for the paths"""
    largest = {path: max(abs(h[name]).max() for name in STRESSES) for path, h in alone.items()}

    def residual(scaled):
        # One element says what the whole cube does, as all of it is strained alike.
        settings = {**common, **settings_of(scaled), "Model/kind": "continuum", "Model/elements per edge": 2,
                    "Model/elements per height": 0, "Loading/time step": 1e-6}
        with tempfile.TemporaryDirectory() as folder:

            def difference(path):
                history, target = alone[path], Path(folder) / path.replace(" ", "-")
                if not run(program, target, {**settings, **PATHS[path]}):
                    return np.full(3 * len(history["time_s"]), 1.)
                mine = run_data.read_history(target)
                at = lambda name: np.interp(history["time_s"], mine["time_s"], mine[name])  # it has other samples
                return np.concatenate([(at(name) - history[name]) / largest[path] for name in STRESSES])

            return np.concatenate(list(pool.map(difference, alone)))

    start = [np.log(start / low) / np.log(high / low) if spans_decades(low, high) else (start - low) / (high - low)
             for _, start, low, high in UNKNOWNS]
    options = {"bounds": (0, 1), "xtol": 1e-3, "ftol": 1e-3, "max_nfev": 15}
    nearest = np.clip(least_squares(residual, start, diff_step=0.02, **options).x, 0.01, 0.99)
    return settings_of(least_squares(lambda x: residual(x)**3, nearest, diff_step=0.01, **options).x)


def folder_of(folder, model, path, seed):
    return folder / f"{model}-{path}-{seed}".replace(" ", "-")


def first_stage(history):
    return {name: values[history["stage"] == 1] for name, values in history.items()}


def fit_all(program, folder, seeds, paths, common):
    """The continuum of each packing, by seed; fits that are there are not made again."""
    with concurrent.futures.ThreadPoolExecutor(len(seeds)) as fits, \
            concurrent.futures.ThreadPoolExecutor(common.jobs) as pool:

        def fitted(seed):
            kept = folder / f"continuum-{seed}.json"
            if not kept.exists():
                alone = {path: run_data.read_history(folder_of(folder, "grains alone", path, seed)) for path in paths}
                kept.write_text(json.dumps(fit(program, common.settings, alone, pool), indent=1) + "\n")
            return json.loads(kept.read_text())

        return dict(zip(seeds, fits.map(fitted, seeds)))


def measure(program, folder, seeds, choice, common):
    """Errors by model and path of a choice of both, one a packing; and those between packings of grains alone."""
    rows, (models, paths) = {}, choice
    read = lambda model, path, seed: run_data.read_history(folder_of(folder, model, path, seed))
    with concurrent.futures.ThreadPoolExecutor(common.jobs) as pool:
        alone = lambda seed, path, packing: run(program, folder_of(folder, "grains alone", path, seed),
                                                {**common.settings, "Model/kind": "grains", "Packing/seed": seed,
                                                 **PATHS[path], **packing})
        list(pool.map(lambda seed: alone(seed, paths[0], {}), seeds))
        packing = {seed: same_packing(folder_of(folder, "grains alone", paths[0], seed)) for seed in seeds}
        list(pool.map(lambda job: alone(*job, packing[job[0]]), [(seed, path) for seed in seeds for path in paths[1:]]))
        continuum = fit_all(program, folder, seeds, paths, common)
        jobs = [(model, path, seed) for seed in seeds for path in paths for model in models]
        done = list(pool.map(lambda job: run(program, folder_of(folder, *job),
                                             {**common.settings, **continuum[job[2]], **MODELS[job[0]],
                                              "Packing/seed": job[2], **PATHS[job[1]], **packing[job[2]]}), jobs))
    for (model, path, seed), is_done in zip(jobs, done):
        mine, alone = (read(name, path, seed) if is_done else None for name in (model, "grains alone"))
        rows.setdefault((model, path), []).append(differences(mine, alone, False) if is_done else None)
        if path == paths[0]:  # all of them begin with it
            rows.setdefault((model, "isotropic compression"), []).append(
                differences(first_stage(mine), first_stage(alone), False) if is_done else None)
    for path in paths:  # what another packing of the same grains would give
        first = read("grains alone", path, seeds[0])
        rows["grains of another packing", path] = [differences(read("grains alone", path, seed), first, False)
                                                   for seed in seeds[1:]]
    return rows


def write_table(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["model", "path", "runs", "failed", *(f"error_{k}_percent" for k in (1, 2, 3)),
                        "largest_error_percent", "scatter_percent", "error_of_mean_percent"])
        for (model, name), found in rows.items():
            good = [row for row in found if row]
            largest = [[abs(difference).max() for difference in row] for row in good]  # by packing and stress
            worst = [max(row) for row in largest]
            mean = [f"{statistics.mean(column):.2f}" for column in zip(*largest)] or ["", "", ""]
            table.writerow([model, name, len(good), len(found) - len(good), *mean,
                            f"{statistics.mean(worst):.2f}" if worst else "",
                            f"{statistics.stdev(worst):.2f}" if len(worst) > 1 else "",
                            f"{np.abs(np.mean(good, axis=0)).max():.2f}" if good else ""])


def draw(folder, seed, choice):
    """Stresses of all models on the paths, as in Wellmann's figure 6.5."""
    models, paths = choice
    figure, all_axes = run_data.new_panels(1, len(paths))
    for axes, path in zip(all_axes.ravel(), paths):
        for model, style in [("grains alone", "-"), *zip(MODELS, (":", "--", "-."))]:
            if model not in ["grains alone", *models]:
                continue
            history = run_data.read_history(folder_of(folder, model, path, seed))
            for k, name in enumerate(STRESSES):
                axes.plot(1e3 * history["time_s"], 1e-6 * history[name], style, color=run_data.COLOURS[k],
                          label=f"σ{k + 1}, {model}")
        axes.set_title(TITLES[list(PATHS).index(path)], fontsize="medium")
        axes.set_xlabel("time in ms")
    all_axes.ravel()[0].set_ylabel("principal stress in MPa")
    all_axes.ravel()[0].legend(fontsize="x-small")
    run_data.save_diagram(figure, str(folder), "paths.png")


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("--paths", nargs="+", choices=PATHS, default=list(PATHS),
                        help="these alone; the continuum is fitted to them")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS), help="these alone, beside grains")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, each on one core (default 2)")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="of the driver, for all runs")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    folder, seeds = arguments.folder.resolve(), range(1, arguments.seeds + 1)
    common = Common(dict(text.split("=", 1) for text in getattr(arguments, "set")), arguments.jobs)
    choice = arguments.models, arguments.paths
    rows = measure(arguments.program.resolve(), folder, seeds, choice, common)
    write_table(rows, folder / "paths.csv")
    print((folder / "paths.csv").read_text(), end="")
    draw(folder, seeds[0], choice)


if __name__ == "__main__":
    main()
