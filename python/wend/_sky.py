"""Pictures of all directions."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


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
