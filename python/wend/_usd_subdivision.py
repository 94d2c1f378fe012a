"""USD's subdivision surfaces as shapes of the renderer, and how finely they are cut for a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdGeom  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._errors import InputError

Parameters = dict[str, Any]

#: Corners of a face and edges of a point, and triangles of all surfaces together, that the renderer takes.
MOST_AROUND = 128
MOST_TRIANGLES = 2**23

#: Levels of what is copied, whose size in the picture is not known.
_LEVELS_OF_COPIES = 2
#: Of a single mesh, where nothing else is asked for.
_MOST_OF_A_MESH = 2**21
_FEWEST_LEVELS, _MOST_LEVELS = 1, 6


@dataclass
class View:
    """How large things are in the picture."""

    eye: npt.NDArray[np.float64]
    pixel: float  #: at distance 1, or at any where rays are parallel
    is_parallel: bool = False

    def size_of_pixel(self, low: npt.NDArray[np.float64], high: npt.NDArray[np.float64]) -> float:
        """Across, where a box is nearest."""
        if self.is_parallel:
            return self.pixel
        return self.pixel * float(np.linalg.norm(np.maximum(np.maximum(low - self.eye, self.eye - high), 0)))


class Faces:
    """A mesh's faces as the renderer takes them: against the clock, of three corners or more, and triangles for "loop".

    Args:
        counts: corners of each face of the stage's mesh.
        corners: the points of these.
        scheme: how it is subdivided.
        is_left_handed: whether the corners go with the clock.
    """

    def __init__(
        self, counts: npt.NDArray[np.int64], corners: npt.NDArray[np.int64], scheme: str, is_left_handed: bool
    ) -> None:
        first = _starts(counts)
        if scheme == UsdGeom.Tokens.loop:
            fans = np.maximum(counts - 2, 0)
            #: of each face, that of the stage's mesh
            self.of_face = np.repeat(np.arange(len(counts)), fans)
            step = np.arange(len(self.of_face)) - np.repeat(_starts(fans), fans)
            start = first[self.of_face]
            order = np.stack([start, start + step + 1, start + step + 2], axis=1)
            self.counts = np.full(len(self.of_face), 3)
            #: of each corner, that of the stage's mesh
            self.order = (order[:, ::-1] if is_left_handed else order).reshape(-1)
        else:
            self.of_face = np.flatnonzero(counts >= 3)
            self.counts = counts[self.of_face]
            step = np.arange(self.counts.sum()) - np.repeat(_starts(self.counts), self.counts)
            if is_left_handed:
                step = np.repeat(self.counts, self.counts) - 1 - step
            self.order = np.repeat(first[self.of_face], self.counts) + step
        #: of each corner
        self.points = corners[self.order]

    def edges(self) -> npt.NDArray[np.int64]:
        """The ends of each face's edges, as points."""
        first = _starts(self.counts)
        following = np.arange(1, len(self.points) + 1)
        following[first + self.counts - 1] = first
        return np.stack([self.points, self.points[following]], axis=1)


