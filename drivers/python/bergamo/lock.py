"""Whether a run is writing to a folder: it holds a lock on the folder for its life (drivers/common/run_folder.h)."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

KERNEL_LIST = Path("/proc/locks")


def is_locked(folder: Path) -> bool:
    """Looks into the kernel's list of locks. Where that does not name the folder, as on a file system whose numbers
    differ or for a run in another container, it asks for a shared lock and gives it back at once.
    """
    try:
        status = os.stat(folder)
    except OSError:
        return False
    device = f"{os.major(status.st_dev):02x}:{os.minor(status.st_dev):02x}:{status.st_ino}"
    try:
        lines = [line.split() for line in KERNEL_LIST.read_text().splitlines()]
    except OSError:
        lines = []
    if any("FLOCK" in words and "WRITE" in words and device in words and "->" not in words for words in lines):
        return True
    return not takes_shared_lock(folder)


def takes_shared_lock(folder: Path) -> bool:
    try:
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError:
        return True  # not ours to say
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return True
    except BlockingIOError:
        return False
    except OSError:
        return True
    finally:
        os.close(descriptor)
