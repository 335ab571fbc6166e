"""Markdown as the repository has it, read for the site: sections, links, tables."""

import re

from tree import Mistake, place_of, relative, resolve

FENCE = re.compile(r"^(```+|~~~+).*?^\1[ \t]*$\n?", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.DOTALL)
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^)\s]+)(\))")
HEADING = re.compile(r"^(#+) +(.*?)(?: *\{[^}]*\})? *$", re.MULTILINE)
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
PICTURE = re.compile(r"^!\[[^\]]*\]\([^)]+\)\n", re.MULTILINE)


def outside_code(text, change):
    """The text with `change` applied to all that is no code."""
    done, last = [], 0
    for found in sorted([*FENCE.finditer(text)], key=lambda match: match.start()):
        done += [outside_spans(text[last:found.start()], change), found[0]]
        last = found.end()
    return "".join([*done, outside_spans(text[last:], change)])


def outside_spans(text, change):
    """A link's text may be code, so spans are hidden while the change is made."""
    spans = []

    def hide(found):
        spans.append(found[0])
        return f"\0{len(spans) - 1}\0"

    return re.sub("\0(\\d+)\0", lambda found: spans[int(found[1])], change(CODE.sub(hide, text)))


def blank_code(text):
    """The text with spaces for its blocks of code: all else stays at its place."""
    return FENCE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def is_outside(link):
    return re.match(r"[a-z]+:|#|/", link) is not None


def links(text):
    """Relative links of a page, without their anchors."""
    found = []

    def note(part):
        found.extend(match[2].partition("#")[0] for match in LINK.finditer(part) if not is_outside(match[2]))
        return part

    outside_code(text, note)
    return found


def moved(text, source, place):
    """The text of a page with its links for a place on the site. @param source the page's path from the root"""

    def move(found):
        if is_outside(found[2]):
            return found[0]
        path, sharp, anchor = found[2].partition("#")
        return found[1] + relative(place_of(resolve(path, source)), place) + sharp + anchor + found[3]

    return outside_code(text, lambda part: LINK.sub(move, part))


def slug(heading):
    """The anchor of a heading, as GitHub and the site make it."""
    return re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower()).strip().replace(" ", "-")


def section(text, heading):
    """What stands below a heading, down to the next one of its rank; Mistake where there is none."""
    plain = blank_code(text)
    for found in HEADING.finditer(plain):
        if found[2] == heading:
            following = re.compile(rf"^#{{1,{len(found[1])}}} ", re.MULTILINE).search(plain, found.end())
            return text[found.end():following.start() if following else None].strip("\n") + "\n"
    raise Mistake(f"a page has no section '{heading}'")


def for_python_markdown(text):
    """Python-Markdown wants four spaces before a nested list, where GitHub takes the width of the number."""
    return outside_code(text, lambda part: re.sub(r"^ {2,3}(?=- )", "    ", part, flags=re.MULTILINE))


def without_pictures(text, targets):
    """The text without the pictures that lie at these targets."""
    return PICTURE.sub(lambda found: "" if any(f"({target})" in found[0] for target in targets) else found[0], text)


def figures(text):
    """The pictures of a section, and its first table with the paragraph before it."""
    plain = blank_code(text)
    shown = PICTURE.findall(plain)
    if table := TABLE.search(plain):
        before = plain[:table.start()].rstrip().rpartition("\n\n")[2]
        shown += [before + "\n"] if before and not re.match(r"[#!|]", before) else []
        shown.append(table[0])
    return "\n".join(shown)
