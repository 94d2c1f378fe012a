"""Blender's lamps that have a size, a spread, or move, and what is not shown to the camera, against Cycles."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    SIZE,
    add,
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
    straight,
    told,
)

from cycles_reference import reference  # noqa: E402

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def block(scene):
    return mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(0.3, 0, 0.5), stretch=(0.4, 0.4, 0.5))


@pytest.mark.parametrize("soft_falloff", [False, True])
def test_soft_spot(scene, tmp_path, soft_falloff):
    floor(scene)
    block(scene)
    lamp(
        scene, "SPOT", 300, (1, -1, 4), (0.2, 0.1, 0),
        shadow_soft_size=0.3, spot_size=0.9, spot_blend=0.4, use_soft_falloff=soft_falloff,
    )  # fmt: skip
    # With it, Cycles takes a disk that faces what is lit.
    check(scene, tmp_path, 1000, tolerance=0.02 if soft_falloff else 0.01)


@pytest.mark.parametrize("shape", ["SQUARE", "DISK"])
@pytest.mark.parametrize("spread", [1.0, 2.0])
def test_spread(scene, tmp_path, shape, spread):
    floor(scene)
    block(scene)
    lamp(scene, "AREA", 100, (0.5, -0.5, 4), (0.1, 0.1, 0), shape=shape, size=1.5, spread=spread)
    # Where little of the lamp shines, few connections find it.
    check(scene, tmp_path, 4000)


@pytest.mark.parametrize("kind", ["POINT", "SPOT", "AREA"])
def test_lamps_move(scene, tmp_path, kind):
    """Cycles leaves lamps where they are at the frame: the mean of its pictures on the way."""
    floor(scene)
    settings = {"size": 0.4} if kind == "AREA" else {"shadow_soft_size": 0.2}
    if kind == "SPOT":
        # With a soft falloff, Cycles takes a disk that faces what is lit.
        settings.update(spot_size=1.5, use_soft_falloff=False)
    moving = lamp(scene, kind, 300, (0, 0, 2.5), **settings)
    # The edge of a spot's cone goes over the floor.
    steps = 32 if kind == "SPOT" else 8

    def render(seed):
        pictures = []
        for step in range(steps):
            moving.location.x = ((step + 0.5) / steps - 0.5) * 1.5
            pictures.append(by_cycles(scene, tmp_path, 100, seed))
        return blocks(np.mean(pictures, axis=0))

    theirs = reference(render)
    moving.location.x = 0
    straight(moving)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    ours = wend.render(blend.of_scene(scene, spp=4000 if kind == "SPOT" else 1000).scene(), sampling="classical").image
    agree(blocks(ours), theirs)


def test_what_cannot_move_is_where_it_is_half_way(scene):
    floor(scene)
    straight(lamp(scene, "POINT", 300, (0, 0, 2.5), shadow_soft_size=0))
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.render.motion_blur_position = "START"
    with pytest.warns(wend.SceneWarning, match="light 'POINT': warning: what moves .* half open"):
        text = blend.of_scene(scene).text()
    place = text[: text.index('LightSource "point"')].rsplit("Transform [", 1)[1].split("]")[0].split()
    # From 0 to 1.5 from frame 2 to 3.
    assert float(place[12]) == pytest.approx(0.75)


def alpha_of(scene, tmp_path, spp=1000):
    """Both pictures with their opacity."""
    scene.render.film_transparent = True
    scene.render.image_settings.color_mode = "RGBA"
    scene.cycles.samples = spp
    scene.render.filepath = str(tmp_path / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    theirs = np.array(image.pixels[:]).reshape(SIZE, SIZE, 4)[::-1]
    ours = wend.render(blend.of_scene(scene, spp=spp).scene(), sampling="classical")
    return np.dstack([ours.image, ours["alpha"]]), theirs


def agree_with_opacity(ours, theirs):
    def blocks(picture):
        return picture.reshape(4, SIZE // 4, 4, SIZE // 4, 4).mean(axis=(1, 3))

    a, b = blocks(ours), blocks(theirs)
    error = np.abs(a - b) / np.maximum(b, 0.05 * b.mean())
    # Our opacity is that of fifteen rays a pixel.
    error[..., 3] = np.abs(a - b)[..., 3]
    assert error.max() <= 0.01, f"\n{np.round(a - b, 3)}"


@pytest.mark.parametrize("how", ["object", "collection", "shader"])
def test_a_holdout_is_a_hole(scene, tmp_path, how):
    floor(scene)
    lamp(scene, "AREA", 300, (1, -1, 4), size=1.0).visible_camera = False
    made = mesh(scene, "cube", material("BsdfDiffuse", color=(0.7, 0.5, 0.3)), place=(0, 0, 0.7), turn=(0, 0, 0.4), stretch=(0.7, 0.7, 0.7))
    if how == "object":
        made.is_holdout = True
    elif how == "shader":
        made.data.materials[0] = material("Holdout")
    else:
        collection = bpy.data.collections.new("matte")
        scene.collection.children.link(collection)
        scene.collection.objects.unlink(made)
        collection.objects.link(made)
        bpy.context.view_layer.layer_collection.children["matte"].holdout = True
    ours, theirs = alpha_of(scene, tmp_path)
    assert theirs[SIZE // 2, SIZE // 2, 3] < 1e-6
    agree_with_opacity(ours, theirs)


@pytest.mark.parametrize("how", ["object", "collection"])
def test_what_the_camera_does_not_see_casts_its_shadow(scene, tmp_path, how):
    floor(scene)
    sky(scene, (0.2, 0.2, 0.2))
    lamp(scene, "AREA", 300, (1, -1, 4), size=1.0).visible_camera = False
    made = block(scene)
    if how == "object":
        made.visible_camera = False
    else:
        collection = bpy.data.collections.new("unseen")
        scene.collection.children.link(collection)
        scene.collection.objects.unlink(made)
        collection.objects.link(made)
        bpy.context.view_layer.layer_collection.children["unseen"].indirect_only = True
    check(scene, tmp_path, 1000)


@pytest.mark.parametrize("seen", [False, True])
def test_lamps_are_seen_by_mirrors_and_are_in_nobodys_way(scene, tmp_path, seen):
    floor(scene)
    sky(scene, (0.1, 0.1, 0.1))
    mirror = material("BsdfPrincipled", base_color=(0.9, 0.8, 0.7), metallic=1.0, roughness=0.0)
    mesh(scene, "uv_sphere", mirror, smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    # The sun is behind the panel, which hangs in the picture.
    lamp(scene, "AREA", 100, (-1, -1, 3), (0.3, -0.3, 0), size=1.5).visible_camera = seen
    lamp(scene, "SUN", 1, (0, 0, 9), (0.3, -0.3, 0), angle=0.6)
    check(scene, tmp_path, 4000)


@pytest.mark.parametrize("size", [(-1, 1, 1), (1, 1, -1)], ids=["sideways", "backwards"])
@pytest.mark.parametrize("kind", ["POINT", "SPOT", "DISK", "RECTANGLE"])
def test_mirrored_lamps_shine_where_cycles_has_them(scene, tmp_path, kind, size):
    """Those that are mirrored along their axis shine backwards."""
    floor(scene)
    sky(scene, (0.2, 0.2, 0.2))
    camera(scene, (0, -4, 5), (0, 0, 0))
    settings = {"spot_size": 1.5, "spot_blend": 0.5} if kind == "SPOT" else {}
    if kind in ("POINT", "SPOT"):
        made = lamp(scene, kind, 100, (0.3, 0, 6), (0.1, 0.1, 0), size, shadow_soft_size=0.3, **settings)
        made.data.use_soft_falloff = False
    else:
        lamp(scene, "AREA", 100, (0.3, 0, 6), (0.1, 0.1, 0), size, shape=kind, size=0.8)
    check(scene, tmp_path, 500, tolerance=0.015)


def test_lamps_and_worlds_that_take_light_away_or_end_it_early_are_named(scene):
    floor(scene)
    sky(scene, (1, 1, 1))
    lamp(scene, "POINT", -60, (1, -1, 2)).name = "dark"
    lamp(scene, "AREA", 60, (1, -1, 2)).data.cycles.max_bounces = 0
    scene.world.cycles.max_bounces = 2
    words = told(scene)
    assert "light 'dark': warning: negative power" in words
    assert "light 'AREA': warning: light that was reflected more often than its 0 times is there" in words
    assert "world 'world': warning: light that was reflected more often than its 2 times is there" in words
