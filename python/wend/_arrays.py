"""Arrays as the native part takes them: float32, C-contiguous, and only copied where they are not."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InputError

Array = npt.NDArray[np.float32]


def rows(value: npt.ArrayLike, width: int, name: str, count: int | None = None) -> Array:
    """`value` as (N, width), one row standing for all `count`."""
    try:
        array = np.asarray(value, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from None
    if array.ndim == 0 or array.shape[-1] != width:
        raise InputError(f"{name}: expected shape (..., {width}), not {array.shape}")
    array = array.reshape(-1, width)
    if count is not None and array.shape[0] != count:
        if array.shape[0] != 1:
            raise InputError(f"{name}: {array.shape[0]} rows do not go with {count}")
        array = np.broadcast_to(array, (count, width))
    return np.ascontiguousarray(array)


def leading_shape(*values: npt.ArrayLike) -> tuple[int, ...]:
    """What the shapes of arrays of vectors have before their last axis, broadcast."""
    try:
        return np.broadcast_shapes(*(np.shape(value)[:-1] for value in values))
    except ValueError:
        shapes = " and ".join(str(np.shape(value)) for value in values)
        raise InputError(f"arrays of shapes {shapes} do not go together") from None


def spread(value: npt.ArrayLike, width: int, name: str, shape: tuple[int, ...]) -> Array:
    """`value` broadcast to shape + (width,), as rows."""
    array = np.asarray(value, dtype=np.float32)
    if array.ndim == 0 or array.shape[-1] != width:
        raise InputError(f"{name}: expected shape (..., {width}), not {array.shape}")
    return np.ascontiguousarray(np.broadcast_to(array, (*shape, width))).reshape(-1, width)


def picture(value: Any, name: str) -> Array:
    """An image as (height, width, 3)."""
    array = np.asarray(value, dtype=np.float32)
    if array.ndim == 2:
        array = np.repeat(array[:, :, None], 3, axis=2)
    if array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise InputError(f"{name}: expected an image of shape (height, width, 3), not {array.shape}")
    return np.ascontiguousarray(array)
