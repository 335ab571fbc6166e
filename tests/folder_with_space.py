#!/usr/bin/env python3
"""The project configures in a folder whose path has a space: compiler wrappers that libraries are asked through may not.

Usage: folder_with_space.py CMAKE
"""

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main():
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "a b"
        folder.mkdir()
        (folder / "source").symlink_to(ROOT)
        done = subprocess.run([sys.argv[1], "-S", folder / "source", "-B", folder / "build", "-G", "Ninja",
                               "-DBERGAMO_WITH_FE=OFF", "-DBERGAMO_TESTS=OFF"], capture_output=True, text=True)
    print(done.stdout, done.stderr, sep="")
    sys.exit(done.returncode)


if __name__ == "__main__":
    main()
