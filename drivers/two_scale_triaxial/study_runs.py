"""What the studies of the two-scale cube share: runs of the driver, and the errors of stresses."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common" / "plots"))
import numpy as np
import run_data
import studies

STRESSES = ["stress_1_Pa", "stress_2_Pa", "stress_3_Pa"]


def run(program, folder, settings, files=("two_scale_triaxial.prm",)):
    """Runs the driver on parameter files of this folder unless FOLDER holds a finished run; false where it fails."""
    return studies.run(program, folder, settings, [HERE / file for file in files])


def same_packing(folder):
    """Settings of a run over the grains of another one, that of FOLDER."""
    return {"Packing/sample": folder / "sample.h5"}


def differences(history, reference, from_start):
    """Differences of the three principal stresses over the path, over the largest of the reference [%]; none of a run
    that has ended early. @param from_start stresses count from their starts"""
    times = reference["time_s"]
    if history["time_s"][-1] < 0.999 * times[-1]:
        return None
    values = lambda h: [np.interp(times, h["time_s"], h[name]) - (h[name][0] if from_start else 0) for name in STRESSES]
    largest = max(abs(stress).max() for stress in values(reference))
    return [100 * (a - b) / largest for a, b in zip(values(history), values(reference))]


def errors(history, reference, from_start):
    """Largest of the differences() of each stress."""
    found = differences(history, reference, from_start)
    return [abs(difference).max() for difference in found] if found else None


def argument_parser(description, over_packings=True):
    return studies.argument_parser(description, "two_scale_triaxial", over_packings)
