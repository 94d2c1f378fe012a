"""Pictures in tiles (UDIM), laid out as one: where there is no tile it has one value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

Pixels = npt.NDArray[np.float32]
#: Column and row, counted from the tile 1001, whose coordinates are from 0 to 1; rows go upwards.
Tile = tuple[int, int]

#: Pixels of one picture; tiles of more are made smaller.
_MOST = 2**26

#: Pixels around all tiles: those at the edges again, so that nothing else is seen there, and then what is missing.
_RIM = 2


def tile_of(number: int) -> Tile | None:
    """By its number in names of files; None for what is none."""
    return ((number - 1001) % 10, (number - 1001) // 10) if 1001 <= number <= 9999 else None


def laid_out(
    tiles: Mapping[Tile, Callable[[], Pixels]], missing: Iterable[float], tell: Callable[[str], None], begins: Tile | None = None
) -> tuple[Pixels, npt.NDArray[np.float64]]:
    """One picture of all tiles, each as large as the largest.

    Args:
        tiles: one or more that give (height, width, 3), rows from above; each is asked once, and made smaller at once.
        missing: the colour where there is no tile.
        tell: is told where tiles are made smaller.
        begins: a tile that the picture reaches to, too, though it may be missing.

    Returns:
        The picture, for a texture that is clamped at its edges, and the matrix that takes coordinates to its own; columns
        are points.
    """
    places = np.array([*tiles] if begins is None else [*tiles, begins])
    first, count = places.min(axis=0), np.ptp(places, axis=0) + 1
    read, halvings = {}, 0
    for tile, pixels_of in tiles.items():
        pixels = pixels_of()
        height, width = pixels.shape[:2]
        halved = 0
        while np.prod(np.array((height, width)) * count[::-1] + 2 * _RIM) > _MOST and max(height, width) > 1:
            height, width, halved = max(height // 2, 1), max(width // 2, 1), halved + 1
        read[tile], halvings = _resized(pixels, height, width), max(halvings, halved)
    if halvings:
        tell(f"pictures in tiles are made {2**halvings} times smaller: all of them fill {count[0]} x {count[1]} tiles")
    height, width = np.max([pixels.shape[:2] for pixels in read.values()], axis=0)
    result = np.empty((height * count[1] + 2 * _RIM, width * count[0] + 2 * _RIM, 3), dtype=np.float32)
    result[:] = np.array(list(missing), dtype=np.float32)
    for rim in (1, 0):
        # The rims of all, over which the tiles beside them lie.
        for (column, row), pixels in read.items():
            x = _RIM + (column - first[0]) * width - rim
            y = _RIM + (first[1] + count[1] - 1 - row) * height - rim
            padded = np.pad(_resized(pixels, height, width), ((rim, rim), (rim, rim), (0, 0)), mode="edge")
            result[y : y + height + 2 * rim, x : x + width + 2 * rim] = padded
    across, upwards = width / result.shape[1], height / result.shape[0]
    matrix = np.array(
        [
            [across, 0, _RIM / result.shape[1] - first[0] * across],
            [0, upwards, _RIM / result.shape[0] - first[1] * upwards],
            [0, 0, 1],
        ]
    )
    return result, matrix


def _resized(pixels: Pixels, height: int, width: int) -> Pixels:
    """Means of pixels where they become fewer, the same several times where they become more."""
    while pixels.shape[0] >= 2 * height and pixels.shape[1] >= 2 * width:
        even = pixels[: pixels.shape[0] // 2 * 2, : pixels.shape[1] // 2 * 2]
        pixels = (even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]) * np.float32(0.25)
    rows = (np.arange(height) * pixels.shape[0]) // height
    columns = (np.arange(width) * pixels.shape[1]) // width
    return np.asarray(pixels[rows[:, None], columns[None, :]], dtype=np.float32)


def encoded(image: npt.NDArray[Any]) -> Pixels:
    """The numbers of a picture of 8 bits that was decoded as sRGB."""
    return np.where(image <= 0.0031308, 12.92 * image, 1.055 * np.maximum(image, 0.0031308) ** (1 / 2.4) - 0.055).astype(np.float32)
