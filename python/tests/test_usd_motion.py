"""USD's time: frames, and what moves while the camera's shutter is open, by what it covers over time."""

import numpy as np
import pytest
import wend

pytest.importorskip("pxr", reason="usd-core is absent")
pytestmark = pytest.mark.filterwarnings("ignore:.*no light:wend.SceneWarning")

from pxr import Gf, UsdGeom  # noqa: E402

from usd_stage import Stage  # noqa: E402


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


def test_frames_are_those_of_the_time(stage):
    cube = UsdGeom.Cube.Define(stage.stage, "/cube")
    place = cube.AddTranslateOp()
    place.Set(Gf.Vec3d(-5, 0, -10), 1)
    place.Set(Gf.Vec3d(5, 0, -10), 3)
    stage.stage.SetStartTimeCode(1)
    stage.stage.SetEndTimeCode(3)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    cube.CreateDisplayColorAttr([(0, 0, 0)])

    def column(**options):
        return np.nonzero(stage.image(size=(80, 80), **options)[40, :, 0] < 0.9)[0].mean()

    assert column() == pytest.approx(20, abs=2)
    assert column(time=2) == pytest.approx(39.5, abs=2)


def test_what_moves_is_blurred_while_the_shutter_is_open(stage):
    cube = UsdGeom.Cube.Define(stage.stage, "/cube")
    place = cube.AddTranslateOp()
    place.Set(Gf.Vec3d(-5, 0, -11), 1)
    place.Set(Gf.Vec3d(5, 0, -11), 3)
    cube.CreateDisplayColorAttr([(0, 0, 0)])
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    still = 1 - stage.image(size=(80, 80), spp=64, time=2)[:, :, 0].mean()
    stage.camera.CreateShutterOpenAttr(-0.5)
    stage.camera.CreateShutterCloseAttr(0.5)
    sky = stage.image(size=(80, 80), spp=256, time=2)[:, :, 0]
    assert 1 - sky.mean() == pytest.approx(still, rel=0.05)
    # At distance 10 the front, 2 across, goes from -2.5 to 2.5: each place is behind it for two fifths of the time.
    assert 1 - sky[40, 35:45].mean() == pytest.approx(0.4, abs=0.05)
    columns = np.nonzero((1 - sky[38:42]).mean(axis=0) > 0.02)[0]
    assert columns.min() == pytest.approx(26, abs=2) and columns.max() == pytest.approx(53, abs=2)
    # A camera that goes along sees it sharp.
    move = stage.camera.AddTranslateOp()
    move.Set(Gf.Vec3d(-5, 0, 0), 1)
    move.Set(Gf.Vec3d(5, 0, 0), 3)
    sharp = stage.image(size=(80, 80), spp=64, time=2)[:, :, 0]
    assert 1 - sharp[40, 40] == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("scheme", ["none", "bilinear"])
@pytest.mark.parametrize("by", ["samples", "velocities"])
def test_meshes_change_their_shape_while_the_shutter_is_open(stage, scheme, by):
    # The right edge of a card goes from x = 1 to x = 3, at distance 10, where the picture is 20 across.
    card = stage.card(colour=(0, 0, 0), half=1, distance=10)
    card.CreateSubdivisionSchemeAttr(scheme)
    points = card.GetPointsAttr()
    if by == "samples":
        points.Set([(-1, -1, -10), (0, -1, -10), (0, 1, -10), (-1, 1, -10)], 1)
        points.Set([(-1, -1, -10), (4, -1, -10), (4, 1, -10), (-1, 1, -10)], 3)
    else:
        points.Set([(-1, -1, -10), (2, -1, -10), (2, 1, -10), (-1, 1, -10)], 2)
        card.CreateVelocitiesAttr().Set([(0, 0, 0), (48, 0, 0), (48, 0, 0), (0, 0, 0)], 2)
        stage.stage.SetTimeCodesPerSecond(24)
    stage.camera.CreateShutterOpenAttr(-0.5)
    stage.camera.CreateShutterCloseAttr(0.5)
    edges = 1 + 2 * (np.arange(1000) + 0.5) / 1000
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    sky = stage.image(size=(80, 80), spp=256, time=2)[:, :, 0]
    assert 1 - sky.mean() == pytest.approx((1 + edges.mean()) * 2 / 400, rel=0.01)
    # Columns of a quarter unit: where the edge is for some of the time.
    for column in (42, 46, 49, 53):
        x = column / 4 - 10
        covered = np.clip((edges - x) / 0.25, 0, 1).mean()
        assert 1 - sky[38:42, column].mean() == pytest.approx(covered, abs=0.02)
    # At the time itself, without a shutter.
    stage.camera.CreateShutterOpenAttr(0.0)
    stage.camera.CreateShutterCloseAttr(0.0)
    still = stage.image(size=(80, 80), time=2)[:, :, 0]
    assert 1 - still.mean() == pytest.approx((1 + 2) * 2 / 400, rel=0.01)


