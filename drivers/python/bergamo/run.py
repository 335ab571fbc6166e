"""A run's folder: parameters, tables, figures, pictures and snapshots, read when asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from .errors import MissingFile, near_names, unknown_name
from .lock import is_locked
from .parameters import Section, read_parameters
from .pictures import Pictures
from .snapshot import Snapshot
from .summary import Summary, read_summary
from .table import Table, read_table

PREVIOUS = "previous_run"
MARKS = ("parameters.prm", "history.csv", "summary.json", "snapshot.h5")


class Tables(Mapping[str, Table]):
    """The tables of a folder by name without ".csv", each read anew when asked for: `run.tables["mould"]`."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __getitem__(self, name: str) -> Table:
        """UnknownName, with the nearest names, where there is none of this name; else errors as read_table()."""
        path = self.folder / f"{name}.csv"
        if not path.is_file():
            raise unknown_name(f"{self.folder} has no table", name, self)
        return read_table(path)

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(path.stem for path in self.folder.glob("*.csv")))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"<Tables of {self.folder}: {', '.join(self) or 'none'}>"


class Run:
    """A run of a driver, finished or not. Nothing is kept: every look reads what is on the disk now, so a run that goes
    on may be looked at again and again.
    """

    def __init__(self, folder: Path | str, parent: Run | None = None) -> None:
        """See open_run()."""
        self.folder = Path(folder)
        if not self.folder.is_dir():
            what = "a file, no folder" if self.folder.exists() else "no such folder"
            raise MissingFile(f"{self.folder}: {what} of a run{hint_of(self.folder)}")
        self.parent = parent or parent_of(self.folder)
        if not is_run(self.folder):
            inner = [str(path) for path in sub_folders(self.folder)]
            inner += sorted(str(path) for path in self.folder.iterdir() if path.is_dir() and is_run(path))
            raise MissingFile(f"{self.folder} is no folder of a run: it has none of {', '.join(MARKS)} and no pictures"
                              + (f"; runs in it: {', '.join(inner[:5])}" if inner else ""))

    @property
    def name(self) -> str:
        return self.folder.resolve().name

    @property
    def parameters(self) -> Section:
        """All parameters, as nested mapping; of a run within another one those of that. See Section."""
        path = self.folder / "parameters.prm"
        return self.parent.parameters if self.parent and not path.exists() else read_parameters(path)

    @property
    def summary(self) -> Summary:
        """The figures at the end. MissingFile as long as the run is not there; see state."""
        return read_summary(self.folder / "summary.json")

    @property
    def history(self) -> Table:
        """Columns over time, history.csv. MissingFile, naming the runs within, where only these have one."""
        path = self.folder / "history.csv"
        if not path.exists() and self.runs:
            raise MissingFile(f"{self.folder} has no history of its own; runs within: {', '.join(list(self.runs)[:5])}"
                              + (", ..." if len(self.runs) > 5 else ""))
        return read_table(path)

    @property
    def tables(self) -> Tables:
        """All tables of the folder, the history among them, by name."""
        return Tables(self.folder)

    @property
    def pictures(self) -> Pictures:
        """Series of pictures by name; see Pictures."""
        return Pictures(self.folder)

    def snapshot(self, name: str = "snapshot.h5") -> Snapshot:
        """The last state that the run kept to go on from; or another archive of the folder, by name. MissingFile where
        there is none: a run keeps one at every Output/snapshot interval, and where it is stopped.
        """
        path = self.folder / name
        if not path.is_file():
            raise MissingFile(f"{path}: no such file; the run has kept no snapshot (yet); archives in the folder: "
                              f"{', '.join(self.archives) or 'none'}")
        return Snapshot(path)

    @property
    def archives(self) -> list[str]:
        """Names of snapshot.h5 and its like."""
        return sorted(path.name for path in self.folder.glob("*.h5"))

    @property
    def runs(self) -> dict[str, Run]:
        """Runs within this one, as the samples of an ensemble, by their paths from here ("samples/0001")."""
        return {str(path.relative_to(self.folder)): Run(path, self) for path in sub_folders(self.folder)}

    @property
    def previous(self) -> Run | None:
        """The run that was here before, if it was moved aside (--force)."""
        path = self.folder / PREVIOUS
        return Run(path) if path.is_dir() and is_run(path) else None

    @property
    def state(self) -> str:
        """"finished": at its end. "running": a program is writing to the folder. "interrupted": neither; it was stopped
        or killed, and --restart goes on with it where there is a snapshot.
        """
        if self.parent:
            return "finished" if (self.folder / "figures.csv").exists() else self.parent.state
        if is_locked(self.folder):
            return "running"
        return "finished" if (self.folder / "summary.json").exists() else "interrupted"

    @property
    def is_finished(self) -> bool:
        return self.state == "finished"

    @property
    def model(self) -> str:
        """What the run is of, as its summary has it; its folder's name where that has nothing."""
        return str(self._finished_summary().get("model") or self.name)

    @property
    def title(self) -> str:
        """For diagrams: the parameter named title, or else model and folder."""
        try:
            for path, parameter in self.parameters.flat().items():
                if path.split("/")[-1].lower() == "title" and parameter.text:
                    return parameter.text
        except MissingFile:
            pass
        model = self._finished_summary().get("model")
        return f"{model} – {self.name}" if model else self.name

    def _finished_summary(self) -> Mapping[str, object]:
        try:
            return self.summary
        except (OSError, ValueError):  # not there, or damaged
            return {}

    def __repr__(self) -> str:
        return f"<Run {self.folder}: {self.state}>"


def open_run(folder: Path | str) -> Run:
    """Opens a run's folder, `bergamo.open("results/two_scale_triaxial")`.

    MissingFile for a folder that is not there, naming those that were perhaps meant, or that is none of a run.
    """
    return Run(folder)


def is_run(folder: Path) -> bool:
    return any((folder / mark).is_file() for mark in MARKS) or any(folder.glob("*.vtu"))


def sub_folders(folder: Path) -> list[Path]:
    """Folders of runs within a run: one or two floors down, but for what was moved aside."""
    found = [*folder.glob("*/history.csv"), *folder.glob("*/*/history.csv"), *folder.glob("*/*/snapshot.h5")]
    return sorted({path.parent for path in found if PREVIOUS not in path.relative_to(folder).parts})


def parent_of(folder: Path) -> Run | None:
    """The run that a folder without parameters of its own is part of."""
    if (folder / "parameters.prm").exists():
        return None
    above = [path for path in list(folder.resolve().parents)[:2] if (path / "parameters.prm").is_file()]
    return Run(above[0]) if above else None


def hint_of(folder: Path) -> str:
    """Folders beside a missing one that were perhaps meant."""
    if not folder.parent.is_dir():
        return f"; there is no folder {folder.parent} either"
    names = [path.name for path in folder.parent.iterdir() if path.is_dir()]
    near = near_names(folder.name, names)
    return f"; did you mean {' or '.join(str(folder.parent / name) for name in near)}?" if near else ""
