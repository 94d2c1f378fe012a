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


BALL = """
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0.5 0.2 0.1]
Shape "sphere" "float radius" 0.8 "string name" "ball"
"""


class Compositor:
    """Blender's compositor: what a socket of its tree has becomes the picture of a scene with nothing in it."""

    def __init__(self, shape: tuple[int, ...], path: pathlib.Path) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.path = path
        self.tree = bpy.data.node_groups.new("compositor", "CompositorNodeTree")
        self.tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        self.end = self.tree.nodes.new("NodeGroupOutput").inputs[0]
        scene, render = bpy.context.scene, bpy.context.scene.render
        scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(scene.camera)
        scene.compositing_node_group = self.tree
        render.engine, scene.cycles.samples = "CYCLES", 1
        render.resolution_y, render.resolution_x = shape[:2]
        render.resolution_percentage = 100
        settings = render.image_settings
        if hasattr(settings, "media_type"):
            settings.media_type = "IMAGE"
        settings.file_format, settings.color_depth = "OPEN_EXR", "32"
        render.filepath = str(path)

    def result(self, socket: bpy.types.NodeSocket) -> np.ndarray:
        self.tree.links.new(socket, self.end)
        bpy.ops.render.render(write_still=True)
        return wend.read(self.path).image


@pytest.mark.parametrize(("exr", "rounding"), [("float", 0), ("half", 2**-11)])
def test_blender_reads_the_values_of_ours(tmp_path: pathlib.Path, exr: str, rounding: float) -> None:
    film = wend.render(wend.loads(BALL), spp=8, sampling="classical", seed=3, layers=["direct", "cryptomatte"], progress=False)
    path = tmp_path / "ours.exr"
    film.save(path, layer_names="blender", exr=exr)
    compositor = Compositor(film.image.shape, tmp_path / "result.exr")
    picture = compositor.tree.nodes.new("CompositorNodeImage")
    picture.image = bpy.data.images.load(str(path))
    assert picture.image.type == "MULTILAYER"
    names = {"Combined": "beauty", "Denoising Albedo": "albedo", "direct": "direct", "Depth": "depth", "Normal": "normal",
             "variance": "variance", "samples": "samples", "Alpha": "alpha"}
    for socket, layer in names.items():
        ours = film[layer] if film[layer].ndim == 3 else np.dstack([film[layer]] * 3)
        assert ours.any(), layer
        is_colour = layer in ("beauty", "albedo", "direct", "alpha")
        np.testing.assert_allclose(compositor.result(picture.outputs[socket]), ours, rtol=rounding if is_colour else 0,
                                   err_msg=layer)
    matte = compositor.tree.nodes.new("CompositorNodeCryptomatteV2")
    matte.source, matte.image, matte.matte_id = "IMAGE", picture.image, "ball"
    np.testing.assert_allclose(compositor.result(matte.outputs["Matte"])[:, :, 0], film["alpha"], atol=1e-6)
    matte.matte_id = "bowl"
    assert not compositor.result(matte.outputs["Matte"]).any(), "there is no such object"