def _starts(counts: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    return np.cumsum(counts) - counts


class Refinement:
    """How finely surfaces are cut: so that edges are two pixels long, or as finely as is asked for.

    Args:
        levels: what is asked for; None: what the picture needs.

    Raises:
        InputError: for less than none.
    """

    def __init__(self, levels: int | None) -> None:
        if levels is not None and levels < 0:
            raise InputError(f"subdivision {levels}: must not be below 0")
        # Far above what is ever made; more would leave the range of numbers.
        self.asked = None if levels is None else min(levels, 64)
        self.view: View | None = None
        self._triangles = 0.0

    def levels(
        self, points: npt.NDArray[np.float32], faces: Faces, world: npt.NDArray[np.float64], in_object: bool
    ) -> int | None:
        """Of a mesh in the world; None where the triangles of its faces alone are too many."""

        def triangles(levels: int) -> float:
            return len(faces.points) * max(4.0**levels / 2, 1.0)

        if self.asked is not None:
            levels = self.asked
        else:
            in_view = not in_object and self.view is not None
            levels = self._needed(points, faces, world) if in_view else _LEVELS_OF_COPIES
            while levels > _FEWEST_LEVELS and triangles(levels) > _MOST_OF_A_MESH:
                levels -= 1
        while levels >= 0 and self._triangles + triangles(levels) > MOST_TRIANGLES:
            levels -= 1
        if levels < 0:
            return None
        self._triangles += triangles(levels)
        return levels

    def _needed(self, points: npt.NDArray[np.float32], faces: Faces, world: npt.NDArray[np.float64]) -> int:
        assert self.view is not None
        placed = points.astype(np.float64) @ world[:3, :3] + world[3, :3]
        edges = faces.edges()
        # A few edges that are longer than all others do not count.
        longest = float(np.quantile(np.linalg.norm(placed[edges[:, 0]] - placed[edges[:, 1]], axis=1), 0.95))
        pixel = self.view.size_of_pixel(placed.min(axis=0), placed.max(axis=0))
        most = 2 * pixel * 2.0**_MOST_LEVELS
        return _MOST_LEVELS if longest >= most else max(math.ceil(math.log2(max(longest / (2 * pixel), 1))), _FEWEST_LEVELS)


def surface(
    reader: Any,
    prim: Any,
    points: npt.NDArray[np.float32],
    faces: Faces,
    coordinates: tuple[npt.NDArray[np.float32], str] | None,
    world: npt.NDArray[np.float64],
    in_object: bool,
) -> Parameters | None:
    """The parameters of a "subdivision", but for holes; None, with a warning, for a surface that the renderer does not
    take. `coordinates` are those of the stage's mesh, with their interpolation; `world` is where it is."""
    mesh = UsdGeom.Mesh(prim)
    time = reader.time
    if not len(faces.counts):
        return None
    if not _is_taken(faces, len(points)):
        reader.warn(prim, f"a surface with more than {MOST_AROUND} edges at a point is taken as its control mesh")
        return None
    levels = reader.refinement.levels(points, faces, world, in_object)
    if levels is None:
        reader.warn(prim, f"where subdivision leads to more than {MOST_TRIANGLES} triangles, control meshes are taken")
        return None
    if levels < (reader.refinement.asked or 0):
        reader.warn(prim, f"subdivision is less than asked for, as all leads to {MOST_TRIANGLES} triangles at most")
    parameters: Parameters = {
        "string scheme": mesh.GetSubdivisionSchemeAttr().Get(time),
        "point3 P": points,
        "integer faceVertexCounts": faces.counts.astype(np.int32),
        "integer indices": faces.points.astype(np.int32),
        "integer levels": levels,
        "string interpolateBoundary": mesh.GetInterpolateBoundaryAttr().Get(time),
        "string triangleSubdivisionRule": mesh.GetTriangleSubdivisionRuleAttr().Get(time),
    }
    parameters |= _creases(reader, prim, mesh, len(points))
    if coordinates is not None:
        linear = mesh.GetFaceVaryingLinearInterpolationAttr().Get(time)
        parameters |= _texture_coordinates(linear, faces, *coordinates)
    return parameters


def _is_taken(faces: Faces, points: int) -> bool:
    if faces.counts.max() > MOST_AROUND:
        return False
    # A point has at most twice as many edges as faces.
    if np.bincount(faces.points, minlength=points).max() * 2 <= MOST_AROUND:
        return True
    edges = np.unique(np.sort(faces.edges(), axis=1), axis=0)
    return bool(np.bincount(edges.reshape(-1)).max() <= MOST_AROUND)


def _creases(reader: Any, prim: Any, mesh: Any, points: int) -> Parameters:
    time = reader.time

    def integers(attribute: Any) -> npt.NDArray[np.int64]:
        return np.array(attribute.Get(time) or [], dtype=np.int64)

    def sharpnesses(attribute: Any) -> npt.NDArray[np.float32]:
        return np.maximum(np.nan_to_num(np.array(attribute.Get(time) or [], dtype=np.float32)), 0)

    parameters: Parameters = {}
    chain, lengths = integers(mesh.GetCreaseIndicesAttr()), integers(mesh.GetCreaseLengthsAttr())
    sharp = sharpnesses(mesh.GetCreaseSharpnessesAttr())
    if len(chain):
        edges = int(lengths.sum()) - len(lengths)
        are_points = chain.min() >= 0 and chain.max() < points
        if are_points and (lengths >= 2).all() and lengths.sum() == len(chain) and len(sharp) in (len(lengths), edges):
            parameters |= {
                "integer creaseIndices": chain.astype(np.int32),
                "integer creaseLengths": lengths.astype(np.int32),
                "float creaseSharpnesses": sharp,
            }
        else:
            reader.warn(prim, "creases whose numbers do not go together are left out")
    corners, sharp = integers(mesh.GetCornerIndicesAttr()), sharpnesses(mesh.GetCornerSharpnessesAttr())
    if len(corners):
        if corners.min() >= 0 and corners.max() < points and len(sharp) == len(corners):
            parameters |= {"integer cornerIndices": corners.astype(np.int32), "float cornerSharpnesses": sharp}
        else:
            reader.warn(prim, "sharp corners whose numbers do not go together are left out")
    return parameters


def _texture_coordinates(
    linear: str, faces: Faces, values: npt.NDArray[np.float32], interpolation: str
) -> Parameters:
    if interpolation == UsdGeom.Tokens.faceVarying:
        # Corners with the same coordinates are not a seam.
        values, indices = np.unique(values, axis=0, return_inverse=True)
        chosen = indices.reshape(-1)[faces.order]
    elif interpolation in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying):
        chosen = faces.points
        linear = "none" if interpolation == UsdGeom.Tokens.vertex else "all"
    elif interpolation == UsdGeom.Tokens.uniform:
        chosen = np.repeat(faces.of_face, faces.counts)
    else:
        chosen = np.zeros(len(faces.points), dtype=np.int64)
    return {
        "point2 uv": values,
        "integer uvindices": chosen.astype(np.int32),
        "string faceVaryingLinearInterpolation": linear,
    }
