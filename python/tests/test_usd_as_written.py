"""Stages as programs write them: what is bound, shown, coloured and asked for in more than the plainest way."""

import struct
import warnings
import zlib

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import Gf, Sdf, UsdGeom, UsdRender, UsdShade, UsdSkel, UsdVol  # noqa: E402

import wend  # noqa: E402
from usd_stage import Stage, middle  # noqa: E402

TYPES = Sdf.ValueTypeNames


@pytest.fixture
def stage(tmp_path):
    made = Stage(tmp_path)
    made.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    return made


def png(file, pixels, bits=8):
    """Grey, colours, or colours with an opacity."""
    pixels = np.asarray(pixels, dtype=np.uint8 if bits == 8 else ">u2")
    height, width = pixels.shape[:2]
    kind = {1: 0, 3: 2, 4: 6}[pixels.size // (height * width)]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", width, height, bits, kind, 0, 0, 0)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    return file


def material(stage, colour=(0, 0, 0), path="/m", kind="UsdPreviewSurface", name="diffuseColor"):
    made = UsdShade.Material.Define(stage.stage, path)
    shader = UsdShade.Shader.Define(stage.stage, f"{path}/surface")
    shader.CreateIdAttr(kind)
    shader.CreateInput(name, TYPES.Color3f).Set(Gf.Vec3f(*colour))
    shader.CreateInput("roughness", TYPES.Float).Set(1.0)
    made.CreateSurfaceOutput("mtlx" if kind.startswith("ND_") else "").ConnectToSource(shader.ConnectableAPI(), "surface")
    return made, shader


def bind(prim, *arguments, **options):
    UsdShade.MaterialBindingAPI.Apply(prim.GetPrim()).Bind(*arguments, **options)


def connect(stage, shader, name, kind, inputs, output="rgb", of=TYPES.Color3f):
    """Connects an input to another node of these inputs: types and values by name."""
    node = UsdShade.Shader.Define(stage.stage, f"{shader.GetPath().GetParentPath()}/{name}")
    node.CreateIdAttr(kind)
    for key, (type_, value) in inputs.items():
        node.CreateInput(key, type_).Set(value)
    node.CreateOutput(output, of)
    shader.CreateInput(name, of).ConnectToSource(node.ConnectableAPI(), output)
    return node


def on_a_card(stage, file, name="emissiveColor", output="rgb", u=(0, 1), kind="UsdUVTexture", **inputs):
    """A card with a picture as an input; the sky is dark where the card shines."""
    card = stage.card()
    UsdGeom.PrimvarsAPI(card).CreatePrimvar("st", TYPES.TexCoord2fArray, "vertex").Set(
        [Gf.Vec2f(*p) for p in ((u[0], 0), (u[1], 0), (u[1], 1), (u[0], 1))]
    )
    made, shader = material(stage)
    given = {key: (TYPES.Token, value) for key, value in inputs.items()} | {"file": (TYPES.Asset, str(file))}
    connect(stage, shader, name, kind, given, output, TYPES.Color3f if output == "rgb" else TYPES.Float)
    bind(card, made)
    if name == "emissiveColor":
        stage.stage.RemovePrim("/sky")
    return card


GREEN = (0.014, 1.0, 0.014)


def test_what_is_bound_for_renders_comes_first(stage):
    card = stage.card()
    bind(card, material(stage, (1, 0, 0), "/preview")[0])
    bind(card, material(stage, (0, 1, 0), "/full")[0], materialPurpose=UsdShade.Tokens.full)
    assert middle(stage.image()) == pytest.approx(GREEN, abs=0.01)


def test_a_material_for_renders_alone_is_taken(stage):
    card = stage.card()
    bind(card, material(stage, (0, 1, 0), "/full")[0], materialPurpose=UsdShade.Tokens.full)
    assert middle(stage.image()) == pytest.approx(GREEN, abs=0.01)


def test_what_is_for_renders_within_a_proxy_is_seen(stage):
    UsdGeom.Imageable(UsdGeom.Xform.Define(stage.stage, "/proxy")).CreatePurposeAttr(UsdGeom.Tokens.proxy)
    stage.card(colour=(0.9, 0.9, 0.9), distance=1.5, path="/proxy/own")
    card = stage.card(colour=(0.2, 0.2, 0.2), path="/proxy/card")
    UsdGeom.Imageable(card).CreatePurposeAttr(UsdGeom.Tokens.render)
    assert middle(stage.image()) == pytest.approx((0.2, 0.2, 0.2), abs=0.01)


def test_what_renders_are_not_to_see_is_not_there(stage):
    card = stage.card(colour=(0.2, 0.2, 0.2))
    UsdGeom.Imageable(card).CreatePurposeAttr(UsdGeom.Tokens.render)
    UsdGeom.VisibilityAPI.Apply(card.GetPrim()).CreateRenderVisibilityAttr(UsdGeom.Tokens.invisible)
    assert middle(stage.image()) == pytest.approx((1, 1, 1), abs=1e-3)


@pytest.mark.parametrize(
    ("channels", "space", "value"),
    [(1, "auto", 0.502), (3, "auto", 0.2159), (4, "auto", 0.2159), (1, "sRGB", 0.2159), (3, "raw", 0.502)],
)
def test_grey_pictures_are_numbers_unless_it_is_said(stage, tmp_path, channels, space, value):
    pixels = np.full((4, 4, channels), 128)
    pixels[..., 3:] = 255
    on_a_card(stage, png(tmp_path / "map.png", pixels), sourceColorSpace=space)
    assert middle(stage.image()) == pytest.approx(np.full(3, value), rel=1e-3)


@pytest.mark.parametrize(("space", "value"), [("auto", 0.5), ("sRGB", 0.2140)])
def test_numbers_of_16_bits_are_as_they_are(stage, tmp_path, space, value):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 32768), bits=16), sourceColorSpace=space)
    assert middle(stage.image()) == pytest.approx(np.full(3, value), rel=1e-3)


