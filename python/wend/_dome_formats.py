"""Pictures of all directions in other layouts, as latlong ones."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Pixels = npt.NDArray[np.float32]


def _angular(right: Floats, up: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """The radius is the angle from the middle."""
    away = np.hypot(right, up)
    r = np.divide(np.arccos(np.clip(ahead, -1, 1)) / np.pi, away, out=np.zeros_like(away), where=away > 0)
    return (1 + r * right) / 2, (1 - r * up) / 2


def _mirrored_ball(right: Floats, up: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """By the normal of the ball, which is halfway between a direction and the middle."""
    size = np.maximum(np.sqrt(2 * (1 + ahead)), 1e-9)
    return (1 + right / size) / 2, (1 - up / size) / 2


def _vertical_cross(right: Floats, up: Floats, ahead: Floats) -> tuple[Floats, Floats]:
    """Three columns of four: the top; left, front and right; below; behind, upside down."""
    largest = np.maximum(np.maximum(abs(right), abs(up)), abs(ahead))
    largest = np.maximum(largest, 1e-30)
    x, y, z = right / largest, up / largest, ahead / largest
    # Along each face to the right and downwards, from -1 to 1, and which face it is.
    faces = [
        (z >= 1, x, -y, 1, 1),
        (x >= 1, -z, -y, 2, 1),
        (x <= -1, z, -y, 0, 1),
        (y >= 1, x, z, 1, 0),
        (y <= -1, x, -z, 1, 2),
        (z <= -1, x, y, 1, 3),
    ]
    is_there = [face[0] for face in faces]
    across = np.select(is_there, [(face[3] + (1 + face[1]) / 2) / 3 for face in faces])
    down = np.select(is_there, [(face[4] + (1 + face[2]) / 2) / 4 for face in faces])
    return across, down


_PLACES: dict[str, Callable[[Floats, Floats, Floats], tuple[Floats, Floats]]] = {
    "angular": _angular,
    "mirroredBall": _mirrored_ball,
    "cubeMapVerticalCross": _vertical_cross,
}


def is_known(layout: str) -> bool:
    return layout in _PLACES


def as_latlong(picture: Pixels, layout: str) -> Pixels:
    """With the same middle, upright, and as fine in the middle as the picture; rows from above."""
    height = int(np.clip(max(picture.shape[:2]), 64, 2048))
    longitude = ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5) * 2 * np.pi
    latitude = (0.5 - (np.arange(height) + 0.5) / height) * np.pi
    around, upwards = np.meshgrid(longitude, latitude)
    across, down = _PLACES[layout](np.cos(upwards) * np.sin(around), np.sin(upwards), np.cos(upwards) * np.cos(around))
    x = np.clip(across * picture.shape[1] - 0.5, 0, picture.shape[1] - 1)
    y = np.clip(down * picture.shape[0] - 0.5, 0, picture.shape[0] - 1)
    left, top = np.minimum(x.astype(int), max(picture.shape[1] - 2, 0)), np.minimum(y.astype(int), max(picture.shape[0] - 2, 0))
    u, v = (x - left)[..., None], (y - top)[..., None]
    beside, below = np.minimum(left + 1, picture.shape[1] - 1), np.minimum(top + 1, picture.shape[0] - 1)
    upper = picture[top, left] * (1 - u) + picture[top, beside] * u
    lower = picture[below, left] * (1 - u) + picture[below, beside] * u
    return np.asarray(upper * (1 - v) + lower * v, dtype=np.float32)
