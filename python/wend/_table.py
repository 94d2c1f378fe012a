"""Tables of results: columns by name, without pandas, and with it."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas


class Table(dict[str, "np.ndarray[Any, Any]"]):
    """Columns by name, all of one length: `table["variance"]` is an array. A notebook shows it."""

    @classmethod
    def of(cls, rows: Iterable[Mapping[str, Any]]) -> Table:
        """Of rows that have the same keys."""
        listed = list(rows)
        names = list(listed[0]) if listed else []
        return cls({name: _column([row[name] for row in listed]) for name in names})

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The same row by row."""
        return [dict(zip(self, values)) for values in zip(*self.values())]

    def dataframe(self) -> pandas.DataFrame:
        """As a pandas DataFrame; pandas must be installed."""
        import pandas

        return pandas.DataFrame({name: list(column) for name, column in self.items()})

    def __repr__(self) -> str:
        cells = [list(self)] + [[_text(value) for value in row.values()] for row in self.rows]
        widths = [max(map(len, column)) for column in zip(*cells)]
        return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in cells)

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(_text(value))}</td>" for value in row.values()) + "</tr>"
            for row in self.rows
        )
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _column(values: list[Any]) -> np.ndarray[Any, Any]:
    if all(isinstance(value, (int, float)) or value is None for value in values):
        integral = all(isinstance(value, int) for value in values)
        return np.array([np.nan if v is None else v for v in values], dtype=np.int64 if integral else np.float64)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def _text(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, (float, np.floating)) else str(value)
