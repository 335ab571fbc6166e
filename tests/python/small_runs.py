"""Runs for the tests: small ones of drivers, each made once a process, and folders written by hand."""

import atexit
import functools
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "drivers" / "python"), str(ROOT / "tests" / "regression")]

from driver_process import n_rows, stop_when  # noqa: E402

DRIVERS = Path(os.environ.get("BERGAMO_DRIVERS", ROOT / "build" / "release" / "drivers"))
KEPT = Path(tempfile.mkdtemp())
atexit.register(shutil.rmtree, KEPT, True)


def command(driver, folder, *settings):
    words = [word for setting in settings for word in ("--set", setting)]
    return [str(DRIVERS / driver), str(ROOT / "drivers" / driver / "smoke.prm"), "--output", str(folder), "--quiet",
            "--no-plots", "--threads", "1", *words]


@functools.cache
def run_of(driver, *settings):
    """The folder of a run to its end."""
    folder = KEPT / f"{driver}_{len(list(KEPT.iterdir()))}"
    result = subprocess.run(command(driver, folder, *settings), capture_output=True, text=True)
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return folder


@functools.cache
def stopped_run_of(driver, table, rows, *settings):
    """The folder of a run that was stopped by Ctrl-C once a table had so many rows: its snapshot is of the last step."""
    folder = KEPT / f"{driver}_{len(list(KEPT.iterdir()))}_stopped"
    stop_when(lambda: n_rows(folder / table) >= rows, command(driver, folder, *settings), signal.SIGINT)
    return folder


class FolderCase(unittest.TestCase):
    """A folder that goes with the test."""

    def setUp(self):
        self.tmp = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tmp, True)

    def write(self, name, text):
        path = self.tmp / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path
