#!/usr/bin/env python3
"""Breaks the code on purpose, one place at a time, and says whether the tests notice.

Each line of table.py is a mutation: a text of a source file, what it becomes, and the tests that should fail then. They
are made in a copy of the working tree, built with the release preset; --here makes them in the tree itself, where a
build is at hand, and takes each back. A mutation is caught where its tests fail, hang or crash, not compiled where the
compiler refuses it, stale where the file does not hold the text exactly once, and it survives where the tests pass.
Every result goes to results.txt in the folder; what stands there is not run again without --again.

Usage: run.py [--only PART] [--again] [--here] [--list] [--stale] [--folder DIR] [--jobs N]
Ends with status 1 where a mutation survived or is stale.
"""

import argparse
import filecmp
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from table import MUTATIONS, TESTS

ROOT = Path(__file__).resolve().parents[2]
LONGEST_TEST = 600  # s


class Checkout:
    """A copy of the working tree with a build of its own."""

    def __init__(self, tree, jobs):
        self.tree, self.jobs = tree, jobs
        self.build = self.tree / "build" / "release"
        if tree != ROOT:
            self.take_over()

    def take_over(self):
        self.tree.mkdir(parents=True, exist_ok=True)
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                                check=True, capture_output=True).stdout
        for name in listed.decode().split("\0"):
            source, copy = ROOT / name, self.tree / name
            if source.is_file() and not (copy.is_file() and filecmp.cmp(source, copy, shallow=False)):
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)
        subprocess.run(["cmake", "--preset", "release"], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def compile(self, target):
        """@return whether it compiled"""
        command = ["ninja", "-C", self.build, f"-j{self.jobs}", target]
        return subprocess.run(command, capture_output=True).returncode == 0

    def passes(self, target, tests):
        command = [word.format(build=self.build, tree=self.tree, tests=tests) for word in TESTS[target]]
        try:
            return subprocess.run(command, cwd=self.build, capture_output=True, timeout=LONGEST_TEST).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def is_stale(mutation, tree):
    return (tree / mutation.file).read_text().count(mutation.old) != 1


def outcome_of(mutation, checkout, sound):
    path = checkout.tree / mutation.file
    text = path.read_text()
    if is_stale(mutation, checkout.tree):
        return "stale"
    if (mutation.target, mutation.tests) not in sound:
        if not checkout.compile(mutation.target) or not checkout.passes(mutation.target, mutation.tests):
            return "unsound"  # its tests fail as it is
        sound.add((mutation.target, mutation.tests))
    try:
        path.write_text(text.replace(mutation.old, mutation.new))
        if not checkout.compile(mutation.target):
            return "not compiled"
        return "survived" if checkout.passes(mutation.target, mutation.tests) else "caught"
    finally:
        path.write_text(text)


def read_results(path):
    lines = path.read_text().splitlines() if path.exists() else []
    return dict(line.split(": ", 1)[::-1] for line in lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", metavar="PART", help="mutations whose file has this in its path")
    parser.add_argument("--again", action="store_true", help="those that have a result, too")
    parser.add_argument("--here", action="store_true", help="in the working tree, which must not change meanwhile")
    parser.add_argument("--list", action="store_true", help="show them and do nothing")
    parser.add_argument("--stale", action="store_true", help="show those that are and do nothing else")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "mutations", metavar="DIR")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="compilers at a time")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped"))  # and takes back what is broken
    chosen = [mutation for mutation in MUTATIONS if arguments.only in mutation.file]
    if arguments.list:
        for mutation in chosen:
            print(mutation)
        return 0
    if arguments.stale:
        stale = [mutation for mutation in chosen if is_stale(mutation, ROOT)]
        for mutation in stale:
            print(mutation)
        return 1 if stale else 0
    arguments.folder.mkdir(parents=True, exist_ok=True)
    results = arguments.folder / "results.txt"
    known = {} if arguments.again else read_results(results)
    left = [mutation for mutation in chosen if str(mutation) not in known]
    if left:
        checkout, sound = Checkout(ROOT if arguments.here else arguments.folder / "tree", arguments.jobs), set()
        for mutation in left:
            start = time.monotonic()
            known[str(mutation)] = outcome_of(mutation, checkout, sound)
            print(f"{known[str(mutation)]}: {mutation} ({time.monotonic() - start:.0f} s)", flush=True)
            results.write_text("".join(f"{outcome}: {name}\n" for name, outcome in known.items()))
    counts = {}
    for mutation in chosen:
        counts[known[str(mutation)]] = counts.get(known[str(mutation)], 0) + 1
    print(", ".join(f"{number} {outcome}" for outcome, number in sorted(counts.items())), f"of {len(chosen)}")
    return 1 if any(outcome in counts for outcome in ("survived", "stale", "unsound")) else 0


if __name__ == "__main__":
    sys.exit(main())
