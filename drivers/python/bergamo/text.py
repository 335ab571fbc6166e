"""Numbers and tables for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any


def short(value: Any) -> str:
    """A figure with six digits at most."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(short(item) for item in value)
    return str(value)


def percent(share: float) -> str:
    return f"{100 * share:+.3g} %"


def duration(seconds: float) -> str:
    """75 s as "1 min 15 s", 7300 s as "2 h 01 min"."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def aligned(rows: Iterable[Sequence[str]], right: Sequence[int] = (), indent: str = "  ") -> list[str]:
    """Lines with columns of equal width. @param right numbers of the columns that end at one place"""
    rows = [list(row) for row in rows]
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))] if rows else []
    return [(indent + "  ".join(word.rjust(width) if k in right else word.ljust(width)
                                for k, (word, width) in enumerate(zip(row, widths)))).rstrip() for row in rows]
