"""Wend inside Blender: the render engine and its zip."""

import tomllib
import zipfile

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    SIZE,
    blocks,
    by_cycles,
    camera,
    floor,
    lamp,
    link,
    material,
    mesh,
    node,
    scene,
    sky,
    straight,
    takes,
)

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def test_the_add_on_gives_the_passes_that_a_view_layer_asks_for(scene, tmp_path, addon):
    floor(scene, (0.6, 0.4, 0.2))
    sky(scene, (1, 1, 1))
    camera(scene, (0, 0, 5), (0, 0.001, 0))
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_diffuse_color = True
    scene.render.engine, scene.wend.samples = "WEND", 4
    scene.render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.exr_codec, scene.render.image_settings.use_exr_interleave = "NONE", True
    scene.render.filepath = str(tmp_path / "passes.exr")
    bpy.ops.render.render(write_still=True)
    # Uncompressed, a file ends with its last line: channel after channel, by name.
    line = np.frombuffer((tmp_path / "passes.exr").read_bytes()[-11 * SIZE * 4 :], dtype="<f4").reshape(11, SIZE)
    combined, depth, albedo, normal = np.split(line, [4, 5, 8])
    assert np.allclose(combined[0], 1)
    assert depth.min() > 4.9 and depth.max() < 6
    assert np.allclose(albedo, [[0.2], [0.4], [0.6]], atol=1e-3)
    assert np.allclose(normal, [[0], [0], [1]], atol=1e-3)


@pytest.fixture
def addon():
    from wend import blender_addon

    blender_addon.register()
    yield blender_addon
    blender_addon.unregister()


def test_the_add_on_renders_frames(scene, tmp_path, addon):
    floor(scene)
    ball = mesh(scene, "uv_sphere", material("BsdfDiffuse", color=(0.8, 0.2, 0.1)), place=(0, 0, 0.5), radius=0.7)
    lamp(scene, "SUN", 3, (0, 0, 5), (0.5, 0.3, 0), angle=0)
    for frame, x in ((1, -1.0), (2, 1.0)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, 2
    pictures = {}
    for engine in ("CYCLES", "WEND"):
        scene.render.engine = engine
        scene.cycles.samples, scene.wend.samples, scene.wend.guiding = 256, 256, "classical"
        scene.render.filepath = str(tmp_path / f"{engine}.####")
        bpy.ops.render.render(animation=True)
        pictures[engine] = [wend.read(tmp_path / f"{engine}.{i:04}.exr").image for i in (1, 2)]
    for ours, theirs in zip(pictures["WEND"], pictures["CYCLES"]):
        assert np.abs(blocks(ours) / blocks(theirs) - 1).max() < 0.01
    assert np.abs(pictures["WEND"][0] - pictures["WEND"][1]).mean() > 0.01


def test_the_add_on_blurs_what_moves(scene, tmp_path, addon):
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    ball = mesh(scene, "cube", material("BsdfDiffuse", color=(0.9, 0.2, 0.1)), place=(0, 0, 1))
    straight(ball)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.8
    scene.render.engine = "WEND"
    scene.wend.samples, scene.wend.guiding = 1000, "classical"
    scene.render.filepath = str(tmp_path / "wend.exr")
    bpy.ops.render.render(write_still=True)
    ours = wend.read(scene.render.filepath).image
    scene.render.engine = "CYCLES"
    assert np.abs(blocks(ours) / blocks(by_cycles(scene, tmp_path, 1000)) - 1).max() < 0.01


def test_the_add_on_bakes_before_a_render_without_windows(scene, tmp_path, addon):
    """Textures, and the sky."""
    tree = scene.world.node_tree
    ramp = node(tree, "VectorMath", operation="MULTIPLY_ADD")
    ramp.inputs[1].default_value, ramp.inputs[2].default_value = (0.4, 0.4, 0.4), (0.5, 0.5, 0.5)
    link(tree, node(tree, "TexCoord"), ramp.inputs[0], "Generated")
    link(tree, ramp, tree.nodes["Background"].inputs["Color"])
    noise = lambda tree, socket: link(tree, node(tree, "TexNoise", scale=3.0), socket, 1)  # noqa: E731
    ball = mesh(scene, "cube", takes("BsdfDiffuse", "Color", noise), place=(0, 0, 0.5))
    for frame, x in ((1, -1.0), (2, 1.0)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, 2
    for engine in ("CYCLES", "WEND"):
        scene.render.engine = engine
        scene.cycles.samples = scene.wend.samples = 128
        scene.wend.guiding = "classical"
        scene.render.filepath = str(tmp_path / f"{engine}.####")
        bpy.ops.render.render(animation=True)
    for frame in (1, 2):
        ours, theirs = (blocks(wend.read(tmp_path / f"{engine}.{frame:04}.exr").image) for engine in ("WEND", "CYCLES"))
        assert np.abs(ours / theirs - 1).max() < 0.01
    assert not addon._classes()[1].prepared


def test_the_add_on_says_what_is_wrong(scene, tmp_path, addon):
    (tmp_path / "broken.png").write_bytes(b"no picture")
    image = bpy.data.images.new("broken", 4, 4)
    image.source, image.filepath = "FILE", str(tmp_path / "broken.png")
    made = material("BsdfDiffuse")
    texture = made.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    link(made.node_tree, texture, next(n for n in made.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse").inputs["Color"])
    mesh(scene, "cube", made)
    scene.render.engine = "WEND"
    with pytest.raises(RuntimeError, match="broken.png"):
        bpy.ops.render.render()


def test_the_zip_of_the_add_on(tmp_path, addon, capsys):
    wheel = tmp_path / "wend-0.1.0-cp311-cp311-manylinux_2_28_x86_64.whl"
    assert addon.main([str(wheel), "-o", str(tmp_path / "wend.zip")]) == 2
    assert "wheel of Wend" in capsys.readouterr().err
    wheel.write_bytes(b"a wheel")
    assert addon.main([str(wheel), "-o", str(tmp_path / "wend.zip")]) == 0
    with zipfile.ZipFile(tmp_path / "wend.zip") as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        assert manifest["wheels"] == [f"./wheels/{wheel.name}"] and manifest["id"] == "wend" and manifest["version"] == "0.1.0"
        assert f"wheels/{wheel.name}" in archive.namelist() and "__init__.py" in archive.namelist()
