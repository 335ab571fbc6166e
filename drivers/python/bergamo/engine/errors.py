"""What goes wrong in a simulation; the texts are those of the library."""

from __future__ import annotations

from ..errors import Error


class ConfigError(Error, ValueError):
    """A value that cannot be; the message names the thing, its value, what is allowed and the remedy. Nothing has changed."""


class RunError(Error, RuntimeError):
    """A simulation that cannot go on (diverged), or a file (disk full, damaged); the message says what, where, the remedy."""


class StaleView(Error, RuntimeError):
    """A view of an array that is no longer the simulation's: grains were sorted, added or removed."""


class Busy(Error, RuntimeError):
    """Another thread is at work on the simulation, or a callback wants to step the simulation that calls it."""
