"""Figures that a run leaves at its end."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .errors import DamagedFile, MissingFile, unknown_name
from .units import unit_of


class Summary(Mapping[str, Any]):
    """The figures of summary.json by name: int, float, bool, str or a list of float. Infinite or undefined ones, null in
    the file, are nan. Names carry their units (`wall_time_s`); `units` has them apart.
    """

    def __init__(self, figures: Mapping[str, Any], path: Path | None = None) -> None:
        self._figures = {name: float("nan") if value is None else value for name, value in figures.items()}
        self.path = path

    def __getitem__(self, name: str) -> Any:
        """A figure; UnknownName, with the nearest names, where there is none of this name."""
        try:
            return self._figures[name]
        except KeyError:
            raise unknown_name(f"{self.path or 'the summary'} has no figure", name, self._figures) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def __contains__(self, name: object) -> bool:
        return name in self._figures

    def __repr__(self) -> str:
        return f"<Summary of {len(self)} figures: {', '.join(self)}>"

    @property
    def units(self) -> dict[str, str]:
        """Unit of every figure; empty for those without one."""
        return {name: unit_of(name) for name in self}


def read_summary(path: Path | str) -> Summary:
    """MissingFile where there is none: the run is not at its end. DamagedFile where it is no object of JSON."""
    path = Path(path)
    try:
        figures = json.loads(path.read_text())
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}; a run writes it at its end") from None
    except ValueError as error:
        raise DamagedFile(f"{path} is damaged: {error}") from None
    if not isinstance(figures, dict):
        raise DamagedFile(f"{path} is damaged: it holds no figures by name")
    return Summary(figures, path)
