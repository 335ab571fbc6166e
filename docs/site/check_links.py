"""Links of the built site lead to files and anchors that are there."""

from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

ATTRIBUTES = {"a": "href", "link": "href", "img": "src", "script": "src"}
WITHOUT_NETWORK = ("link", "img", "script")  # what a page fetches by itself


class Page(HTMLParser):
    """Anchors and links of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.targets = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(value for name, value in attributes if name == "id")
        target = values.get(ATTRIBUTES.get(tag, ""))
        if target and values.get("rel") != "canonical":
            self.targets.append((tag, target))


def mistakes(html):
    """@param html folder of the site; what doxygen has made there is taken as it is"""
    described = html / "reference" / "cpp"
    pages = {path: Page(path.read_text()) for path in sorted(html.rglob("*.html"))
             if described not in path.parents and path.name != "404.html"}
    return [f"{path.relative_to(html)}: {wrong}" for path, page in pages.items() for tag, target in page.targets
            if (wrong := mistake_of(path, tag, target, pages))]


def mistake_of(path, tag, target, pages):
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return f"fetches '{target}' from the network" if tag in WITHOUT_NETWORK and parts.scheme != "data" else None
    file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not file.is_file():
        return f"dead link '{target}'"
    anchor = unquote(parts.fragment)
    if anchor and file in pages and anchor not in pages[file].anchors:
        return f"'{target}': the page has no anchor '{anchor}'"
    return None
