"""Faces of USD that are not convex cover what they go around, whichever corner is their first."""

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import UsdGeom  # noqa: E402

from usd_stage import Stage, coverage  # noqa: E402

ARROW = [(-1, -1), (-0.5, 0.5), (1, 1), (-1, 1)]
L = [(-1, -1), (1, -1), (1, -0.5), (-0.5, -0.5), (-0.5, 1), (-1, 1)]
#: A comb of three teeth.
COMB = [(-1, -1), (1, -1), (1, 1), (0.6, 1), (0.6, -0.5), (0.2, -0.5), (0.2, 1), (-0.2, 1), (-0.2, -0.5), (-0.6, -0.5), (-0.6, 1), (-1, 1)]  # fmt: skip
#: An L with a corner in the middle of a straight edge.
STRAIGHT = [(-1, -1), (0, -1), (1, -1), (1, -0.5), (-0.5, -0.5), (-0.5, 1), (-1, 1)]
SHAPES = {"arrow": ARROW, "L": L, "comb": COMB, "straight": STRAIGHT}


def area(corners):
    x, y = np.array(corners, dtype=float).T
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


def face(stage, corners, first, flipped=False):
    mesh = UsdGeom.Mesh.Define(stage.stage, "/face")
    order = [*corners[first:], *corners[:first]]
    mesh.CreatePointsAttr([(x, y, -1.25) for x, y in (order[::-1] if flipped else order)])
    mesh.CreateFaceVertexCountsAttr([len(corners)])
    mesh.CreateFaceVertexIndicesAttr(list(range(len(corners))))
    mesh.CreateSubdivisionSchemeAttr("none")
    mesh.CreateDisplayColorAttr([(0, 0, 0)])
    return mesh


@pytest.mark.parametrize("first", [0, 1, 3])
@pytest.mark.parametrize("shape", SHAPES)
def test_faces_cover_what_they_go_around(tmp_path, shape, first):
    corners = SHAPES[shape]
    stage = Stage(tmp_path)
    face(stage, corners, first, flipped=first == 1)
    # The camera sees a square of side 2.5 there.
    assert coverage(stage) == pytest.approx(area(corners) / 6.25, abs=0.006)


def test_other_faces_are_what_they_were(tmp_path):
    stage = Stage(tmp_path)
    mesh = face(stage, L, 0)
    square = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]
    mesh.GetPointsAttr().Set([(x, y, -1.25) for x, y in [*L, *square, *ARROW]])
    mesh.GetFaceVertexCountsAttr().Set([4, 6, 2])
    mesh.GetFaceVertexIndicesAttr().Set([6, 7, 8, 9, 0, 1, 2, 3, 4, 5, 0, 1])
    assert coverage(stage) == pytest.approx((area(L) + area(square)) / 6.25, abs=0.006)


def test_a_polygon_that_crosses_itself_is_cut_somehow(tmp_path):
    stage = Stage(tmp_path)
    face(stage, [(-1, -1), (1, 1), (-1, 1), (1, -1), (0, 0.5)], 0)
    assert 0 < coverage(stage) < 1
