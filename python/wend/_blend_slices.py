"""Sheets of Blender through the voxels of an object, so that what is inside it can be baked."""

from __future__ import annotations

import math
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]


def _columns(layers: int, height: int, width: int) -> int:
    """Of layers beside each other, so that all together are about a square."""
    return min(max(round(math.sqrt(layers * height / width)), 1), layers)


def slices(places: npt.NDArray[np.float64], like: Any) -> tuple[Any, tuple[int, int]]:
    """A mesh of one sheet a layer, and the size of the picture of which each place is the middle of a pixel.

    Args:
        places: (layers, height, width, 3), evenly spaced.
        like: the object's mesh, whose generated coordinates it has.
    """
    layers, height, width, _ = places.shape
    columns = _columns(layers, height, width)
    size = columns * width, -(-layers // columns) * height
    # Where the pixels' borders are; and a point within each sheet that is in no pixel's middle, around which it is cut.
    ends = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.4142, 0.3719]])
    first, last = places[:, 0, 0], places[:, -1, -1]
    # Of a single voxel any width will do, but none at all shows nothing.
    step = [(last - first)[:, axis] / (n - 1) if n > 1 else np.ones(layers) for axis, n in ((0, width), (1, height))]
    corners = np.repeat(first[:, None], 5, axis=1)
    for axis, (n, by) in enumerate(((width, step[0]), (height, step[1]))):
        corners[:, :, axis] += by[:, None] * (ends[:, axis] * n - 0.5)
    layer = np.arange(layers)
    tile = np.stack([layer % columns, layer // columns], axis=-1)
    uvs = (tile[:, None] + ends) * (width, height) / size
    faces = [(5 * i + a, 5 * i + (a + 1) % 4, 5 * i + 4) for i in range(layers) for a in range(4)]
    mesh = bpy.data.meshes.new("wend.bake")
    mesh.from_pydata(corners.reshape(-1, 3).tolist(), [], faces)
    # There are no coordinates by UV inside.
    nothing = mesh.uv_layers.new(name="UVMap")
    nothing.uv.foreach_set("vector", np.zeros(len(mesh.loops) * 2, dtype=np.float32))
    nothing.active_render = True
    baked = mesh.uv_layers.new(name="wend.bake")
    baked.uv.foreach_set("vector", uvs.reshape(-1, 2)[np.ravel(faces)].astype(np.float32).ravel())
    mesh.uv_layers.active = mesh.uv_layers["wend.bake"]
    mesh.use_auto_texspace = False
    mesh.texspace_location, mesh.texspace_size = like.texspace_location, like.texspace_size
    return mesh, size


def sliced(pixels: Floats, shape: tuple[int, ...]) -> Floats:
    """Of such a picture, rows from above, what is at each place."""
    layers, height, width = shape
    columns = _columns(layers, height, width)
    tiles = pixels[::-1].reshape(-1, height, columns, width, pixels.shape[-1])
    return np.ascontiguousarray(tiles.swapaxes(1, 2).reshape(-1, height, width, pixels.shape[-1])[:layers])
