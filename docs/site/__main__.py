#!/usr/bin/python3
"""Builds the documentation site of the pages of the whole repository; checks links, commands, excerpts of commits.

Parameters are printed by the drivers' programs, so these have to be built; `./run site` does. Formulas are drawn by
KaTeX (libjs-katex), the C++ interface is described where doxygen is installed. The site needs no network.

Usage: /usr/bin/python3 docs/site [--output FOLDER] [--no-cpp]
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from tree import ROOT, Mistake  # noqa: E402

REMEDY = "the site is built by mkdocs, which is not installed: sudo apt install mkdocs-material libjs-katex"


def build(folder, with_cpp):
    from cpp_reference import describe
    from navigation import write_configuration
    from stage import stage
    if not stage(folder / "pages"):
        print("formulas stay as they are written: libjs-katex is not installed (sudo apt install libjs-katex)")
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    command = ["mkdocs", "build", "--strict", "--clean", "--quiet", "--config-file", write_configuration(folder)]
    done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}{done.stderr}error: mkdocs has not built the site, see above")
    if not describe(folder / "html" / "reference" / "cpp", with_cpp) and with_cpp:
        print("without the C++ interface: doxygen is not installed (sudo apt install doxygen)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    build_folder = Path(os.environ.get("BERGAMO_BUILD", ROOT / "build" / "release"))
    parser.add_argument("--output", type=Path, default=build_folder / "site", help="folder for pages and html")
    parser.add_argument("--no-cpp", action="store_true", help="without the C++ interface")
    arguments = parser.parse_args()
    try:
        import mkdocs  # noqa: F401
    except ImportError:
        sys.exit(f"error: {REMEDY}")
    from checks import mistakes
    folder = arguments.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    try:
        build(folder, not arguments.no_cpp)
        found = mistakes(folder / "html")
    except Mistake as error:
        sys.exit(f"error: {error}")
    for mistake in found:
        print(mistake, file=sys.stderr)
    if found:
        sys.exit(f"error: {len(found)} mistakes in the pages, see above")
    print(f"{folder / 'html' / 'index.html'}\nto search in it: python3 -m http.server --directory '{folder / 'html'}'")


if __name__ == "__main__":
    main()
