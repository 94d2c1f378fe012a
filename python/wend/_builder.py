"""Scenes that a program gives: no file, and no text in between."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from . import _wend
from ._errors import InputError
from ._scene import Scene, _checked, _options

_INTEGERS = ("integer", "bool")
_TEXTS = ("string", "texture")


class SceneBuilder:
    """A scene in the terms of pbrt-v4, directive by directive: what its files say, with arrays in place of text.

    ```python
    b = wend.SceneBuilder()
    b.add("LookAt", 0, 0, -4, 0, 0, 0, 0, 1, 0)
    b.add("Camera", "perspective", {"float fov": 40})
    b.add("WorldBegin")
    b.add("LightSource", "infinite", {"rgb L": (1, 1, 1)})
    with b.block("Attribute"):
        b.add("Material", "diffuse", {"rgb reflectance": (0.8, 0.4, 0.2)})
        b.add("Shape", "trianglemesh", {"point3 P": points, "integer indices": triangles})
    film = wend.render(b.scene())
    ```

    Args:
        name: what stands for the file in messages; the line in them is the number of the directive.
        folder: that file names are relative to.
    """

    def __init__(self, *, name: str = "scene", folder: str | os.PathLike[str] = ".") -> None:
        self._name = name
        self._folder = os.fspath(folder)
        self._directives: list[tuple[str, list[str], list[float], list[tuple[str, Any]]]] = []

    def add(self, directive: str, *arguments: Any) -> None:
        """Add a directive.

        Args:
            directive: its name, such as "Shape".
            arguments: texts, or numbers, or a sequence of numbers, as they follow it in a file; in the end, parameters:
                values by "type name", such as {"float radius": 2}. Arrays of any shape are taken flat, in the order of
                memory: points (N, 3), triangles (N, 3). They are not copied until the scene is made, and must not
                change until then.

        Raises:
            InputError: for arguments that are neither; what is wrong with them as a directive is said by `scene`.
        """
        self._directives.append(_directive(directive, arguments))

    def insert(self, position: int, other: SceneBuilder) -> None:
        """What another builder was given, before what was added here when `len` was `position`."""
        self._directives[position:position] = other._directives

    @contextmanager
    def block(self, kind: str = "Attribute", *arguments: Any) -> Iterator[None]:
        """What is added inside stands between `kind`Begin and `kind`End: "Attribute", or "Object" with its
        name."""
        self.add(kind + "Begin", *arguments)
        yield
        self.add(kind + "End")

    def scene(
        self,
        *,
        resolution: tuple[int, int] | None = None,
        crop: tuple[float, float, float, float] | None = None,
        max_depth: int | None = None,
        sampler: str | None = None,
    ) -> Scene:
        """The scene so far. The arguments are those of `load`.

        Raises:
            InputError: for whatever is wrong, with the number of the directive as the line.

        Warns:
            SceneWarning: for what is asked for and is done otherwise, each kind once.
        """
        sequence = _wend.DirectiveSequence(self._name, self._folder)
        for directive in self._directives:
            sequence.add(*directive)
        return _checked(sequence.finish(*_options(resolution, crop, max_depth, sampler)))

    def text(self) -> str:
        """The scene so far as a pbrt-v4 file says it."""
        return "".join(_lines(*directive) for directive in self._directives)

    @property
    def name(self) -> str:
        """What stands for the file in messages."""
        return self._name

    @property
    def size(self) -> int:
        """Bytes of the numbers that parameters hold."""
        return sum(values.nbytes for *_, given in self._directives for _, values in given if isinstance(values, np.ndarray))

    def __len__(self) -> int:
        """How many directives there are."""
        return len(self._directives)

    def __repr__(self) -> str:
        return f"<wend.SceneBuilder {self._name!r}, {len(self)} directives>"


def _directive(directive: str, arguments: tuple[Any, ...]) -> tuple[str, list[str], list[float], list[tuple[str, Any]]]:
    given = list(arguments)
    parameters = given.pop() if given and isinstance(given[-1], Mapping) else {}
    texts = [a for a in given if isinstance(a, str)]
    try:
        numbers = [float(x) for a in given if not isinstance(a, str) for x in np.ravel(a)]
    except (TypeError, ValueError):
        raise InputError(f"{directive}: expected texts and numbers, not {given!r}") from None
    return directive, texts, numbers, [(n, _values(n, v)) for n, v in parameters.items()]


def _values(declared: str, value: Any) -> Any:
    kind = declared.split(" ", 1)[0]
    if isinstance(value, str):
        return [value]
    if kind in _TEXTS or (isinstance(value, (list, tuple)) and value and isinstance(value[0], str)):
        return list(value)
    try:
        array = np.asarray(value)
        # Those of the right type are all whole: a comparison would be copies of them.
        if kind in _INTEGERS and array.dtype != np.int32:
            if not (array.dtype.kind in "iub" and np.array_equal(array, array.astype(np.int32))):
                raise ValueError
        return np.ascontiguousarray(array, dtype=np.int32 if kind in _INTEGERS else np.float32).reshape(-1)
    except (TypeError, ValueError, OverflowError):
        wanted = "whole numbers" if kind in _INTEGERS else "numbers"
        raise InputError(f'"{declared}": expected {wanted}, not {value!r:.80}') from None


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def _written(declared: str, values: Any) -> str:
    if isinstance(values, list):
        return " ".join(map(_quoted, values))
    if declared.startswith("bool "):
        return " ".join("true" if x else "false" for x in values)
    return " ".join(map(str, values)) if values.dtype == np.int32 else " ".join(f"{x:.9g}" for x in values.tolist())


def _lines(directive: str, texts: list[str], numbers: list[float], parameters: list[tuple[str, Any]]) -> str:
    # The one directive whose text is a word.
    words = texts if directive == "ActiveTransform" else map(_quoted, texts)
    line = " ".join([directive, *words])
    if numbers:
        written = " ".join(f"{x:.17g}" for x in numbers)
        line += f" [ {written} ]" if len(numbers) == 16 else " " + written
    return line + "".join(f"\n    {_quoted(n)} [ {_written(n, v)} ]" for n, v in parameters) + "\n"
