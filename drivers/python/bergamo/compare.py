"""Two runs beside each other: `python3 -m bergamo compare A B`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .diagram import COLOURS, mark_stages, new_panels, save_whole, time_axis
from .errors import MissingData, MissingFile
from .run import Run
from .table import Table
from .text import aligned, percent, short

PANELS_ACROSS = 4


@dataclass(frozen=True)
class Difference:
    """How much a column of two histories differs, at the times of the first within the times of the second."""

    name: str
    largest: float  # of |b - a|
    time: float  # where it is [s]
    first: float  # values there
    second: float
    scale: float  # largest |a|

    @property
    def relative(self) -> float:
        """Over the largest value of the first; infinite where that is zero and the other is not."""
        return self.largest / self.scale if self.scale > 0 else (math.inf if self.largest > 0 else 0.)


def history_differences(first: Table, second: Table) -> list[Difference]:
    """Of all columns that both have, the largest relative one first; the second is joined by straight lines between its
    rows. MissingData where their times do not meet, or where one has no rows yet.
    """
    if not (first.n_rows and second.n_rows):
        raise MissingData(f"{(second if first.n_rows else first).path} has no samples yet")
    time, other = first["time_s"], second["time_s"]
    shared = (time >= other[0]) & (time <= other[-1])
    if not shared.any():
        raise MissingData(f"the histories have no time in common: {time[0]:.6g} to {time[-1]:.6g} s and "
                          f"{other[0]:.6g} to {other[-1]:.6g} s")
    found = []
    for name in first:
        if name == "time_s" or name not in second:
            continue
        a, b = first[name][shared], np.interp(time[shared], other, second[name])
        size = np.abs(b - a)
        if np.isfinite(size).any():
            at = int(np.nanargmax(size))
            found.append(Difference(name, float(size[at]), float(time[shared][at]), float(a[at]), float(b[at]),
                                    float(np.nanmax(np.abs(a)))))
    return sorted(found, key=lambda difference: -difference.relative)


def compare(first: Run, second: Run) -> str:
    """Differences of all figures and of all columns of the histories, as a text for a terminal."""
    names = distinct_names(first, second)
    lines = [f"A: {first.folder} ({first.state})", f"B: {second.folder} ({second.state})", "Parameters that differ"]
    lines += parameter_lines(first, second) or ["  none"]
    lines += ["Figures", *figure_lines(first, second)]
    lines += ["Largest differences of the history's columns", *history_lines(first.history, second.history)]
    for name, only, other in ((names[0], first.history, second.history), (names[1], second.history, first.history)):
        alone = [column for column in only if column not in other]
        if alone:
            lines.append(f"Columns of {name} alone: {', '.join(alone)}")
    return "\n".join(lines)


def parameter_lines(first: Run, second: Run) -> list[str]:
    try:
        a, b = ({path: parameter.text for path, parameter in run.parameters.flat().items()} for run in (first, second))
    except MissingFile as error:
        return [f"  {error}"]
    return aligned([path, a.get(path, "-"), b.get(path, "-")] for path in {**a, **b} if a.get(path) != b.get(path))


def figure_lines(first: Run, second: Run) -> list[str]:
    found = []
    for run in (first, second):
        try:
            found.append(run.summary)
        except MissingFile as error:
            return [f"  {error}"]
    a, b = found
    rows = [["", "A", "B", "B - A", "of A"]]
    for name in {**a, **b}:
        values = [figures[name] if name in figures else None for figures in found]
        rows.append([name, *("-" if value is None else short(value) for value in values), *difference_of(*values)])
    return aligned(rows, right=(1, 2, 3, 4))


def difference_of(a: Any, b: Any) -> tuple[str, str]:
    """Of two figures, and over the first."""
    if any(isinstance(value, (bool, str, list)) or value is None for value in (a, b)):
        return ("", "") if a == b or None in (a, b) else ("differ", "")
    return short(b - a), percent((b - a) / abs(a)) if a else ""


def history_lines(first: Table, second: Table) -> list[str]:
    rows = [["", "difference", "of the largest", "at time in s", "A", "B"]]
    for found in history_differences(first, second):
        rows.append([found.name, short(found.largest), percent(found.relative).lstrip("+"), short(found.time),
                     short(found.first), short(found.second)])
    return aligned(rows, right=(1, 2, 3, 4, 5))


def distinct_names(first: Run, second: Run) -> tuple[str, str]:
    """For a legend: the folders' names, or their paths where these are alike."""
    return (first.name, second.name) if first.name != second.name else (str(first.folder), str(second.folder))


def check_columns(runs: Sequence[Run], names: Sequence[str]) -> None:
    """UnknownName, with the nearest names, where a run's history lacks one of the columns."""
    for history in (run.history for run in runs):
        for name in names:
            history[name]


def draw(first: Run, second: Run, path: Path | str, columns: Sequence[str] = ()) -> Path:
    """Draws the curves of both over one another, a panel a column, into a PNG.

    @param columns of the histories; where none is named, all that both have but for those of zeros
    """
    a, b = first.history, second.history
    names = list(columns) or [name for name in a if name in b and name not in ("time_s", "stage")
                              and (a[name].any() or b[name].any())]
    if not names:
        raise MissingData(f"{a.path} and {b.path} have no column in common that is not zero throughout")
    check_columns((first, second), names)
    across = min(PANELS_ACROSS, len(names))
    figure, panels = new_panels(math.ceil(len(names) / across), across)
    unit = time_axis(max((a["time_s"], b["time_s"]), key=lambda time: time[-1]))[1]
    factor = 1e3 if unit == "ms" else 1
    for axes, name in zip(panels.ravel(), names):
        for table, colour, style in ((a, COLOURS[0], "-"), (b, COLOURS[1], "--")):
            axes.plot(table["time_s"] * factor, table[name], color=colour, linestyle=style,
                      marker="o" if table.n_rows == 1 else None)
        mark_stages(axes, a["time_s"] * factor, a)
        axes.set_title(name, fontsize=10, loc="left")
        axes.set_xlabel(f"time in {unit}", fontsize=9)
    for axes in panels.ravel()[len(names):]:
        axes.set_axis_off()
    panels[0, 0].legend(panels[0, 0].get_lines()[:2], distinct_names(first, second), fontsize=9)
    save_whole(figure, path, dpi=80)
    return Path(path)
