"""Links within built pages lead somewhere, and nothing is asked of the network to show them.

Other sites' pages may be linked to; whether they are there is not asked.
"""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# What a browser fetches by itself.
FETCHED = {"img": "src", "script": "src", "link": "href", "iframe": "src", "source": "src", "video": "src"}
# Sphinx names pages by it that follow or precede.
PAGES_BY_RELATION = {"next", "prev", "index", "search", "author", "canonical"}


class Page(HTMLParser):
    """The anchors and links of one page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attributes}
        self.anchors.update(values[name] for name in ("id", "name") if name in values)
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        if FETCHED.get(tag) in values:
            target = values[FETCHED[tag]]
            (self.links if values.get("rel") in PAGES_BY_RELATION else self.fetched).append(target)


def offences(folder: Path) -> list[str]:
    """A line for each link of the pages in a folder that leads nowhere, or that a browser would go to the network for."""
    pages = {path.resolve(): Page(path.read_text()) for path in sorted(folder.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(folder.resolve())
        for target in page.fetched:
            if urlsplit(target).netloc:
                found.append(f"{name}: {target} is fetched from the network")
        for target in page.links + page.fetched:
            reason = why_broken(target, path, pages)
            if reason:
                found.append(f"{name}: {target}: {reason}")
    return sorted(set(found))


def why_broken(target: str, path: Path, pages: dict[Path, Page]) -> str:
    """What is wrong with a link; empty if nothing is, or if it leads elsewhere."""
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return ""
    there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not there.is_file():
        return "there is no such file"
    if parts.fragment and there in pages and unquote(parts.fragment) not in pages[there].anchors:
        return "the page has no such anchor"
    return ""