def test_numbers_of_materialx_are_as_they_are(stage, tmp_path):
    card = stage.card()
    made, shader = material(stage, (0, 0, 0), kind="ND_standard_surface_surfaceshader", name="base_color")
    shader.CreateInput("base", TYPES.Float).Set(1.0)
    shader.CreateInput("specular_color", TYPES.Color3f).Set(Gf.Vec3f(0))
    shader.CreateInput("coat", TYPES.Float).Set(0.0)
    file = png(tmp_path / "map.png", np.full((4, 4, 3), 128))
    connect(stage, shader, "specular_roughness", "ND_image_float", {"file": (TYPES.Asset, str(file))}, "out", TYPES.Float)
    bind(card, made)
    with pytest.warns(wend.SceneWarning, match="the luminance is taken"):
        text = stage.read().text()
    picture = next(word for word in text.split('"') if word.endswith(".exr"))
    assert wend.read(picture).image == pytest.approx(128 / 255, rel=1e-3)


@pytest.mark.parametrize("wrap", [{}, {"wrapS": "useMetadata", "wrapT": "useMetadata"}, {"wrapS": "black", "wrapT": "black"}])
def test_beyond_a_picture_is_black_unless_it_is_said(stage, tmp_path, wrap):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 255)), "diffuseColor", u=(-2, 1), **wrap)
    image = stage.image(spp=64)
    assert image[4, 4][0] < 0.1 and image[4, 8][0] < 0.1 and image[4, 6][0] < 0.1


@pytest.mark.parametrize("kind", ["ND_UsdUVTexture", "ND_UsdUVTexture_23"])
def test_beyond_a_picture_of_materialx_it_is_repeated(stage, tmp_path, kind):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 255)), "diffuseColor", u=(-2, 1), kind=kind)
    assert '"string wrap" [ "repeat" ]' in stage.read().text()


def test_ways_to_go_on_that_differ_are_named(stage, tmp_path):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 255)), "diffuseColor", wrapS="repeat", wrapT="clamp")
    with pytest.warns(wend.SceneWarning, match=r"/m/diffuseColor: .*upwards as it does sideways \(wrapS\)"):
        stage.read()


def corners_of(image):
    """Below and above, left and right, a tenth of its side within."""
    side = len(image) // 10
    return image[-side, side], image[-side, -side], image[side, side], image[side, -side]


#: Of the points of a card.
COLOURS = [(0.8, 0.1, 0.1), (0.1, 0.8, 0.1), (0.1, 0.1, 0.8), (0.1, 0.1, 0.1)]


