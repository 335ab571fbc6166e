#!/usr/bin/env python3
"""Steps of the same simulation from C++ (step_snapshot of tests/python) and from Python, in turns, on a settled heap: seconds
and ratio of each pair, their median and scatter, and whether the states agree bit for bit afterwards.

Usage: /usr/bin/python3 benchmarks/python_steps.py [--edge N] [--steps N] [--repeats N] [--threads N] [--build DIR]
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--edge", type=int, default=12, help="grains along an edge of the heap")
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release")
    return parser.parse_args()


def cpu_name():
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown processor")


def from_cpp(program, snapshot, given):
    result = subprocess.run([program, snapshot, str(given.steps), str(given.threads)], check=True, capture_output=True, text=True)
    seconds, state = result.stdout.split()
    return float(seconds), int(state)


def from_python(engine, snapshot, given):
    simulation = engine.Simulation.load(snapshot)
    begin = time.perf_counter()
    simulation.step(given.steps)
    return time.perf_counter() - begin, simulation.state_hash


def main():
    given = options()
    os.environ["BERGAMO_BUILD"] = str(given.build)
    sys.path[:0] = [str(ROOT / "drivers" / "python"), str(ROOT / "tests" / "python")]
    from bergamo import engine
    from engine_scenes import falling
    engine.set_threads(given.threads)
    program = given.build / "tests" / "python" / "step_snapshot"
    with tempfile.TemporaryDirectory() as folder:
        snapshot = Path(folder) / "snapshot.h5"
        heap = falling(given.edge)
        heap.run_until(0.05)
        heap.save(snapshot)
        print(f"{len(heap)} grains, {len(heap.contacts())} contacts, {given.steps} steps, {given.threads} threads; {cpu_name()}, "
              f"{engine.pack_width()} numbers a pack")
        ratios = []
        for repeat in range(given.repeats):
            runs = [lambda: from_cpp(program, snapshot, given), lambda: from_python(engine, snapshot, given)]
            order = (0, 1) if repeat % 2 == 0 else (1, 0)
            results = dict(zip(order, [runs[k]() for k in order]))
            (cpp, state), (python, other) = results[0], results[1]
            if state != other:
                sys.exit("error: the states differ")
            ratios.append(python / cpp)
            print(f"  C++ {cpp:.3f} s, Python {python:.3f} s, ratio {ratios[-1]:.4f}")
    low, middle, high = np.quantile(ratios, (0.25, 0.5, 0.75))
    print(f"Python over C++: median {middle:.4f}, quartiles {low:.4f} to {high:.4f}; states equal to the last bit")


if __name__ == "__main__":
    main()
