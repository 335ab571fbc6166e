"""How the engine computes on this machine."""

from __future__ import annotations

from .library import library


def set_threads(n_threads: int) -> None:
    """Threads of all that is computed from now on, packings too; at first as OMP_NUM_THREADS says, or one for each core.
    Results do not depend on it. After a first computation on several threads do not fork (multiprocessing: "spawn").
    """
    library().set_team(n_threads)


def threads() -> int:
    return library().team()


def pack_width() -> int:
    """Numbers that the engine computes at a time: 8 with AVX-512, 4 with AVX2, 2 with SSE2, as it was built."""
    return library().pack_width
