"""Follows a run in a terminal until it ends: `python3 -m bergamo watch RUN`. Reads files alone."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from .errors import DamagedFile, Error, MissingFile
from .run import Run
from .table import Table, read_table
from .text import duration, short

ROWS_OF_A_RUN = "Output/samples"  # the parameter that says how many rows a history gets
COLUMNS = 4  # shown where none is named


@dataclass
class Pace:
    """Rows and time of the first look, from which the rest is estimated."""

    rows: int
    clock: float

    def seconds_left(self, rows: int, n_rows: int, now: float) -> float | None:
        if rows <= self.rows or n_rows <= rows:
            return None
        return (now - self.clock) / (rows - self.rows) * (n_rows - rows)


@dataclass
class Watch:
    """What a watch prints with, and when."""

    stream: TextIO
    interval: float = 1.  # [s]
    columns: Sequence[str] = ()
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep

    def follow(self, run: Run) -> bool:
        """Prints a line a look until the run is no longer running; on a terminal one live line.

        @return whether the run is finished. UnknownName for a column that its history has not.
        """
        pace: Pace | None = None
        is_live, shown = self.stream.isatty(), ""
        while True:
            state = run.state  # before the rows: what a run has written when it ends is not missed
            path, table = latest_history(run)
            if table is not None and pace is None:
                pace = Pace(table.n_rows, self.clock())
            line = self.line(run, path, table, pace) if table is not None else "no samples yet"
            if line != shown or state != "running":
                self.print_line(line, is_live)
                shown = line
            if state != "running":
                break
            self.sleep(self.interval)
        self.stream.write(("\n" if is_live else "") + ending(run, state) + "\n")
        return state == "finished"

    def line(self, run: Run, path: Path, table: Table, pace: Pace | None) -> str:
        """One look: where the run stands, and the last row."""
        row = table.row(-1)
        words = [] if path.parent == run.folder else [str(path.parent.relative_to(run.folder))]
        words.append(f"t = {short(row['time_s'])} s")
        wanted = expected_rows(run) if path.parent == run.folder else None
        words.append(f"row {table.n_rows}" + (f" of about {wanted}" if wanted else ""))
        left = pace.seconds_left(table.n_rows, wanted, self.clock()) if pace and wanted else None
        if left is not None:
            words.append(f"{duration(left)} left")
        if run.runs:
            inner = run.runs.values()
            words.append(f"{sum(one.is_finished for one in inner)} of {len(inner)} runs within are finished")
        names = self.columns or [name for name in table.names if name not in ("time_s", "stage")][:COLUMNS]
        words += [f"{name} = {short(float(table[name][-1]))}" for name in names]
        return "  ".join(words)

    def print_line(self, line: str, is_live: bool) -> None:
        if is_live:
            width = shutil.get_terminal_size().columns - 1
            self.stream.write("\r" + line[:width].ljust(width))
        else:
            self.stream.write(line + "\n")
        self.stream.flush()


def latest_history(run: Run) -> tuple[Path, Table | None]:
    """The history that was written to last, of the run or of one within it; none without a whole row."""
    files = [path for path in (run.folder / "history.csv", *(inner.folder / "history.csv" for inner in run.runs.values()))
             if path.exists()]
    for path in sorted(files, key=lambda path: path.stat().st_mtime_ns, reverse=True):
        try:
            table = read_table(path)
        except (MissingFile, DamagedFile):  # just made, or moved aside
            continue
        if table.n_rows:
            return path, table
    return run.folder, None


def expected_rows(run: Run) -> int | None:
    """Of the history at the end, where the run's parameters say so."""
    try:
        return int(run.parameters[ROWS_OF_A_RUN])  # type: ignore[arg-type]
    except Error:
        return None


def ending(run: Run, state: str) -> str:
    if state != "finished":
        has_snapshot = any(one.archives for one in (run, *run.runs.values()))
        return "interrupted" + ("; --restart goes on with it" if has_snapshot else "")
    try:
        summary = run.summary
    except Error:
        return "finished"
    wall = f" in {duration(summary['wall_time_s'])}" if "wall_time_s" in summary else ""
    return f"finished{wall}: " + ", ".join(f"{name} = {short(value)}" for name, value in summary.items()
                                           if name in ("steps", "particles", "energy_residual"))
