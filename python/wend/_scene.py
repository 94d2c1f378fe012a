"""Scenes: loading them, looking at their parameters, changing these."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _wend
from ._arguments import whole
from ._errors import InputError, SceneWarning

#: Parameters with more elements are data rather than settings, and are not listed.
MOST_ELEMENTS = 16


def load(
    path: str | os.PathLike[str],
    *,
    resolution: tuple[int, int] | None = None,
    crop: tuple[float, float, float, float] | None = None,
    max_depth: int | None = None,
    sampler: str | None = None,
) -> Scene:
    """Load a scene file (pbrt-v4, or Mitsuba 3: `.xml`) and all that it refers to.

    Args:
        path: the scene file, plain or gzip.
        resolution: (width, height) of the picture in pixels; None: the scene's.
        crop: the part of the picture to render, (x0, x1, y0, y1) as fractions in [0, 1].
        max_depth: largest number of scattering events of a walk; 0: no limit.
        sampler: "sobol" or "independent".

    Raises:
        InputError: for whatever is wrong in the file, with file, line and column.

    Warns:
        SceneWarning: for what the file asks for and is done otherwise, each kind once.
    """
    return _checked(_wend.load(os.fspath(path), *_options(resolution, crop, max_depth, sampler)))


def loads(
    text: str,
    *,
    folder: str | os.PathLike[str] = ".",
    name: str = "scene.pbrt",
    resolution: tuple[int, int] | None = None,
    crop: tuple[float, float, float, float] | None = None,
    max_depth: int | None = None,
    sampler: str | None = None,
) -> Scene:
    """The same for a scene in a string; its files are looked up in `folder`, and `name` is what messages call it."""
    native = _wend.load_text(text, os.fspath(folder), name, *_options(resolution, crop, max_depth, sampler))
    return _checked(native)


def demo_scene() -> Path:
    """The file of the scene that `wend demo` renders: a room with a lamp behind a wall, and haze."""
    return Path(__file__).parent / "scenes" / "demo.pbrt"


class Scene:
    """A scene, ready to be rendered. It never changes: `with_` makes another one."""

    def __init__(self, native: _wend.Scene) -> None:
        self._native = native

    @property
    def file(self) -> str:
        """The file that it was loaded from."""
        return self._native.file

    @property
    def resolution(self) -> tuple[int, int]:
        """(width, height) of the picture in pixels."""
        return self._native.resolution

    @property
    def spp(self) -> int:
        """Samples per pixel that the file asks for."""
        return self._native.spp

    @property
    def max_depth(self) -> int:
        """Largest number of scattering events of a walk."""
        return self._native.max_depth

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Two corners of the box around all surfaces, in scene units."""
        return self._native.bounds

    @property
    def warnings(self) -> list[str]:
        """What the file asks for and is done otherwise, as `file:line:column: warning: ...`."""
        return self._native.warnings

    @property
    def parameters(self) -> dict[str, Any]:
        """The parameters that the file gives, by the names that `with_` takes; large arrays are left out.

        A name is that of a directive, a point, and the parameter's own: `camera.fov`, `film.iso`,
        `medium.fog.sigma_s` (of MakeNamedMedium "fog"), `material.wax.roughness`, `texture.grid.scale`, and by
        number, in the order of the file, `light[0].L`, `arealight[1].scale`, `shape[3].radius`, `material[2].eta`
        (of a Material without a name; 0 is that of shapes before any).
        """
        return {
            name: tuple(values) if len(values) > 1 else values[0]
            for name, _, values in self._native.parameters(MOST_ELEMENTS)
        }

    def with_(self, changes: Mapping[str, Any]) -> Scene:
        """The scene with other values of some parameters; this one stays as it is.

        Args:
            changes: values by name (see `parameters`). A number, a text, or a sequence of numbers, of the type that
                the file gives the parameter; for one that it does not give, a number is a "float", three numbers
                are an "rgb", a text is a "string". A pair (type, value), such as ("spectrum", "metal-Cu-eta") or
                ("texture", "marble"), says the type itself.

        What the changes do not touch is shared with this scene: shapes and what finds them for rays (unless a
        parameter of a shape changes, or it becomes one that rays can pass), media, and the content of files, which
        are not read again.

        Raises:
            InputError: for a directive that the scene has not, or a value that it does not take.

        Warns:
            SceneWarning: for a parameter that the directive does not know, among others.
        """
        known = {name: kind for name, kind, _ in self._native.parameters(MOST_ELEMENTS)}
        native = self._native.with_parameters([_change(name, value, known.get(name)) for name, value in changes.items()])
        before = set(self.warnings)
        return _checked(native, before)

    def shares_geometry_with(self, other: Scene) -> bool:
        """Whether shapes, and what finds them for rays, lie in memory once for both scenes."""
        return self._native.shares_geometry_with(other._native)

    def __repr__(self) -> str:
        width, height = self.resolution
        return f"<wend.Scene {self.file!r}, {width} x {height}>"


def _options(
    resolution: tuple[int, int] | None,
    crop: tuple[float, float, float, float] | None,
    max_depth: int | None,
    sampler: str | None,
) -> tuple[str, str, int | None, str]:
    size = ""
    if resolution is not None:
        if isinstance(resolution, str) or len(resolution) != 2:
            raise InputError(f"resolution: expected (width, height), not {resolution!r}")
        width, height = (whole(n, "resolution", 1, (1 << 31) - 1) for n in resolution)
        size = f"{width}x{height}"
    part = "" if crop is None else ",".join(str(float(x)) for x in crop)
    return size, part, max_depth, sampler or ""


def _checked(native: _wend.Scene, known: set[str] | None = None) -> Scene:
    for warning in native.warnings:
        if known is None or warning not in known:
            warnings.warn(warning, SceneWarning, stacklevel=3)
    return Scene(native)


_TEXT_TYPES = ("string", "texture", "spectrum")
#: How many numbers make one element of the types that a file may give a colour as.
_COLOURS = ("rgb", "spectrum", "blackbody")


def _change(name: str, value: Any, kind: str | None) -> tuple[str, str, list[float] | list[str]]:
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], str):
        kind, value = value
        explicit = True
    else:
        explicit = False
    texts = [value] if isinstance(value, str) else value
    if isinstance(texts, Sequence) and texts and all(isinstance(text, str) for text in texts):
        return name, kind if kind and (explicit or kind in _TEXT_TYPES) else "string", list(texts)
    try:
        numbers = [float(x) for x in np.asarray(value, dtype=np.float64).reshape(-1)]
    except (TypeError, ValueError):
        raise InputError(f"{name}: expected numbers or text, not {value!r}") from None
    if not explicit:
        if kind is None:
            kind = "bool" if isinstance(value, bool) else "rgb" if len(numbers) == 3 else "float"
        elif kind in _COLOURS and len(numbers) == 3:
            kind = "rgb"
        elif kind in ("texture", "string"):
            kind = "rgb" if len(numbers) == 3 else "float"
    return name, kind or "float", numbers
