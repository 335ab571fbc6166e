#!/usr/bin/env python3
"""Steps of the same simulation from C++ (step_snapshot of tests/python) and from Python, in turns, on a settled heap: seconds by
the clock and of the processor, their ratios with median and scatter, and whether the states agree bit for bit afterwards. On a
machine that others use too, the processor's seconds tell more.

Usage: /usr/bin/python3 benchmarks/python_steps.py [--edge N] [--steps N] [--repeats N] [--threads N] [--build DIR]
"""

import argparse
import os
import subprocess
import sys
import tempfile
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


def steps_of(command, snapshot, given):
    """In a process of its own, of so many steps after as many others."""
    result = subprocess.run([*command, snapshot, str(given.steps), str(given.threads)], check=True, capture_output=True, text=True)
    clock, work, state = result.stdout.split()
    return np.array([float(clock), float(work)]), int(state)


FROM_PYTHON = """
import sys, time
from bergamo import engine
engine.set_threads(int(sys.argv[3]))
simulation = engine.Simulation.load(sys.argv[1])
simulation.step(int(sys.argv[2]))
begin, begin_of_work = time.perf_counter(), time.process_time()
simulation.step(int(sys.argv[2]))
print(time.perf_counter() - begin, time.process_time() - begin_of_work, simulation.state_hash)
"""


def main():
    given = options()
    os.environ["BERGAMO_BUILD"] = str(given.build)
    sys.path[:0] = [str(ROOT / "drivers" / "python"), str(ROOT / "tests" / "python")]
    from bergamo import engine
    from engine_scenes import falling
    engine.set_threads(given.threads)
    commands = [given.build / "tests" / "python" / "step_snapshot"], [sys.executable, "-c", FROM_PYTHON]
    os.environ["PYTHONPATH"] = str(ROOT / "drivers" / "python")
    with tempfile.TemporaryDirectory() as folder:
        snapshot = Path(folder) / "snapshot.h5"
        heap = falling(given.edge)
        heap.run_until(0.05)
        heap.save(snapshot)
        print(f"{len(heap)} grains, {len(heap.contacts())} contacts, {given.steps} steps, {given.threads} threads; {cpu_name()}, "
              f"{engine.pack_width()} numbers a pack")
        ratios = []
        for repeat in range(given.repeats):
            order = (0, 1) if repeat % 2 == 0 else (1, 0)
            results = {k: steps_of(commands[k], snapshot, given) for k in order}
            (cpp, state), (python, other) = results[0], results[1]
            if state != other:
                sys.exit("error: the states differ")
            ratios.append(python / cpp)
            print(f"  clock: C++ {cpp[0]:.3f} s, Python {python[0]:.3f} s; processor: {cpp[1]:.3f} s, {python[1]:.3f} s, ratio "
                  f"{ratios[-1][1]:.4f}", flush=True)
    for name, column in zip(("clock", "processor"), np.transpose(ratios)):
        low, middle, high = np.quantile(column, (0.25, 0.5, 0.75))
        print(f"Python over C++, {name}: median {middle:.4f}, quartiles {low:.4f} to {high:.4f}")
    print("states equal to the last bit")


if __name__ == "__main__":
    main()
