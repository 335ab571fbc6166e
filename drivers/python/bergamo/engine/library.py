"""The compiled part, once it is loaded."""

from __future__ import annotations

from functools import cache
from types import ModuleType

from .binary import load


@cache
def library() -> ModuleType:
    """ImportError, naming the target to build, where it is not built."""
    return load()
