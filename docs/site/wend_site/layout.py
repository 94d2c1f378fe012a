"""Which file of the repository becomes which page of the site, and what that makes of the links between them."""

import os
import re
from pathlib import Path, PurePosixPath

# What is a page, by itself or by its folder; the first that fits counts. Pages of a folder keep their names.
PAGES = {
    "README.md": "overview.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "CHANGELOG.md": "project/changelog.md",
    "bench/README.md": "project/measuring.md",
    "scenes/README.md": "project/scenes.md",
    "docs/architecture.md": "project/architecture.md",
    "docs/experiments/README.md": "experiments/index.md",
    "docs/references.bib": "bibliography.md",
}
FOLDERS = {
    "docs/site/": "",
    "docs/theory/": "theory/",
    "docs/experiments/": "experiments/",
    "docs/decisions/": "decisions/",
    "docs/": "guides/",
    "examples/notebooks/": "notebooks/",
}
# Folders whose page is made here, of what is in them.
INDEXED = {"docs/theory": "theory/index.md", "docs/decisions": "decisions/index.md", "examples/notebooks": "notebooks/index.md"}
# What is shown, or given as a file, where it lies.
FILES = {".png", ".jpg", ".svg", ".pbrt"}

# What pages are to have that are lists for readers of the repository, too.
APPENDED = {"experiments/index.md": "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"}

LINK = re.compile(r"\]\(([^()\s]+)\)")
INCLUDED = re.compile(r"^(\s*(?:`{3,}|:{3,})\{(?:literalinclude|figure|image)\} )(\S+)$")
FENCE = re.compile(r"^\s*(`{3,}|~{3,}|:{3,})")


class Layout:
    """Pages and links of one repository.

    Args:
        root: the repository.
        pages: where its pages are written.
    """

    def __init__(self, root: Path, pages: Path) -> None:
        self.root = root
        self.pages = pages
        #: Files and folders that are no pages, but are linked to: as they lie in the repository.
        self.linked_sources: set[str] = set()
        #: Pages that there are.
        self.written: set[str] = set()

    def documents(self) -> list[str]:
        """The documents that are pages, by their paths in the repository."""
        found = [path for path in PAGES if path.endswith(".md") and (self.root / path).exists()]
        for path in sorted((self.root / "docs").rglob("*.md")):
            name = path.relative_to(self.root).as_posix()
            if name not in PAGES:
                found.append(name)
        return found

    def page_of(self, path: str) -> str | None:
        """The page of a file or folder of the repository; None if it has none of its own."""
        if path in PAGES:
            return PAGES[path]
        if path in INDEXED:
            return INDEXED[path]
        if (self.root / path).is_dir():
            return PAGES.get(f"{path}/README.md")
        if PurePosixPath(path).suffix in (".md", ".ipynb"):
            for folder, target in FOLDERS.items():
                if path.startswith(folder):
                    return str(PurePosixPath(target + path.removeprefix(folder)).with_suffix(".md"))
        return None

    def link(self, target: str, document: str) -> str:
        """What a link in a document has to be on the document's page. A broken one stays, for Sphinx to name."""
        name, _, anchor = target.partition("#")
        if not name or re.match(r"[a-z]+:", name):
            return target
        path = os.path.normpath(PurePosixPath(document).parent / name)
        if path.startswith("..") or not (self.root / path).exists():
            return target
        here = self.pages / (self.page_of(document) or "")
        suffix = f"#{anchor}" if anchor else ""
        page = self.page_of(path)
        if page is None and PurePosixPath(path).suffix in FILES:
            return os.path.relpath(self.root / path, here.parent)
        if page is None:
            self.linked_sources.add(path)
            page = source_page(path)
        return os.path.relpath(self.pages / page, here.parent) + suffix

    def file(self, target: str, document: str) -> str:
        """A file that a document names, as its page has to name it."""
        here = self.pages / (self.page_of(document) or "")
        return os.path.relpath(self.root / PurePosixPath(document).parent / target, here.parent)

    def rewritten(self, text: str, document: str) -> str:
        """A document's text with the links of its page; what is code stays, and so do the numbers of lines."""
        lines = []
        fence = ""
        for line in text.split("\n"):
            line = INCLUDED.sub(lambda m: m[1] + self.file(m[2], document), line)
            match = FENCE.match(line)
            if match and not fence:
                fence = match[1]
            elif match and line.strip() == fence:
                fence = ""
            elif not fence or fence.startswith(":"):
                line = LINK.sub(lambda m: f"]({self.link(m[1], document)})", line)
            lines.append(line)
        return "\n".join(lines)

    def stage_documents(self) -> None:
        """Writes the pages of all documents."""
        for document in self.documents():
            text = (self.root / document).read_text()
            page = self.page_of(document) or document
            self.write(page, self.rewritten(text, document) + APPENDED.get(page, ""))

    def write(self, page: str, text: str) -> None:
        """Writes a page, unless it is there already: Sphinx reads again what is newer."""
        path = self.pages / page
        self.written.add(page)
        if not path.exists() or path.read_text() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)


def source_page(path: str) -> str:
    """The page that shows a file, or lists a folder."""
    return f"source/{path}.md"
