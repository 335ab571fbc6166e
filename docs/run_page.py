#!/usr/bin/python3
"""Runs the Python of a page of this folder, block after block in one namespace, and puts what each prints below it.

A block is fenced by ```python; what it prints stands in the block ```text that follows it. Runs in the present folder, where
the runs that the page opens lie in results/; pictures go to docs/. The package bergamo is that of the checkout.

Usage: run_page.py PAGE [--check]   --check leaves the page as it is: only errors count
"""

import argparse
import contextlib
import io
import os
import re
import sys
from pathlib import Path

PACKAGE = str(Path(__file__).resolve().parents[1] / "drivers" / "python")
sys.path.insert(0, PACKAGE)
os.environ["PYTHONPATH"] = PACKAGE  # of programs that the page starts

BLOCK = re.compile(r"(```python\n)(.*?)(```\n)(?:\n```text\n.*?```\n)?", re.DOTALL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    import matplotlib
    matplotlib.use("Agg")
    text, namespace = arguments.page.read_text(), {"__name__": arguments.page.stem}

    def with_output(found):
        line = text[:found.start(2)].count("\n")
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):  # errors name the line of the page
            exec(compile("\n" * line + found[2], arguments.page, "exec"), namespace)
        output = printed.getvalue()
        return "".join(found.groups()[:3]) + (f"\n```text\n{output}```\n" if output else "")

    page = BLOCK.sub(with_output, text)
    if not arguments.check:
        arguments.page.write_text(page)


if __name__ == "__main__":
    main()
