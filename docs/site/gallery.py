"""The gallery of the front: cards of all examples, as HTML."""

import html

from examples import groups, readme
from tree import place_of

CARD = """<a class="card" href="{link}"><img src="{picture}" alt="" loading="lazy">
<b>{title}</b><span>{summary}</span></a>
"""


def gallery():
    """Pictures that lead to the pages of the examples, by group."""
    return "".join(f'<h2 class="group">{html.escape(group)}</h2>\n<div class="gallery">\n'
                   + "".join(card(name, entry) for name, entry in members.items()) + "</div>\n"
                   for group, members in groups().items())


def card(name, entry):
    link = place_of(f"drivers/{name}/README.md").replace(".md", ".html")
    return CARD.format(link=link, picture=place_of(entry["picture"]), title=html.escape(entry["title"]),
                       summary=html.escape(readme(name)[0].replace("`", "")))
