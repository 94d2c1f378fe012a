"""Stages are rendered as their settings ask for, or what differs is named."""

import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import Gf, Sdf, UsdGeom, UsdRender, UsdShade  # noqa: E402

import wend  # noqa: E402
from test_usd_as_written import bind, material  # noqa: E402
from usd_stage import Stage, coverage, middle  # noqa: E402


@pytest.fixture
def stage(tmp_path):
    made = Stage(tmp_path)
    made.settings = UsdRender.Settings.Define(made.stage, "/Render/settings")
    made.stage.SetMetadata("renderSettingsPrimPath", "/Render/settings")
    return made


@pytest.mark.parametrize(
    ("policy", "pixel", "share"),
    [
        ("expandAperture", 1, 1 / 8),
        ("expandAperture", 2, 1 / 16),
        ("cropAperture", 1, 1 / 2),
        ("adjustApertureWidth", 1, 1 / 8),
        ("adjustApertureWidth", 0.25, 1 / 2),
        ("adjustApertureHeight", 1, 1 / 2),
        ("adjustPixelAspectRatio", 3, 1 / 4),
    ],
)
def test_apertures_conform_as_is_asked_for(stage, policy, pixel, share):
    """The card covers a quarter of the aperture, which is a square; pictures are twice as wide as they are high."""
    stage.card(colour=(0, 0, 0), half=1)
    stage.settings.CreateAspectRatioConformPolicyAttr(policy)
    stage.settings.CreatePixelAspectRatioAttr(pixel)
    assert coverage(stage, size=(80, 40)) == pytest.approx(share, abs=0.012)


@pytest.mark.parametrize(("asked", "share"), [(None, 0.5), (["default", "proxy"], 0.0), (["default", "render", "proxy"], 0.0)])
def test_purposes_are_those_that_are_asked_for(stage, asked, share):
    """A proxy of a dark card, before what is for renders."""
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    for name, purpose, colour, distance in (("proxy", "proxy", (0, 0, 0), 1.5), ("render", "render", (0.5, 0.5, 0.5), 2)):
        card = stage.card(colour=colour, distance=distance, path=f"/{name}")
        UsdGeom.Imageable(card).CreatePurposeAttr(purpose)
    if asked is not None:
        stage.settings.CreateIncludedPurposesAttr(asked)
    assert middle(stage.image(spp=256))[0] == pytest.approx(share, abs=0.02)


@pytest.mark.parametrize(("asked", "colour"), [(None, 1), (["full", ""], 1), (["preview", ""], 2), ([""], 0)])
def test_materials_are_bound_for_what_is_asked_for(stage, asked, colour):
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    card = stage.card()
    for i, purpose in enumerate(("", "full", "preview")):
        made, _ = material(stage, tuple(0.8 * (k == i) for k in range(3)), f"/m{i}")
        bind(card, made, materialPurpose=purpose or UsdShade.Tokens.allPurpose)
    if asked is not None:
        stage.settings.CreateMaterialBindingPurposesAttr(asked)
    assert int(middle(stage.image(spp=4)).argmax()) == colour


def test_lenses_and_shutters_may_be_off(stage):
    stage.card()
    stage.camera.CreateFStopAttr(0.1)
    stage.camera.CreateFocusDistanceAttr(1.0)
    stage.camera.CreateShutterCloseAttr(1.0)
    moved = UsdGeom.XformCommonAPI(stage.camera)
    for time in (1, 2):
        moved.SetTranslate(Gf.Vec3d(time, 0, 0), time)
    assert "lensradius" in stage.read(time=1).text() and "ActiveTransform" in stage.read(time=1).text()
    stage.settings.CreateDisableDepthOfFieldAttr(True)
    stage.settings.GetPrim().CreateAttribute("disableMotionBlur", Sdf.ValueTypeNames.Bool).Set(True)
    assert "lensradius" not in stage.read(time=1).text() and "ActiveTransform" not in stage.read(time=1).text()


def test_windows_and_products_are_named(stage):
    stage.settings.CreateDataWindowNDCAttr(Gf.Vec4f(0, 0, 0.5, 1))
    product = UsdRender.Product.Define(stage.stage, "/Render/product")
    product.CreateResolutionAttr(Gf.Vec2i(20, 20))
    stage.settings.CreateProductsRel().SetTargets(["/Render/product"])
    with pytest.warns(wend.SceneWarning, match="/Render/settings: .*dataWindowNDC"):
        stage.read()
    with pytest.warns(wend.SceneWarning, match="/Render/product: .*resolution"):
        stage.read()


def test_pixels_of_no_shape_are_an_error(stage):
    stage.settings.CreatePixelAspectRatioAttr(0)
    with pytest.raises(wend.InputError, match="/Render/settings: error: a pixelAspectRatio of 0"):
        stage.read()
