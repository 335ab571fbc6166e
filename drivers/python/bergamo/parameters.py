"""Parameters of a run from its parameters.prm, which has each with its explanation, unit and range."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Union

from .errors import DamagedFile, MissingFile, unknown_name
from .table import is_number
from .units import unit_of_text

Value = Union[bool, int, float, tuple[float, ...], str]

SET = re.compile(r"set\s+(.*?)\s*=\s*(.*)")
DEFAULT = re.compile(r"\s*#\s*default:\s*(.*)")


@dataclass(frozen=True)
class Parameter:
    """One parameter as its file has it."""

    path: str  # "Section/Inner section/name"
    text: str  # as written
    value: Value
    explanation: str = ""  # without unit and range
    unit: str = ""  # "Pa", "kg/m3"; empty for numbers without one
    allowed: str = ""  # "a number > 0"
    usual: str = ""  # "1e+06 to 1e+12", where the program warns of all else
    default: str | None = None  # where the run's value is another


class Section(Mapping[str, Union["Section", Value]]):
    """Values by name, sections by theirs, in the order of the file: `parameters["Grains"]["friction"]`, or in one go
    `parameters["Grains/friction"]`. Numbers are int, float or a tuple of float, truths bool, all else str.
    """

    def __init__(self, path: str = "", file: Path | None = None) -> None:
        self.path, self.file = path, file
        self._entries: dict[str, Section | Parameter] = {}

    def __getitem__(self, name: str) -> Section | Value:
        entry = self._entry(name)
        return entry.value if isinstance(entry, Parameter) else entry

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __contains__(self, name: object) -> bool:
        try:
            self._entry(str(name))
        except KeyError:
            return False
        return True

    def __repr__(self) -> str:
        return f"<Section {self.path or self.file}: {', '.join(self)}>"

    def about(self, name: str) -> Parameter:
        """A parameter with its text, unit and range; UnknownName for a section or a name that is not there."""
        entry = self._entry(name)
        if isinstance(entry, Section):
            raise unknown_name(f"{self.file or 'the file'}: a section is no parameter,", name, entry.flat())
        return entry

    def unit(self, name: str) -> str:
        """Unit of a parameter; empty for one without."""
        return self.about(name).unit

    def flat(self) -> dict[str, Parameter]:
        """All parameters of this section and those in it, by their paths from here."""
        result: dict[str, Parameter] = {}
        for name, entry in self._entries.items():
            if isinstance(entry, Section):
                result.update({f"{name}/{path}": parameter for path, parameter in entry.flat().items()})
            else:
                result[name] = entry
        return result

    def _entry(self, name: str) -> Section | Parameter:
        entry: Section | Parameter | None = self
        for word in name.split("/"):
            entry = entry._entries.get(word) if isinstance(entry, Section) else None
        if entry is None:
            raise unknown_name(f"{self.file or 'the file'}: no parameter", f"{self.path}/{name}".lstrip("/"),
                               [f"{self.path}/{path}".lstrip("/") for path in [*self._entries, *self.flat()]])
        return entry

    def _section(self, name: str) -> Section:
        inner = self._entries.setdefault(name, Section(f"{self.path}/{name}".lstrip("/"), self.file))
        if not isinstance(inner, Section):
            raise DamagedFile(f"{self.file}: '{name}' is a parameter and a section")
        return inner


def read_parameters(path: Path | str) -> Section:
    """Reads a parameter file. One that a run has written explains every parameter; in others only values are known.

    MissingFile where there is none, DamagedFile where a section does not end or ends twice.
    """
    path = Path(path)
    try:
        text = path.read_text()
    except OSError as error:
        raise MissingFile(f"{path}: {error.strerror}; every run writes parameters.prm as it begins") from None
    return parse_parameters(text, path)


def parse_parameters(text: str, path: Path | None = None) -> Section:
    """@param text of a parameter file; @param path for messages"""
    sections = [Section("", path)]
    comment: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if line.startswith("#"):
            comment.append(line.lstrip("#").strip())
            continue
        statement = line.partition("#")[0].strip()
        if statement.startswith("subsection "):
            sections.append(sections[-1]._section(statement[len("subsection "):].strip()))
        elif statement == "end":
            if len(sections) == 1:
                raise DamagedFile(f"{path}: line {number} ends a section that has not begun")
            sections.pop()
        elif found := SET.fullmatch(statement):
            parameter = parameter_of(f"{sections[-1].path}/{found[1]}".lstrip("/"), found[2], " ".join(comment))
            default = DEFAULT.fullmatch(line[len(statement):])
            if default:
                parameter = Parameter(**{**vars(parameter), "default": default[1].strip()})
            sections[-1]._entries[found[1]] = parameter
        elif statement:
            raise DamagedFile(f"{path}: line {number} is neither 'set NAME = VALUE' nor a section: {statement}")
        comment = []
    if len(sections) > 1:
        raise DamagedFile(f"{path}: the section {sections[-1].path} has no end")
    return sections[0]


def parameter_of(path: str, text: str, comment: str) -> Parameter:
    """@param comment "what it is [unit]. Allowed: a number > 0. Usual: 1 to 10." """
    explanation, _, allowed = comment.partition("Allowed: ")
    explanation = explanation.strip().rstrip(".").strip()
    unit = unit_of_text(explanation)
    if unit:
        explanation = explanation[:explanation.rindex("[")].strip()
    allowed, usual = (part.strip().rstrip(".") for part in allowed.partition("Usual: ")[::2])
    return Parameter(path, text, value_of(text, allowed), explanation, unit, allowed, usual)


def value_of(text: str, allowed: str = "") -> Value:
    """The value that a text stands for; where its range is not known, the one that it looks like."""
    parts = [part.strip() for part in text.split(",")] if text else []
    is_list = "separated by commas" in allowed or (not allowed and len(parts) > 1)
    if is_list and all(map(is_number, parts)):
        return tuple(map(float, parts))
    if allowed == "true or false" or not allowed:
        if text in ("true", "yes", "false", "no"):
            return text in ("true", "yes")
    if allowed.startswith("a whole number") or not allowed:
        if re.fullmatch(r"[+-]?\d+", text):
            return int(text)
    if (allowed.startswith("a number") or not allowed) and is_number(text):
        return float(text)
    return text
