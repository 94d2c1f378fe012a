"""No input of USD's surfaces and lights is ignored without a word: each changes the scene or what is told."""

import warnings

import numpy as np
import pytest

import wend

pytest.importorskip("pxr", reason="usd-core is not installed")
from pxr import Gf, Sdf, UsdGeom, UsdLux, UsdShade  # noqa: E402
from usd_stage import Stage  # noqa: E402

TYPES = {
    "float": Sdf.ValueTypeNames.Float,
    "color": Sdf.ValueTypeNames.Color3f,
    "bool": Sdf.ValueTypeNames.Bool,
    "int": Sdf.ValueTypeNames.Int,
    "token": Sdf.ValueTypeNames.Token,
}
VALUES = {"color": (0.17, 0.43, 0.71), "bool": True, "int": 1, "token": "presence"}

SURFACES = {
    "UsdPreviewSurface": """diffuseColor:color emissiveColor:color useSpecularWorkflow:int specularColor:color metallic
        roughness clearcoat clearcoatRoughness opacity opacityMode:token opacityThreshold ior displacement normal:color""",
    "ND_standard_surface_surfaceshader": """base base_color:color diffuse_roughness metalness specular specular_color:color
        specular_roughness specular_IOR specular_anisotropy specular_rotation transmission transmission_color:color
        transmission_depth transmission_scatter:color transmission_scatter_anisotropy transmission_dispersion
        transmission_extra_roughness subsurface subsurface_color:color subsurface_radius:color subsurface_scale
        subsurface_anisotropy sheen sheen_color:color sheen_roughness coat coat_color:color coat_roughness coat_anisotropy
        coat_IOR coat_affect_color coat_affect_roughness thin_film_thickness emission emission_color:color opacity:color
        thin_walled:bool""",
    "ND_open_pbr_surface_surfaceshader": """base_weight base_color:color base_diffuse_roughness base_metalness specular_weight
        specular_color:color specular_roughness specular_ior specular_roughness_anisotropy transmission_weight
        transmission_color:color transmission_depth transmission_scatter:color transmission_scatter_anisotropy
        transmission_dispersion_scale subsurface_weight subsurface_color:color subsurface_radius subsurface_radius_scale:color
        subsurface_scatter_anisotropy fuzz_weight fuzz_color:color fuzz_roughness coat_weight coat_color:color coat_roughness
        coat_roughness_anisotropy coat_ior coat_darkening thin_film_weight emission_luminance emission_color:color
        geometry_opacity geometry_thin_walled:bool""",
}
#: What makes other inputs count.
WITH = {
    "UsdPreviewSurface": [{"clearcoat": 0.5}, {"opacity": 0.0}, {"useSpecularWorkflow": 1}],
    "ND_standard_surface_surfaceshader": [
        {"transmission": 1.0},
        {"transmission": 1.0, "transmission_depth": 1.0},
        {"transmission": 1.0, "transmission_depth": 1.0, "transmission_scatter": (0.2, 0.1, 0.1)},
        {"subsurface": 1.0},
        {"sheen": 0.5},
        {"coat": 0.5},
        {"emission": 1.0},
    ],
    "ND_open_pbr_surface_surfaceshader": [
        {"transmission_weight": 1.0},
        {"transmission_weight": 1.0, "transmission_depth": 1.0},
        {"transmission_weight": 1.0, "transmission_depth": 1.0, "transmission_scatter": (0.2, 0.1, 0.1)},
        {"subsurface_weight": 1.0},
        {"fuzz_weight": 0.5},
        {"coat_weight": 0.5},
        {"emission_luminance": 1.0},
    ],
}


