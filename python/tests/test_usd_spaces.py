"""Pictures of USD have the colours of their space, and MaterialX's tiled ones their place."""

import numpy as np
import pytest

pytest.importorskip("pxr", reason="usd-core is absent")

from pxr import Sdf, UsdGeom, UsdShade  # noqa: E402

from test_usd_as_written import bind, connect, material, on_a_card, png  # noqa: E402
from usd_stage import Stage, middle  # noqa: E402

TYPES = Sdf.ValueTypeNames


@pytest.fixture
def stage(tmp_path):
    return Stage(tmp_path).sky()


@pytest.mark.parametrize(
    ("space", "value", "is_told"),
    [
        ("srgb_texture", 0.2159, False),
        ("Utility - sRGB - Texture", 0.2159, False),
        ("lin_rec709_scene", 0.502, False),
        ("Utility - Raw", 0.502, False),
        ("g22_rec709", 0.502, True),
        ("acescg", 0.502, True),
        ("srgb_p3d65_scene", 0.502, True),
    ],
)
def test_colour_spaces_go_by_their_names(stage, tmp_path, space, value, is_told):
    on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 128)))
    stage.stage.GetPrimAtPath("/m/emissiveColor").GetAttribute("inputs:file").SetColorSpace(space)
    assert any(f"the colour space {space}" in text for text in stage.told()) == is_told
    assert middle(stage.image()) == pytest.approx(np.full(3, value), rel=1e-3)


@pytest.mark.parametrize(
    "inputs",
    [
        {},
        {"uvoffset": (0.25, 0)},
        {"uvtiling": (2, 1), "uvoffset": (0.5, 0)},
        {"realworldimagesize": (4, 1), "realworldtilesize": (2, 1)},
        {"uvoffset": (0.5, 0), "realworldimagesize": (1, 1), "realworldtilesize": (2, 1)},
    ],
)
def test_tiled_pictures_lie_as_materialx_has_them(stage, tmp_path, inputs):
    """(coordinates * tiling - offset) / size of the image * size of a tile; the quarter at the right of it is dark."""
    pixels = np.zeros((4, 4, 3))
    pixels[:, :3] = 255
    file = png(tmp_path / "map.png", pixels)
    made, shader = material(stage, (1, 1, 1), kind="ND_standard_surface_surfaceshader", name="specular_color")
    shader.CreateInput("base", TYPES.Float).Set(1.0)
    shader.CreateInput("specular", TYPES.Float).Set(0.0)
    given = {name: (TYPES.Float2, value) for name, value in inputs.items()} | {"file": (TYPES.Asset, str(file))}
    connect(stage, shader, "base_color", "ND_tiledimage_color3", given, "out")
    card = stage.card(distance=1, half=1)
    UsdGeom.PrimvarsAPI(card).CreatePrimvar("st", TYPES.TexCoord2fArray, "vertex").Set([(0, 0), (1, 0), (1, 1), (0, 1)])
    bind(card, made)
    seen = stage.image(size=(32, 32), spp=16)[16, :, 0]
    tiling, offset = inputs.get("uvtiling", (1, 1))[0], inputs.get("uvoffset", (0, 0))[0]
    size = inputs.get("realworldtilesize", (1, 1))[0] / inputs.get("realworldimagesize", (1, 1))[0]
    for x in (6, 10, 14, 18, 22, 26, 30):
        place = ((x + 0.5) / 32 * tiling - offset) * size % 1
        if min(abs(place - edge) for edge in (0, 0.75, 1)) > 0.13:
            assert (seen[x] > 0.5) == (place < 0.75), (x, place)


def test_coordinates_of_another_index_are_told(stage, tmp_path):
    card = on_a_card(stage, png(tmp_path / "map.png", np.full((4, 4, 3), 128)), kind="ND_image_color3")
    node = UsdShade.Shader(card.GetPrim().GetStage().GetPrimAtPath("/m/emissiveColor"))
    connect(stage, node, "texcoord", "ND_texcoord_vector2", {"index": (TYPES.Int, 1)}, "out", TYPES.Float2)
    assert any("another index than 0" in text for text in stage.told())
