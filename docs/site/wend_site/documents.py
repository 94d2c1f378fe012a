"""A Sphinx extension: citations become links, formulas are set, and mathematics is MathML, which needs no network."""

import re
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform

from . import citations, docstrings, sidebar
from .formulas import IN_TEXT, formula_html

# As tests/layers/check_citations.py has them.
ENTRY = re.compile(r"^@\w+\{\s*([a-z]+(?:19|20)[0-9]{2}[a-z]?)\s*,", re.MULTILINE)
FORMULA_PAGES = ("theory/", "experiments/")


class Citations(SphinxTransform):
    """A key of the bibliography between backticks is a citation."""

    default_priority = 400

    def apply(self, **kwargs: Any) -> None:
        keys = set(ENTRY.findall(Path(self.config.wend_bibliography).read_text()))
        for literal in list(self.document.findall(nodes.literal)):
            key = literal.astext()
            if key in keys and not isinstance(literal.parent, nodes.reference):
                literal.replace_self(citation(key, self.env.docname))


def citation(key: str, document: str) -> nodes.Node:
    """What {cite:t}`key` makes."""
    inner = nodes.inline(key, key, classes=["xref", "cite"])
    return addnodes.pending_xref(
        key, inner, refdomain="cite", reftype="t", reftarget=key, refdoc=document, refwarn=True, support_smartquotes=False
    )


class Formulas(SphinxTransform):
    """What is indented on the theory's pages is a formula, and single letters may have indices."""

    default_priority = 401

    def apply(self, **kwargs: Any) -> None:
        if not self.env.docname.startswith(FORMULA_PAGES):
            return
        for block in list(self.document.findall(nodes.literal_block)):
            # A block between fences is code, or a table of figures.
            if block.get("language", "none") in ("none", "default") and "```" not in block.rawsource:
                lines = (formula_html(line) for line in block.astext().rstrip().split("\n"))
                text = f'<div class="formula">{"<br/>".join(lines)}</div>'
                block.replace_self(nodes.raw(block.rawsource, text, format="html"))
        for text in list(self.document.findall(nodes.Text)):
            if not isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.raw, nodes.math, nodes.title)):
                replace_in_text(text)


def replace_in_text(text: nodes.Text) -> None:
    parts: list[nodes.Node] = []
    end = 0
    for match in IN_TEXT.finditer(text):
        parts += [nodes.Text(text[end : match.start()]), nodes.raw(match[0], formula_html(match[0]), format="html")]
        end = match.end()
    if parts:
        text.parent.replace(text, [*parts, nodes.Text(text[end:])])


def visit_inline_math(translator: Any, node: nodes.math) -> None:
    translator.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def visit_math_block(translator: Any, node: nodes.math_block) -> None:
    translator.body.append(f'<div class="math">{tex2mathml(node.astext(), as_block=True)}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    citations.register()
    app.add_config_value("wend_bibliography", "", "env", str)
    app.add_transform(Citations)
    app.add_transform(Formulas)
    # Napoleon has 500.
    app.connect("autodoc-process-docstring", docstrings.process, priority=400)
    app.connect("autodoc-process-docstring", docstrings.process_at_last, priority=600)
    # The theme has 500.
    app.connect("html-page-context", sidebar.use_titles, priority=400)
    app.connect("env-updated", sidebar.forget_titles)
    app.add_html_math_renderer("mathml", (visit_inline_math, None), (visit_math_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
