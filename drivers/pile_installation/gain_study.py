#!/usr/bin/python3
"""What two scales save beside grains alone: processor time of a step over the number of grains in the block.

The dissertation's pile and ground over coarse grains, with blocks of several widths in the same ground: what a step costs
grows with the grains of the block, and what is left without them is the continuum's and the overlap's. So does ground of
grains alone cost: with as many times the grains as the saving says, as many times their share. Each run settles one tile
and goes some hundred steps from the start. Keep the machine free.

Writes FOLDER/gain.csv and prints it. Runs that are finished are not run again. Further settings NAME=VALUE of the driver
hold for all runs.
"""

import csv

import numpy as np
from domain_study import HERE, arguments_of, run_data, studies

TILE = 0.03  # of the sand [m]
GROUND = 1.25  # width of all ground [m]
WIDTHS = {"narrow": 0.15, "middle": 0.3, "wide": 0.6}
SAVING = 46  # of grains, by the dissertation: 25 million for 540 000


def measure(program, folder, common):
    """A row a block: width [m], grains, elements, processor time of a step [s]."""
    rows = []
    for name, width in WIDTHS.items():
        settings = {"Model/block width": width, "Model/beyond sides": (GROUND - width) / 2,
                    "Sand/tiles": round(width / TILE), "Sand/box": f"{width}, 0.0161, 0.1545",
                    "Pile/time": 6e-4, "Pile/start time": 3e-4, "Output/pictures": 1, "Output/samples": 1}
        files = [HERE / f"pile_installation_{file}.prm" for file in ("thesis", "soft", "coarse")]
        if not studies.run(program, folder / name, {**settings, **common}, files):
            raise SystemExit(1)
        summary = run_data.read_summary(folder / name)
        rows.append([width, summary["particles"], summary["elements"], summary["core_time_per_step_s"]])
    return rows


def main():
    program, folder, _, common = arguments_of(__doc__)
    rows = measure(program, folder, common)
    with open(folder / "gain.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["block_width_m", "grains", "elements", "core_time_per_step_s"])
        table.writerows(rows)
    print((folder / "gain.csv").read_text(), end="")
    _, grains, _, seconds = np.array(rows).T
    a_grain, rest = np.polyfit(grains, seconds, 1)
    alone = SAVING * grains[0] * a_grain
    print(f"a grain {1e6 * a_grain:.3f} us, continuum and overlap {1e3 * rest:.2f} ms, off by "
          f"{100 * np.abs((rest + a_grain * grains) / seconds - 1).max():.1f} % at most")
    print(f"the dissertation's saving of {SAVING}: {alone:.3f} s a step for {seconds[0]:.4f} s, a gain of "
          f"{alone / seconds[0]:.1f}")


if __name__ == "__main__":
    main()
