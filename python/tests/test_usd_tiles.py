"""Pictures of USD in tiles (UDIM), and those that are not there."""

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import Gf, Sdf, UsdGeom, UsdShade, UsdUtils  # noqa: E402

import wend  # noqa: E402
from test_usd_as_written import bind, connect, material, png  # noqa: E402
from usd_stage import Stage  # noqa: E402

TYPES = Sdf.ValueTypeNames
RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
#: Of the quarters of the picture: left and right below, left and right above.
PLACES = [(7, 1), (7, 7), (1, 1), (1, 7)]


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path)


def tiles(folder, **colours):
    """A picture of one colour for each number of a tile, each of another size; the pattern of their names."""
    for i, (number, colour) in enumerate(colours.items()):
        png(folder / f"map.{number[1:]}.png", np.broadcast_to(colour, (32 + i, 40 + i, len(colour))))
    return folder / "map.<UDIM>.png"


def card(stage, file, name="emissiveColor", output="rgb", scheme="none", low=(0, 0), high=(2, 2), **inputs):
    """It fills the view; its coordinates are from the one to the other."""
    made = stage.card(half=2)
    made.CreateSubdivisionSchemeAttr(scheme)
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    UsdGeom.PrimvarsAPI(made).CreatePrimvar("st", TYPES.TexCoord2fArray, "faceVarying").Set([Gf.Vec2f(*p) for p in corners])
    look, shader = material(stage)
    given = {"file": (TYPES.Asset, str(file))} | inputs
    of = TYPES.Float if output in "rgba" else TYPES.Color3f
    node = connect(stage, shader, name, "UsdUVTexture", given, output, of)
    bind(made, look)
    return shader, node


def placed(stage, node, scale, move=(0, 0)):
    transform = UsdShade.Shader.Define(stage.stage, "/m/place")
    transform.CreateIdAttr("UsdTransform2d")
    transform.CreateInput("scale", TYPES.Float2).Set(Gf.Vec2f(*scale))
    transform.CreateInput("translation", TYPES.Float2).Set(Gf.Vec2f(*move))
    node.CreateInput("st", TYPES.Float2).ConnectToSource(transform.ConnectableAPI(), "result")


def quarters(image):
    return np.array([image[place] for place in PLACES])


def sky(stage):
    stage.stage.DefinePrim("/sky", "DomeLight").GetAttribute("inputs:intensity").Set(1.0)


PINK = (0.5, 0.25, 0.75)
FALLBACK = {"fallback": (TYPES.Float4, Gf.Vec4f(*PINK, 0.5))}


def test_tiles_lie_by_their_columns_and_rows(stage, tmp_path):
    """As MaterialX names them."""
    for place, colour in (("u1_v1", RED), ("u2_v1", GREEN), ("u1_v2", BLUE)):
        png(tmp_path / f"map_{place}.png", np.broadcast_to(colour, (32, 40, 3)))
    card(stage, tmp_path / "map_<UVTILE>.png", **FALLBACK)
    assert quarters(stage.image()) == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), PINK]), abs=2e-3)


@pytest.mark.parametrize("scheme", ["none", "bilinear"])
def test_tiles_lie_by_their_numbers(stage, tmp_path, scheme):
    card(stage, tiles(tmp_path, t1001=RED, t1002=GREEN, t1011=BLUE), scheme=scheme, **FALLBACK)
    assert quarters(stage.image()) == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), PINK]), abs=2e-3)


def test_tiles_need_not_begin_at_the_first(stage, tmp_path):
    card(stage, tiles(tmp_path, t1013=RED, t1022=GREEN), low=(1, 1), high=(3, 3))
    assert quarters(stage.image()) == pytest.approx(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0)]), abs=2e-3)


def test_beyond_all_tiles_is_what_is_missing(stage, tmp_path):
    card(stage, tiles(tmp_path, t1001=RED), "diffuseColor", **FALLBACK)
    sky(stage)
    image = quarters(stage.image(spp=64))
    assert image[0] == pytest.approx((1, 0.014, 0.014), abs=0.01)
    assert image[1:] == pytest.approx(np.broadcast_to(PINK, (3, 3)), abs=0.02)