def told(stage, tmp_path):
    """The scene as text, and its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        text = stage.read(maps=tmp_path / "maps").text()
    return text, {str(w.message) for w in caught if w.category is wend.SceneWarning}


@pytest.mark.parametrize("kind", SURFACES)
def test_surfaces(tmp_path, kind):
    declared = [word.partition(":")[::2] for word in SURFACES[kind].split()]
    types = {name: type_ or "float" for name, type_ in declared}
    stage = Stage(tmp_path)
    material = UsdShade.Material.Define(stage.stage, "/mat")
    shader = UsdShade.Shader.Define(stage.stage, "/mat/s")
    shader.CreateIdAttr(kind)
    is_preview = kind == "UsdPreviewSurface"
    output = material.CreateSurfaceOutput() if is_preview else material.CreateSurfaceOutput("mtlx")
    output.ConnectToSource(shader.ConnectableAPI(), "out")
    UsdShade.MaterialBindingAPI.Apply(stage.card().GetPrim()).Bind(material)

    def give(name, value):
        shader.CreateInput(name, TYPES[types[name]]).Set(Gf.Vec3f(*value) if isinstance(value, tuple) else value)

    left = set(types)
    for given in [{}, *WITH[kind]]:
        for name, value in given.items():
            give(name, value)
        before = told(stage, tmp_path)
        for name in sorted(left - set(given)):
            give(name, VALUES.get(types[name], 0.37))
            if told(stage, tmp_path) != before:
                left.remove(name)
            shader.GetPrim().RemoveProperty(f"inputs:{name}")
        for name in given:
            shader.GetPrim().RemoveProperty(f"inputs:{name}")
    assert not left


@pytest.mark.parametrize(
    "change",
    [
        lambda p: UsdLux.ShadowAPI.Apply(p).CreateShadowEnableAttr(False),
        lambda p: UsdLux.ShadowAPI.Apply(p).CreateShadowColorAttr((1, 0, 0)),
        lambda p: UsdLux.LightAPI(p).GetLightLinkCollectionAPI().CreateIncludeRootAttr(False),
        lambda p: UsdLux.LightAPI(p).CreateDiffuseAttr(0.5),
        lambda p: UsdLux.LightAPI(p).CreateNormalizeAttr(True),
        lambda p: UsdLux.LightAPI(p).CreateExposureAttr(1),
    ],
    ids=["no shadows", "coloured shadows", "links", "diffuse", "normalised", "exposure"],
)
def test_lights(tmp_path, change):
    stage = Stage(tmp_path)
    prim = stage.lamp("RectLight", width=3.0)
    before = told(stage, tmp_path)
    change(prim)
    assert told(stage, tmp_path) != before


@pytest.mark.parametrize(
    "change",
    [
        lambda c: c.CreateExposureAttr(1.0),
        lambda c: c.CreateExposureIsoAttr(200.0),
        lambda c: c.CreateExposureFStopAttr(2.0),
        lambda c: c.CreateExposureTimeAttr(0.01),
        lambda c: c.CreateExposureResponsivityAttr(0.5),
        lambda c: c.CreateClippingRangeAttr(Gf.Vec2f(20, 1000)),
        lambda c: c.CreateClippingPlanesAttr([(0, 0, -1, -1)]),
        lambda c: c.CreateFStopAttr(2.0),
        lambda c: c.CreateVerticalApertureOffsetAttr(1.0),
        lambda c: c.CreateFocalLengthAttr(12.0),
    ],
    ids=["exposure", "iso", "f-stop", "time", "responsivity", "near", "planes", "lens", "offset", "focal length"],
)
def test_cameras(tmp_path, change):
    stage = Stage(tmp_path)
    stage.card()
    before = told(stage, tmp_path)
    try:
        change(stage.camera)
    except AttributeError:
        pytest.skip("this USD has no such attribute")
    assert told(stage, tmp_path) != before


@pytest.mark.parametrize(("axis", "upwards", "brightest"), [("Y", "z", "+y"), ("Z", "y", "+z"), ("scene", "z", "+z")])
def test_a_dome_has_its_pole_where_it_is_asked_to_be(tmp_path, axis, upwards, brightest):
    picture = tmp_path / "sky.exr"
    rows = np.zeros((8, 16, 3), dtype=np.float32)
    rows[0] = 5  # around the pole
    wend.Film.of(rows).save(picture)
    stage = Stage(tmp_path)
    UsdGeom.SetStageUpAxis(stage.stage, UsdGeom.Tokens.z if upwards == "z" else UsdGeom.Tokens.y)
    dome = UsdLux.DomeLight_1.Define(stage.stage, "/sky")
    dome.CreateTextureFileAttr(str(picture))
    dome.CreatePoleAxisAttr(axis)
    seen = {}
    for towards in ("+y", "-y", "+z", "+x"):
        stage.look(towards)
        seen[towards] = float(stage.image(size=(9, 9))[3:6, 3:6].mean())
    assert max(seen, key=seen.get) == brightest and seen[brightest] > 1
