"""What the studies of several drivers share: their command line, and runs that are not run again."""

import argparse
import subprocess
import sys
from pathlib import Path

import run_data


def run(program, folder, settings, files):
    """Runs a driver on parameter files unless FOLDER holds a finished run; false where it fails."""
    if run_data.read_summary(folder):
        return True
    options = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    result = subprocess.run([program, *files, "--output", folder, "--force", "--no-plots", "--quiet", "--threads", "1",
                             *options], capture_output=True, text=True)
    if result.returncode != 0:
        print(f"{folder}: {result.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
    return result.returncode == 0


def argument_parser(description, driver, over_packings=True):
    """What every study asks for: the driver's program, a folder for the runs, and over how many packings, if any."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help=f"the driver {driver}")
    parser.add_argument("folder", type=Path, help="of the runs")
    if over_packings:
        parser.add_argument("--seeds", type=int, default=1, help="packings (default 1)")
    return parser
