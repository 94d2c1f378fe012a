"""Subdivision surfaces of USD: their areas in pictures, by closed forms, and how finely they are cut."""

import re

import numpy as np
import pytest
import wend

pytest.importorskip("pxr", reason="usd-core is absent")
pytestmark = pytest.mark.filterwarnings("ignore:.*no light:wend.SceneWarning")

from pxr import Gf, Sdf, UsdGeom, UsdShade, Vt  # noqa: E402

from usd_stage import Stage, coverage  # noqa: E402


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


def square(stage, half=4.0, distance=10.0, scheme="catmullClark", **attributes):
    """One face before the camera, whose picture is 20 across at distance 10."""
    mesh = UsdGeom.Mesh.Define(stage.stage, "/square")
    mesh.CreatePointsAttr([(x * half, y * half, -distance) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateSubdivisionSchemeAttr(scheme)
    mesh.CreateDisplayColorAttr([(0, 0, 0)])
    for name, value in attributes.items():
        mesh.GetPrim().GetAttribute(name).Set(value)
    return mesh


def area_of_spline(points):
    """Within the closed cubic B-spline of control points: half the integral of x dy - y dx."""
    t = (np.arange(1000) + 0.5)[:, None] / 1000
    area = 0.0
    for k in range(len(points)):
        a, b, c, d = (np.asarray(points[(k + i) % len(points)], dtype=float) for i in range(4))
        place = ((1 - t) ** 3 * a + (3 * t**3 - 6 * t**2 + 4) * b + (-3 * t**3 + 3 * t**2 + 3 * t + 1) * c + t**3 * d) / 6
        speed = (-((1 - t) ** 2) * a + (3 * t**2 - 4 * t) * b + (-3 * t**2 + 2 * t + 1) * c + t**2 * d) / 2
        area += 0.5 * float((place[:, 0] * speed[:, 1] - place[:, 1] * speed[:, 0]).mean())
    return area


def test_boundaries_are_corners_or_splines(stage):
    assert area_of_spline([(-1, -1), (1, -1), (1, 1), (-1, 1)]) < 4
    mesh = square(stage)
    assert coverage(stage) == pytest.approx(64 / 400, rel=0.01)
    mesh.CreateInterpolateBoundaryAttr("edgeOnly")
    expected = area_of_spline([(-4, -4), (4, -4), (4, 4), (-4, 4)]) / 400
    assert coverage(stage) == pytest.approx(expected, rel=0.01)
    mesh.CreateSubdivisionSchemeAttr("bilinear")
    assert coverage(stage) == pytest.approx(64 / 400, rel=0.01)


def test_creases_and_corners_hold_edges_in_place(stage):
    mesh = square(stage, interpolateBoundary="edgeOnly")
    # Two sharp corners: the edge between them is straight, and the others are splines that begin there.
    mesh.CreateCornerIndicesAttr([0, 1])
    mesh.CreateCornerSharpnessesAttr([10.0, 10.0])
    two = coverage(stage)
    mesh.CreateCornerIndicesAttr([0, 1, 2, 3])
    mesh.CreateCornerSharpnessesAttr([10.0] * 4)
    four = coverage(stage)
    none = area_of_spline([(-4, -4), (4, -4), (4, 4), (-4, 4)]) / 400
    assert four == pytest.approx(64 / 400, rel=0.01)
    assert none * 1.05 < two < four / 1.05


def test_an_infinitely_sharp_cube_is_a_cube(stage):
    mesh = UsdGeom.Mesh.Define(stage.stage, "/cube")
    mesh.CreatePointsAttr([(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (-12, -8)])
    mesh.CreateFaceVertexCountsAttr([4] * 6)
    mesh.CreateFaceVertexIndicesAttr([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    mesh.CreateDisplayColorAttr([(0, 0, 0)])
    smooth = coverage(stage)
    loops = [[0, 1, 3, 2, 0], [4, 5, 7, 6, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
    mesh.CreateCreaseIndicesAttr([i for loop in loops for i in loop])
    mesh.CreateCreaseLengthsAttr([len(loop) for loop in loops])
    mesh.CreateCreaseSharpnessesAttr([10.0] * len(loops))
    sharp = coverage(stage)
    assert sharp == pytest.approx(16 / 400 * (10 / 8) ** 2, rel=0.01)
    assert smooth < 0.7 * sharp
    # By edge instead of by chain.
    mesh.CreateCreaseSharpnessesAttr([10.0] * 12)
    assert coverage(stage) == pytest.approx(sharp, rel=1e-6)


def test_triangles_and_what_is_none_are_taken_by_loop(stage):
    mesh = square(stage, scheme="loop")
    # The corners of the boundary spline are those of the square, as triangles have no other boundary.
    mesh.CreateInterpolateBoundaryAttr("edgeOnly")
    expected = area_of_spline([(-4, -4), (4, -4), (4, 4), (-4, 4)]) / 400
    assert coverage(stage) == pytest.approx(expected, rel=0.01)


def test_materials_of_faces_and_holes_leave_the_surface_whole(stage):
    mesh = UsdGeom.Mesh.Define(stage.stage, "/grid")
    mesh.CreatePointsAttr([(x, y, -10) for y in (-4, 0, 4) for x in (-4, 0, 4)])
    mesh.CreateFaceVertexCountsAttr([4] * 4)
    mesh.CreateFaceVertexIndicesAttr([0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7])
    mesh.CreateDisplayColorAttr([(0, 0, 0)])
    mesh.CreateInterpolateBoundaryAttr("edgeOnly")
    ring = [(-4, -4), (0, -4), (4, -4), (4, 0), (4, 4), (0, 4), (-4, 4), (-4, 0)]
    whole = area_of_spline(ring) / 400
    assert coverage(stage) == pytest.approx(whole, rel=0.01)
    material = UsdShade.Material.Define(stage.stage, "/m")
    subset = UsdGeom.Subset.CreateGeomSubset(mesh, "part", UsdGeom.Tokens.face, Vt.IntArray([1]), "materialBind")
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)
    shader = UsdShade.Shader.Define(stage.stage, "/m/s")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0, 0, 0))
    shader.CreateInput("ior", Sdf.ValueTypeNames.Float).Set(1.0)
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    assert coverage(stage) == pytest.approx(whole, rel=0.01)
    # A quarter is away, by symmetry.
    mesh.CreateHoleIndicesAttr([3])
    assert coverage(stage) == pytest.approx(0.75 * whole, rel=0.01)


def levels(stage, **options):
    return [int(n) for n in re.findall(r'"integer levels" \[ (\d+) \]', stage.read(**options).text())]


def test_edges_are_cut_to_two_pixels(stage):
    square(stage)
    # Eight of twenty units are 40 of 100 pixels: 20 pieces of two pixels, which 2^5 are.
    assert levels(stage, size=(100, 100)) == [5]
    assert levels(stage, size=(12, 12)) == [2]
    assert levels(stage, size=(1, 1)) == [1]
    assert levels(stage, size=(4000, 4000)) == [6]
    assert levels(stage, size=(100, 100), subdivision=3) == [3]
    with pytest.raises(wend.InputError, match="subdivision -1"):
        stage.read(subdivision=-1)
    with pytest.warns(wend.SceneWarning, match="less than asked for"):
        assert levels(stage, subdivision=30) == [11]
    stage.camera.CreateProjectionAttr("orthographic")
    stage.camera.CreateHorizontalApertureAttr(400)
    stage.camera.CreateVerticalApertureAttr(400)
    # Forty units across.
    assert levels(stage, size=(100, 100)) == [4]


def test_what_cannot_be_subdivided_is_its_control_mesh(stage):
    spokes = 300
    turn = 2 * np.pi * np.arange(spokes) / spokes
    mesh = UsdGeom.Mesh.Define(stage.stage, "/fan")
    mesh.CreatePointsAttr([(0, 0, -10), *((4 * np.cos(a), 4 * np.sin(a), -10) for a in turn)])
    mesh.CreateFaceVertexCountsAttr([3] * spokes)
    mesh.CreateFaceVertexIndicesAttr([i for k in range(spokes) for i in (0, k + 1, (k + 1) % spokes + 1)])
    mesh.CreateDisplayColorAttr([(0, 0, 0)])
    with pytest.warns(wend.SceneWarning, match="/fan: warning: a surface with more than 256 edges at a point"):
        assert '"trianglemesh"' in stage.read().text()
    assert coverage(stage) == pytest.approx(np.pi * 16 / 400, rel=0.01)


def test_creases_that_are_none_are_named(stage):
    mesh = square(stage)
    mesh.CreateCreaseIndicesAttr([0, 7])
    mesh.CreateCreaseLengthsAttr([2])
    mesh.CreateCreaseSharpnessesAttr([1.0])
    mesh.CreateCornerIndicesAttr([1])
    with pytest.warns(wend.SceneWarning) as told:
        stage.read()
    texts = " ".join(str(warning.message) for warning in told)
    assert "creases whose numbers" in texts and "sharp corners whose numbers" in texts
