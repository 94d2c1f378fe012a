"""Pictures that Blender writes and reads: multilayer OpenEXR files."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")

SIZE = 12


def layers_that_blender_sees(path: pathlib.Path) -> list[str]:
    image = bpy.data.images.load(str(path))
    len(image.pixels)  # reads the file
    assert image.type == "MULTILAYER"
    tree = bpy.data.node_groups.new("tree", "CompositorNodeTree")
    node = tree.nodes.new("CompositorNodeImage")
    node.image = image
    return [socket.name for socket in node.outputs]


def test_a_multilayer_file_of_blender_is_read(tmp_path: pathlib.Path) -> None:
    bpy.ops.wm.read_factory_settings()
    scene, view = bpy.context.scene, bpy.context.view_layer
    render = scene.render
    render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.cycles.pixel_filter_type = "BOX"
    render.resolution_x, render.resolution_y, render.resolution_percentage = SIZE, SIZE, 100
    render.film_transparent = True
    view.use_pass_z = view.use_pass_normal = view.use_pass_diffuse_direct = True
    view.cycles.denoising_store_passes = True
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    path = tmp_path / "multilayer.exr"
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)

    film = wend.read(path)
    assert film.image.shape == (SIZE, SIZE, 3)
    assert {"alpha", "depth", "normal", "albedo", "Diffuse Direct"} <= set(film)
    # The cube in the middle, and nothing behind it.
    middle, corner = (SIZE // 2, SIZE // 2), (0, 0)
    assert film["alpha"][middle] == 1 and film["alpha"][corner] == 0
    assert 5 < film["depth"][middle] < 15 and film["depth"][corner] > 1e9
    assert np.linalg.norm(film["normal"][middle]) == pytest.approx(1, abs=0.2)
    # The base colour, and a little of what the coat reflects.
    np.testing.assert_allclose(film["albedo"][middle], 0.8, atol=0.05)
    assert film.image[middle].mean() > 0 and film.image[corner].max() == 0


def test_blender_sees_the_layers_of_ours(furnace: wend.Scene, tmp_path: pathlib.Path) -> None:
    film = wend.render(furnace, spp=2, sampling="classical", progress=False)
    path = tmp_path / "ours.exr"
    film.save(path, layer_names="blender")
    assert {"Combined", "Alpha", "Depth", "Normal", "Denoising Albedo", "variance"} <= set(layers_that_blender_sees(path))
