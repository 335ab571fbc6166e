#!/usr/bin/env python3
"""./run in a checkout that cannot be written: one message with the remedy, and nothing of the shell's own.

Usage: read_only_checkout.py
"""

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SKIPPED = 77


def run_read_only(checkout, setting):
    """`./run strip_footing --help` with the checkout mounted for reading alone."""
    inside = f"""mount --bind {ROOT} {checkout} && mount -o remount,bind,ro {checkout} || exit 99
        {setting} {checkout}/run strip_footing --help"""
    return subprocess.run(["unshare", "--map-root-user", "--mount", "bash", "-c", inside], capture_output=True, text=True)


def main():
    with tempfile.TemporaryDirectory() as parent:
        checkout = Path(parent) / "checkout"
        checkout.mkdir()
        for setting, folder in (("", f"{checkout}/build/release"), ("BERGAMO_BUILD=/proc/none", "/proc/none")):
            result = run_read_only(checkout, setting)
            if result.returncode == 99 or "unshare" in result.stderr:
                print("this machine allows no mounts:", result.stderr)
                sys.exit(SKIPPED)
            lines = result.stderr.splitlines()
            if result.returncode != 1 or len(lines) != 1 or not lines[0].startswith("error: ") or \
                    folder not in lines[0] or "BERGAMO_BUILD=" not in lines[0]:
                sys.exit(f"{setting} ./run: status {result.returncode}, {result.stderr}")


if __name__ == "__main__":
    main()
