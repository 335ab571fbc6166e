"""A run in the browser: `python3 -m bergamo watch RUN --page`. Served to this machine alone."""

from .look import Looks
from .server import HOST, PageServer

__all__ = ["HOST", "Looks", "PageServer"]
