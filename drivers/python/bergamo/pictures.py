"""Pictures that a run writes for ParaView, as arrays: series of VTU files over time."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, overload
from xml.etree import ElementTree

import numpy as np

from .continuum import Continuum
from .contacts import contacts_of_picture
from .errors import DamagedFile, MissingFile, unknown_name
from .grains import grains_of_picture
from .mesh import Mesh, read_vtu
from .surfaces import surfaces_of_picture

NUMBERED = re.compile(r"(.+)_(\d{4,})\.vtu")

# What a series of this name holds; others are meshes as they are.
KINDS: dict[str, Callable[[Mesh, float], Any]] = {
    "grains": grains_of_picture,
    "contacts": contacts_of_picture,
    "surfaces": surfaces_of_picture,
    "continuum": lambda mesh, time: Continuum(time, mesh),
}


class Series(Sequence[Any]):
    """Pictures of one kind over time: `series[-1]` reads the last one, as Grains, Contacts, Surfaces or Continuum by the
    series' name, or as a Mesh (`velocity`, the field of a silo).
    """

    def __init__(self, name: str, times: Sequence[float] | np.ndarray, paths: Sequence[Path]) -> None:
        self.name = name
        self.times = np.asarray(times, dtype=float)  # (number of pictures,) [s]
        self.paths = list(paths)

    def __len__(self) -> int:
        return len(self.paths)

    @overload
    def __getitem__(self, number: int) -> Any: ...

    @overload
    def __getitem__(self, number: slice) -> Series: ...

    def __getitem__(self, number: int | slice) -> Any:
        if isinstance(number, slice):
            return Series(self.name, self.times[number], self.paths[number])
        mesh = read_vtu(self.paths[number])
        return KINDS[self.name](mesh, float(self.times[number])) if self.name in KINDS else mesh

    def at(self, time: float) -> Any:
        """The picture nearest to a time [s]; MissingFile where there is none at all."""
        if not self.paths:
            raise MissingFile(f"there is no picture of {self.name} yet")
        return self[int(np.abs(self.times - time).argmin())]

    def mesh(self, number: int) -> Mesh:
        """A picture as its file has it, points and cells."""
        return read_vtu(self.paths[number])

    def __repr__(self) -> str:
        span = f" from {self.times[0]:.4g} to {self.times[-1]:.4g} s" if len(self) else ""
        return f"<Series {self.name}: {len(self)} pictures{span}>"


class Pictures(Mapping[str, Series]):
    """The series of a run's folder by name: `run.pictures["grains"][-1]`. Read anew when asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def _names(self) -> list[str]:
        names = {path.stem for path in self.folder.glob("*.pvd")}
        names |= {found[1] for path in self.folder.glob("*.vtu") if (found := NUMBERED.fullmatch(path.name))}
        return sorted(names)

    def __getitem__(self, name: str) -> Series:
        """UnknownName, with those that there are, where there are no pictures of this name."""
        index = self.folder / f"{name}.pvd"
        if index.is_file():
            times, paths = read_pvd(index)
            return Series(name, times, paths)
        paths = numbered_files(self.folder, name)
        if not paths:
            raise unknown_name(f"{self.folder} has no pictures of", name, self._names())
        return Series(name, np.full(len(paths), np.nan), paths)  # no times without an index

    def __iter__(self) -> Iterator[str]:
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())

    def __repr__(self) -> str:
        return f"<Pictures of {self.folder}: {', '.join(self) or 'none'}>"


def numbered_files(folder: Path, name: str) -> list[Path]:
    """Files NAME_0000.vtu in the order of their numbers."""
    found = [(int(match[2]), path) for path in folder.glob("*.vtu")
             if (match := NUMBERED.fullmatch(path.name)) and match[1] == name]
    return [path for _, path in sorted(found)]


def read_pvd(path: Path) -> tuple[list[float], list[Path]]:
    """Times [s] and files of a collection of ParaView."""
    try:
        entries = ElementTree.parse(path).getroot().iter("DataSet")
        found = [(float(entry.attrib["timestep"]), path.parent / entry.attrib["file"]) for entry in entries]
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}; name the folder of a run that draws these pictures") from None
    except (ElementTree.ParseError, KeyError, ValueError) as error:
        raise DamagedFile(f"{path} is damaged: {error}") from None
    return [time for time, _ in found], [file for _, file in found]
