"""Pictures of the sky."""

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


def equal_area(latlong: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """The square picture of a sphere that pbrt wants, of one by latitude and longitude, as OpenEXR has them: the
    middle is +z, +x is to the left of it, +y on top."""
    x, y, z = directions(min(max(int(latlong.shape[0]), 16), 2048))
    longitude, latitude = np.arctan2(x, z), np.arcsin(np.clip(y, -1, 1))
    height, width = latlong.shape[:2]
    column = (0.5 - longitude / (2 * np.pi)) * width - 0.5
    row = np.clip((0.5 - latitude / np.pi) * height - 0.5, 0, height - 1)
    c0, r0 = np.floor(column).astype(int), np.floor(row).astype(int)
    fc, fr = (column - c0)[..., None], (row - r0)[..., None]
    r1 = np.minimum(r0 + 1, height - 1)
    left, right = c0 % width, (c0 + 1) % width
    top = latlong[r0, left] * (1 - fc) + latlong[r0, right] * fc
    bottom = latlong[r1, left] * (1 - fc) + latlong[r1, right] * fc
    return np.asarray(top * (1 - fr) + bottom * fr, dtype=np.float32)
