#!/usr/bin/env python3
"""Builds the site: pages of all documents, of the program's options and of the interfaces, by Sphinx; then checks it.

Warnings are errors, and so are links between pages that lead nowhere. Nothing is fetched from a network.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from wend_site import check_commands, check_links
from wend_site.gallery import stage_gallery
from wend_site.interfaces import run_doxygen, stage_interfaces
from wend_site.layout import Layout
from wend_site.options import command_tree, stage_options
from wend_site.python_api import stage_python
from wend_site.sources import stage_notebooks, stage_sources

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# Pages that are lists of others: in an order where there is one, then the rest.
THEORY = [
    "conventions", "learned_field", "distance", "survival", "next_event", "guiding_choice", "reflection", "samples", "subsurface", "planar", "half_space",
]
LISTS = {
    "theory/index.md": ("How it works", "Formulas with their sources, derivations where they are ours, and limits.", THEORY),
    "decisions/index.md": ("Decisions", "Choices that are costly to reverse, and their reasons.", []),
}
BIBLIOGRAPHY = "# Literature\n\n```{bibliography}\n:all:\n```\n"


def stage(layout: Layout, tree: list[dict]) -> None:
    """Writes all pages for Sphinx."""
    layout.stage_documents()
    stage_notebooks(layout)
    stage_options(layout, tree)
    stage_gallery(layout)
    stage_interfaces(layout)
    stage_python(layout)
    stage_sources(layout)
    for page, (title, text, first) in LISTS.items():
        folder = Path(page).parent.as_posix()
        others = sorted(Path(name).stem for name in layout.written if Path(name).parent.as_posix() == folder)
        pages = [*first, *(name for name in others if name not in first and name != "index")]
        layout.write(page, "\n".join([f"# {title}", "", text, "", "```{toctree}", "", *pages, "```", ""]))
    layout.write("bibliography.md", BIBLIOGRAPHY)


def drop_old_pages(layout: Layout, html: Path) -> None:
    """Removes what an earlier build made of documents that are no more."""
    for path in layout.pages.rglob("*.md"):
        page = path.relative_to(layout.pages)
        if page.as_posix() not in layout.written:
            path.unlink()
            (html / page).with_suffix(".html").unlink(missing_ok=True)


def run_sphinx(pages: Path, output: Path, environment: dict[str, str]) -> None:
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-j", "auto", "-b", "html"]
    command += ["-c", str(HERE), "-d", str(output / "doctrees"), str(pages), str(output / "html")]
    done = subprocess.run(command, env={**os.environ, **environment}, check=False)
    if done.returncode != 0:
        sys.exit("build.py: Sphinx has warnings or errors, above")


def offences(output: Path, tree: list[dict]) -> list[str]:
    """What is wrong with the built pages and with the commands that they show."""
    found = check_links.offences(output / "html")
    for path in [HERE / "index.md", *sorted((HERE / "tutorials").glob("*.md"))]:
        found += check_commands.offences(path.read_text(), tree, str(path.relative_to(ROOT)))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wend", type=Path, required=True, help="the program")
    parser.add_argument("--doxyfile", type=Path, required=True, help="as CMake configured it")
    parser.add_argument("--python", type=Path, required=True, help="the folder that has the package wend")
    parser.add_argument("--version", required=True, help="Wend's")
    parser.add_argument("--output", type=Path, required=True, help="folder for what is made; the site is html/index.html in it")
    options = parser.parse_args()
    output = options.output.resolve()
    pages = output / "pages"
    tree = command_tree(options.wend)
    layout = Layout(ROOT, pages)
    stage(layout, tree)
    drop_old_pages(layout, output / "html")
    environment = {
        "WEND_VERSION": options.version,
        "WEND_DOXYGEN_XML": str(run_doxygen(options.doxyfile, output / "doxygen")),
        "PYTHONPATH": str(options.python.resolve()),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    run_sphinx(pages, output, environment)
    found = offences(output, tree)
    if found:
        sys.exit("\n".join(found))
    print(f"{output / 'html' / 'index.html'}: the site")


if __name__ == "__main__":
    main()
