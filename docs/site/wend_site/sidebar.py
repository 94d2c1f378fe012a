"""The sidebar of all pages is made of their titles alone.

The theme asks for it once a page, and Sphinx copies the headings and names of every page for it before it drops them: most of
the time that a build would take.
"""

from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment


def without_headings(contents: nodes.Element) -> nodes.bullet_list:
    """A page's table of contents with its title and the lists of other pages in it."""
    title = next(contents.findall(addnodes.compact_paragraph), None)
    item = nodes.list_item("", *([title.deepcopy()] if title else []))
    lists = [node.deepcopy() for node in contents.findall(addnodes.toctree)]
    if lists:
        item += nodes.bullet_list("", *lists)
    return nodes.bullet_list("", item)


def all_without_headings(environment: BuildEnvironment) -> dict[str, nodes.bullet_list]:
    """Those of all pages, made once a build."""
    made = getattr(environment, "wend_titles", None)
    if made is None:
        made = {page: without_headings(contents) for page, contents in environment.tocs.items()}
        environment.wend_titles = made
    return made


def use_titles(app: Sphinx, page: str, template: str, context: dict[str, Any], document: Any) -> None:
    """Before the theme asks: what it is given for that."""
    ask = context.get("toctree")
    environment = app.env
    if ask is None:
        return

    def toctree(**options: Any) -> str:
        kept = environment.tocs
        environment.tocs = all_without_headings(environment)
        try:
            return ask(**options)
        finally:
            environment.tocs = kept

    context["toctree"] = toctree


def forget_titles(app: Sphinx, environment: BuildEnvironment) -> list[str]:
    """They are of one build: the environment is kept for the next."""
    environment.wend_titles = None
    return []
