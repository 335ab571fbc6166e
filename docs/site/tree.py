"""Where things lie: in the repository, and on the site."""

import posixpath
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLACES = {"README.md": "overview.md", "docs/front.md": "index.md", "docs/results/README.md": "results/index.md",
          "ARCHITECTURE.md": "architecture.md", "CONTRIBUTING.md": "contributing.md"}


class Mistake(Exception):
    """What someone who writes a page, or builds the site, can mend."""


def drivers():
    """Names of the drivers, sorted: folders with a main.cc."""
    return sorted(main.parent.name for main in (ROOT / "drivers").glob("*/main.cc"))


def pages():
    """All Markdown of the repository that the site shows, as paths from its root."""
    found = sorted(str(path.relative_to(ROOT)) for path in [*ROOT.glob("docs/*.md"), *ROOT.glob("docs/*/*.md")])
    return ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", *found,
            *(f"drivers/{name}/README.md" for name in drivers())]


def place_of(source):
    """Where a file of the repository lies on the site. @param source path from the root, with '/'"""
    parts = source.split("/")
    if source in PLACES:
        return PLACES[source]
    if parts[0] == "docs":
        return "/".join(parts[1:])
    if parts[0] == "drivers" and parts[-1] == "README.md":
        return f"examples/{parts[1]}.md"
    return f"files/{source}"


def resolve(link, source):
    """The path from the root that a relative link of a page means. @param source the page's path from the root"""
    return posixpath.normpath(posixpath.join(posixpath.dirname(source), link))


def relative(target, place):
    """Link from one place of the site to another."""
    return posixpath.relpath(target, posixpath.dirname(place) or ".")
