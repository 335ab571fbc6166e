"""Tables that runs write as CSV: the history and its like."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .errors import BadArgument, DamagedFile, MissingData, MissingFile, unknown_name
from .units import unit_of

if TYPE_CHECKING:
    import pandas


class Table(Mapping[str, np.ndarray]):
    """Columns of numbers by name, as a mapping: `table["time_s"]` is an array of shape (n_rows,).

    Names are those of the file and carry their units (`stress_3_Pa`); `units` has them apart.
    """

    def __init__(self, columns: Mapping[str, np.ndarray], path: Path | None = None) -> None:
        """@param columns arrays of one length, (n_rows,) each; @param path the file, for messages"""
        self._columns = dict(columns)
        self.path = path

    def __getitem__(self, name: str) -> np.ndarray:
        """A column, (n_rows,); UnknownName, with the nearest names, where there is none of this name."""
        try:
            return self._columns[name]
        except KeyError:
            raise unknown_name(f"{self.path or 'the table'} has no column", name, self._columns) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """The number of columns; that of rows is n_rows."""
        return len(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __repr__(self) -> str:
        return f"<Table {self.path.name if self.path else ''}: {self.n_rows} rows of {', '.join(self)}>"

    @property
    def n_rows(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    @property
    def names(self) -> list[str]:
        return list(self._columns)

    @property
    def units(self) -> dict[str, str]:
        """Unit of every column; empty for numbers without one."""
        return {name: unit_of(name) for name in self}

    @property
    def array(self) -> np.ndarray:
        """All of it as a structured array of shape (n_rows,), a field of float64 for each column."""
        array = np.empty(self.n_rows, dtype=[(name, float) for name in self])
        for name, values in self.items():
            array[name] = values
        return array

    def row(self, number: int) -> dict[str, float]:
        """One row by name; -1 is the last one. BadArgument beyond the end."""
        if not -self.n_rows <= number < self.n_rows:
            raise BadArgument(f"{self.path or 'the table'} has {self.n_rows} rows, no row {number}")
        return {name: float(values[number]) for name, values in self.items()}

    def frame(self) -> pandas.DataFrame:
        """All of it as a DataFrame of pandas, if that is installed; MissingData otherwise."""
        try:
            import pandas
        except ImportError:
            raise MissingData("pandas is not installed: apt install python3-pandas; columns and .array need none"
                              ) from None
        return pandas.DataFrame(self._columns)


def read_table(path: Path | str) -> Table:
    """Reads a table of numbers. A row that its run is just writing, which has no line break yet, is left out.

    MissingFile where there is none, DamagedFile, naming the line, for rows of another length or that are no numbers.
    """
    path = Path(path)
    try:
        text = path.read_text()
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}; name the folder of a run") from None
    except UnicodeDecodeError as error:
        raise DamagedFile(f"{path} is damaged: {error}") from None
    lines = text[:text.rfind("\n") + 1].splitlines()
    if not lines or not lines[0].strip():
        raise DamagedFile(f"{path} does not begin with the names of its columns (yet)")
    names = [name.strip() for name in lines[0].split(",")]
    rows = numbers_of(path, lines, len(names))
    return Table(dict(zip(names, rows.T)), path)


def numbers_of(path: Path, lines: list[str], n_columns: int) -> np.ndarray:
    """@return (n_rows, n_columns), of all lines but the first"""
    rows = [line for line in lines[1:] if line.strip()]
    for line in rows:
        if line.count(",") != n_columns - 1:
            raise DamagedFile(f"{path} is damaged: line {lines.index(line) + 1} has {line.count(',') + 1} values, "
                              f"its header {n_columns}")
    try:
        return np.array(",".join(rows).split(",") if rows else [], dtype=float).reshape(len(rows), n_columns)
    except ValueError:
        number, word = next((number, word) for number, line in enumerate(lines[1:], 2) if line.strip()
                            for word in line.split(",") if not is_number(word))
        raise DamagedFile(f"{path} is damaged: '{word}' in line {number} is no number") from None


def is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
