"""Runs of a driver as a user starts them, and such that are stopped at an event, however fast the machine is."""

import csv
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

# A snapshot as often as the driver looks at the clock, so that steps decide when there is one.
SNAPSHOTS_BY_STEPS = ["--set", "Output/snapshot interval=1e-9"]
OF_THE_CLOCK = ("wall", "particle", "share", "core", "threads")  # first words of figures that are no results


def stop_when(happened, command, send=signal.SIGKILL):
    """Starts a run and sends it the signal as soon as happened() is true, which must be long before its end.

    @return what it printed; AssertionError if it ended by itself
    """
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        while process.poll() is None and not happened():
            time.sleep(0.005)
        process.send_signal(send)
        stdout, stderr = process.communicate()
    finally:
        process.kill()
        process.wait()
    if process.returncode != (-send if send == signal.SIGKILL else 128 + send):
        raise AssertionError(f"the run ended by itself, with status {process.returncode}:\n{stderr}")
    return subprocess.CompletedProcess(command, process.returncode, stdout, stderr)


def renewal(path):
    """Tells from now on whether a file has appeared or was written anew."""
    def stamp():
        try:
            status = os.stat(path)
        except FileNotFoundError:
            return None
        return status.st_ino, status.st_mtime_ns

    before = stamp()
    return lambda: stamp() not in (None, before)


def n_rows(history, wanted=lambda row: True):
    """Whole rows of a table that a run is writing, as lists of texts; none if it is not there yet."""
    try:
        lines = history.read_text().split("\n")[1:-1]
    except FileNotFoundError:
        return 0
    return sum(wanted(line.split(",")) for line in lines)


class DriverCase(unittest.TestCase):
    """Runs of one driver into a folder that goes with the test. A subclass names its program and parameter file."""

    program = parameters = None

    def setUp(self):
        self.tmp = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tmp, True)

    def command(self, output, settings=(), *options, file=None):
        words = [word for setting in settings for word in ("--set", setting)]
        return [str(self.program), str(file or self.parameters), "--output", str(output), "--no-plots", "--quiet", *words,
                *options]

    def run_driver(self, *arguments, **files):
        return subprocess.run(self.command(*arguments, **files), capture_output=True, text=True)

    def figures(self, name, settings=(), *options, file=None):
        """The summary of a run that must succeed, in the folder of that name."""
        result = self.run_driver(self.tmp / name, settings, *options, file=file)
        self.check_success(result)
        return json.loads((self.tmp / name / "summary.json").read_text())

    def table(self, name, *path):
        """A table of a run, its history unless named; each row the numbers by column."""
        with open(self.tmp.joinpath(name, *(path or ("history.csv",))), newline="") as lines:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def assert_same_results(self, run, whole):
        """The figures of two runs, to the last bit; what tells of the machine's speed may differ."""
        runs = [json.loads((self.tmp / name / "summary.json").read_text()) for name in (run, whole)]
        figures, expected = ({key: value for key, value in figures.items() if key.split("_")[0] not in OF_THE_CLOCK}
                             for figures in runs)
        self.assertEqual(figures, expected)

    def check_success(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)

    def assert_refused(self, settings, *words, status=2, writes=False):
        """One message that has all words, and no folder unless the run had begun."""
        out = self.tmp / "refused"
        result = self.run_driver(out, settings)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
        self.assertEqual(out.exists(), writes)


class OneThreadCase(DriverCase):
    """Runs of so few grains that they are not worth a team of threads; those that succeed have nothing to say."""

    def command(self, *arguments, **files):
        words = super().command(*arguments, **files)
        return words if "--threads" in words else [*words, "--threads", "1"]

    def check_success(self, result):
        super().check_success(result)
        self.assertEqual(result.stderr, "")
