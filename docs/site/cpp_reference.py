"""The C++ interface, from the comments of the headers, by doxygen."""

import re
import shutil
import subprocess

from tree import ROOT

DOXYFILE = ROOT / "docs" / "site" / "Doxyfile"


def describe(folder, wanted):
    """Lets doxygen fill a folder, or leaves a page there that says how to. @return whether it did"""
    folder.mkdir(parents=True, exist_ok=True)
    doxygen = shutil.which("doxygen") if wanted else None
    if not doxygen:
        (folder / "index.html").write_text("<!doctype html><meta charset=utf-8><title>C++</title><p>Not built: "
                                           "<code>sudo apt install doxygen</code>, then <code>./run site</code>.\n")
        return False
    settings = DOXYFILE.read_text() + f"\nOUTPUT_DIRECTORY = {folder.parent}\nHTML_OUTPUT = {folder.name}\n"
    subprocess.run([doxygen, "-"], input=settings, text=True, cwd=ROOT, check=True, capture_output=True)
    return True


def rooms():
    """The tables of floors of ARCHITECTURE.md, with nothing else."""
    text = (ROOT / "ARCHITECTURE.md").read_text()
    return re.findall(r"(?:^\| floor of .*\n)(?:^\|.*\n)+", text, re.MULTILINE)


def page():
    tables = "\n".join(rooms())
    return ("# C++\n\nPublic headers say shapes, frames, units, preconditions, errors and sources: "
            '<a href="cpp/index.html"><b>all classes and functions</b></a>, by doxygen.\n\n'
            "Where to look, from [Architecture](../architecture.md): an arrow only points down.\n\n" + tables +
            "\nA program of your own links `Bergamo::dem`, `Bergamo::fe`, `Bergamo::coupling` or `Bergamo::adapter`: "
            "[Using it](../overview.md#using-it).\n")
