"""What stages say that nothing reads is told, with the prim."""

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdShade  # noqa: E402

import wend  # noqa: E402
from test_usd_as_written import bind, connect, material, on_a_card, png  # noqa: E402
from usd_stage import Stage, middle  # noqa: E402

TYPES = Sdf.ValueTypeNames


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path).sky()


def curves(stage):
    prim = UsdGeom.BasisCurves.Define(stage.stage, "/it")
    prim.CreateTypeAttr("linear")
    prim.CreatePointsAttr([(-1, 0, -2), (1, 0, -2)])
    prim.CreateCurveVertexCountsAttr([2])
    prim.CreateWidthsAttr([0.1])
    prim.SetWidthsInterpolation("constant")
    prim.CreateNormalsAttr([(0, 1, 0), (0, 1, 0)])


def displaced(stage):
    made, shader = material(stage, path="/it")
    made.CreateDisplacementOutput("mtlx").ConnectToSource(shader.ConnectableAPI(), "out")
    bind(stage.card(), made)


def unbound(stage):
    rel = UsdShade.MaterialBindingAPI.Apply(stage.card(path="/it").GetPrim()).GetDirectBindingRel()
    (rel or stage.stage.GetPrimAtPath("/it").CreateRelationship("material:binding")).SetTargets(["/nowhere"])


def cards(stage):
    model = UsdGeom.ModelAPI.Apply(UsdGeom.Xform.Define(stage.stage, "/it").GetPrim())
    Usd.ModelAPI(model.GetPrim()).SetKind("component")
    model.CreateModelDrawModeAttr("cards")
    model.CreateModelApplyDrawModeAttr(True)


def coloured(stage):
    made, shader = material(stage, (0.8, 0, 0), path="/it")
    shader.GetInput("diffuseColor").GetAttr().SetColorSpace("lin_ap1_scene")
    bind(stage.card(), made)


WAYS = {
    "a light that is a sphere": (
        lambda s: UsdLux.LightAPI.Apply(s.stage.DefinePrim("/it", "Sphere")),
        "/it: .* Sphere that is a light",
    ),
    "no shaping": (
        lambda s: s.stage.DefinePrim("/it", "SphereLight").CreateAttribute("inputs:shaping:cone:angle", TYPES.Float).Set(5.0),
        "/it: .*inputs:shaping:cone:angle is left out, as ShapingAPI is not applied",
    ),
    "unknown": (lambda s: s.stage.DefinePrim("/it", "PxrEnvDayLight"), "/it: .* PxrEnvDayLight, which USD does not know"),
    "procedural": (lambda s: s.stage.DefinePrim("/it", "GenerativeProcedural"), "/it: .* GenerativeProcedural is left out"),
    "cards": (cards, "/it: .*model:drawMode = cards"),
    "ribbons": (curves, "/it: .*ribbons, are taken as round"),
    "displacement": (displaced, "/it: .*outputs:displacement is left out"),
    "missing material": (unbound, "/it: .*not there: /nowhere"),
    "colours": (coloured, "/it/surface: .*colours of the space lin_ap1_scene"),
}


@pytest.mark.parametrize("way", WAYS)
def test_what_is_not_read_is_told(stage, way):
    assert stage.told() == []
    change, text = WAYS[way]
    change(stage)
    with pytest.warns(wend.SceneWarning, match=text):
        stage.read()


def test_samples_without_a_first_frame_are_taken_at_their_first(stage):
    card = stage.card(colour=(0.4, 0.4, 0.4))
    points = card.GetPointsAttr().Get()
    card.GetPointsAttr().Clear()
    card.GetPointsAttr().Set(points, 3)
    with pytest.warns(wend.SceneWarning, match="no startTimeCode: it is taken at the first, 3"):
        stage.read()
    assert middle(stage.image()) == pytest.approx(np.full(3, 0.4), abs=0.01)


@pytest.mark.parametrize(("family", "target"), [(None, "/m"), ("materialBind", "/nowhere")])
def test_materials_of_faces_that_are_not_taken_are_told(stage, family, target):
    material(stage, (0.8, 0, 0))
    card = stage.card()
    subset = UsdGeom.Subset.CreateGeomSubset(card, "part", "face", [0], family or "")
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim())
    subset.GetPrim().CreateRelationship("material:binding").SetTargets([target])
    with pytest.warns(wend.SceneWarning, match="/card/part: .*(not there: /nowhere|family materialBind)"):
        stage.read()


@pytest.mark.parametrize(
    ("name", "kind", "value"),
    [
        ("orientations", TYPES.QuathArray, [Gf.Quath(1)]),
        ("orientationsf", TYPES.QuatfArray, [Gf.Quatf(1)]),
        ("scales", TYPES.Float3Array, [(1, 1, 1)]),
    ],
)
def test_instancers_with_too_few_turns_are_told(stage, name, kind, value):
    """USD's own library makes places of what lies beyond them in memory."""
    UsdGeom.Cube.Define(stage.stage, "/it/proto")
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/it")
    instancer.CreatePrototypesRel().SetTargets(["/it/proto"])
    instancer.CreateProtoIndicesAttr([0, 0, 0])
    instancer.CreatePositionsAttr([(x, 0, -5) for x in (-1, 0, 1)])
    instancer.GetPrim().CreateAttribute(name, kind).Set(value)
    with pytest.warns(wend.SceneWarning, match=f"/it: .*whose {name} are not as many"):
        stage.read()


def test_other_coordinates_than_those_that_are_asked_for_are_told(stage, tmp_path):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 128)))
    node = UsdShade.Shader(stage.stage.GetPrimAtPath("/m/emissiveColor"))
    connect(stage, node, "st", "UsdPrimvarReader_float2", {"varname": (TYPES.String, "uv2")}, "result", TYPES.Float2)
    with pytest.warns(wend.SceneWarning, match="/card: .*coordinates uv2 are not there: st are taken"):
        stage.read()


@pytest.mark.parametrize(("mode", "is_told"), [("transparent", True), ("presence", False)])
def test_reflection_that_an_opacity_takes_with_it_is_told(stage, mode, is_told):
    made, shader = material(stage)
    shader.CreateInput("opacity", TYPES.Float).Set(0.5)
    shader.CreateInput("opacityMode", TYPES.Token).Set(mode)
    bind(stage.card(), made)
    assert any("/m/surface: " in word and "what is reflected" in word for word in stage.told()) == is_told


def test_instancers_with_too_many_sizes_have_the_first(stage):
    """As USD's own library makes them."""
    UsdGeom.Cube.Define(stage.stage, "/it/proto")
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/it")
    instancer.CreatePrototypesRel().SetTargets(["/it/proto"])
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(-1, 0, -5), (1, 0, -5)])
    instancer.CreateScalesAttr([(0.5, 0.5, 0.5)] * 3)
    assert not stage.told()
    assert stage.read().text().count("ObjectInstance") == 2