@pytest.mark.parametrize("interpolation", ["vertex", "faceVarying"])
@pytest.mark.parametrize("by_material", [False, True])
def test_colours_of_points_are_seen(stage, interpolation, by_material):
    card = stage.card(half=2)
    card.CreateDisplayColorPrimvar(interpolation).Set(COLOURS)
    if by_material:
        made, shader = material(stage)
        shader.CreateInput("useSpecularWorkflow", TYPES.Int).Set(1)
        name = {"varname": (TYPES.String, "displayColor")}
        connect(stage, shader, "diffuseColor", "UsdPrimvarReader_float3", name, "result", TYPES.Color3f)
        bind(card, made)
    image = stage.image(size=(40, 40), spp=64)
    below_left, below_right, above_left, above_right = corners_of(image)
    for seen, colour in zip((below_left, below_right, above_right, above_left), COLOURS):
        assert seen == pytest.approx(colour, abs=0.15)


def test_colours_of_faces_are_seen(stage):
    card = stage.card(half=2)
    card.GetPointsAttr().Set([(-2, -2, -2), (0, -2, -2), (2, -2, -2), (2, 2, -2), (0, 2, -2), (-2, 2, -2)])
    card.GetFaceVertexCountsAttr().Set([4, 4])
    card.GetFaceVertexIndicesAttr().Set([0, 1, 4, 5, 1, 2, 3, 4])
    card.CreateDisplayColorPrimvar("uniform").Set(COLOURS[:2])
    image = stage.image(size=(8, 8), spp=64)
    assert image[4, 1] == pytest.approx(COLOURS[0], abs=0.01) and image[4, 6] == pytest.approx(COLOURS[1], abs=0.01)


def test_colours_that_cannot_vary_are_named(stage):
    card = stage.card(half=2)
    card.CreateSubdivisionSchemeAttr("catmullClark")
    card.CreateDisplayColorPrimvar("vertex").Set(COLOURS)
    with pytest.warns(wend.SceneWarning, match="/card: .*the mean is taken"):
        stage.read()


STANDARD = {"kind": "ND_standard_surface_surfaceshader", "name": "base_color"}


def by_its_colours(stage, name="displayColor", path="/m", weight=1.0, converted=True):
    """A material whose base colour is a primvar, by nodes of MaterialX."""
    made, shader = material(stage, path=path, **STANDARD)
    shader.CreateInput("base", TYPES.Float).Set(weight)
    if converted:
        shader = connect(stage, shader, "base_color", "ND_convert_color4_color3", {}, "out")
    socket, of = ("in", TYPES.Color4f) if converted else ("base_color", TYPES.Color3f)
    kind = "ND_geompropvalue_color4" if converted else "ND_geompropvalue_color3"
    connect(stage, shader, socket, kind, {"geomprop": (TYPES.String, name)}, "out", of)
    return made


def constants(text, name):
    return [float(x) for x in text.split(f'"{name}" [ ')[1].split(" ]")[0].split()]


@pytest.mark.parametrize("converted", [False, True])
@pytest.mark.parametrize("weight", [1.0, 0.5])
def test_colours_of_points_are_converted_and_weighted(stage, converted, weight):
    card = stage.card()
    card.CreateDisplayColorPrimvar("vertex").Set(COLOURS)
    bind(card, by_its_colours(stage, weight=weight, converted=converted))
    assert constants(stage.read().text(), "float values") == pytest.approx(weight * np.ravel(COLOURS), rel=1e-5)


def test_one_colour_of_a_shape_is_weighted(stage):
    card = stage.card(colour=(0.8, 0.4, 0.2))
    bind(card, by_its_colours(stage, weight=0.5))
    made = stage.read().text().split('"/m of /card"')[1]
    assert constants(made, "rgb reflectance") == pytest.approx((0.4, 0.2, 0.1), rel=1e-5)


def test_pictures_are_weighted(stage, tmp_path):
    made, shader = material(stage, **STANDARD)
    shader.CreateInput("base", TYPES.Float).Set(0.5)
    file = png(tmp_path / "map.png", np.full((4, 4, 3), 128))
    connect(stage, shader, "base_color", "ND_image_color3", {"file": (TYPES.Asset, str(file))}, "out")
    bind(stage.card(), made)
    assert '"float scale" [ 0.5 ]' in stage.read().text()


