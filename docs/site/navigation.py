"""The configuration that mkdocs builds from: docs/mkdocs.yml with the lists of pages that it names filled in."""

import yaml
from mkdocs.utils import yaml_load

import examples
from tree import ROOT, Mistake

CONFIGURATION = ROOT / "docs" / "mkdocs.yml"


def write_configuration(folder):
    """Writes it for a site whose pages lie in folder/pages; Mistake where nav lacks one of them. @return its path"""
    inherited = yaml_load(CONFIGURATION.read_text())
    pages = folder / "pages"
    nav = filled(inherited["nav"], {"EXAMPLES": examples.navigation(), "RESULTS": pages_of(pages, "results")})
    for missing in sorted({str(page.relative_to(pages)) for page in pages.rglob("*.md")}.difference(listed(nav))):
        raise Mistake(f"docs/mkdocs.yml: nav does not have {missing}")
    assets = {name: [file for file in inherited[name] if (pages / file).exists()]  # KaTeX may be missing
              for name in ("extra_css", "extra_javascript")}
    path = folder / "mkdocs.yml"
    path.write_text(yaml.safe_dump({"INHERIT": str(CONFIGURATION), "docs_dir": str(pages),
                                    "site_dir": str(folder / "html"), "nav": nav, **assets}))
    return path


def pages_of(pages, folder):
    """The pages of a folder, its index first."""
    found = sorted((pages / folder).glob("*.md"), key=lambda page: (page.name != "index.md", page.name))
    return [f"{folder}/{page.name}" for page in found]


def filled(nav, lists):
    """A nav in which names of lists stand for these."""
    if isinstance(nav, str):
        return lists.get(nav, nav)
    if isinstance(nav, dict):
        return {title: filled(value, lists) for title, value in nav.items()}
    return [filled(entry, lists) for entry in nav]


def listed(nav):
    """The pages of a nav."""
    for entry in nav:
        value = next(iter(entry.values())) if isinstance(entry, dict) else entry
        yield from listed(value) if isinstance(value, list) else [value]
