"""Faces of meshes as triangles: fans where a face is convex, else ears that are cut off one by one."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Integers = npt.NDArray[np.int64]


def triangulate(points: npt.NDArray[np.float32], counts: Integers, corners: Integers) -> tuple[Integers, Integers]:
    """Of each triangle its corners, counted through all faces, and its face; those of a face follow each other."""
    first = np.cumsum(counts) - counts
    fans = np.maximum(counts - 2, 0)
    before = np.cumsum(fans) - fans
    faces = np.repeat(np.arange(len(counts)), fans)
    step = np.arange(len(faces)) - np.repeat(before, fans)
    triangles = np.stack([first[faces], first[faces] + step + 1, first[faces] + step + 2], axis=1)
    for count in np.unique(counts[counts > 3]):
        chosen = np.flatnonzero(counts == count)
        around = first[chosen, None] + np.arange(count)
        places = points[corners[around]].astype(np.float64)
        turns, normals = _turns(places)
        dented = np.flatnonzero((turns < 0).any(axis=1))
        if count == 4:
            # From the corner that points inwards both diagonals' triangles are within.
            order = (np.argmin(turns[dented], axis=1)[:, None] + np.arange(4)) % 4
            turned = np.take_along_axis(around[dented], order, axis=1)
            rows = before[chosen[dented], None] + np.arange(2)
            triangles[rows] = turned[:, [[0, 1, 2], [0, 2, 3]]]
            continue
        for face in dented:
            start = before[chosen[face]]
            triangles[start : start + count - 2] = around[face][_ears(_flattened(places[face], normals[face]))]
    return triangles, faces


def _turns(places: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """At each corner of faces (N, corners, 3) by how much it turns: below 0 inwards, 0 for what rounding makes of a straight
    line. And the faces' normals."""
    ahead = np.roll(places, -1, axis=1) - places
    from_first = places - places[:, :1]
    normals = np.cross(from_first, np.roll(from_first, -1, axis=1)).sum(axis=1)
    turns = np.einsum("nci,ni->nc", np.cross(np.roll(ahead, 1, axis=1), ahead), normals)
    return np.where(np.abs(turns) > 1e-6 * (normals**2).sum(axis=1)[:, None], turns, 0), normals


def _flattened(places: npt.NDArray[np.float64], normal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Along the normal, so that faces go against the clock."""
    axis = int(np.argmax(np.abs(normal)))
    flat = places[:, [(axis + 1) % 3, (axis + 2) % 3]]
    return flat if normal[axis] > 0 else flat * np.array([1.0, -1.0])


def _ears(flat: npt.NDArray[np.float64]) -> list[list[int]]:
    """Triangles of a polygon, by its corners. One that crosses itself has as many, somewhere."""
    left = list(range(len(flat)))
    result = []
    while len(left) > 3:
        at = next((i for i in range(len(left)) if _is_ear(flat, left, i)), 0)
        result.append([left[at - 1], left[at], left[(at + 1) % len(left)]])
        del left[at]
    return [*result, left]


def _is_ear(flat: npt.NDArray[np.float64], left: list[int], at: int) -> bool:
    """Whether the triangle at a corner holds no other corner."""
    a, b, c = flat[left[at - 1]], flat[left[at]], flat[left[(at + 1) % len(left)]]
    if _area(a, b, c) <= 0:
        return False
    others = flat[[i for i in left if not any(np.array_equal(flat[i], p) for p in (a, b, c))]]
    inside = (_area(a, b, others) >= 0) & (_area(b, c, others) >= 0) & (_area(c, a, others) >= 0)
    return not bool(inside.any())


def _area(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64], c: npt.NDArray[np.float64]) -> Any:
    """Twice that of triangles, whose last corners may be many; above 0 against the clock."""
    return (b[0] - a[0]) * (c[..., 1] - a[1]) - (b[1] - a[1]) * (c[..., 0] - a[0])
