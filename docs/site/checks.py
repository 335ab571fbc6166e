"""All that can be wrong with the pages, each as "file:line: what"."""

import check_commands
import check_commits
import check_formulas
import check_links
from tree import ROOT, pages


def mistakes(html):
    """Of the pages of the repository and of the site built from them. @param html folder of the site"""
    found = check_links.mistakes(html) + check_formulas.mistakes(html)
    for source in pages():
        text = (ROOT / source).read_text()
        found += check_commands.mistakes(source, text) + check_commits.mistakes(source, text)
    return found
