"""Stages of USD: what cameras see, what lights give by their specification, shapes, materials, instances."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import wend

pytest.importorskip("pxr", reason="usd-core is absent")
pytestmark = pytest.mark.filterwarnings("ignore:.*no light:wend.SceneWarning")

from pxr import Gf, Sdf, UsdGeom, UsdLux, UsdShade, UsdUtils, UsdVol, Vt  # noqa: E402

import wend.usd  # noqa: E402
from usd_stage import Stage, coverage, middle  # noqa: E402


SMALL_VOLUME = Path(__file__).resolve().parents[2] / "fuzz" / "corpus" / "vdb" / "zip.vdb"


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


@pytest.mark.parametrize(
    ("kind", "inputs", "scale", "area"),
    [
        ("RectLight", {"width": 2.0, "height": 3.0}, (1, 1, 1), 6),
        ("RectLight", {"width": 2.0, "height": 3.0}, (2, 0.5, 3), 6),
        ("RectLight", {"width": 2.0, "height": 3.0}, (2, 1, 1), 12),
        ("DiskLight", {"radius": 1.5}, (1, 1, 1), math.pi * 2.25),
        ("DiskLight", {"radius": 1.5}, (2, 2, 1), math.pi * 9),
        ("SphereLight", {"radius": 1.5}, (1, 1, 1), 4 * math.pi * 2.25),
        ("SphereLight", {"radius": 0.75}, (2, 2, 2), 4 * math.pi * 2.25),
        ("CylinderLight", {"radius": 1.0, "length": 3.0}, (1, 1, 1), 6 * math.pi),
    ],
)
def test_area_lights_have_the_radiance_of_their_specification(stage, kind, inputs, scale, area):
    stage.lamp(kind, scale=scale, color=Gf.Vec3f(1, 0.5, 0.25), intensity=3.0, exposure=2.0, **inputs)
    assert middle(stage.image()) == pytest.approx((12, 6, 3), rel=1e-4)
    stage.stage.GetPrimAtPath("/lamp").GetAttribute("inputs:normalize").Set(True)
    assert middle(stage.image()) == pytest.approx(np.array((12, 6, 3)) / area, rel=1e-4)


@pytest.mark.parametrize("kind", ["RectLight", "DiskLight"])
def test_flat_lights_shine_along_minus_z_alone(stage, kind):
    stage.lamp(kind, turn=(0, 0, 0), intensity=3.0, **({"radius": 2.0} if kind == "DiskLight" else {"width": 4.0, "height": 4.0}))
    assert middle(stage.image()) == pytest.approx((0, 0, 0), abs=1e-6)


def test_distant_lights_give_their_irradiance(stage):
    stage.card()
    prim = stage.lamp("DistantLight", turn=(0, 0, 0), intensity=2 * math.pi, angle=0.5, normalize=True)
    # Irradiance 2 pi on a matt card of albedo 1/2.
    assert middle(stage.image(spp=64)) == pytest.approx((1, 1, 1), rel=1e-3)
    prim.GetAttribute("inputs:normalize").Set(False)
    prim.GetAttribute("inputs:intensity").Set(1000.0)
    expected = 0.5 / math.pi * 1000 * math.pi * math.sin(math.radians(0.25)) ** 2
    assert middle(stage.image(spp=64)) == pytest.approx(np.full(3, expected), rel=1e-3)


def test_a_sphere_that_is_a_point_has_its_intensity(stage):
    stage.card()
    stage.lamp("SphereLight", place=(0, 0, 0.5), turn=(0, 0, 0), radius=0.1, intensity=100.0)
    prim = stage.stage.GetPrimAtPath("/lamp")
    prim.GetAttribute("treatAsPoint").Set(True)
    # Radiance 100 over a disc of radius 0.1, at 2.5 from the card.
    expected = 0.5 / math.pi * 100 * math.pi * 0.01 / 2.5**2
    assert middle(stage.image(spp=64, size=(91, 91))) == pytest.approx(np.full(3, expected), rel=2e-3)
    UsdLux.ShapingAPI.Apply(prim).CreateShapingConeAngleAttr(20)
    UsdLux.ShapingAPI(prim).CreateShapingConeSoftnessAttr(0.1)
    image = stage.image(spp=16, size=(91, 91))
    assert middle(image) == pytest.approx(np.full(3, expected), rel=2e-3)
    assert image[2, 2] == pytest.approx((0, 0, 0), abs=1e-9)


def test_temperatures_colour_lights(stage):
    stage.lamp("RectLight", width=4.0, height=4.0, intensity=2.0, enableColorTemperature=True, colorTemperature=3000.0)
    red, _, blue = middle(stage.image())
    assert red > 3 * blue > 0
    seen = middle(stage.image())
    assert 0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2] == pytest.approx(2, rel=0.02)


@pytest.mark.parametrize(("towards", "colour"), [("+z", 0), ("+x", 1), ("+y", 2), ("-x", 3)])
def test_domes_are_turned_as_openexr_says(stage, tmp_path, towards, colour):
    colours = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0.5, 0)], dtype=np.float32)
    picture = np.zeros((64, 128, 3), dtype=np.float32)
    picture[:, 56:72] = colours[0]  # the middle: longitude 0, +z
    picture[:, 24:40] = colours[1]  # longitude pi / 2, +x
    picture[:, 88:104] = colours[3]
    picture[:10] = colours[2]
    wend.Film.of(picture).save(tmp_path / "sky.exr")
    prim = stage.stage.DefinePrim("/sky", "DomeLight")
    prim.GetAttribute("inputs:texture:file").Set(Sdf.AssetPath(str(tmp_path / "sky.exr")))
    prim.GetAttribute("inputs:intensity").Set(3.0)
    stage.look(towards)
    assert middle(stage.image()) == pytest.approx(3 * colours[colour], abs=1e-3)


def test_cameras_see_what_usd_says(stage):
    # A bright card of 0.2 x 0.2 at a known place, right of and above the middle.
    card = stage.card(half=0.1, path="/mark")
    UsdGeom.XformCommonAPI(card).SetTranslate(Gf.Vec3d(1.0, 0.5, 0))
    material = UsdShade.Material.Define(stage.stage, "/m")
    shader = UsdShade.Shader.Define(stage.stage, "/m/s")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set((5, 5, 5))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(card.GetPrim()).Bind(material)

    def centre(**options):
        image = stage.image(**options)[:, :, 1]
        y, x = np.nonzero(image > 1)
        return (x.mean() + 0.5) / image.shape[1], (y.mean() + 0.5) / image.shape[0]

    # At distance 2 the half width is 2.
    assert centre(size=(160, 160)) == pytest.approx((0.75, 0.375), abs=0.01)
    # A wider picture sees more at the sides.
    assert centre(size=(320, 160)) == pytest.approx((0.625, 0.375), abs=0.01)
    assert centre(size=(160, 320)) == pytest.approx((0.75, 0.4375), abs=0.01)
    stage.camera.CreateHorizontalApertureOffsetAttr(5)
    assert centre(size=(160, 160)) == pytest.approx((0.5, 0.375), abs=0.01)
    stage.camera.CreateHorizontalApertureOffsetAttr(0)
    stage.camera.CreateProjectionAttr("orthographic")
    stage.camera.CreateHorizontalApertureAttr(40)
    stage.camera.CreateVerticalApertureAttr(40)
    # Four units across.
    assert centre(size=(160, 160)) == pytest.approx((0.75, 0.375), abs=0.01)


def test_an_exposure_multiplies(stage):
    prim = stage.stage.DefinePrim("/sky", "DomeLight")
    prim.GetAttribute("inputs:intensity").Set(3.0)
    before = middle(stage.image())
    # A stop and a half.
    stage.camera.CreateExposureAttr(1.5)
    assert middle(stage.image()) == pytest.approx(before * 2**1.5, rel=1e-4)
    stage.camera.GetExposureAttr().Set(float("inf"))
    with pytest.raises(wend.InputError, match="exposure"):
        stage.read()


@pytest.mark.parametrize(
    ("kind", "values", "share"),
    [
        # At distance 10 the picture is 20 across.
        ("Cube", {"size": 4.0}, 16 / 400 * (10 / 8) ** 2),
        ("Sphere", {"radius": 2.0}, math.pi * 4 / 400 * 100 / 96),
        ("Cylinder", {"radius": 2.0, "height": 0.01}, math.pi * 4 / 400),
        ("Plane", {"width": 4.0, "length": 2.0}, 8 / 400),
        ("Cone", {"radius": 2.0, "height": 0.01}, math.pi * 4 / 400),
        ("Capsule", {"radius": 2.0, "height": 0.01}, math.pi * 4 / 400 * 100 / 96),
        ("Cylinder_1", {"radiusBottom": 2.0, "radiusTop": 1.0, "height": 0.01}, math.pi * 4 / 400),
        ("Capsule_1", {"radiusBottom": 1.0, "radiusTop": 0.5, "height": 2.0, "axis": "Y"}, (math.pi * 0.625 + 3) / 400),
    ],
)
def test_primitives_have_their_sizes(stage, kind, values, share):
    prim = stage.stage.DefinePrim("/thing", kind)
    for name, value in values.items():
        prim.GetAttribute(name).Set(value)
    UsdGeom.XformCommonAPI(prim).SetTranslate(Gf.Vec3d(0, 0, -10))
    UsdGeom.Gprim(prim).CreateDisplayColorAttr([(0, 0, 0)])
    assert coverage(stage, (160, 160)) == pytest.approx(share, rel=0.04)


def test_faces_keep_their_materials_and_their_holes(stage):
    mesh = UsdGeom.Mesh.Define(stage.stage, "/mesh")
    x = [-2, -1, 0, 1, 2]
    mesh.CreatePointsAttr([(a, b, -2) for b in (-2, 2) for a in x])
    mesh.CreateFaceVertexCountsAttr([4, 4, 4, 4])
    mesh.CreateFaceVertexIndicesAttr([k + d for k in range(4) for d in (0, 1, 6, 5)])
    mesh.CreateSubdivisionSchemeAttr("none")
    mesh.CreateHoleIndicesAttr([3])
    for k, colour in enumerate([(2, 0, 0), (0, 3, 0)]):
        material = UsdShade.Material.Define(stage.stage, f"/m{k}")
        shader = UsdShade.Shader.Define(stage.stage, f"/m{k}/s")
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set(colour)
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set((0, 0, 0))
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        if k == 0:
            subset = UsdGeom.Subset.CreateGeomSubset(mesh, "part", UsdGeom.Tokens.face, Vt.IntArray([1]), "materialBind")
            UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)
        else:
            UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    image = stage.image(size=(32, 32))[16]
    for column, (red, green) in zip((4, 12, 20), ((0, 3), (2, 0), (0, 3))):
        assert image[column][0] >= red and (image[column][0] < 1) == (red == 0)
        assert image[column][1] >= green and (image[column][1] < 1) == (green == 0)
    assert image[28] == pytest.approx((0, 0, 0), abs=1e-6)


@pytest.mark.parametrize("scheme", ["none", "catmullClark", "bilinear"])
def test_textures_lie_as_usd_has_them(stage, tmp_path, scheme):
    picture = np.zeros((32, 32, 3), dtype=np.float32)
    picture[:16] = (0.8, 0.1, 0.1)  # the upper half
    picture[16:] = (0.1, 0.1, 0.8)
    wend.Film.of(picture).save(tmp_path / "map.exr")
    card = stage.card(half=2, distance=2)
    card.CreateSubdivisionSchemeAttr(scheme)
    UsdGeom.PrimvarsAPI(card).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying").Set(
        [(0, 0), (1, 0), (1, 1), (0, 1)]
    )
    material = UsdShade.Material.Define(stage.stage, "/m")
    shader = UsdShade.Shader.Define(stage.stage, "/m/s")
    shader.CreateIdAttr("UsdPreviewSurface")
    texture = UsdShade.Shader.Define(stage.stage, "/m/t")
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("map.exr")
    texture.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set("raw")
    texture.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(texture.ConnectableAPI(), "rgb")
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(card.GetPrim()).Bind(material)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    image = stage.image(size=(8, 8), spp=64)
    assert image[1, 4][0] > 2 * image[1, 4][2] and image[6, 4][2] > 2 * image[6, 4][0]


def test_pictures_are_found_in_packages(stage, tmp_path):
    wend.Film.of(np.full((4, 8, 3), 0.5, dtype=np.float32)).save(tmp_path / "sky.exr")
    prim = stage.stage.DefinePrim("/sky", "DomeLight")
    prim.GetAttribute("inputs:texture:file").Set(Sdf.AssetPath("sky.exr"))
    prim.GetAttribute("inputs:intensity").Set(3.0)
    stage.stage.GetRootLayer().Save()
    assert UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(stage.file)), str(tmp_path / "stage.usdz"))
    (tmp_path / "sky.exr").unlink()
    scene = wend.usd.read(tmp_path / "stage.usdz", resolution=(3, 3), spp=4).scene()
    assert wend.render(scene, progress=False).image == pytest.approx(np.full((3, 3, 3), 1.5), rel=1e-3)


def materialx(stage, prim, identifier, **inputs):
    material = UsdShade.Material.Define(stage.stage, "/mx")
    shader = UsdShade.Shader.Define(stage.stage, "/mx/s")
    shader.CreateIdAttr(identifier)
    for name, value in inputs.items():
        kind = Sdf.ValueTypeNames.Color3f if isinstance(value, tuple) else Sdf.ValueTypeNames.Float
        shader.CreateInput(name, kind).Set(value)
    material.CreateSurfaceOutput("mtlx").ConnectToSource(shader.ConnectableAPI(), "out")
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)


@pytest.mark.parametrize(
    ("identifier", "names"),
    [
        ("ND_standard_surface_surfaceshader", ("transmission", "specular_IOR")),
        ("ND_open_pbr_surface_surfaceshader", ("transmission_weight", "specular_ior")),
    ],
)
def test_glass_of_a_depth_has_its_colour(stage, identifier, names):
    cube = UsdGeom.Cube.Define(stage.stage, "/cube")
    UsdGeom.XformCommonAPI(cube).SetTranslate(Gf.Vec3d(0, 0, -3))
    given = {names[0]: 1.0, names[1]: 1.0, "transmission_color": (0.8, 0.5, 0.2), "transmission_depth": 2.0}
    materialx(stage, cube.GetPrim(), identifier, specular_roughness=0.0, **given)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    # The cube is as thick as the depth, and refracts nothing.
    stage.camera.GetFocalLengthAttr().Set(1000)
    seen = stage.image(size=(16, 16), spp=256).mean(axis=(0, 1))
    assert seen == pytest.approx((0.8, 0.5, 0.2), rel=3e-3)
    # Scattering takes nothing away: under a white sky, what does not absorb cannot be seen.
    shader = UsdShade.Shader.Get(stage.stage, "/mx/s")
    shader.GetInput("transmission_color").Set((0.5, 0.5, 0.5))
    shader.CreateInput("transmission_scatter", Sdf.ValueTypeNames.Color3f).Set((math.log(2),) * 3)
    assert middle(stage.image(size=(5, 5), spp=256)) == pytest.approx((1, 1, 1), rel=1e-3)


@pytest.mark.parametrize(
    ("identifier", "inputs"),
    [
        ("ND_standard_surface_surfaceshader", {"subsurface": 1.0, "subsurface_scale": 0.05, "specular_IOR": 1.0}),
        ("ND_open_pbr_surface_surfaceshader", {"subsurface_weight": 1.0, "subsurface_radius": 0.05, "specular_ior": 1.0}),
    ],
)
def test_dense_media_have_the_colour_that_is_asked_for(stage, identifier, inputs):
    sphere = UsdGeom.Sphere.Define(stage.stage, "/ball")
    sphere.CreateRadiusAttr(2)
    UsdGeom.XformCommonAPI(sphere).SetTranslate(Gf.Vec3d(0, 0, -5))
    materialx(stage, sphere.GetPrim(), identifier, subsurface_color=(0.8, 0.5, 0.3), **inputs)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    assert middle(stage.image(size=(5, 5), spp=1024)) == pytest.approx((0.8, 0.5, 0.3), abs=0.04)


@pytest.mark.parametrize(
    ("identifier", "names"),
    [
        ("ND_standard_surface_surfaceshader", ("sheen", "sheen_color", "sheen_roughness", "specular")),
        ("ND_open_pbr_surface_surfaceshader", ("fuzz_weight", "fuzz_color", "fuzz_roughness", "specular_weight")),
    ],
)
def test_fibres_cover_what_is_below_by_what_they_scatter(stage, identifier, names):
    cube = UsdGeom.Cube.Define(stage.stage, "/cube")
    UsdGeom.XformCommonAPI(cube).SetTranslate(Gf.Vec3d(0, 0, -3))
    given = dict(zip(names, (1.0, (1.0, 0.5, 0.0), 1.0, 0.0), strict=True))
    materialx(stage, cube.GetPrim(), identifier, base_color=(1.0, 1.0, 1.0), **given)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    stage.camera.GetFocalLengthAttr().Set(1000)
    seen = stage.image(size=(16, 16), spp=256).mean(axis=(0, 1))
    # Of light from straight ahead the roughest fibres scatter back 0.342 (zeltner2022).
    assert seen == pytest.approx((1, 1 - 0.342 / 2, 1 - 0.342), abs=5e-3)


def test_instances_are_where_they_are_put(stage):
    root = UsdGeom.Xform.Define(stage.stage, "/things")
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/things/copies")
    cube = UsdGeom.Cube.Define(stage.stage, "/things/copies/cube")
    cube.CreateSizeAttr(1)
    cube.CreateDisplayColorAttr([(0, 0, 0)])
    UsdGeom.XformCommonAPI(cube).SetScale(Gf.Vec3f(2, 2, 0.01))
    instancer.CreatePrototypesRel().AddTarget(cube.GetPath())
    instancer.CreateProtoIndicesAttr([0, 0, 0])
    instancer.CreatePositionsAttr([(-5, 0, 0), (5, 5, 0), (0, 0, 0)])
    instancer.CreateInvisibleIdsAttr([2])
    UsdGeom.XformCommonAPI(root).SetTranslate(Gf.Vec3d(0, 0, -10))
    assert coverage(stage) == pytest.approx(2 * 4 / 400, rel=0.05)
    image = stage.image(size=(80, 80))[:, :, 0]
    assert image[40, 20] < 0.9 and image[20, 60] < 0.9 and image[40, 40] > 0.9


def cards(stage, path, positions, target):
    """An instancer that copies a black card of 2 x 2, or another prim."""
    instancer = UsdGeom.PointInstancer.Define(stage.stage, path)
    if target is None:
        cube = UsdGeom.Cube.Define(stage.stage, f"{path}/cube")
        cube.CreateSizeAttr(1)
        cube.CreateDisplayColorAttr([(0, 0, 0)])
        UsdGeom.XformCommonAPI(cube).SetScale(Gf.Vec3f(2, 2, 0.01))
        target = cube.GetPath()
    instancer.CreatePrototypesRel().AddTarget(target)
    instancer.CreateProtoIndicesAttr([0] * len(positions))
    instancer.CreatePositionsAttr(positions)
    return instancer


def test_instancers_within_instancers_multiply(stage):
    # A prototype with a card of its own and an instancer of two more, which is copied twice.
    outer = UsdGeom.PointInstancer.Define(stage.stage, "/outer")
    group = UsdGeom.Xform.Define(stage.stage, "/outer/group")
    own = UsdGeom.Cube.Define(stage.stage, "/outer/group/own")
    own.CreateSizeAttr(2)
    own.CreateDisplayColorAttr([(0, 0, 0)])
    UsdGeom.XformCommonAPI(own).SetScale(Gf.Vec3f(1, 1, 0.001))
    inner = cards(stage, "/outer/group/inner", [(0, 3, 0), (0, 6, 0)], None)
    UsdGeom.XformCommonAPI(inner).SetTranslate(Gf.Vec3d(1, 0, 0))
    outer.CreatePrototypesRel().AddTarget(group.GetPath())
    outer.CreateProtoIndicesAttr([0, 0])
    outer.CreatePositionsAttr([(-5, -4, -10), (2, -4, -10)])
    assert stage.read().text().count("ObjectInstance") == 6
    assert coverage(stage) == pytest.approx(6 * 4 / 400, rel=0.02)
    image = stage.image(size=(80, 80))[:, :, 0]

    def is_dark(x, y):
        return image[round(40 - 4 * y), round(40 + 4 * x)] < 0.5

    assert is_dark(-5, -4) and is_dark(-4, -1) and is_dark(-4, 2) and is_dark(3, -1) and is_dark(3, 2)
    assert not is_dark(-6.5, 2) and not is_dark(0, -1)


def test_an_instancer_that_copies_itself_is_named(stage):
    cards(stage, "/a", [(0, 0, -10)], "/group")
    UsdGeom.Xform.Define(stage.stage, "/group")
    cards(stage, "/group/again", [(1, 0, 0)], "/group")
    with pytest.warns(wend.SceneWarning, match="what copies itself is left out"):
        stage.read()


@pytest.mark.parametrize("basis", ["linear", "bspline", "catmullRom", "bezier"])
def test_curves_have_their_width(stage, basis):
    curves = UsdGeom.BasisCurves.Define(stage.stage, "/hair")
    curves.CreateTypeAttr("linear" if basis == "linear" else "cubic")
    if basis != "linear":
        curves.CreateBasisAttr(basis)
    curves.CreateCurveVertexCountsAttr([7])
    curves.CreatePointsAttr([(0, y, -10) for y in (-9, -6, -3, 0, 3, 6, 9)])
    curves.CreateWidthsAttr([1.0])
    curves.CreateDisplayColorAttr([(0, 0, 0)])
    length = {"linear": 18, "bspline": 12, "catmullRom": 12, "bezier": 18}[basis]
    assert coverage(stage, (160, 160)) == pytest.approx(length / 400, rel=0.08)


def test_what_is_hidden_or_a_guide_is_not_seen(stage):
    for k, (visible, purpose) in enumerate([("invisible", "default"), ("inherited", "guide"), ("inherited", "proxy")]):
        sphere = UsdGeom.Sphere.Define(stage.stage, f"/s{k}")
        sphere.CreateVisibilityAttr(visible)
        sphere.CreatePurposeAttr(purpose)
        UsdGeom.XformCommonAPI(sphere).SetTranslate(Gf.Vec3d(0, 0, -5))
    assert coverage(stage) == 0


def test_volumes_are_named_with_their_files(stage):
    volume = UsdVol.Volume.Define(stage.stage, "/smoke")
    field = UsdVol.OpenVDBAsset.Define(stage.stage, "/smoke/density")
    file = stage.file.with_name("smoke.vdb")
    file.write_bytes(SMALL_VOLUME.read_bytes())
    field.CreateFilePathAttr("smoke.vdb")
    field.CreateFieldNameAttr("d")
    volume.CreateFieldRelationship("density", field.GetPath())
    volume.CreateExtentAttr([(-1, -1, -1), (1, 2, 3)])
    with pytest.warns(wend.SceneWarning, match="/smoke: warning: a volume scatters"):
        text = stage.read().text()
    assert f'"string filename" [ "{file}" ]' in text and '"string gridname" [ "d" ]' in text


def test_a_volume_without_an_extent_has_that_of_its_grid(stage):
    volume = UsdVol.Volume.Define(stage.stage, "/smoke")
    field = UsdVol.OpenVDBAsset.Define(stage.stage, "/smoke/density")
    field.CreateFilePathAttr(str(SMALL_VOLUME))
    field.CreateFieldNameAttr("density")
    volume.CreateFieldRelationship("density", field.GetPath())
    text = stage.read().text()
    points = np.array(text.split('"point3 P" [')[1].split("]")[0].split(), dtype=float).reshape(-1, 3)
    # Voxels from 0 to 7 across, which fade within another on each side.
    assert points.min(axis=0)[1:] == pytest.approx((-1, -1)) and points.max(axis=0)[1:] == pytest.approx((8, 8))
    # It is as if the box had been given, and larger ones are the same.
    stage.camera.AddTranslateOp().Set(Gf.Vec3d(2, 3, 12))
    stage.camera.GetFocalLengthAttr().Set(60)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    seen = stage.image(size=(8, 8), spp=256)
    assert seen.mean() < 0.97
    volume.CreateExtentAttr([(-9, -9, -9), (200, 11, 11)])
    assert 1 - stage.image(size=(8, 8), spp=256).mean() == pytest.approx(1 - seen.mean(), rel=0.1)
    volume.GetExtentAttr().Clear()
    field.CreateFilePathAttr("absent.vdb")
    with pytest.raises(wend.InputError, match="absent.vdb"):
        stage.read()


def test_what_is_wrong_is_named(stage, tmp_path):
    broken = tmp_path / "broken.usda"
    broken.write_text("#usda 1.0\ndef Sphere {\n")
    for file in (broken, tmp_path / "absent.usda"):
        with pytest.raises(wend.InputError, match=file.name):
            wend.usd.read(file)
    with pytest.raises(wend.InputError, match="/nowhere"):
        stage.read(camera="/nowhere")
    mesh = UsdGeom.Mesh.Define(stage.stage, "/mesh")
    mesh.CreatePointsAttr([(0, 0, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    with pytest.warns(wend.SceneWarning, match="/mesh: warning: a mesh whose faces"):
        stage.read()


def test_the_command_renders_and_writes(stage, tmp_path):
    stage.card()
    stage.lamp("SphereLight", place=(0, 0, 0.5), radius=0.1, intensity=100.0)
    stage.stage.GetRootLayer().Save()
    scene, picture = tmp_path / "scene.pbrt", tmp_path / "a.exr"
    command = [sys.executable, "-m", "wend.usd", str(stage.file), "-o", str(scene), "--render", str(picture)]
    done = subprocess.run([*command, "--resolution", "24x16", "--spp", "4"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    again = wend.render(wend.load(scene), progress=False)
    assert np.array_equal(again.image, wend.read(picture).image)
    assert subprocess.run([*command, "--resolution", "x"], capture_output=True).returncode == 2
    missing = subprocess.run([command[0], "-m", "wend.usd", "absent.usda", "-o", "x.pbrt"], capture_output=True, text=True)
    assert missing.returncode == 2 and "absent.usda" in missing.stderr
