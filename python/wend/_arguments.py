"""Arguments as the native part takes them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ._errors import InputError


def whole(value: Any, name: str, low: int, high: int) -> int:
    """`value`, of whatever type, as a whole number in [low, high]."""
    try:
        number = int(value)
        is_whole = bool(number == value)
    except (TypeError, ValueError, OverflowError):
        is_whole = False
    if not is_whole or not low <= number <= high:
        kind = f"positive whole number, at most {high}" if low == 1 else f"whole number from {low} to {high}"
        raise InputError(f"{name}: expected a {kind}, not {value!r}")
    return number


def names_of(values: Iterable[str], name: str) -> list[str]:
    """A list of names. One alone is no list of its letters."""
    given = [values] if isinstance(values, (str, bytes)) else list(values)
    if given == [values] or not all(isinstance(one, str) for one in given):
        raise InputError(f"{name}: expected a list of names, not {values!r}")
    return given


def instance(value: Any, kind: type, name: str, where_from: str) -> Any:
    """`value`, which is of that class."""
    if not isinstance(value, kind):
        raise TypeError(f"{name}: expected a wend.{kind.__name__} ({where_from}), not {value!r}")
    return value
