"""The drivers' parameters, as their programs print them."""

import functools
import os
import re
import subprocess
import sys
from itertools import groupby
from pathlib import Path

from tree import ROOT, Mistake, drivers

sys.path.insert(0, str(ROOT / "drivers" / "python"))
from bergamo.parameters import parse_parameters  # noqa: E402  the one place that knows how a parameter file reads

INDEX = """# Parameters

Of all drivers, by section, as the programs print them; explained as in the first driver that is named, whose page has
defaults and ranges. On the command line: `--set "Section/name=value"`.
"""


def folder():
    """Where the programs lie: BERGAMO_DRIVERS, or the build's."""
    build = os.environ.get("BERGAMO_BUILD", ROOT / "build" / "release")
    return Path(os.environ.get("BERGAMO_DRIVERS", Path(build) / "drivers"))


@functools.cache
def of(driver):
    """All parameters of a driver by their paths, "Section/name", in its order; Mistake where it is not built."""
    program = folder() / driver
    try:
        done = subprocess.run([program, "--print-parameters"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise Mistake(f"{program} does not print its parameters ({error}); "
                      f"build it: ninja -C {folder().parent} {driver}")
    return parse_parameters(done.stdout, program).flat()


def section_of(path):
    return path.rpartition("/")[0]


def escaped(text):
    """Plain words in a cell of a table."""
    return re.sub(r"([\\|*_\[])", r"\\\1", text).replace("<", "&lt;")


def name_of(path):
    return escaped(path.rpartition("/")[2])


def row(*cells):
    return f"| {' | '.join(cells)} |"


def allowed(parameter):
    return escaped(parameter.allowed.removeprefix("one of ").removeprefix("a number ")) or "any"


def table_of(driver):
    """A table for each section of a driver."""
    lines = ["Printed by the program: `--print-parameters` writes them as a file.\n"]
    for section, members in groupby(of(driver).items(), key=lambda entry: section_of(entry[0])):
        lines += [f"\n### {section} {{ #{anchor(section)} }}\n", row("name", "default", "unit", "allowed", ""),
                  "|---|---|---|---|---|"]
        for path, parameter in members:
            default = f"`{parameter.text}`" if parameter.text else ""
            lines.append(row(name_of(path), default, escaped(parameter.unit), allowed(parameter),
                             escaped(parameter.explanation)))
    return "\n".join(lines) + "\n"


def anchor(section):
    """Of a section's table on a driver's page."""
    return "parameters-" + re.sub(r"\W+", "-", section.lower())


def index():
    """Which driver has which parameter."""
    users = {}
    for driver in drivers():
        for path, parameter in of(driver).items():
            users.setdefault(path, []).append((driver, parameter))
    lines = [INDEX]
    for section, paths in groupby(sorted(users, key=lambda path: (section_of(path), path)), key=section_of):
        lines += [f"\n## {section}\n", row("name", "unit", "", "drivers"), "|---|---|---|---|"]
        for path in paths:
            first = users[path][0][1]
            links = ", ".join(f"[{driver}](../examples/{driver}.md#{anchor(section)})" for driver, _ in users[path])
            lines.append(row(name_of(path), escaped(first.unit), escaped(first.explanation), links))
    return "\n".join(lines) + "\n"
