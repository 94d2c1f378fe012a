"""Curves of USD as cubic Bézier pieces of the renderer's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdGeom  # type: ignore[import-not-found,import-untyped,unused-ignore]

Parameters = dict[str, Any]
Matrix = npt.NDArray[np.float64]

#: Control points of a Bézier piece by those of a piece in another basis.
_TO_BEZIER = {
    "bspline": np.array([[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]) / 6,
    "catmullRom": np.array([[0, 6, 0, 0], [-1, 6, 1, 0], [0, 1, 6, -1], [0, 0, 6, 0]]) / 6,
    "bezier": np.eye(4),
    "linear": np.array([[3, 0], [2, 1], [1, 2], [0, 3]]) / 3,
}

#: How many points a piece is further than the one before.
_STEPS = {"bspline": 1, "catmullRom": 1, "bezier": 3, "linear": 1}


def curve_segments(reader: Any, prim: Any) -> Iterator[Parameters]:
    """The curves, whole where their width is one, else in their pieces."""
    curves = UsdGeom.BasisCurves(prim)
    time = reader.time
    points = np.array(curves.GetPointsAttr().Get(time) or [], dtype=np.float64).reshape(-1, 3)
    counts = np.array(curves.GetCurveVertexCountsAttr().Get(time) or [], dtype=np.int64)
    if not len(counts) or counts.min() < 2 or counts.sum() != len(points):
        reader.warn(prim, "curves whose counts are not of their points are left out")
        return
    ends = [curves.ComputePointsAtTime(t, time) for t in reader.shutter] if reader.shutter[0] != reader.shutter[1] else []
    if ends and not np.array_equal(np.array(ends[0]), np.array(ends[1])):
        reader.warn(prim, "the points of curves stay while the shutter is open")
    normals = (prim.GetAttribute(name) for name in ("normals", "primvars:normals"))
    if any(attribute.HasAuthoredValue() for attribute in normals if attribute):
        reader.warn(prim, "curves with normals, which are ribbons, are taken as round")
    kind = curves.GetTypeAttr().Get(time)
    basis = "linear" if kind == UsdGeom.Tokens.linear else str(curves.GetBasisAttr().Get(time))
    if basis not in _TO_BEZIER:
        reader.warn(prim, f"curves of the basis {basis} are taken as straight lines")
        basis = "linear"
    wrap = str(curves.GetWrapAttr().Get(time))
    laid = [_laid_out(count, basis, wrap) for count in counts]
    widths = _Widths(reader, prim, counts, [len(pieces) for pieces in laid], wrap == UsdGeom.Tokens.periodic)
    first = 0
    for i, count in enumerate(counts):
        if len(laid[i]):
            corners = _with_ends(points[first : first + count])[laid[i]]
            yield from _pieces(np.einsum("ij,njk->nik", _TO_BEZIER[basis], corners), widths.of(i, laid[i], _TO_BEZIER[basis]))
        first += count


def _with_ends(values: Matrix) -> Matrix:
    """The points with those beyond that pinned curves have."""
    return np.concatenate([values, [2 * values[0] - values[1], 2 * values[-1] - values[-2]]])


def _laid_out(count: int, basis: str, wrap: str) -> npt.NDArray[np.int64]:
    """The points of each piece; of those beyond the ends the one before is called `count`, the one after `count + 1`."""
    taken = 2 if basis == "linear" else 4
    indices = np.arange(count)
    if wrap == UsdGeom.Tokens.periodic:
        indices = np.concatenate([indices, indices[: {"linear": 1, "bezier": 1}.get(basis, 3)]])
    elif wrap == UsdGeom.Tokens.pinned and basis in ("bspline", "catmullRom"):
        indices = np.concatenate([[count], indices, [count + 1]])
    starts = np.arange(0, len(indices) - taken + 1, _STEPS[basis])
    return np.asarray(indices[starts[:, None] + np.arange(taken)], dtype=np.int64)


class _Widths:
    """Widths by where they are given.

    Args:
        counts: of the points of each curve.
        pieces: of each curve.
    """

    def __init__(
        self, reader: Any, prim: Any, counts: npt.NDArray[np.int64], pieces: list[int], is_periodic: bool
    ) -> None:
        curves = UsdGeom.BasisCurves(prim)
        primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("widths")
        given = primvar.ComputeFlattened(reader.time) if primvar and primvar.HasValue() else curves.GetWidthsAttr().Get(reader.time)
        self._values = np.array(given or [1.0], dtype=np.float64)
        ends = [n if is_periodic else n + 1 for n in pieces]
        sizes = {"vertex": counts, "varying": np.array(ends), "uniform": np.ones(len(counts), dtype=np.int64)}
        interpolation = str(primvar.GetInterpolation() if primvar and primvar.HasValue() else curves.GetWidthsInterpolation())
        # What is said counts, and after that what fits.
        fitting = [kind for kind in (interpolation, *sizes) if kind in sizes and sizes[kind].sum() == len(self._values)]
        self._kind = fitting[0] if fitting and len(self._values) > 1 else "constant"
        if self._kind == "constant" and len(self._values) > 1:
            reader.warn(prim, "of widths that are not of the curves' points the mean is taken")
        self._firsts = np.concatenate([[0], np.cumsum(sizes.get(self._kind, counts))]).astype(np.int64)

    def of(self, curve: int, pieces: npt.NDArray[np.int64], to_bezier: Matrix) -> Matrix:
        """At the beginning and at the end of each piece of a curve."""
        if self._kind == "constant":
            return np.full((len(pieces), 2), self._values.mean())
        own = self._values[self._firsts[curve] : self._firsts[curve + 1]]
        if self._kind == "uniform":
            return np.full((len(pieces), 2), own[0])
        if self._kind == "varying":
            return np.stack([own[: len(pieces)], np.roll(own, -1)[: len(pieces)]], axis=1)
        return np.maximum((_with_ends(own)[pieces] @ to_bezier.T)[:, [0, -1]], 0)


def _pieces(beziers: Matrix, widths: Matrix) -> Iterator[Parameters]:
    if np.ptp(widths) == 0:
        # Pieces share their ends.
        points = np.concatenate([beziers[:, :3].reshape(-1, 3), beziers[-1:, 3]])
        yield {"string type": "round", "point3 P": points, "float width": widths[0, 0]}
        return
    for points, (width0, width1) in zip(beziers, widths):
        yield {"string type": "round", "point3 P": points, "float width0": width0, "float width1": width1}
