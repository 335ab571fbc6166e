"""Puts the pages of the site together in a folder that mkdocs builds from."""

import re
import shutil
from pathlib import Path

import cpp_reference
import examples
import gallery
import parameters
import python_reference
from text import for_python_markdown, links, moved, section
from tree import ROOT, pages, place_of, resolve

INCLUDE = re.compile(r"<!-- include (\S+): (.+?) -->\n")
KATEX = Path("/usr/share/javascript/katex")  # Debian's libjs-katex


def page_text(source):
    """A page of the repository as it stands on the site."""
    text, place = (ROOT / source).read_text(), place_of(source)
    if source.startswith("drivers/"):
        return examples.page(source.split("/")[1], examples.entries()[source.split("/")[1]])
    included = {found[0]: moved(section((ROOT / found[1]).read_text(), found[2]), found[1], place)
                for found in INCLUDE.finditer(text)}
    text = moved(text, source, place).replace("<!-- gallery -->\n", gallery.gallery())
    for directive, part in included.items():
        text = text.replace(directive, part)
    return text.replace("# Bergamo\n", "# What Bergamo can do\n", 1) if source == "README.md" else text


def generated():
    """Pages that stand in no file, by their places."""
    return {"examples/index.md": examples.index(), "reference/parameters.md": parameters.index(),
            "reference/python.md": python_reference.page(), "reference/cpp.md": cpp_reference.page()}


def copy_linked(source, folder):
    """Brings what a page links to and is no page itself."""
    for link in links((ROOT / source).read_text()):
        path = resolve(link, source)
        if (ROOT / path).is_file() and not path.endswith(".md"):
            copy(path, folder)


def copy(path, folder):
    target = folder / place_of(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / path, target)


def stage(folder):
    """Fills a folder, which is made anew, with all pages and pictures. @return whether formulas can be drawn"""
    shutil.rmtree(folder, ignore_errors=True)
    for source in pages():
        write(folder / place_of(source), page_text(source))
        copy_linked(source, folder)
    for place, text in generated().items():
        write(folder / place, text)
    for entry in examples.entries().values():
        copy(entry["picture"], folder)
    shutil.copytree(ROOT / "docs" / "site" / "assets", folder / "assets")
    if KATEX.is_dir():
        shutil.copytree(KATEX, folder / "assets" / "katex", ignore=shutil.ignore_patterns("*.mjs"), symlinks=False)
    return KATEX.is_dir()


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(for_python_markdown(text))