def test_a_constant_is_converted(stage):
    made, shader = material(stage, **STANDARD)
    converting = connect(stage, shader, "base_color", "ND_convert_color4_color3", {}, "out")
    given = {"value": (TYPES.Color4f, Gf.Vec4f(0.3, 0.4, 0.5, 1))}
    connect(stage, converting, "in", "ND_constant_color4", given, "out", TYPES.Color4f)
    bind(stage.card(), made)
    assert constants(stage.read().text(), "rgb reflectance") == pytest.approx((0.3, 0.4, 0.5), rel=1e-5)


def test_a_channel_of_colours_is_named(stage):
    made, shader = material(stage, **STANDARD)
    taking = connect(stage, shader, "base_color", "ND_extract_color4", {}, "out")
    connect(stage, taking, "in", "ND_geompropvalue_color4", {"geomprop": (TYPES.String, "displayColor")}, "out", TYPES.Color4f)
    bind(stage.card(), made)
    with pytest.warns(wend.SceneWarning, match="/m/surface: .*ND_geompropvalue_color4 as base_color is left out"):
        stage.read()


@pytest.mark.parametrize("name", ["displayColor", "other"])
def test_subsets_that_read_other_colours_are_named(stage, name):
    card = stage.card()
    card.GetFaceVertexCountsAttr().Set([3, 3])
    card.GetFaceVertexIndicesAttr().Set([0, 1, 2, 0, 2, 3])
    for path, primvar, face in (("/m", "displayColor", 0), ("/n", name, 1)):
        UsdGeom.PrimvarsAPI(card).CreatePrimvar(primvar, TYPES.Color3fArray, "vertex").Set(COLOURS)
        subset = UsdGeom.Subset.CreateGeomSubset(card, f"of{path[1:]}", "face", [face], "materialBind")
        bind(subset, by_its_colours(stage, primvar, path))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        stage.read()
    words = [str(w.message) for w in told]
    assert any("/card: warning: all parts of a mesh have the colours of the first: displayColor" in w for w in words) == (name == "other")


def test_a_display_opacity_lets_light_through(stage):
    stage.card(colour=(0, 0, 0)).CreateDisplayOpacityAttr([0.25])
    assert stage.image(spp=1024).mean() == pytest.approx(0.75, abs=0.01)


@pytest.mark.parametrize("kind", ["Float", "FloatArray"])
def test_a_display_opacity_is_inherited(stage, kind):
    above = UsdGeom.Xform.Define(stage.stage, "/above")
    value = 0.25 if kind == "Float" else [0.25]
    UsdGeom.PrimvarsAPI(above).CreatePrimvar("displayOpacity", getattr(TYPES, kind), "constant").Set(value)
    stage.card(path="/above/card")
    assert '"float alpha" [ 0.25 ]' in stage.read().text()


def test_what_shines_and_is_not_opaque_is_seen_as_such(stage):
    """A quarter of what is there shines, and three quarters of the sky pass."""
    made, shader = material(stage)
    shader.CreateInput("emissiveColor", TYPES.Color3f).Set(Gf.Vec3f(3, 2, 1))
    shader.CreateInput("opacity", TYPES.Float).Set(0.25)
    shader.CreateInput("ior", TYPES.Float).Set(1.0)
    bind(stage.card(), made)
    assert stage.image(spp=4096).mean(axis=(0, 1)) == pytest.approx(0.75 + 0.25 * np.array([3, 2, 1]), rel=0.01)


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("ND_standard_surface_surfaceshader", "base_color"),
        ("ND_open_pbr_surface_surfaceshader", "base_color"),
        ("ND_UsdPreviewSurface_surfaceshader", "diffuseColor"),
    ],
)
def test_constants_of_materialx_are_values(stage, kind, name):
    made, shader = material(stage, kind=kind, name=name)
    connect(stage, shader, name, "ND_constant_color3", {"value": (TYPES.Color3f, Gf.Vec3f(0.3, 0.4, 0.5))}, "out")
    bind(stage.card(), made)
    assert constants(stage.read().text(), "rgb reflectance") == pytest.approx([0.3, 0.4, 0.5], rel=1e-5)


