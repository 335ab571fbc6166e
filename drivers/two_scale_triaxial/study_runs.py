"""What the studies of the two-scale cube share: runs of the driver that are not run again, and the errors of stresses."""

import argparse
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common" / "plots"))
import run_data

STRESSES = ["stress_1_Pa", "stress_2_Pa", "stress_3_Pa"]


def run(program, folder, settings, files=("two_scale_triaxial.prm",)):
    """Runs the driver on parameter files of this folder unless FOLDER holds a finished run; false where it fails."""
    if run_data.read_summary(folder):
        return True
    options = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    result = subprocess.run([program, *(HERE / file for file in files), "--output", folder, "--force", "--no-plots",
                             "--quiet", "--threads", "1", *options], capture_output=True, text=True)
    if result.returncode != 0:
        print(f"{folder}: {result.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
    return result.returncode == 0


def errors(history, reference, from_start):
    """Largest differences of the three principal stresses over the path, over the largest of the reference [%]; none of
    a run that has ended early. @param from_start stresses count from their starts"""
    if len(history["time_s"]) < len(reference["time_s"]):
        return None
    values = lambda h: [h[name] - (h[name][0] if from_start else 0) for name in STRESSES]
    largest = max(abs(stress).max() for stress in values(reference))
    return [100 * abs(a - b).max() / largest for a, b in zip(values(history), values(reference))]


def argument_parser(description):
    """What every study asks for: the driver's program, and a folder for the runs."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="the driver two_scale_triaxial")
    parser.add_argument("folder", type=Path, help="of the runs")
    return parser
