"""The look of diagrams, and saving them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

# Colours that people with colour-blindness can tell apart (Okabe and Ito, 2008).
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"]


def time_axis(time: np.ndarray) -> tuple[np.ndarray, str]:
    """Times in a unit that suits their size, and that unit's name. @param time (n,) [s]"""
    longest = np.nanmax(np.abs(time)) if len(time) else 0
    return (time * 1e3, "ms") if 0 < longest < 0.1 else (time, "s")


def new_diagram_look() -> None:
    """Light grid, no frame on top and right; needs no screen."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.rcParams.update({
        "font.size": 11, "axes.titlesize": 12, "axes.spines.top": False, "axes.spines.right": False,
        "axes.grid": True, "grid.color": "#DDDDDD", "grid.linewidth": 0.6, "axes.axisbelow": True,
        "lines.linewidth": 1.6, "legend.frameon": False, "axes.formatter.useoffset": False})


def new_diagram(n_rows: int = 1, height_ratios: Sequence[float] | None = None) -> tuple[Any, np.ndarray]:
    """A figure and its axes one above the other, (n_rows, 1), with one scale across, in the project's look."""
    new_diagram_look()
    from matplotlib import pyplot
    return pyplot.subplots(n_rows, 1, sharex=True, squeeze=False, figsize=(8.0, 4.8 if n_rows == 1 else 6.4),
                           gridspec_kw={"height_ratios": height_ratios or [1] * n_rows}, layout="constrained")


def new_panels(n_rows: int, n_columns: int) -> tuple[Any, np.ndarray]:
    """A figure and its axes in rows and columns, each with scales of its own, in the project's look."""
    new_diagram_look()
    from matplotlib import pyplot
    return pyplot.subplots(n_rows, n_columns, squeeze=False, figsize=(5.6 * n_columns, 4.2 * n_rows),
                           layout="constrained")


def mark_stages(axes: Any, time: np.ndarray, columns: Mapping[str, np.ndarray]) -> None:
    """A thin upright line where the run went from one stage to the next."""
    stages = columns.get("stage")
    if stages is not None:
        for i in np.flatnonzero(np.diff(stages)):
            axes.axvline(time[i + 1], color="#999999", linewidth=0.8, linestyle=(0, (2, 2)), zorder=0)


def save_whole(figure: Any, path: Path | str, dpi: int = 150) -> None:
    """Saves a PNG whole or not at all; OSError where it cannot be."""
    part = f"{path}.part"
    figure.savefig(part, dpi=dpi, format="png")
    os.replace(part, path)