def test_a_stage_says_how_it_wants_to_be_rendered(stage):
    stage.card(colour=(0.2, 0.2, 0.2))
    other = UsdGeom.Camera.Define(stage.stage, "/other")
    UsdGeom.XformCommonAPI(other).SetRotate(Gf.Vec3f(0, 180, 0))
    settings = UsdRender.Settings.Define(stage.stage, "/Render/settings")
    settings.CreateCameraRel().AddTarget("/other")
    settings.CreateResolutionAttr(Gf.Vec2i(30, 20))
    stage.stage.SetMetadata("renderSettingsPrimPath", "/Render/settings")
    image = stage.image(size=None)
    assert image.shape == (20, 30, 3) and middle(image) == pytest.approx((1, 1, 1), abs=1e-3)
    assert middle(stage.image(camera="/camera")) == pytest.approx((0.2, 0.2, 0.2), abs=0.01)


def test_fields_that_are_left_out_are_named(stage, tmp_path):
    volume = UsdVol.Volume.Define(stage.stage, "/smoke")
    for name in ("density", "temperature"):
        field = UsdVol.OpenVDBAsset.Define(stage.stage, f"/smoke/{name}")
        field.CreateFilePathAttr(__file__.rsplit("/", 3)[0] + "/fuzz/corpus/vdb/zip.vdb")
        volume.CreateFieldRelationship(name, field.GetPath())
    UsdGeom.XformCommonAPI(UsdVol.OpenVDBAsset.Get(stage.stage, "/smoke/density")).SetTranslate(Gf.Vec3d(1, 0, 0))
    with pytest.warns(wend.SceneWarning) as told:
        stage.read()
    words = [str(w.message) for w in told]
    assert any("/smoke: warning" in word and word.endswith("temperature") for word in words)
    assert any("/smoke/density: warning" in word for word in words)


def test_a_prototype_may_be_defined_by_overs(stage):
    """As USD's documents have it, so that it is not seen where it is."""
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/instancer")
    UsdGeom.Xform.Define(stage.stage, "/instancer/prototypes/tree")
    stage.card(colour=(0.2, 0.2, 0.2), path="/instancer/prototypes/tree/card")
    stage.stage.GetPrimAtPath("/instancer/prototypes").SetSpecifier(Sdf.SpecifierOver)
    instancer.CreatePrototypesRel().AddTarget("/instancer/prototypes/tree")
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr([(0, 0, 0)])
    assert middle(stage.image()) == pytest.approx((0.2, 0.2, 0.2), abs=0.01)


@pytest.mark.parametrize("kind", ["TexCoord2fArray", "TexCoord2hArray", "Float2Array", "TexCoord3fArray", "Float3Array"])
def test_coordinates_of_every_type_are_read(stage, tmp_path, kind):
    """The left half of the picture is white, and s runs upwards."""
    pixels = np.zeros((4, 4, 3))
    pixels[:, :2] = 255
    card = on_a_card(stage, png(tmp_path / "map.png", pixels), "diffuseColor")
    api = UsdGeom.PrimvarsAPI(card)
    api.RemovePrimvar("st")
    of_points = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)]
    values = [p if "3" in kind else p[:2] for p in of_points]
    api.CreatePrimvar("st", getattr(TYPES, kind), "vertex").Set(values)
    image = stage.image(spp=64)
    assert image[7, 4][0] > 2 * image[1, 4][0]


def test_a_shape_without_the_coordinates_that_are_asked_for_is_named(stage, tmp_path):
    card = on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 255)), "diffuseColor")
    UsdGeom.PrimvarsAPI(card).RemovePrimvar("st")
    name = {"varname": (TYPES.String, "st")}
    texture = UsdShade.Shader.Get(stage.stage, "/m/diffuseColor")
    connect(stage, texture, "st", "UsdPrimvarReader_float2", name, "result", TYPES.Float2)
    with pytest.warns(wend.SceneWarning, match="/card: .*without texture coordinates"):
        stage.read()


@pytest.mark.parametrize("kind", ["Cube", "Sphere"])
def test_other_shapes_have_no_coordinates(stage, tmp_path, kind):
    made, shader = material(stage)
    file = {"file": (TYPES.Asset, str(png(tmp_path / "map.png", np.full((4, 4, 3), 255))))}
    connect(stage, shader, "diffuseColor", "UsdUVTexture", file)
    bind(stage.stage.DefinePrim("/thing", kind), made)
    with pytest.warns(wend.SceneWarning, match="/thing: .*without texture coordinates"):
        stage.read()


