"""Files of a simulation: their folder, and pictures for bergamo.open(folder).pictures and ParaView."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..pictures import read_pvd
from .errors import RunError
from .library import library


def make_folder(folder: Path) -> None:
    """RunError where it cannot be made."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RunError(f"cannot make the folder {folder}: {error.strerror}; choose another one") from None


def draw_into(folder: Path, model: Any, names: list[str], time: float) -> list[Path]:
    """Adds a picture at a time [s] to each series; later ones, of a run that was begun anew from a snapshot, go."""
    make_folder(folder)
    drawn = []
    for name in names:
        index = folder / f"{name}.pvd"
        times, paths = read_pvd(index) if index.exists() else ([], [])
        frames = [(at, path.name) for at, path in zip(times, paths) if at < time]
        path = folder / f"{name}_{len(frames):04d}.vtu"
        model.draw(name, str(path))
        library().Model.write_pvd(str(index), [*frames, (time, path.name)])
        drawn.append(path)
    return drawn
