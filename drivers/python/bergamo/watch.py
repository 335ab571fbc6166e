"""Follows a run in a terminal until it ends: `python3 -m bergamo watch RUN`. Reads files alone."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from .errors import Error, unknown_name
from .run import Run
from .table import numbers_of
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


class GrowingTable:
    """The last row of a table that a run adds to, and how many there are. Reads what is new alone."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._begin(-1)

    def _begin(self, file: int) -> None:
        self.names: list[str] = []
        self.n_rows = 0
        self.last: dict[str, float] = {}
        self._file, self._read = file, 0  # number of the file, bytes of its whole lines

    def look(self) -> bool:
        """@return whether there is a row by now; DamagedFile where the last one is none."""
        try:
            with open(self.path, "rb") as file:
                status = os.fstat(file.fileno())
                if status.st_ino != self._file or status.st_size < self._read:  # begun anew
                    self._begin(status.st_ino)
                file.seek(self._read)
                new = file.read()
        except OSError:
            return False
        whole = new[:new.rfind(b"\n") + 1]
        self._read += len(whole)
        lines = [line for line in whole.decode().splitlines() if line.strip()]
        if lines and not self.names:
            self.names = lines.pop(0).split(",")
        self.n_rows += len(lines)
        if lines:
            values = numbers_of(self.path, [",".join(self.names), lines[-1]], len(self.names))[0]
            self.last = dict(zip(self.names, map(float, values)))
        return self.n_rows > 0

    def __getitem__(self, name: str) -> float:
        if name not in self.last:
            raise unknown_name(f"{self.path} has no column", name, self.names)
        return self.last[name]


@dataclass
class Watch:
    """What a watch prints with, and when."""

    stream: TextIO
    interval: float = 1.  # [s]
    columns: Sequence[str] = ()
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep
    tables: dict[Path, GrowingTable] = field(default_factory=dict)

    def follow(self, run: Run) -> bool:
        """Prints a line a look until the run is no longer running; on a terminal one live line.

        @return whether the run is finished. UnknownName for a column that its history has not.
        """
        pace: Pace | None = None
        is_live, shown = self.stream.isatty(), ""
        while True:
            state = run.state  # before the rows: what a run has written when it ends is not missed
            table = self.latest_history(run)
            if table is not None and pace is None:
                pace = Pace(table.n_rows, self.clock())
            line = self.line(run, table, pace) if table is not None else "no samples yet"
            if line != shown or state != "running":
                self.print_line(line, is_live)
                shown = line
            if state != "running":
                break
            self.sleep(self.interval)
        self.stream.write(("\n" if is_live else "") + ending(run, state) + "\n")
        return state == "finished"

    def latest_history(self, run: Run) -> GrowingTable | None:
        """The history that was written to last, of the run or of one within it; none without a whole row."""
        folders = [run.folder, *(inner.folder for inner in run.runs.values())]
        files = [path for path in (folder / "history.csv" for folder in folders) if path.exists()]
        tables = [self.tables.setdefault(path, GrowingTable(path)) for path in files]
        grown = [table for table in tables if table.look()]
        return max(grown, key=lambda table: os.stat(table.path).st_mtime_ns) if grown else None

    def line(self, run: Run, table: GrowingTable, pace: Pace | None) -> str:
        """One look: where the run stands, and the last row."""
        folder = table.path.parent
        words = [] if folder == run.folder else [str(folder.relative_to(run.folder))]
        words.append(f"t = {short(table['time_s'])} s")
        wanted = expected_rows(run) if folder == run.folder else None
        words.append(f"row {table.n_rows}" + (f" of about {wanted}" if wanted else ""))
        left = pace.seconds_left(table.n_rows, wanted, self.clock()) if pace and wanted else None
        if left is not None:
            words.append(f"{duration(left)} left")
        if run.runs:
            inner = run.runs.values()
            words.append(f"{sum(one.is_finished for one in inner)} of {len(inner)} runs within are finished")
        names = self.columns or [name for name in table.names if name not in ("time_s", "stage")][:COLUMNS]
        words += [f"{name} = {short(table[name])}" for name in names]
        return "  ".join(words)

    def print_line(self, line: str, is_live: bool) -> None:
        if is_live:
            width = shutil.get_terminal_size().columns - 1
            self.stream.write("\r" + line[:width].ljust(width))
        else:
            self.stream.write(line + "\n")
        self.stream.flush()


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
