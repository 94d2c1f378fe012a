"""Blender's nodes that light goes through at facets, against Cycles."""

import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import check, floor, link, material, mesh, node, scene, sky, told  # noqa: E402, F401

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def stage(scene, made, shape="uv_sphere"):
    sky(scene, (0.5, 0.7, 1.0))
    floor(scene)
    if shape == "cube":
        mesh(scene, "cube", made, place=(0, 0, 1), turn=(0.2, 0.3, 0.4), stretch=(0.7, 0.7, 0.7))
    else:
        mesh(scene, shape, made, smooth=True, place=(0, 0, 1), segments=64, ring_count=32)


@pytest.mark.parametrize(
    ("inputs", "shape"),
    [
        ({"roughness": 0.0}, "uv_sphere"),
        ({"roughness": 0.3, "color": (0.9, 0.6, 0.3)}, "uv_sphere"),
        ({"roughness": 0.3, "ior": 1.3}, "cube"),
    ],
    ids=["smooth", "rough", "cube"],
)
def test_refraction_lets_all_through_that_can_pass(scene, tmp_path, inputs, shape):
    stage(scene, material("BsdfRefraction", distribution="GGX", **inputs), shape)
    check(scene, tmp_path, 1500)


@pytest.mark.parametrize("by", ["Fresnel", "LayerWeight"])
def test_glass_that_is_mixed_by_hand(scene, tmp_path, by):
    made = material("MixShader")
    tree = made.node_tree
    mixed = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader")
    link(tree, node(tree, by, **({"ior": 1.45} if by == "Fresnel" else {"blend": 0.3})), mixed.inputs[0])
    link(tree, node(tree, "BsdfRefraction", distribution="GGX", ior=1.45, roughness=0.1), mixed.inputs[1])
    link(tree, node(tree, "BsdfAnisotropic", roughness=0.1, distribution="GGX"), mixed.inputs[2])
    stage(scene, made)
    check(scene, tmp_path, 1500)


@pytest.mark.parametrize(("transmission", "distribution"), [(1.0, "MULTI_GGX"), (0.0, "GGX")])
def test_facets_that_are_taken_as_others_are_named(scene, transmission, distribution):
    """Those of glass reflect once, those of other surfaces several times."""
    other = {"GGX": "MULTI_GGX", "MULTI_GGX": "GGX"}[distribution]
    inputs = {"transmission_weight": transmission, "roughness": 0.3}
    made = material("BsdfPrincipled", distribution=distribution, **inputs)
    mesh(scene, "cube", made)
    # Nothing is lit, which is named too.
    assert f"the distribution {distribution} is taken as {other}" in told(scene)
    made.node_tree.nodes["Principled BSDF"].distribution = other
    assert "distribution" not in told(scene)


def test_the_coat_of_glass_is_named(scene):
    mesh(scene, "cube", material("BsdfPrincipled", transmission_weight=1.0, coat_weight=1.0))
    assert "the coat of glass is left out" in told(scene)