def test_tiles_are_scaled_and_what_is_missing_is_not(stage, tmp_path):
    half = {"scale": (TYPES.Float4, Gf.Vec4f(0.5)), "bias": (TYPES.Float4, Gf.Vec4f(0.125))}
    card(stage, tiles(tmp_path, t1001=RED), **half, **FALLBACK)
    image = quarters(stage.image())
    assert image[0] == pytest.approx((0.625, 0.125, 0.125), abs=2e-3)
    assert image[3] == pytest.approx(PINK, abs=2e-3)


def test_a_place_is_before_tiles(stage, tmp_path):
    _, node = card(stage, tiles(tmp_path, t1001=RED, t1002=GREEN, t1011=BLUE), high=(1, 1), **FALLBACK)
    placed(stage, node, (2, 2))
    assert quarters(stage.image()) == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), PINK]), abs=2e-3)


@pytest.mark.parametrize("output", ["r", "a"])
def test_an_opacity_may_be_in_tiles(stage, tmp_path, output):
    """Before a white sky; the card is black."""
    file = tiles(tmp_path, t1001=(255, 0, 0, 255), t1002=(51, 0, 0, 51), t1011=(0, 0, 0, 0))
    raw = {"sourceColorSpace": (TYPES.Token, "raw")}
    shader, _ = card(stage, file, "opacity", output, **raw, **FALLBACK)
    shader.CreateInput("ior", TYPES.Float).Set(1.0)
    sky(stage)
    shown = 1 - quarters(stage.image(spp=1024))[:, 0]
    assert shown == pytest.approx((1, 0.2, 0, 0.5), abs=0.05)


def test_opaque_pictures_have_an_opacity(stage, tmp_path):
    """Whose colours are no opacity."""
    file = png(tmp_path / "map.png", np.broadcast_to((51, 51, 51, 255), (2, 2, 4)))
    shader, _ = card(stage, file, "opacity", "a")
    shader.CreateInput("ior", TYPES.Float).Set(1.0)
    sky(stage)
    assert stage.image()[4, 4] == pytest.approx((0, 0, 0), abs=0.02)
    assert '"float alpha" [ 1 ]' in stage.read().text()


def test_normals_may_be_in_tiles_and_placed(stage, tmp_path):
    """A normal that leans to the right is lit by a lamp from there; where there is none, it is the card's."""
    lean = tuple(int(round(127.5 * (1 + x))) for x in (0.6, 0, 0.8))
    file = tiles(tmp_path, t1002=lean, t1011=(128, 128, 255))
    shader, node = card(stage, file, "normal", "rgb", high=(1, 1), sourceColorSpace=(TYPES.Token, "raw"))
    node.CreateInput("scale", TYPES.Float4).Set(Gf.Vec4f(2))
    node.CreateInput("bias", TYPES.Float4).Set(Gf.Vec4f(-1))
    placed(stage, node, (2, 2))
    shader.GetInput("diffuseColor").Set(Gf.Vec3f(0.5))
    shader.CreateInput("ior", TYPES.Float).Set(1.0)
    stage.lamp("DistantLight", turn=(0, 45, 0), intensity=np.pi, angle=0.0)
    plain, leaning = (0.5 * (np.array(n) @ (0.5**0.5, 0, 0.5**0.5)) for n in ((0, 0, 1), (0.6, 0, 0.8)))
    assert quarters(stage.image(spp=64))[:, 0] == pytest.approx([plain, leaning, plain, plain], rel=0.02)


def test_other_pictures_stay_where_they_are(stage, tmp_path):
    """Those of a material whose coordinates are the tiles' of what shines."""
    shader, _ = card(stage, tiles(tmp_path, t1001=RED, t1002=GREEN), "emissiveColor", high=(2, 1))
    half = np.zeros((2, 16, 3))
    half[:, 8:, 2] = 255
    given = {"file": (TYPES.Asset, str(png(tmp_path / "half.png", half))), "wrapS": (TYPES.Token, "repeat")}
    connect(stage, shader, "diffuseColor", "UsdUVTexture", given)
    sky(stage)
    row = stage.image(size=(16, 16), spp=64)[8]
    # The picture is there twice: it is blue in its right half.
    assert row[[1, 5, 10, 14], 2] == pytest.approx([0.014, 1, 0.014, 1], abs=0.1)
    assert row[[1, 10], :2] == pytest.approx(np.array([(1, 0.014), (0.014, 1)]), abs=0.1)


