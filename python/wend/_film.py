"""Pictures: colours, layers, where they come from; reading, measuring and merging them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _wend
from ._arrays import Array, picture
from ._errors import InputError


class Film:
    """A picture and its layers, as arrays that share its memory.

    `film.image` is the beauty; `film["variance"]`, `film["albedo"]`, `film["depth"]` and so on are layers, `list(film)`
    names them. It converts to an array of the beauty, and a notebook shows it.
    """

    def __init__(self, native: _wend.Picture, statistics: Mapping[str, Any] | None = None) -> None:
        self._native = native
        self._statistics = dict(statistics or {})

    @classmethod
    def of(cls, image: npt.ArrayLike) -> Film:
        """A picture of linear RGB, (height, width, 3), without layers; to save it, for instance."""
        return cls(_wend.picture_of(picture(image, "image")))

    @property
    def image(self) -> Array:
        """Linear RGB, (height, width, 3), float32; no copy."""
        return self._native.image

    @property
    def statistics(self) -> dict[str, Any]:
        """What the render did: `spp`, `seconds`, `training_seconds`, `paths`, `segments`, `passes`, `guiding`."""
        return self._statistics

    @property
    def metadata(self) -> dict[str, str]:
        """Scene, settings, seed, version and samples, as an OpenEXR file has them."""
        return self._native.metadata

    def __getitem__(self, name: str) -> Array:
        """A layer: (height, width, channels), or (height, width) where it has one channel; no copy."""
        if name == "beauty":
            return self.image
        try:
            layer = self._native.layer(name)
        except KeyError:
            raise KeyError(f"no layer {name!r}: there are beauty, {', '.join(self._native.layer_names)}") from None
        return layer[:, :, 0] if layer.shape[2] == 1 else layer

    def __contains__(self, name: object) -> bool:
        return name == "beauty" or name in self._native.layer_names

    def __iter__(self) -> Iterator[str]:
        return iter(["beauty", *self._native.layer_names])

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return np.array(self.image, dtype=dtype, copy=True if copy is None and dtype is not None else copy)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        half: bool = False,
        layer_names: str = "wend",
        exr: str = "float",
        alpha: bool = False,
    ) -> None:
        """Write it: .exr with layers and metadata, .png or .jpg in sRGB.

        Args:
            path: the file; it appears whole or not at all.
            half: the colours alone in half floats (.exr), as references are kept.
            layer_names: how an .exr calls its channels: "wend", "pbrt" or "blender". `read` takes all of them.
            exr: "half": colours of an .exr in half floats, and what is no colour in floats.
            alpha: write the layer `alpha` as channel A of an .exr.

        Raises:
            InputError: for another extension, or a value that there is not.
        """
        if exr not in ("float", "half"):
            raise InputError(f"exr: expected float or half, not {exr!r}")
        self._native.save(os.fspath(path), half, layer_names, exr == "half", alpha)

    def _repr_png_(self) -> bytes:
        return self._native.png()

    def __repr__(self) -> str:
        height, width, _ = self.image.shape
        spp = self._statistics.get("spp")
        return f"<wend.Film {width} x {height}{f', {spp} spp' if spp else ''}>"


def read(path: str | os.PathLike[str]) -> Film:
    """Read a picture file: OpenEXR with its layers and metadata, or the colours of PNG, JPEG, HDR, PFM and others.

    An opacity that is not 1 everywhere is the layer `alpha`. Layers of files that pbrt or Blender (multilayer, the first
    view layer) wrote have Wend's names where they mean the same.

    Raises:
        InputError: for a file that is missing or broken.
    """
    name = os.fspath(path)
    if name.lower().endswith(".exr"):
        return Film(_wend.read_picture(name))
    return Film(_wend.read_image(name))


def opacity_of(path: str | os.PathLike[str]) -> npt.NDArray[np.float32]:
    """Of a picture file, (height, width); 1 where it has none."""
    film = Film(_wend.read_image(os.fspath(path)))
    return film["alpha"] if "alpha" in film else np.ones(film.image.shape[:2], dtype=np.float32)


def merge(renders: Iterable[Film | str | os.PathLike[str]]) -> Film:
    """Join independent renders of one picture, weighted by what their samples are worth, with no bias.

    Args:
        renders: films, or OpenEXR files of `wend render`, at least two, with different seeds.

    Returns:
        A film with the layers that all have; `statistics["shares"]` are the weights of each.

    Raises:
        InputError: where they are not estimates of the same picture by different seeds.
    """
    given: list[Any] = [
        render._native if isinstance(render, Film) else os.fspath(render) for render in renders
    ]
    if len(given) < 2:
        raise InputError("merge wants two renders or more")
    native, shares, left_out = _wend.merge(given)
    return Film(native, {"shares": shares, "left_out": left_out})


Reference = Any
"""A picture, a file, or a pair of either: two independent halves, whose own noise then does not count."""


def halves(reference: Reference) -> tuple[Array, Array]:
    """The two halves of a reference as arrays."""
    if isinstance(reference, (str, os.PathLike)):
        name = os.fspath(reference)
        pair = (f"{name}.ref-a.exr", f"{name}.ref-b.exr")
        if not os.path.exists(name) and all(map(os.path.exists, pair)):
            return halves(pair)
        image = read(name).image
        return image, image
    if isinstance(reference, tuple) and len(reference) == 2:
        a, b = (read(half).image if isinstance(half, (str, os.PathLike)) else picture(half, "reference")
                for half in reference)
        return a, b
    image = picture(reference, "reference")
    return image, image


def metric(image: Film | npt.ArrayLike | str | os.PathLike[str], reference: Reference) -> dict[str, float]:
    """How far a picture is from its reference.

    Args:
        image: a film, an array (height, width, 3) of linear colour, or a file.
        reference: the same, a pair of them (two independent halves), or NAME of the files NAME.ref-a.exr and
            NAME.ref-b.exr.

    Returns:
        `relmse` (mean of squared errors over squared reference), its standard error, `relmse_trimmed` (without the
        worst 0.1 % of pixels), `error_p9999`, `mse`, `mape` and `flip` (the mean of HDR-FLIP, 0 to 1).

    Raises:
        InputError: where sizes differ or a pixel is not finite.
    """
    pixels = read(image).image if isinstance(image, (str, os.PathLike)) else picture(image, "image")
    a, b = halves(reference)
    return _wend.metrics(pixels, a, b)
