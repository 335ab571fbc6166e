#!/usr/bin/python3
"""How much of a wave an overlap reflects, over its wave length, the elements and the ways to make the overlap.

Each run sends a pulse of compression or of shear from the grains or from the continuum through an overlap; in grains alone
the same pulse is measured in the same way. Waves that the elements do not carry cannot come from the continuum and are left
out.

Writes FOLDER/reflection.csv and FOLDER/plots/reflection.png and prints the table. Runs that are finished are not run again,
so a study that was broken off goes on.
"""

import argparse
import concurrent.futures
import csv
import itertools
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common" / "plots"))
import run_data

WAVES, SOURCES = ("compression", "shear"), ("grains", "continuum")
LENGTHS = (4, 6, 8, 12, 16)  # of waves [grains]
COUNT = 12  # of waves in a pulse: the fewer, the more of it are shorter waves, which elements slow down
COLUMNS = {"2 elements of 1 grain": (1, 2), "4 elements of 1 grain": (1, 4), "1 element of 2 grains": (2, 1),
           "2 elements of 2 grains": (2, 2), "4 elements of 2 grains": (2, 4), "2 elements of 4 grains": (4, 2)}

# What is varied from the defaults at two wave lengths, twice and four times the overlap.
VARIANTS = {
    "transfer time": {f"{value:g} s": {"Coupling/transfer time": value} for value in (1e-7, 1e-6, 1e-5, 1e-4, 1e-3)},
    "penalty": {f"{value:g} Pa/m2": {"Coupling/penalty": value} for value in (1e13, 1e14, 1e15)}
    | {"1e+16 Pa/m2": {"Coupling/penalty": 1e16, "Output/time step": 2e-7}},
    "edge": {"none": {"Coupling/edge depth": 0}, "1e15 Pa/m2": {"Coupling/edge stiffness": 1e15},
             "1e16 Pa/m2": {}},
    "projection": {"consistent": {"Coupling/projection": "consistent"}},
}
VARIED_LENGTHS = (8, 16)


def run(program, folder, settings):
    """Runs the driver unless the folder holds a finished run, and gives the summary, none where it is refused."""
    if not run_data.read_summary(folder):
        options = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
        result = subprocess.run([program, HERE / "overlap_waves.prm", "--output", folder, "--force", "--no-plots", "--quiet",
                                 "--threads", "1", "--set", "Output/samples=10", "--set", "Output/pictures=1",
                                 "--set", f"Pulse/waves={COUNT}", *options],
                                capture_output=True, text=True)
        if result.returncode != 0:
            print(f"{folder.name}: {result.stderr.strip()}", file=sys.stderr)
    return run_data.read_summary(folder)


def jobs():
    """Group, name and settings of each run."""
    for wave, length in itertools.product(WAVES, LENGTHS):
        pulse = {"Pulse/wave": wave, "Pulse/wave length": length}
        yield "alone", "grains alone", {**pulse, "Pulse/from": "grains", "Column/kind": "grains"}
        for (name, (size, layers)), source in itertools.product(COLUMNS.items(), SOURCES):
            if source == "grains" or length > 3.5 * size:
                yield "elements", name, {**pulse, "Pulse/from": source, "Column/element size": size,
                                         "Column/overlap layers": layers}
    for wave, length in itertools.product(WAVES, VARIED_LENGTHS):
        for group, variants in VARIANTS.items():
            for name, settings in variants.items():
                yield group, name, {"Pulse/wave": wave, "Pulse/wave length": length, "Pulse/from": "grains", **settings}


def measure(program, folder):
    rows = []
    path = lambda job: folder / "-".join(str(word).replace(" ", "-").replace("/", "-")
                                         for word in (job[0], job[1], *list(job[2].values())[:3]))
    all_jobs = list(jobs())
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        summaries = list(pool.map(lambda job: run(program, path(job), job[2]), all_jobs))
    for (group, name, settings), summary in zip(all_jobs, summaries):
        if summary:
            rows.append({"group": group, "variant": name, "wave": settings["Pulse/wave"], "from": settings["Pulse/from"],
                         "wave_length_grains": settings["Pulse/wave length"],
                         "wave_length_over_overlap": summary["wave_length_m"] / summary["overlap_m"],
                         **{f"{part}_percent": 100 * summary[f"{part}_share"]
                            for part in ("reflected", "held", "transmitted", "gained")},
                         "energy_residual": summary["energy_residual"],
                         "stable_time_step_s": summary["stable_time_step_s"]})
    return rows


def write_table(rows, path):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows({key: f"{value:.3g}" if isinstance(value, float) else value for key, value in row.items()}
                        for row in rows)


def draw(rows, folder):
    figure, panels = run_data.new_panels(2, 2)
    for (wave, source), axes in zip(itertools.product(WAVES, SOURCES), panels.flat):
        for name, colour in zip(("grains alone", *COLUMNS), ("#000000", *run_data.COLOURS)):
            chosen = [row for row in rows if row["group"] in ("alone", "elements") and row["variant"] == name
                      and row["wave"] == wave and (row["from"] == source or row["group"] == "alone")]
            axes.loglog([row["wave_length_over_overlap"] for row in chosen],
                        [max(row["reflected_percent"], 1e-4) for row in chosen], ".:" if name == "grains alone" else ".-",
                        color=colour, label=name)
        axes.axhline(3, color="black", linewidth=0.8, linestyle=":")
        axes.axvline(1, color="black", linewidth=0.8, linestyle=":")
        axes.set_ylim(5e-5, 150)
        axes.set_title(f"{wave} from the {source}", loc="left")
        axes.set_xlabel("wave length over overlap")
        axes.set_ylabel("reflected energy in %")
    panels[0][0].legend(fontsize=8)
    run_data.save_diagram(figure, str(folder), "reflection.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="the driver overlap_waves")
    parser.add_argument("folder", type=Path, help="of the runs")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = measure(arguments.program.resolve(), arguments.folder.resolve())
    write_table(rows, arguments.folder / "reflection.csv")
    print((arguments.folder / "reflection.csv").read_text(), end="")
    draw(rows, arguments.folder)


if __name__ == "__main__":
    main()
