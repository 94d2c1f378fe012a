"""Blender's nodes that light goes through at facets, against Cycles."""

import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import check, floor, lamp, link, material, mesh, node, scene, sky, takes, told  # noqa: E402, F401

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


@pytest.mark.parametrize("how", ["principled", "sum", "picture"])
def test_glass_that_shines_shines_to_both_sides(scene, tmp_path, how):
    """What its inner side shines with comes out as bright."""
    floor(scene)
    glow = {"distribution": "GGX", "roughness": 0.3, "emission_color": (0.2, 0.4, 1), "emission_strength": 0.5}
    if how == "sum":
        made = material()
        tree = made.node_tree
        both = node(tree, "AddShader")
        link(tree, node(tree, "BsdfGlass", distribution="GGX", roughness=0.3, color=(0.8, 0.8, 0.8)), both.inputs[0])
        link(tree, node(tree, "Emission", color=(0.2, 0.4, 1), strength=0.5), both.inputs[1])
        link(tree, both, next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial").inputs["Surface"])
    elif how == "principled":
        made = material("BsdfPrincipled", base_color=(0.8, 0.8, 0.8), transmission_weight=1.0, **glow)
    else:

        def wire(tree, socket):
            gradient = node(tree, "TexGradient")
            link(tree, node(tree, "TexCoord"), gradient.inputs[0], "Generated")
            link(tree, gradient, socket)

        made = takes("BsdfPrincipled", "Emission Strength", wire, transmission_weight=1.0, **glow)
    sky(scene, (0.3, 0.3, 0.3))
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 1.01), segments=64, ring_count=32)
    check(scene, tmp_path, 2500, cycles_spp=2500)


@pytest.mark.parametrize("what", ["mesh", "lamp", "volume", "own volume"])
def test_what_shines_in_glass_comes_out_as_bright(scene, tmp_path, what):
    sky(scene, (0.2, 0.3, 0.4))
    made = material("BsdfGlass", distribution="GGX", roughness=0.3, ior=1.45)
    glow = {"color": (0.5, 0.5, 0.5), "density": 0.5, "emission_color": (1, 0.4, 0.1), "emission_strength": 0.5}
    if what == "own volume":
        tree = made.node_tree
        end = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")
        link(tree, node(tree, "VolumePrincipled", **glow), end.inputs["Volume"])
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 0.5), radius=1.7, segments=64, ring_count=32)
    if what == "mesh":
        shining = material("Emission", color=(1, 0.4, 0.1))
        mesh(scene, "uv_sphere", shining, smooth=True, place=(0, 0, 0.5), radius=0.9, segments=64, ring_count=32)
    elif what == "lamp":
        lamp(scene, "POINT", 20, (0, 0, 0.5), shadow_soft_size=0.8, use_soft_falloff=False)
    elif what == "volume":
        mesh(scene, "cube", material("VolumePrincipled", "Volume", **glow), place=(0, 0, 0.5), size=1.5)
    check(scene, tmp_path, 1500)


def test_in_glass_the_camera_sees_all_as_bright(scene, tmp_path):
    sky(scene, (0.3, 0.4, 0.5))
    water = material("BsdfGlass", distribution="GGX", roughness=0.3, ior=1.33)
    tree = water.node_tree
    end = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")
    link(tree, node(tree, "VolumeAbsorption", color=(0.2, 0.6, 0.9), density=0.1), end.inputs["Volume"])
    mesh(scene, "cube", water, place=(0, -6, 3), size=3)
    floor(scene)
    check(scene, tmp_path, 1500)
