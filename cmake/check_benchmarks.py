#!/usr/bin/env python3
"""Whether the benchmarks compile: every source of benchmarks/ as far as its errors go, without making code of it, which
takes a quarter of the time. Needs a build folder configured with BERGAMO_BENCHMARKS and
CMAKE_EXPORT_COMPILE_COMMANDS, whose precompiled headers are there.

Usage: check_benchmarks.py BUILD_FOLDER
"""

import concurrent.futures
import json
import os
import subprocess
import sys
from pathlib import Path

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"


def check(entry):
    return subprocess.run(entry["command"] + " -fsyntax-only", shell=True, cwd=entry["directory"], capture_output=True, text=True)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    commands = json.loads((Path(sys.argv[1]) / "compile_commands.json").read_text())
    # image_velocity sees headers that its own target patches first
    sources = [entry for entry in commands if BENCHMARKS in Path(entry["file"]).parents
               and BENCHMARKS / "image_velocity" not in Path(entry["file"]).parents]
    if not sources:
        sys.exit(f"error: {sys.argv[1]} builds no benchmark; configure it with -DBERGAMO_BENCHMARKS=ON")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(check, sources))
    for entry, result in zip(sources, results):
        if result.returncode != 0:
            print(f"error: {entry['file']} does not compile:\n{result.stderr}", file=sys.stderr)
    if any(result.returncode for result in results):
        sys.exit(1)
    print(f"benchmarks: {len(sources)} sources compile")


if __name__ == "__main__":
    main()
