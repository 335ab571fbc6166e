"""What the page shows of a run at one look, as plain data for JSON."""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..diagram import time_axis
from ..errors import Error, MissingFile
from ..run import Run
from ..table import Table, read_table
from ..text import duration, short
from ..units import unit_of
from ..watch import GrowingTable, Pace, Watch, ending, expected_rows
from .picture import DRAWN, Picture, stamp_of

POINTS = 400  # of a curve at most; more than it has pixels
NO_CURVES = ("time_s", "stage")


class Looks:
    """Looks at a run, one at a time, whoever asks: what is not new is not read again."""

    def __init__(self, run: Run, watch: Watch) -> None:
        """@param watch whose columns, clock and tables count; it prints nothing here"""
        self.run, self.watch = run, watch
        self.picture = Picture()
        self._pace: Pace | None = None
        self._table: tuple[tuple[Path, int, int], Table] | None = None
        self._lock = threading.Lock()

    def look(self) -> dict[str, Any]:
        """State, progress, curves and names of the pictures. What cannot be read is told in "trouble"."""
        with self._lock:
            return self._look()

    def draw(self) -> bytes:
        """PNG of the last pictures in one; MissingFile where there is none."""
        with self._lock:
            return self.picture.draw(self.last_pictures())

    def last_pictures(self) -> dict[str, Path]:
        """The last file of each series that is drawn, by name; MissingFile where there is none yet."""
        last = {name: series.paths[-1] for name, series in self.run.pictures.items() if series.paths}
        drawn = [name for name in DRAWN if name in last] or list(last)[:1]
        if not drawn:
            raise MissingFile(f"{self.run.folder} has no picture (yet)")
        return {name: last[name] for name in drawn}

    def plots(self) -> dict[str, Path]:
        """Diagrams that the run has drawn at its end, by name; none that lead out of its folder."""
        folder = (self.run.folder / "plots").resolve()
        inside = folder.parent == self.run.folder.resolve()
        return {path.name: path for path in sorted(folder.glob("*.png"))
                if inside and path.resolve().parent == folder and path.is_file()}

    def _look(self) -> dict[str, Any]:
        state = self.run.state  # before the rows: what a run has written when it ends is not missed
        result: dict[str, Any] = {"state": state, "title": self.run.title, "folder": str(self.run.folder.resolve()),
                                  "share": 1. if state == "finished" else None, "words": [], "curves": [], "constant": [],
                                  "trouble": [], "picture": None, "plots": list(self.plots())}
        try:
            table = self.watch.latest_history(self.run)
            if table is None:
                result["words"].append("no samples yet")
            else:
                self._add_progress(result, table, state)
                self._add_curves(result, table.path)
        except (Error, OSError) as error:
            result["trouble"].append(str(error))
        if state != "running":
            result["words"].append(ending(self.run, state))
        try:
            names = [path.name for path in self.last_pictures().values()]
            result["picture"] = {"name": ", ".join(names), "version": stamp_of(self.last_pictures())}
        except (Error, OSError):
            pass  # many runs draw none before their end
        return result

    def _add_progress(self, result: dict[str, Any], table: GrowingTable, state: str) -> None:
        is_own = table.path.parent == self.run.folder
        if not is_own:
            result["words"].append(str(table.path.parent.relative_to(self.run.folder)))
        if "time_s" in table.names:
            result["words"].append(f"t = {short(table['time_s'])} s")
        wanted = expected_rows(self.run) if is_own else None
        result["words"].append(f"row {table.n_rows}" + (f" of about {wanted}" if wanted else ""))
        inner = self.run.runs.values()
        if inner:
            n_finished = sum(one.is_finished for one in inner)
            result["words"].append(f"{n_finished} of {len(inner)} runs within are finished")
        if state == "finished" or not wanted:
            return
        result["share"] = min(1., table.n_rows / wanted)
        if state != "running":
            return
        now = self.watch.clock()
        self._pace = self._pace or Pace(table.n_rows, now)
        left = self._pace.seconds_left(table.n_rows, wanted, now)
        if left is not None:
            result["words"].append(f"{duration(left)} left")

    def _add_curves(self, result: dict[str, Any], path: Path) -> None:
        table = self._read(path)
        if table.n_rows == 0:
            return
        time, unit = time_axis(table["time_s"]) if "time_s" in table else (np.arange(table.n_rows) + 1., "row")
        names = self.watch.columns or [name for name in table.names if name not in NO_CURVES]
        result["time_unit"] = unit
        for name in names:
            values = table[name]
            finite = values[np.isfinite(values)]
            last = {"name": name, "unit": unit_of(name), "last": short(float(values[-1]))}
            if len(finite) == 0 or (finite.min() == finite.max() and name not in self.watch.columns):
                result["constant"].append(last)
            else:
                rows = thinned(values, POINTS)
                result["curves"].append({**last, "x": rounded(time[rows]), "y": rounded(values[rows])})

    def _read(self, path: Path) -> Table:
        status = os.stat(path)
        stamp = (path, status.st_mtime_ns, status.st_size)
        if self._table is None or self._table[0] != stamp:
            self._table = stamp, read_table(path)
        return self._table[1]


def thinned(values: np.ndarray, most: int) -> np.ndarray:
    """Rows that draw the same curve: the least and the largest of each of equal pieces, the first and the last.

    @param values (n,); @return numbers of rows, growing, `most` and two at most
    """
    if len(values) <= most:
        return np.arange(len(values))
    rows = [0, len(values) - 1]
    for piece in np.array_split(np.arange(len(values)), most // 2):
        of_piece = values[piece]
        if np.isfinite(of_piece).any():
            rows += [int(piece[np.nanargmin(of_piece)]), int(piece[np.nanargmax(of_piece)])]
    return np.unique(rows)


def rounded(values: Sequence[float] | np.ndarray) -> list[float | None]:
    """Six digits are more than a curve shows; what is no number is a gap."""
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values]
