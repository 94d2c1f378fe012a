"""Volumes of Blender that lie within each other, or around the camera, against Cycles."""

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

#: Fog that varies, or is everywhere, is as noisy in Cycles as here.
NOISY = 0.015

DARK = ("VolumeAbsorption", {"color": (0.2, 0.6, 0.6), "density": 0.6})
DARKER = ("VolumeAbsorption", {"color": (0.6, 0.6, 0.2), "density": 1.6})
MIST = ("VolumeScatter", {"color": (0.8, 0.5, 0.3), "density": 0.5, "anisotropy": 0.6})
HAZE = ("VolumeScatter", {"color": (0.3, 0.6, 0.9), "density": 0.5, "anisotropy": -0.4})


def cube(scene, volume, size, place=(0, 0, 1.5), **settings):
    kind, inputs = volume
    return mesh(scene, "cube", material(kind, "Volume", **inputs), place=place, size=size, **settings)


def fill_world(scene, volume):
    tree = scene.world.node_tree
    end = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputWorld")
    link(tree, node(tree, volume[0], **volume[1]), end.inputs["Volume"])


def varies(made, scale=2.0):
    """Its density along an axis."""
    tree = made.data.materials[0].node_tree
    shader = next(n for n in tree.nodes if n.bl_idname.startswith("ShaderNodeVolume"))
    gradient, scaled = node(tree, "TexGradient"), node(tree, "Math", operation="MULTIPLY")
    scaled.inputs[1].default_value = scale
    link(tree, node(tree, "TexCoord"), gradient.inputs[0], "Generated")
    link(tree, gradient, scaled.inputs[0])
    link(tree, scaled, shader.inputs["Density"])
    return made


@pytest.mark.parametrize("pair", [(DARKER, DARK), (MIST, HAZE), (MIST, DARK)], ids=["dark", "two phases", "fog in the dark"])
def test_one_within_another(scene, tmp_path, pair):
    inner, outer = pair
    floor(scene)
    sky(scene, (0.6, 0.8, 1.0))
    lamp(scene, "SUN", 2, (0, 0, 5), (0.6, 0.1, 0), angle=0.2)
    cube(scene, inner, 1.1, turn=(0.2, 0.3, 0))
    cube(scene, outer, 2.6)
    check(scene, tmp_path, 1000)


def test_what_varies_within_another(scene, tmp_path):
    floor(scene)
    sky(scene, (0.6, 0.8, 1.0))
    varies(cube(scene, MIST, 1.4, turn=(0.2, 0.3, 0)))
    cube(scene, HAZE, 2.6)
    check(scene, tmp_path, 1000, tolerance=NOISY)


def test_in_the_volume_of_the_world(scene, tmp_path):
    sky(scene, (0.8, 0.9, 1.0))
    fill_world(scene, ("VolumeAbsorption", {"color": (0.7, 0.8, 0.9), "density": 0.1}))
    mesh(scene, "plane", material("Emission", color=(0.6, 0.4, 0.2)), size=20)
    cube(scene, DARK, 2)
    check(scene, tmp_path, 500)


@pytest.mark.parametrize("is_even", [True, False], ids=["even", "varies"])
def test_around_the_camera(scene, tmp_path, is_even):
    floor(scene)
    sky(scene, (0.6, 0.8, 1.0))
    cube(scene, DARK, 1.2)
    made = cube(scene, ("VolumeScatter", {"color": (0.8, 0.8, 0.8), "density": 0.05}), 16, place=(0, 0, 4))
    if not is_even:
        varies(made, 0.1)
    check(scene, tmp_path, 1000, tolerance=NOISY)


def test_glass_with_a_colour_of_its_own_in_fog(scene, tmp_path):
    floor(scene)
    sky(scene, (0.6, 0.8, 1.0))
    glass = material("BsdfGlass", distribution="GGX", roughness=0.3, ior=1.45)
    tree = glass.node_tree
    link(tree, node(tree, DARK[0], **DARK[1]), next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial").inputs["Volume"])
    mesh(scene, "uv_sphere", glass, smooth=True, place=(0, 0, 1.5), segments=64, ring_count=32, radius=0.8)
    cube(scene, HAZE, 2.4)
    check(scene, tmp_path, 1000)


def test_where_only_parts_of_two_are_at_one_place_is_told(scene):
    sky(scene, (1, 1, 1))
    cube(scene, MIST, 2).name = "mist"
    cube(scene, HAZE, 1.5, place=(0.9, 0, 1.5)).name = "haze"
    words = told(scene)
    assert "object 'haze': warning: its volume is in part within that of object 'mist'" in words


def test_what_varies_in_what_varies_is_told(scene):
    sky(scene, (1, 1, 1))
    varies(cube(scene, MIST, 1))
    varies(cube(scene, HAZE, 2))
    assert "its volume is in place of that of object 'Cube.001', and not added to it" in told(scene, bake_resolution=16)
