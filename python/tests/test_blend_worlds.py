"""Worlds of Blender against Cycles, and against the light of their pictures."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    SIZE,
    agree,
    blocks,
    by_cycles,
    camera,
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

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def shown_otherwise(scene):
    """A world that the camera sees as another one than what lights."""
    tree = scene.world.node_tree
    background, end = tree.nodes["Background"], tree.get_output_node("CYCLES")
    background.inputs["Color"].default_value = (1, 0.5, 0.2, 1)
    other, mixed = node(tree, "Background", color=(0, 0, 0.1)), node(tree, "MixShader")
    link(tree, node(tree, "LightPath"), mixed.inputs[0], "Is Camera Ray")
    link(tree, background, mixed.inputs[1])
    link(tree, other, mixed.inputs[2])
    link(tree, mixed, end.inputs["Surface"])


def test_a_world_lights_as_other_rays_see_it(scene, tmp_path):
    shown_otherwise(scene)
    mesh(scene, "plane", material("BsdfDiffuse", color=(0.6, 0.4, 0.2)), size=6)
    mesh(scene, "cube", material("BsdfAnisotropic", roughness=0.0), place=(0, 0, 0.5))
    camera(scene, (0, -6, 2), (0, 0, 0.5))
    ours = check(scene, tmp_path, 256)
    np.testing.assert_allclose(ours[0], [[0, 0, 0.1]] * SIZE, atol=1e-6)
    assert not [world for world in bpy.data.worlds if world.name != "world"]


def test_a_world_that_mirrors_see_otherwise_is_named(scene):
    shown_otherwise(scene)
    tree = scene.world.node_tree
    mixed, path = tree.nodes["Mix Shader"], tree.nodes["Light Path"]
    link(tree, path, mixed.inputs[0], "Is Glossy Ray")
    mesh(scene, "plane", material("BsdfDiffuse"), size=6)
    assert "is as diffuse surfaces see it, but for the camera" in told(scene)


@pytest.mark.parametrize("how", ["film", "visibility"])
@pytest.mark.parametrize("is_even", [True, False], ids=["even", "picture"])
def test_a_world_that_the_camera_does_not_see_is_in_mirrors(scene, tmp_path, how, is_even):
    sky(scene, (0.5, 0.7, 1.0))
    if not is_even:
        link(scene.world.node_tree, node(scene.world.node_tree, "TexGradient"), scene.world.node_tree.nodes["Background"].inputs[0])
    scene.render.film_transparent = how == "film"
    scene.world.cycles_visibility.camera = how == "film"
    mesh(scene, "plane", material("BsdfDiffuse", color=(0.6, 0.4, 0.2)), size=6)
    mesh(scene, "uv_sphere", material("BsdfAnisotropic", roughness=0.0), smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    lamp(scene, "SUN", 1, (0, 0, 9), (0.3, -0.3, 0), angle=0.6).visible_camera = False
    camera(scene, (0, -6, 2), (0, 0, 0.5))
    assert np.all(check(scene, tmp_path, 2000)[0] == 0)


@pytest.mark.parametrize("is_seen", [True, False])
def test_a_sun_is_seen_by_the_camera_as_it_is_set(scene, tmp_path, is_seen):
    sky(scene, (0.2, 0.2, 0.2))
    lamp(scene, "SUN", 1, (0, 0, 9), (-1.5, 0, 0), angle=0.6).visible_camera = is_seen
    mesh(scene, "plane", material("BsdfDiffuse"), place=(0, 0, 1), size=1)
    camera(scene, (0, -6, 1.1), (0, 0, 1.4))
    check(scene, tmp_path, 256)


def test_a_world_that_the_camera_does_not_see_lights(scene, tmp_path):
    tree = scene.world.node_tree
    link(tree, node(tree, "TexGradient"), tree.nodes["Background"].inputs["Color"])
    scene.world.cycles_visibility.camera = False
    floor(scene)
    camera(scene, (0, -4, 5), (0, 0, 0.5))
    check(scene, tmp_path, 256)


def test_a_world_is_that_of_the_frame(scene, tmp_path):
    tree = scene.world.node_tree
    background = tree.nodes["Background"]
    link(tree, node(tree, "TexGradient"), background.inputs["Color"])
    for frame, strength in ((1, 0.2), (10, 2.0)):
        background.inputs["Strength"].default_value = strength
        background.inputs["Strength"].keyframe_insert("default_value", frame=frame)
    floor(scene)
    camera(scene, (0, -4, 5), (0, 0, 0.5))
    scene.frame_set(1)
    ours = blend.of_scene(scene, frame=10, spp=256).scene()
    scene.frame_set(10)
    agree(blocks(wend.render(ours, sampling="classical").image), blocks(by_cycles(scene, tmp_path, 256)))


def lit_by(scene, light, turn):
    """A floor below a sky of this picture, which is turned."""
    height, width = light.shape
    image = bpy.data.images.new("sky", width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = light[::-1, :, None]
    image.pixels.foreach_set(pixels.ravel())
    tree = scene.world.node_tree
    mapped, picture = node(tree, "Mapping", rotation=turn), node(tree, "TexEnvironment", image=image)
    link(tree, node(tree, "TexCoord"), mapped.inputs[0], "Generated")
    link(tree, mapped, picture.inputs[0])
    link(tree, picture, tree.nodes["Background"].inputs["Color"])
    floor(scene, (0.5, 0.5, 0.5))


@pytest.mark.parametrize("width", [256, 2048])
def test_what_is_small_and_bright_has_all_its_light(scene, width):
    """A pixel that has nearly all light of the sky, anywhere in between the pixels of the panorama."""
    light = np.full((width // 2, width), 0.1, dtype=np.float32)
    row = width // 7
    light[row, width // 3] = 0.1 * width**2
    lit_by(scene, light, (0, 0, 0.7))
    angle = (np.arange(width // 2) + 0.5) / (width // 2) * np.pi
    falls_in = light.sum(axis=1) * np.sin(angle) * np.maximum(np.cos(angle), 0) * 2 * (np.pi / width) ** 2 * 2
    camera(scene, (0, -3, 6), (0, 0, 0))
    ours = wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image
    np.testing.assert_allclose(ours.mean(axis=(0, 1)), 0.5 / np.pi * falls_in.sum(), rtol=0.005)


def test_a_sky_that_is_turned_has_its_sun_where_cycles_has_it(scene, tmp_path):
    light = np.full((64, 128), 0.1, dtype=np.float32)
    light[13:15, 89:91] = 500
    lit_by(scene, light, (0.3, 0.2, 0.7))
    mesh(scene, "uv_sphere", material("BsdfDiffuse"), smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    check(scene, tmp_path, 700, tolerance=0.01)
