"""Archives of a run: HDF5 files with a seal in front (dem/core/archive.h)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Union

import numpy as np

from .errors import DamagedFile, MissingFile, unknown_name

Item = Union[np.ndarray, float, int, str]

SEAL_SIZE = 512  # bytes, HDF5's user block


class Archive:
    """Arrays, numbers and texts by their paths in an HDF5 file, read when asked for: `archive["dem/time"]`.

    MissingFile where there is none, DamagedFile where it is truncated or no archive of Bergamo; HDF5 checks the arrays
    themselves (Fletcher32) as they are read.
    """

    def __init__(self, path: Path | str) -> None:
        import h5py
        self.path = Path(path)
        check_seal(self.path)
        self._items: dict[str, tuple[int, ...]] = {}
        try:
            with h5py.File(self.path, "r") as file:
                self.kind = text_of(file.attrs.get("kind", b""))  # "two-scale triaxial test"
                file.visititems(lambda name, item: self._items.update({name: item.shape})
                                if isinstance(item, h5py.Dataset) else None)
        except OSError as error:
            raise DamagedFile(f"{self.path} is damaged: {error}") from None

    @property
    def names(self) -> list[str]:
        return list(self._items)

    def __contains__(self, name: object) -> bool:
        return name in self._items

    def __getitem__(self, name: str) -> Item:
        """An array (flat, as the file has it), a number or a text; UnknownName with the nearest names."""
        return self.group({name: name})[name]

    def group(self, wanted: dict[str, str]) -> dict[str, Item]:
        """Several items at once. @param wanted their paths by the names that they shall have"""
        import h5py
        for path in wanted.values():
            if path not in self._items:
                raise unknown_name(f"{self.path} holds no", path, self._items)
        try:
            with h5py.File(self.path, "r") as file:
                return {name: item_of(file[path][()]) for name, path in wanted.items()}
        except OSError as error:
            raise DamagedFile(f"{self.path} is damaged: {error}") from None

    def arrays(self, group: str) -> dict[str, np.ndarray]:
        """The arrays that lie directly in a group, by name, flat as the file has them."""
        start = group.rstrip("/") + "/"
        inner = {name[len(start):]: name for name in self._items if name.startswith(start)}
        items = self.group({name: path for name, path in inner.items() if "/" not in name})
        return {name: item for name, item in items.items() if isinstance(item, np.ndarray)}


def check_seal(path: Path) -> None:
    try:
        with open(path, "rb") as file:
            seal = file.read(SEAL_SIZE).decode("ascii", "replace")
            size = file.seek(0, 2)
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}") from None
    found = re.match(r"bergamo archive\nformat (\d+)\nlength (\d+)\n", seal)
    if not found:
        raise DamagedFile(f"{path} is no archive of Bergamo: it does not begin with 'bergamo archive'")
    if int(found[1]) != 1:
        raise DamagedFile(f"{path} has format {found[1]}; this package reads format 1, take that of its version")
    if int(found[2]) != size - SEAL_SIZE:
        raise DamagedFile(f"{path} is damaged: {size - SEAL_SIZE} bytes follow its seal, which says {found[2]}")


def item_of(value: Any) -> Item:
    """What h5py has read, numbers and texts as Python's own."""
    if isinstance(value, np.ndarray):
        return value
    return value.decode() if isinstance(value, bytes) else value.item()


def text_of(value: object) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)
