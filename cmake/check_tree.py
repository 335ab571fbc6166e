#!/usr/bin/env python3
"""Checks that the root holds only what is named here, that no name of a file needs quotes, and that scripts can be called.

In a git checkout the files are those that git tracks; elsewhere all there are, but for build*/ and results/. Prints one
line for each violation, "file: what is wrong", and ends with status 1 if there is any.
Usage: check_tree.py [SOURCE_FOLDER]
"""

import os
import re
import subprocess
import sys

ROOT = {
    ".ci", ".clang-format", ".gitignore", "ARCHITECTURE.md", "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md",
    "LICENSE", "README.md", "benchmarks", "cmake", "coupling", "dem", "docs", "drivers", "fe_dealii", "run", "tests",
}
PLAIN_NAME = re.compile(r"[A-Za-z0-9_./+-]+")


def tracked(root):
    """What git tracks below the root; nothing where there is no git, or none that knows this folder."""
    try:
        listing = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, check=False)
    except OSError:
        return []
    return [os.fsdecode(name) for name in listing.stdout.split(b"\0") if name] if listing.returncode == 0 else []


def present(root):
    for folder, folders, files in os.walk(root):
        if folder == root:
            folders[:] = [name for name in folders if name not in (".git", "results") and not name.startswith("build")]
            files = [name for name in files if name != ".git"]  # a worktree's
        folders[:] = [name for name in folders if name != "__pycache__"]
        for file in files:
            yield os.path.relpath(os.path.join(folder, file), root)


def violation_of(root, path):
    if path.split("/")[0] not in ROOT:
        return "does not belong to the root, says cmake/check_tree.py"
    if not PLAIN_NAME.fullmatch(path):
        return "names are made of letters, digits and _ . + - alone"
    place = os.path.join(root, path)
    if os.path.isfile(place) and first_line(place).startswith(b"#!"):
        if not os.access(place, os.X_OK):
            return "begins as a program does, but is none: chmod +x"
        if path.startswith("drivers/") and first_line(place).rstrip() == b"#!/usr/bin/env python3":
            return "write #!/usr/bin/python3: another Python has none of Debian's packages"
    return None


def first_line(place):
    with open(place, "rb") as file:
        return file.readline(100)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(here)
    paths = sorted(tracked(root) or present(root))
    if not paths:
        sys.exit(f"error: no files in {root}")
    violations = [f"{path!r}: {wrong}" for path in paths if (wrong := violation_of(root, path))]
    print("\n".join(violations) if violations else f"tree: {len(paths)} files, all in their places")
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
