"""Docstrings, whose markup is Markdown's, as Sphinx reads them."""

import re
from typing import Any

QUOTED = re.compile(r"(?<!`)`([^`]+)`(?!`)(\w?)")
# Stands for a colon meanwhile.
COLON = "\ue000"
NAME = re.compile(r"[A-Za-z_][\w.]*(\(\))?")


def as_rst(lines: list[str]) -> list[str]:
    """A docstring with the same meaning: code between backticks, between fences, or indented after a blank line."""
    result: list[str] = []
    in_fence = False
    for line in lines:
        if line.strip().startswith("```"):
            in_fence = not in_fence
            result += [".. code-block:: python", ""] if in_fence else [""]
        elif in_fence:
            result.append("    " + line)
        else:
            if begins_code(line, result):
                result += [".. code-block:: python", ""]
            result.append(line)
    return quoted_as_rst("\n".join(result)).split("\n")


def begins_code(line: str, before: list[str]) -> bool:
    """Whether an indented block begins that is not what follows a heading such as "Args:"."""
    if not line.startswith("    ") or len(before) < 2 or before[-1].strip():
        return False
    return not before[-2].startswith((" ", ".. "))


def quoted_as_rst(text: str) -> str:
    def replacement(match: re.Match[str]) -> str:
        words = " ".join(match[1].split())
        quoted = f":py:obj:`{words.removesuffix('()')}`" if NAME.fullmatch(words) else f"``{words}``"
        return quoted + ("\\ " + match[2] if match[2] else "")

    return QUOTED.sub(replacement, text)


def process(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Before napoleon, which knows the sections, but would take what a property is up to a colon for its type."""
    lines[:] = as_rst(lines)
    if what == "property":
        lines[:] = [line.replace(":", COLON) for line in lines]


def process_at_last(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """After napoleon."""
    lines[:] = [line.replace(COLON, ":") for line in lines]
