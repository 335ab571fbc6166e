#!/usr/bin/env python3
"""What ./run tells of a build goes to standard error, also into a terminal: `./run DRIVER --print-parameters > my.prm` holds
what the driver has written alone. CMake, Ninja and the driver are stand-ins.

Usage: run_output.py
"""

import os
import pty
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STAND_INS = {
    "dpkg-query": "echo installed",
    "cmake": "true",
    "ninja": """echo '[1/1] Building'
        sleep 1
        mkdir -p "$BERGAMO_BUILD/drivers"
        printf '#!/bin/sh\\necho parameters\\n' >"$BERGAMO_BUILD/drivers/penetration"
        chmod +x "$BERGAMO_BUILD/drivers/penetration" """,
}


def main():
    with tempfile.TemporaryDirectory() as folder:
        programs = Path(folder) / "bin"
        programs.mkdir()
        for name, text in STAND_INS.items():
            (programs / name).write_text(f"#!/bin/sh\n{text}\n")
            (programs / name).chmod(0o755)
        terminal, its_end = pty.openpty()
        environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "BERGAMO_BUILD": f"{folder}/build"}
        result = subprocess.run([ROOT / "run", "penetration", "--print-parameters"], stdout=subprocess.PIPE, stderr=its_end,
                                env=environment, text=True)
        os.close(its_end)
        try:
            told = os.read(terminal, 10000).decode()
        except OSError:  # of a terminal that nothing was written to
            told = ""
    if result.returncode != 0 or result.stdout != "parameters\n" or "Building [1/1]" not in told:
        sys.exit(f"status {result.returncode}, standard output {result.stdout!r}, standard error {told!r}")


if __name__ == "__main__":
    main()
