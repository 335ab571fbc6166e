"""What goes wrong in reading a run, each with the thing, what it is, and the remedy in its message."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class Error(Exception):
    """Any of these."""


class MissingFile(Error, FileNotFoundError):
    """A folder or a file is not there, or not yet."""


class DamagedFile(Error, ValueError):
    """A file does not hold what its kind holds."""


class MissingData(Error, LookupError):
    """A file of this kind does not hold what was asked for; another one does."""


class UnknownName(Error, KeyError):
    """No column, figure, parameter or array has this name; the message says which are near."""

    def __str__(self) -> str:  # KeyError's would put the message into quotes
        return str(self.args[0]) if self.args else ""


class BadArgument(Error, ValueError):
    """An argument that makes no sense: an empty box, an axis beyond z, a length that is not positive."""


def near_names(name: str, names: Iterable[str], most: int = 3) -> list[str]:
    """Names that were perhaps meant: spelt alike, or with all words of what was given."""
    names = list(names)
    words = name.lower().replace("/", "_").split("_")
    alike = difflib.get_close_matches(name, names, n=most, cutoff=0.6)
    holding = [other for other in names if all(word in other.lower() for word in words)]
    return list(dict.fromkeys(alike + sorted(holding, key=len)))[:most]


def unknown_name(what: str, name: str, names: Iterable[str]) -> UnknownName:
    """@param what "history.csv has no column" """
    names = list(names)
    near = near_names(name, names)
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else f"there are: {', '.join(names) or 'none'}"
    return UnknownName(f"{what} '{name}'; {hint}")