def test_tiles_may_be_packed(stage, tmp_path):
    pattern = tiles(tmp_path, t1001=RED, t1002=GREEN, t1011=BLUE, t1012=RED)
    card(stage, f"./{pattern.name}")
    stage.stage.GetRootLayer().Save()
    packed = tmp_path / "stage.usdz"
    UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(stage.file)), str(packed))
    for file in tmp_path.glob("*.png"):
        file.unlink()
    image = wend.render(wend.usd.read(packed, resolution=(9, 9), spp=16).scene(), sampling="classical").image
    assert quarters(image) == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)]), abs=2e-3)


def test_large_tiles_become_smaller(monkeypatch):
    from wend import _udim

    monkeypatch.setattr(_udim, "_MOST", 150)
    told = []
    chess = np.indices((16, 16)).sum(axis=0) % 2
    pixels = np.repeat(chess[:, :, None], 3, axis=2).astype(np.float32)
    sheet, matrix = _udim.laid_out({(0, 0): lambda: pixels}, (0, 0, 0), told.append)
    assert sheet.shape == (12, 12, 3) and sheet[1:-1, 1:-1] == pytest.approx(0.5)
    assert sheet[0] == pytest.approx(0)
    assert matrix @ (0.5, 0.5, 1) == pytest.approx((0.5, 0.5, 1))
    assert "2 times smaller" in told[0]


@pytest.mark.parametrize("file", ["absent.png", "absent.<UDIM>.png", ""])
@pytest.mark.parametrize("name", ["emissiveColor", "diffuseColor"])
def test_a_texture_without_a_file_has_its_fallback(stage, file, name):
    card(stage, file, name, scale=(TYPES.Float4, Gf.Vec4f(0.5)), **FALLBACK)
    if name == "diffuseColor":
        sky(stage)
    with pytest.warns(wend.SceneWarning, match="/m/.*Color: warning: .*fallback") as told:
        stage.read()
    assert len([warning for warning in told if "fallback" in str(warning.message)]) == 1
    assert stage.image(spp=64)[4, 4] == pytest.approx(PINK, abs=0.02)


@pytest.mark.parametrize(("kind", "channel"), [("ND_image_color3", None), ("ND_image_color4", 1)])
def test_a_picture_of_materialx_without_a_file_has_its_default(stage, kind, channel):
    stage.card()
    look, shader = material(stage, kind="ND_standard_surface_surfaceshader", name="base_color")
    for key in ("specular", "coat"):
        shader.CreateInput(key, TYPES.Float).Set(0.0)
    shader.CreateInput("base", TYPES.Float).Set(1.0)
    of = TYPES.Color4f if channel is not None else TYPES.Color3f
    value = Gf.Vec4f(*PINK, 1) if channel is not None else Gf.Vec3f(*PINK)
    given = {"file": (TYPES.Asset, "absent.png"), "default": (of, value)}
    if channel is None:
        connect(stage, shader, "base_color", kind, given, "out")
        parameter = '"rgb reflectance" [ 0.5 0.25 0.75 ]'
    else:
        shader.GetInput("base_color").Set(Gf.Vec3f(0.5))
        node = connect(stage, shader, "metalness", "ND_extract_color4", {"index": (TYPES.Int, channel)}, "out", TYPES.Float)
        connect(stage, node, "in", kind, given, "out", of)
        parameter = '"float metallic" [ 0.25 ]'
    bind(stage.stage.GetPrimAtPath("/card"), look)
    with pytest.warns(wend.SceneWarning, match="absent.png: there is no such file"):
        assert parameter in stage.read().text()
