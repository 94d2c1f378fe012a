"""Sums of Blender's shaders, against Cycles."""

import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    check,
    floor,
    lamp,
    link,
    material,
    mesh,
    node,
    scene,
    sky,
    told,
)

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")

SHADERS = {
    # Together they scatter less than all: of what scatters more there is no end.
    "diffuse": ("BsdfDiffuse", {"color": (0.4, 0.25, 0.15)}),
    "blue": ("BsdfDiffuse", {"color": (0.05, 0.15, 0.4)}),
    "glossy": ("BsdfGlossy", {"color": (0.3, 0.35, 0.4), "roughness": 0.3}),
    "translucent": ("BsdfTranslucent", {"color": (0.2, 0.3, 0.15)}),
    "principled": ("BsdfPrincipled", {"base_color": (0.5, 0.3, 0.2)}),
    "sheen": ("BsdfSheen", {"color": (0.25, 0.3, 0.35)}),
    "clear": ("BsdfTransparent", {"color": (0.6, 0.6, 0.6)}),
    "tinted": ("BsdfTransparent", {"color": (0.3, 0.5, 0.6)}),
    "open": ("BsdfTransparent", {"color": (1, 1, 1)}),
    "light": ("Emission", {"color": (1, 0.5, 0.2), "strength": 0.5}),
}


def sum_of(*names):
    made = material()
    tree = made.node_tree
    end = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")
    total = None
    for name in names:
        kind, inputs = SHADERS[name]
        one = node(tree, kind, **inputs)
        if total is not None:
            both = node(tree, "AddShader")
            link(tree, total, both.inputs[0])
            link(tree, one, both.inputs[1])
            one = both
        total = one
    link(tree, total, end.inputs["Surface"])
    return made


def ball(scene, made):
    sky(scene, (0.5, 0.7, 1.0))
    floor(scene)
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 1), radius=1, segments=64, ring_count=32)
    lamp(scene, "AREA", 400, (2, -3, 4), (0.8, 0.2, 0.3), size=1.5).visible_camera = False


# What a ball lets through at random takes many samples.
@pytest.mark.parametrize(
    "names",
    [
        ("diffuse", "glossy"),
        ("diffuse", "blue"),
        ("diffuse", "translucent"),
        ("diffuse", "glossy", "translucent"),
        ("principled", "sheen"),
        ("clear", "glossy"),
        ("tinted", "diffuse"),
        ("clear", "light"),
    ],
    ids="+".join,
)
def test_a_sum_has_all_of_both(scene, tmp_path, names):
    ball(scene, sum_of(*names))
    is_noisy = {"clear", "tinted"} & set(names)
    check(scene, tmp_path, 2000 if is_noisy else 1000, 0.03 if is_noisy else 0.01)


def test_what_is_transparent_in_a_sum_is_named(scene):
    ball(scene, sum_of("open", "glossy"))
    assert "what is transparent in a sum" in told(scene)
