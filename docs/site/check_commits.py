"""Excerpts of commits that pages explain stand in these commits."""

import re
import subprocess

from tree import ROOT

EXCERPT = re.compile(r"<!-- commit (\w+) -->\n+```diff\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def shown(commit):
    """The lines of a commit's changes; nothing where git does not have it, as in a shallow clone."""
    command = ["git", "-C", ROOT, "show", "--format=", "--unified=50", commit]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError:
        return []
    return done.stdout.splitlines() if done.returncode == 0 else []


def mistakes(source, text):
    found = []
    for excerpt in EXCERPT.finditer(text):
        lines = shown(excerpt[1])
        first = text.count("\n", 0, excerpt.start(2)) + 1
        for number, line in enumerate(excerpt[2].splitlines(), first):
            if lines and line.strip() not in ("", "…") and line not in lines:
                found.append(f"{source}:{number}: commit {excerpt[1]} has no line '{line}'")
    return found
