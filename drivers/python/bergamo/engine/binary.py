"""Finds the compiled part of this package: beside it where it is installed, in the build folder of a checkout else."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import sys
from pathlib import Path
from types import ModuleType

TARGET = "bergamo_engine"
SUFFIX = importlib.machinery.EXTENSION_SUFFIXES[0]
HERE = Path(__file__).resolve().parent
CHECKOUT = HERE.parents[3]


def candidates() -> list[Path]:
    """Where the module may lie, the likeliest first: beside this file, in $BERGAMO_BUILD, in build/release, in others."""
    name = f"_engine{SUFFIX}"
    builds = [CHECKOUT / "build" / "release", *sorted((CHECKOUT / "build").glob("*"))]
    if os.environ.get("BERGAMO_BUILD"):
        builds = [Path(os.environ["BERGAMO_BUILD"])]
    return [HERE / name, *(build / "drivers" / "python" / name for build in builds)]


def advice() -> str:
    build = os.environ.get("BERGAMO_BUILD", CHECKOUT / "build" / "release")
    said = (f"bergamo.engine is not built for this Python ({sys.executable}, {SUFFIX}): build the target {TARGET} in the "
            f"checkout, `cmake -S . -B {build} -G Ninja && ninja -C {build} {TARGET}`, with python3-dev and pybind11-dev "
            "installed")
    others = sorted(path.name for where in candidates() for path in where.parent.glob("_engine*"))
    return said + (f"; there is {', '.join(dict.fromkeys(others))}, of another Python: take /usr/bin/python3" if others else "")


def load() -> ModuleType:
    """ImportError, naming the target to build, where the module is not there."""
    for path in candidates():
        if path.is_file():
            spec = importlib.util.spec_from_file_location("bergamo.engine._engine", path)
            assert spec and spec.loader
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            return module
    raise ImportError(advice(), name="bergamo.engine")
