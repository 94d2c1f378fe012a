"""Formulas as the theory's pages have them, one line of text each, set as such: letters slanted, indices low, exponents high."""

import html
import re

BASE = r"[A-Za-zͰ-Ͽ]"
# A letter by itself, or with the d of a differential; an index or exponent; anything else.
TOKEN = re.compile(rf"(?P<raise>[_^])(?P<opens>\{{)?|(?P<letters>{BASE}+)|(?P<other>.)", re.DOTALL)
DIGIT = re.compile(r"\d")
SHORT = re.compile(r"\w+|[±+−∗*]")
# In running text: mu, and one letter that has an index or an exponent.
IN_TEXT = re.compile(rf"(?<!\w)(?:d?mu\d?(?!\w)|{BASE}['′]?(?:[_^](?:\{{[^{{}}]*\}}|[A-Za-z0-9Ͱ-Ͽ]+))+)")
# What has a sign of its own.
WORDS = {"mu": "<i>μ</i>", "sigma": "<i>σ</i>", "sqrt": "√"}
TAGS = {"_": "sub", "^": "sup"}


def formula_html(text: str) -> str:
    """A formula as HTML. What its braces do not close is left as it is."""
    result, end = _rendered(text, 0, closes=False)
    return result if end == len(text) else html.escape(text)


def _rendered(text: str, at: int, closes: bool) -> tuple[str, int]:
    parts = []
    while at < len(text):
        if closes and text[at] == "}":
            return "".join(parts), at + 1
        match = TOKEN.match(text, at)
        assert match is not None  # it takes any character
        at = match.end()
        if match["raise"]:
            tag = TAGS[match["raise"]]
            if match["opens"]:
                inside, at = _rendered(text, at, closes=True)
            elif short := SHORT.match(text, at):
                inside, at = formula_html(short[0]), short.end()
            else:
                parts.append(match["raise"])
                continue
            parts.append(f"<{tag}>{inside}</{tag}>")
        elif match["letters"]:
            parts.append(_letters(match["letters"]))
            if match["letters"].endswith("mu") and (digit := DIGIT.match(text, at)):
                parts.append(f"<sub>{digit[0]}</sub>")
                at = digit.end()
        else:
            parts.append(html.escape(match["other"]))
    return "".join(parts), at + (1 if closes else 0)


def _letters(letters: str) -> str:
    if len(letters) == 1:
        return f"<i>{letters}</i>"
    if letters[0] == "d" and letters[1:] in ("mu", letters[1]):
        return "d" + _letters(letters[1:])
    return WORDS.get(letters, letters)