def test_normals_go_with_points_that_move(stage):
    card = stage.card(half=1)
    card.GetPointsAttr().Set([(-1, -1, -2), (1, -1, -2), (1, 1, -2), (-1, 1, -2)], 1)
    card.GetPointsAttr().Set([(-1, -1, -2), (1, -1, -3), (1, 1, -3), (-1, 1, -2)], 3)
    card.CreateNormalsAttr().Set([(0, 0, 1)] * 4, 1)
    card.GetNormalsAttr().Set([(0.6, 0, 0.8)] * 4, 3)
    stage.camera.CreateShutterOpenAttr(-1.0)
    stage.camera.CreateShutterCloseAttr(1.0)
    text = stage.read(time=2).text()
    assert '"point3 P1"' in text and '"normal3 N1" [ 0.6' in text
    # Points whose number changes are taken as they are.
    card.GetPointsAttr().Set([(-1, -1, -2), (1, -1, -3), (1, 1, -3), (-1, 1, -2), (0, 0, 0)], 3)
    assert '"point3 P1"' not in stage.read(time=2).text()


def test_instances_move_with_their_samples(stage):
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/copies")
    cube = UsdGeom.Cube.Define(stage.stage, "/copies/cube")
    cube.CreateSizeAttr(2)
    cube.CreateDisplayColorAttr([(0, 0, 0)])
    UsdGeom.XformCommonAPI(cube).SetScale(Gf.Vec3f(1, 1, 0.001))
    instancer.CreatePrototypesRel().AddTarget(cube.GetPath())
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr().Set([(-5, 0, -10)], 1)
    instancer.GetPositionsAttr().Set([(5, 0, -10)], 3)
    stage.camera.CreateShutterOpenAttr(-0.5)
    stage.camera.CreateShutterCloseAttr(0.5)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    sky = stage.image(size=(80, 80), spp=256, time=2)[:, :, 0]
    # Two units across that go from -2.5 to 2.5.
    assert 1 - sky[40, 35:45].mean() == pytest.approx(0.4, abs=0.02)
    columns = np.nonzero((1 - sky[38:42]).mean(axis=0) > 0.02)[0]
    assert columns.min() == pytest.approx(26, abs=2) and columns.max() == pytest.approx(53, abs=2)


def test_lights_move_while_the_shutter_is_open(stage):
    lamp = stage.lamp("RectLight", place=(0, 0, 0), turn=(0, 180, 0), intensity=2.0, width=2.0, height=2.0)
    move = UsdGeom.Xformable(lamp).GetOrderedXformOps()[0]
    move.Set(Gf.Vec3d(-5, 0, -10), 1)
    move.Set(Gf.Vec3d(5, 0, -10), 3)
    stage.camera.CreateShutterOpenAttr(-0.5)
    stage.camera.CreateShutterCloseAttr(0.5)
    seen = stage.image(size=(80, 80), spp=256, time=2)[:, :, 0]
    # Two units across that go from -2.5 to 2.5: each place has it for two fifths of the time.
    assert seen.mean() == pytest.approx(2 * 4 / 400, rel=0.02)
    assert seen[40, 35:45].mean() == pytest.approx(0.8, abs=0.05)
    still = stage.stage.DefinePrim("/sun", "DistantLight")
    turn = UsdGeom.Xformable(still).AddRotateXOp()
    turn.Set(0.0, 1)
    turn.Set(90.0, 3)
    with pytest.warns(wend.SceneWarning, match="/sun: warning: a light without a size stays"):
        stage.read(time=2)
