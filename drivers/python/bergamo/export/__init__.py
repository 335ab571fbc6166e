"""Writes grains and contacts for other programs: `python3 -m bergamo export`. docs/files.md has the formats."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..contacts import Contacts
from ..errors import Error, MissingData, unknown_name
from ..grains import Grains
from ..run import Run, open_run
from ..snapshot import Snapshot
from .ovito import write_dump, write_xyz
from .paraview import write_chains, write_glyphs, write_surfaces
from .tables import write_contacts, write_grains

__all__ = ["Scene", "export", "scene_of", "write_chains", "write_contacts", "write_dump", "write_glyphs", "write_grains",
           "write_surfaces", "write_xyz"]


@dataclass(frozen=True)
class Scene:
    """What is written: a run's state at one time."""

    grains: Grains
    contacts: Contacts | None  # none where a run draws no contacts
    cell: np.ndarray | None  # (3,) edges of a periodic cell from the origin [m]
    contact_files: list[Path]  # contacts.pvd, for ParaView
    source: str  # in words
    steps: int | None = None  # a quarter turn of surfaces and glyphs; none: as write_surfaces() and write_glyphs() have it


KINDS: dict[str, Callable[[Scene, Path], list[Path]]] = {
    "csv": lambda scene, folder: [write_grains(scene.grains, folder / "grains.csv"),
                                  *([write_contacts(scene.contacts, folder / "contacts.csv")] if scene.contacts else [])],
    "dump": lambda scene, folder: [write_dump(scene.grains, folder / "grains.dump", scene.cell)],
    "xyz": lambda scene, folder: [write_xyz(scene.grains, folder / "grains.xyz", scene.cell)],
    "surfaces": lambda scene, folder: [write_surfaces(scene.grains, folder / "surfaces.vtp", scene.steps)],
    "glyphs": lambda scene, folder: write_glyphs(scene.grains, folder, scene.steps),
    "chains": lambda scene, folder: [write_chains(scene.contacts, scene.contact_files, folder / "force_chains.py")],
}
DEFAULT = ("csv", "dump", "xyz")


def scene_of(source: Path | str, picture: int | None = None) -> Scene:
    """The state of a snapshot (a file, or that of a run), or a run's picture.

    @param source folder of a run, or an archive; @param picture its number, -1 the last one; none: the snapshot of the run,
    and its last picture where it has none. Errors as open_run(), Snapshot and Run.pictures.
    """
    path = Path(source)
    if path.is_file():
        if picture is not None:
            raise Error(f"{path} is a snapshot; --picture is for the folder of a run")
        return scene_of_snapshot(Snapshot(path), [])
    run = open_run(path)
    files = [file for file in (run.folder / "contacts.pvd",) if file.is_file()]
    if picture is None and "snapshot.h5" in run.archives:
        try:
            return scene_of_snapshot(run.snapshot(), files)
        except MissingData:  # of a state without grains; the pictures may have some
            pass
    return scene_of_picture(run, -1 if picture is None else picture, files)


def scene_of_snapshot(snapshot: Snapshot, contact_files: list[Path]) -> Scene:
    return Scene(snapshot.grains, snapshot.contacts, snapshot.cell, contact_files, str(snapshot.path))


def scene_of_picture(run: Run, number: int, contact_files: list[Path]) -> Scene:
    grains = run.pictures["grains"]
    if not -len(grains) <= number < len(grains):
        raise Error(f"{run.folder} has {len(grains)} pictures of grains; --picture is {number}, counted from 0 (-1: the "
                    "last)")
    shown: Grains = grains[number]
    contacts = None
    if "contacts" in run.pictures:
        series = run.pictures["contacts"]
        contacts = series[number] if len(series) == len(grains) else series.at(shown.time)
    return Scene(shown, contacts, None, contact_files, str(grains.paths[number]))


def export(scene: Scene, folder: Path | str, kinds: Sequence[str] = DEFAULT) -> list[Path]:
    """Writes a state in several formats. @param folder made where it is missing; @param kinds of KINDS; @return the files"""
    for kind in kinds:
        if kind not in KINDS:
            raise unknown_name("there is no format", kind, KINDS)
    where = Path(folder)
    where.mkdir(parents=True, exist_ok=True)
    return [file for kind in kinds for file in KINDS[kind](scene, where)]
