#!/usr/bin/python3
"""How much an overlap shows: two scales beside grains alone, over the ways to make the overlap.

For every seed, grains alone are run on nearly_elastic.prm and give the modulus and Poisson's ratio of the continuum; then
each variant is run with the same grains above a continuum. The error of a principal stress is its largest difference from
grains alone over the path, both counted from their starts, over the largest change of any stress of grains alone.

Writes FOLDER/study.csv and FOLDER/plots/study.png and prints the table. Runs that are finished are not run again, so a study
that was broken off goes on.
"""

import concurrent.futures
import csv
import statistics

from study_runs import STRESSES, argument_parser, errors, run, run_data, same_packing

FILES = ("two_scale_triaxial.prm", "nearly_elastic.prm")

# By group: what is varied from the defaults and nearly_elastic.prm, which has an overlap of two layers, 4.7 grains.
VARIANTS = {
    # by elements an edge, layers of elements, layers of overlap; a grain's mean diameter is 0.85 mm
    "thickness": {f"{n / per_edge * 10 / 0.85:.1f} grains": {"Model/elements per edge": per_edge, "Model/continuum layers": layers,
                                                             "Model/overlap layers": n, "Loading/time step": step}
                  for per_edge, layers, n, step in ((8, 4, 1, 6e-8), (5, 3, 1, 1e-7), (4, 2, 1, 1e-7), (5, 3, 2, 1.2e-7),
                                                    (4, 3, 2, 1.2e-7), (5, 4, 3, 1.2e-7), (10, 9, 8, 8e-8))},
    "elements": {f"{n} elements an edge": {"Model/elements per edge": n, "Model/continuum layers": layers,
                                           "Model/overlap layers": overlap} for n, layers, overlap in ((5, 3, 2), (7, 4, 3))},
    "projection": {"consistent": {"Coupling/projection": "consistent"}},
    "penalty": {f"penalty {value:g}": {"Coupling/penalty": value} for value in (1e13, 1e14, 1e15, 1e16)},
    # in two layers both shapes are the same, by nodal values of 0, 1/2, 1
    "weight": {f"{shape} in three layers": {"Model/weight": shape, "Model/overlap layers": 3, "Model/continuum layers": 4}
               for shape in ("linear", "smooth")},
    "least weight": {f"least weight {value:g}": {"Coupling/least weight": value} for value in (0.01, 0.05, 0.1, 0.2)},
    "edge": {f"edge {depth:g}": {"Coupling/edge depth": depth} for depth in (0, 1, 1.5, 2)},
    "edge stiffness": {f"edge stiffness {value:g}": {"Coupling/edge stiffness": value} for value in (1e15, 1e16, 1e17)},
    "transfer": {f"transfer time {value:g}": {"Coupling/transfer time": value} for value in (2e-5, 1e-4, 5e-4)},
}


def changes(history, names=STRESSES):
    return [history[name] - history[name][0] for name in names]


def elasticity(history):
    """Young's modulus [Pa] and Poisson's ratio of a path that is isotropic first and keeps its volume then."""
    strains = ["strain_1", "strain_2", "strain_3"]
    last = int((history["stage"] == 1).sum()) - 1
    stress, strain = changes(history), [history[name] for name in strains]
    bulk = sum(s[last] for s in stress) / 3 / sum(e[last] for e in strain)
    along = lambda values: (values[2][-1] - values[2][last]) - (values[0][-1] - values[0][last] + values[1][-1] - values[1][last]) / 2
    shear = along(stress) / along(strain) / 2
    return 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def measure(program, folder, seeds, chosen):
    """A row a variant: group, name, errors of each seed, smallest stable step."""
    jobs = []
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        alone = {seed: folder / f"grains-{seed}" for seed in seeds}
        list(pool.map(lambda seed: run(program, alone[seed], {"Model/kind": "grains", "Packing/seed": seed}, FILES),
                      seeds))
        for seed in seeds:
            modulus, ratio = elasticity(run_data.read_history(alone[seed]))
            continuum = {"Continuum/Young's modulus": modulus, "Continuum/Poisson's ratio": ratio, "Packing/seed": seed,
                         **same_packing(alone[seed])}
            jobs.append((None, "continuum alone", seed, {**continuum, "Model/kind": "continuum"}))
            for group, variants in VARIANTS.items():
                if not chosen or group in chosen:
                    jobs += [(group, name, seed, {**continuum, **settings}) for name, settings in variants.items()]
        path = lambda job: folder / f"{job[1].replace(' ', '-')}-{job[2]}"
        list(pool.map(lambda job: run(program, path(job), job[3], FILES), jobs))
    rows = {}
    for job in jobs:
        summary = run_data.read_summary(path(job))
        found = errors(run_data.read_history(path(job)), run_data.read_history(alone[job[2]]), True) if summary else None
        row = rows.setdefault(job[:2], {"errors": [], "step": float("inf"), "failed": 0})
        if found:
            row["errors"].append(found)
            row["step"] = min(row["step"], summary["stable_time_step_s"])
        else:
            row["failed"] += 1
    return rows


def write_table(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["group", "variant", "runs", "failed", *(f"error_{k}_percent" for k in (1, 2, 3)),
                        "largest_error_percent", "scatter_percent", "stable_time_step_s"])
        for (group, name), row in rows.items():
            worst = [max(error) for error in row["errors"]]
            means = [f"{statistics.mean(column):.2f}" for column in zip(*row["errors"])] or ["", "", ""]
            mean = f"{statistics.mean(worst):.2f}" if worst else ""
            scatter = f"{statistics.stdev(worst):.2f}" if len(worst) > 1 else ""
            table.writerow([group or "", name, len(worst), row["failed"], *means, mean, scatter, f"{row['step']:.3g}"])


def draw(rows, folder):
    shown = [(name, [max(error) for error in row["errors"]]) for (group, name), row in rows.items() if row["errors"]]
    figure, all_axes = run_data.new_diagram()
    axes = all_axes[0, 0]
    figure.set_figheight(1.5 + 0.28 * len(shown))
    for place, (name, worst) in enumerate(reversed(shown)):
        axes.barh(place, statistics.mean(worst), color=run_data.COLOURS[0], alpha=0.6)
        axes.plot(worst, [place] * len(worst), ".", color=run_data.COLOURS[1])
    axes.axvline(3, color="black", linewidth=0.8, linestyle=":")
    axes.set_yticks(range(len(shown)), [name for name, _ in reversed(shown)])
    axes.set_xlabel("largest error of a principal stress in % (dots: single seeds)")
    run_data.save_diagram(figure, str(folder), "study.png")


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("--only", nargs="+", choices=sorted(VARIANTS), help="these groups alone")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = measure(arguments.program.resolve(), arguments.folder.resolve(), range(1, arguments.seeds + 1), arguments.only)
    write_table(rows, arguments.folder / "study.csv")
    print((arguments.folder / "study.csv").read_text(), end="")
    draw(rows, arguments.folder)


if __name__ == "__main__":
    main()