def test_two_pictures_of_a_material_are_two_files(stage, tmp_path):
    """Both are scaled, so that they are made anew."""
    card = on_a_card(stage, png(tmp_path / "red.png", np.broadcast_to((255, 0, 0), (4, 4, 3))))
    shader = UsdShade.Shader.Get(stage.stage, "/m/surface")
    given = {"file": (TYPES.Asset, str(png(tmp_path / "green.png", np.broadcast_to((0, 255, 0), (4, 4, 3)))))}
    half = {"scale": (TYPES.Float4, Gf.Vec4f(0.5, 0.25, 1, 1))}
    connect(stage, shader, "diffuseColor", "UsdUVTexture", given | half)
    shader.CreateInput("ior", TYPES.Float).Set(1.0)
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)
    assert card and middle(stage.image(spp=256)) == pytest.approx((1, 0.25, 0), abs=0.02)


def test_a_picture_that_shines_and_is_left_by_its_coordinates_is_named(stage, tmp_path):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 255)), u=(-1, 1), wrapS="repeat", wrapT="repeat")
    with pytest.warns(wend.SceneWarning, match="/card: .*beyond its edges"):
        stage.read()


def test_a_camera_that_is_focused_on_nothing_is_sharp(stage):
    stage.card(colour=(0.2, 0.2, 0.2))
    stage.camera.CreateFStopAttr(2.8)
    with pytest.warns(wend.SceneWarning, match="/camera: .*focused on nothing"):
        assert '"float lensradius"' not in stage.read().text()


def moved_by_a_joint(stage, translations, root="/root", turn=0):
    """A card that a joint moves, by time code, and turns around y."""
    UsdSkel.Root.Define(stage.stage, root)
    skeleton = UsdSkel.Skeleton.Define(stage.stage, f"{root}/skeleton")
    skeleton.CreateJointsAttr(["joint"])
    skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1)])
    skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1)])
    animation = UsdSkel.Animation.Define(stage.stage, f"{root}/animation")
    animation.CreateJointsAttr(["joint"])
    animation.CreateRotationsAttr([Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 1, 0), turn).GetQuat())])
    animation.CreateScalesAttr([Gf.Vec3h(1, 1, 1)])
    for time, x in translations:
        animation.CreateTranslationsAttr().Set([Gf.Vec3f(x, 0, 0)], *time)
    card = stage.card(path=f"{root}/card", colour=(0.2, 0.2, 0.2), half=1)
    binding = UsdSkel.BindingAPI.Apply(card.GetPrim())
    binding.CreateSkeletonRel().AddTarget(skeleton.GetPath())
    binding.CreateJointIndicesPrimvar(False, 1).Set([0] * 4)
    binding.CreateJointWeightsPrimvar(False, 1).Set([1.0] * 4)
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().AddTarget(animation.GetPath())
    return card


@pytest.mark.parametrize(("time", "is_there"), [(1, True), (6, False), (11, True), (16, False), (21, False)])
def test_skeletons_move_meshes(stage, time, is_there):
    moved_by_a_joint(stage, [((1,), 0), ((6,), 50), ((11,), 0), ((21,), 50)])
    assert middle(stage.image(time=time)) == pytest.approx(np.full(3, 0.2 if is_there else 1), abs=0.01)


@pytest.mark.parametrize("time", [1, 15, 21])
def test_skeletons_that_are_beside_others_move_what_is_theirs(stage, time):
    """The one with a single sample has none near most times."""
    for path, times in (("/root/sampled", (1, 11, 21)), ("/root/once", (1,))):
        moved_by_a_joint(stage, [((t,), 50) for t in times], path)
        UsdGeom.Xform.Define(stage.stage, path)
    UsdSkel.Root.Define(stage.stage, "/root")
    assert middle(stage.image(time=time)) == pytest.approx((1, 1, 1), abs=1e-3)


