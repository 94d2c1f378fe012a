"""Citations: what the bibliography's page and the references to it look like."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import pybtex.plugin
import sphinxcontrib.bibtex.plugin
from pybtex.style.formatting.unsrt import Style as Unsorted
from pybtex.style.labels import BaseLabelStyle
from sphinxcontrib.bibtex.style.referencing import BracketStyle
from sphinxcontrib.bibtex.style.referencing.author_year import AuthorYearReferenceStyle


class KeyLabels(BaseLabelStyle):
    """Entries have the keys that sources cite them by."""

    def format_labels(self, sorted_entries: Iterable[Any]) -> Iterator[str]:
        for entry in sorted_entries:
            yield entry.key


class ByAuthor(Unsorted):
    default_label_style = KeyLabels
    default_sorting_style = "author_year_title"


def no_brackets() -> BracketStyle:
    return BracketStyle(left="", right="")


@dataclass
class AuthorsAndYear(AuthorYearReferenceStyle):
    """A reference as the texts want it, which have brackets of their own: Herholz et al. 2019."""

    bracket_textual: BracketStyle = field(default_factory=no_brackets)


def register() -> None:
    pybtex.plugin.register_plugin("pybtex.style.formatting", "by_author", ByAuthor)
    sphinxcontrib.bibtex.plugin.register_plugin("sphinxcontrib.bibtex.style.referencing", "authors_and_year", AuthorsAndYear)
