"""Errors of USD, and of what is written in it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from pxr import Tf  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._errors import InputError

#: What a value of a wrong type, or one that is not finite, ends in.
_BAD_VALUES = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError, Tf.ErrorException)


@contextmanager
def named(prim: Any) -> Iterator[None]:
    """Errors that the prim's values end in are the file's, not ours.

    Raises:
        InputError: with the prim's path.
    """
    try:
        yield
    except InputError:
        raise
    except _BAD_VALUES as error:
        text = reason(error) if isinstance(error, Tf.ErrorException) else str(error)
        raise InputError(f"{prim.GetPath()}: error: a value is none that there can be ({text})") from error


def reason(error: Any) -> str:
    """The first of USD's errors, which tells the place in the text."""
    for part in error.args:
        try:
            text = str(getattr(part, "commentary", part)).strip()
        except UnicodeDecodeError:
            # It quotes what is wrong.
            text = "its text is not UTF-8"
        if text:
            return text
    return "cannot be read"
