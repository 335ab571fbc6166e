"""Files that appear whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

EXACT = "%.17g"  # reads back as the very same double


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A name to write to, which becomes the path once all is written."""
    part = path.with_name(path.name + ".part")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write_rows(path: Path, head: str, columns: list[np.ndarray], separator: str) -> Path:
    """Rows of numbers below a head. @param columns (n,) or (n, components) each; whole numbers are written as such"""
    formats, flat = [], []
    for column in columns:
        for one in column.reshape(len(column), -1).T:
            formats.append("%d" if one.dtype.kind in "iu" else EXACT)
            flat.append(one.tolist())
    line = separator.join(formats) + "\n"
    with whole(path) as part, open(part, "w") as file:
        file.write(head)
        file.writelines(line % row for row in zip(*flat))
    return path