@pytest.mark.parametrize("is_primvar", [False, True])
@pytest.mark.parametrize(("interpolation", "count"), [("vertex", 4), ("faceVarying", 4), ("uniform", 1), ("constant", 1)])
def test_normals_turn_with_their_joint(stage, interpolation, count, is_primvar):
    card = moved_by_a_joint(stage, [((), 0)], turn=60)
    normals = [(0, 0, 1)] * count
    if is_primvar:
        UsdGeom.PrimvarsAPI(card).CreatePrimvar("normals", TYPES.Normal3fArray, interpolation).Set(normals)
    else:
        card.CreateNormalsAttr(normals)
        card.SetNormalsInterpolation(interpolation)
    written = constants(stage.read().text(), "normal3 N")
    turned = (np.sin(np.radians(60)), 0, np.cos(np.radians(60)))
    assert np.reshape(written, (-1, 3)) == pytest.approx(np.tile(turned, (4, 1)), abs=1e-6)


@pytest.mark.parametrize("of_another_file", [False, True])
def test_skeletons_in_instances_move_or_are_named(stage, tmp_path, of_another_file):
    """What refers to the same file is moved with what it refers to."""
    moved_by_a_joint(stage, [((), 50)], "/all/root")
    stage.stage.GetRootLayer().Export(str(tmp_path / "other.usda"))
    for name in ("/a", "/b"):
        copy = stage.stage.DefinePrim(name)
        copy.GetReferences().AddReference(str(tmp_path / "other.usda") if of_another_file else "", "/all")
        copy.SetInstanceable(True)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        stage.read()
    words = [str(w.message) for w in told if "as at rest" in str(w.message)]
    assert len(words) == of_another_file and all(w.startswith("/a/root: warning: ") for w in words)


def test_instances_within_what_skeletons_move_are_named(stage, tmp_path):
    moved_by_a_joint(stage, [((), 50)])
    stage.stage.GetRootLayer().Export(str(tmp_path / "other.usda"))
    held = UsdGeom.Xform.Define(stage.stage, "/root/held").GetPrim()
    held.GetReferences().AddReference(str(tmp_path / "other.usda"), "/root")
    held.SetInstanceable(True)
    with pytest.warns(wend.SceneWarning, match="/root.*: .*in instances is as at rest"):
        stage.read()


def test_what_is_copied_is_posed_below_overs(stage):
    moved_by_a_joint(stage, [((), 50)], "/held/more/root")
    for path in ("/held", "/held/more"):
        stage.stage.GetPrimAtPath(path).SetSpecifier(Sdf.SpecifierOver)
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/instancer")
    instancer.CreatePrototypesRel().AddTarget("/held/more/root")
    instancer.CreateProtoIndicesAttr([0])
    instancer.CreatePositionsAttr([(-50, 0, 0)])
    assert middle(stage.image()) == pytest.approx((0.2, 0.2, 0.2), abs=0.01)


def test_a_pose_without_time_is_taken(stage):
    moved_by_a_joint(stage, [((), 50)])
    assert middle(stage.image()) == pytest.approx((1, 1, 1), abs=1e-3)


def test_blend_shapes_move_points(stage):
    moved_by_a_joint(stage, [((), 0)])
    shape = UsdSkel.BlendShape.Define(stage.stage, "/root/card/away")
    shape.CreateOffsetsAttr([Gf.Vec3f(50, 0, 0)] * 4)
    binding = UsdSkel.BindingAPI(stage.stage.GetPrimAtPath("/root/card"))
    binding.CreateBlendShapesAttr(["away"])
    binding.CreateBlendShapeTargetsRel().AddTarget(shape.GetPath())
    animation = UsdSkel.Animation.Get(stage.stage, "/root/animation")
    animation.CreateBlendShapesAttr(["away"])
    weights = animation.CreateBlendShapeWeightsAttr()
    assert middle(stage.image()) == pytest.approx((0.2, 0.2, 0.2), abs=0.01)
    weights.Set([1.0])
    assert middle(stage.image()) == pytest.approx((1, 1, 1), abs=1e-3)


def test_what_each_copy_is_given_is_named(stage):
    instancer = UsdGeom.PointInstancer.Define(stage.stage, "/instancer")
    stage.card(path="/instancer/card")
    instancer.CreatePrototypesRel().AddTarget("/instancer/card")
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(0, 0, 0), (1, 0, 0)])
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar("displayColor", TYPES.Color3fArray, "varying").Set([(1, 0, 0), (0, 1, 0)])
    with pytest.warns(wend.SceneWarning, match="/instancer: .*left out: displayColor"):
        stage.read()
