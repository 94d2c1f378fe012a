"""Pictures of all directions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._film import Film
from ._scene_reader import SceneReader

#: Of pictures of how lights are shaped.
_SHAPED_SIDE = 512


def directions(side: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """x, y and z of the pixels of a square picture of the sphere, as pbrt has them."""
    centre = (np.arange(side) + 0.5) / side * 2 - 1
    u, v = np.meshgrid(centre, centre)
    across, down = np.abs(u), np.abs(v)
    signed = 1 - (across + down)
    r = 1 - np.abs(signed)
    phi = (np.divide(down - across, r, out=np.ones_like(r), where=r > 0) + 1) * np.pi / 4
    z = np.copysign(1 - r**2, signed)
    ring = r * np.sqrt(np.maximum(2 - r**2, 0))
    return np.copysign(np.cos(phi), u) * ring, np.copysign(np.sin(phi), v) * ring, z


def add_thrown(
    reader: SceneReader, intensity: Any, factor_of: Callable[..., npt.NDArray[np.float64]], side: int = _SHAPED_SIDE
) -> None:
    """Adds a light without a size.

    Args:
        reader: of the scene.
        intensity: a colour.
        factor_of: of x, y and z of directions in the light's own space, what multiplies it there: numbers, or colours.
        side: of the picture that is made.
    """
    # pbrt's pole is y.
    x, z, y = directions(side)
    factor = factor_of(x, y, z)
    if factor.max() <= 0:
        return
    file = reader.map_file(f"shape{len(reader.builder)}.exr")
    is_coloured = factor.ndim == 3
    picture = (factor / factor.max()).astype(np.float32)
    Film.of(picture if is_coloured else np.repeat(picture[:, :, None], 3, axis=2)).save(file)
    parameters = {"rgb I": intensity * factor.max(), "string filename": file}
    reader.builder.add("LightSource", "goniometric", parameters | ({"bool coloured": True} if is_coloured else {}))
