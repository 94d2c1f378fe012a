"""Scenes of Blender: what the renderer makes of them, against Cycles."""

import math
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    SIZE,
    add,
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
)

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def test_point_lamp(scene, tmp_path):
    floor(scene)
    mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(0, 0, 0.5), stretch=(0.5, 0.5, 0.5))
    lamp(scene, "POINT", 200, (1, -1, 3), shadow_soft_size=0.2)
    check(scene, tmp_path, 1000)


def test_spot_lamp(scene, tmp_path):
    floor(scene)
    lamp(scene, "SPOT", 300, (1, -1, 4), (0.2, 0.1, 0), shadow_soft_size=0, spot_size=0.9, spot_blend=0.4)
    check(scene, tmp_path, 400)


@pytest.mark.parametrize("angle", [0, 0.6])
def test_sun(scene, tmp_path, angle):
    floor(scene)
    mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(0, 0, 0.5), turn=(0, 0, 0.5), stretch=(0.5, 0.7, 0.5))
    lamp(scene, "SUN", 3, (0, 0, 5), (0.6, 0.3, 0.2), angle=angle)
    check(scene, tmp_path, 256)


@pytest.mark.parametrize("shape", ["RECTANGLE", "ELLIPSE"])
def test_area_lamp(scene, tmp_path, shape):
    floor(scene)
    lamp(scene, "AREA", 100, (1, -1, 4), (0.4, 0.2, 0.3), (2, 1, 1), shape=shape, size=1.0, size_y=0.4)
    check(scene, tmp_path, 400)


@pytest.mark.parametrize(
    "inputs",
    [
        {"base_color": (0.8, 0.4, 0.1), "roughness": 0.5},
        {"base_color": (0.3, 0.4, 0.6), "roughness": 0.15, "ior": 1.8},
        {"base_color": (0.9, 0.6, 0.3), "metallic": 1.0, "roughness": 0.4},
        {"base_color": (0.5, 0.2, 0.1), "metallic": 0.5, "roughness": 0.6, "coat_weight": 0.7, "coat_roughness": 0.3},
    ],
    ids=["plastic", "shiny", "metal", "coated"],
)
def test_principled(scene, tmp_path, inputs):
    sky(scene, (0.5, 0.7, 1.0))
    mesh(scene, "uv_sphere", material("BsdfPrincipled", **inputs), smooth=True, place=(0, 0, 0.5), radius=1.5, segments=64, ring_count=32)
    lamp(scene, "AREA", 400, (2, -3, 4), (0.8, 0.2, 0.3), size=1.5).visible_camera = False
    check(scene, tmp_path, 600)


@pytest.mark.parametrize(
    "glass",
    [
        {"kind": "BsdfGlass", "color": (1, 1, 1), "distribution": "GGX"},
        {"kind": "BsdfGlass", "color": (0.9, 0.6, 0.3), "distribution": "GGX"},
        {"kind": "BsdfPrincipled", "base_color": (0.8, 0.9, 0.5), "transmission_weight": 1, "distribution": "GGX"},
    ],
    ids=["white", "coloured", "principled"],
)
def test_glass(scene, tmp_path, glass):
    sky(scene, (0.5, 0.7, 1.0))
    floor(scene)
    kind, rest = glass["kind"], {name: value for name, value in glass.items() if name != "kind"}
    mesh(scene, "cube", material(kind, roughness=0.3, ior=1.45, **rest), place=(0, 0, 1), turn=(0.2, 0.3, 0.4), stretch=(0.7, 0.7, 0.7))
    check(scene, tmp_path, 2000, tolerance=0.015)


def test_emission_and_transparency(scene, tmp_path):
    floor(scene)
    mesh(scene, "plane", material("Emission", color=(1, 0.8, 0.5), strength=5), place=(0, 2, 1.5), turn=(1.2, 0, 0), stretch=(1, 1, 1))
    half = bpy.data.materials.new("half")
    tree = half.node_tree
    tree.nodes.clear()
    mix = node(tree, "MixShader", factor=0.3)
    link(tree, node(tree, "BsdfTransparent"), mix.inputs[1])
    link(tree, node(tree, "BsdfDiffuse", color=(0.1, 0.6, 0.3)), mix.inputs[2])
    link(tree, mix, tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    mesh(scene, "cube", half, place=(0, -0.5, 0.6), stretch=(0.5, 0.5, 0.5))
    check(scene, tmp_path, 1000)


@pytest.mark.parametrize("kind", ["HENYEY_GREENSTEIN", "RAYLEIGH", "DRAINE"])
def test_volume_scatter(scene, tmp_path, kind):
    fog = material("VolumeScatter", "Volume", color=(0.8, 0.6, 0.4), density=1.0, phase=kind, anisotropy=0.2, alpha=0.5)
    mesh(scene, "cube", fog, place=(0, 0, 0.5), stretch=(3, 2, 3))
    lamp(scene, "SUN", 3, (0, 0, 5), (0.7, 0.1, 0), angle=0)
    # Noise is half of it.
    check(scene, tmp_path, 2000, tolerance=0.015)


def test_principled_volume(scene, tmp_path):
    sky(scene, (0.3, 0.3, 0.3))
    smoke = material(
        "VolumePrincipled", "Volume", color=(0.5, 0.7, 0.9), density=0.8, anisotropy=0.3,
        absorption_color=(0.2, 0.1, 0.0), emission_strength=0.3, emission_color=(1, 0.4, 0.1),
    )  # fmt: skip
    mesh(scene, "cube", smoke, place=(0, 0, 0.8))
    check(scene, tmp_path, 800)


def test_volume_of_a_file(scene, tmp_path):
    file = pathlib.Path(__file__).parents[3] / "shared/scenes/smoke/smoke.vdb"
    if not file.exists():
        pytest.skip("the collection of shared files is not there")
    volume = bpy.data.volumes.new("smoke")
    volume.filepath = str(file)
    made = add(scene, "smoke", volume)
    made.data.materials.append(material("VolumePrincipled", "Volume", color=(0.8, 0.6, 0.4), density=1.5))
    sky(scene, (1, 1, 1))
    bpy.context.view_layer.update()
    corners = np.array(made.evaluated_get(bpy.context.evaluated_depsgraph_get()).bound_box)
    middle, size = corners.mean(axis=0), float(np.ptp(corners, axis=0).max())
    made.scale = (2 / size,) * 3
    made.location = -middle * 2 / size
    camera(scene, (1, -4, 1), (0, 0, 0))
    check(scene, tmp_path, 1500)


def mean_under_a_white_sky(scene, made):
    """Of both, of a large plane seen from above."""
    sky(scene, (1, 1, 1))
    mesh(scene, "plane", made, size=40)
    camera(scene, (0, 0, 5), (0, 0.01, 0))
    return wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image.mean()


def two(kind, first, second, factor=0.5):
    """A material that mixes or adds two."""
    made = bpy.data.materials.new(kind)
    tree = made.node_tree
    tree.nodes.clear()
    both = node(tree, kind) if kind == "AddShader" else node(tree, kind, factor=factor)
    sockets = both.inputs[-2:]
    for (name, inputs), socket in zip((first, second), sockets):
        link(tree, node(tree, name, **inputs), socket)
    link(tree, both, tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


GREY = ("BsdfDiffuse", {"color": (0.8, 0.8, 0.8)})
LIGHT = ("Emission", {"color": (1, 1, 1), "strength": 1.0})


def test_a_mixture_with_light_reflects_its_share_alone(scene):
    assert mean_under_a_white_sky(scene, two("MixShader", LIGHT, GREY)) == pytest.approx(0.5 + 0.4, abs=0.01)


def test_a_sum_with_light_reflects_all(scene):
    assert mean_under_a_white_sky(scene, two("AddShader", LIGHT, GREY)) == pytest.approx(1.8, abs=0.01)


def test_a_sum_of_both_sides_is_one_material(scene):
    through = ("BsdfTranslucent", {"color": (0.1, 0.1, 0.1)})
    assert mean_under_a_white_sky(scene, two("AddShader", GREY, through)) == pytest.approx(0.9, abs=0.01)


def test_groups_within_groups(scene):
    inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
    inner.interface.new_socket("Colour", in_out="INPUT", socket_type="NodeSocketColor")
    inner.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    matt = inner.nodes.new("ShaderNodeBsdfDiffuse")
    inner.links.new(inner.nodes.new("NodeGroupInput").outputs[0], matt.inputs["Color"])
    inner.links.new(matt.outputs[0], inner.nodes.new("NodeGroupOutput").inputs[0])
    outer = bpy.data.node_groups.new("outer", "ShaderNodeTree")
    outer.interface.new_socket("Amount", in_out="INPUT", socket_type="NodeSocketFloat")
    outer.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    used = outer.nodes.new("ShaderNodeGroup")
    used.node_tree = inner
    used.inputs[0].default_value = (0.6, 0.6, 0.6, 1)
    mix = outer.nodes.new("ShaderNodeMixShader")
    outer.links.new(outer.nodes.new("NodeGroupInput").outputs[0], mix.inputs[0])
    outer.links.new(used.outputs[0], mix.inputs[1])
    outer.links.new(outer.nodes.new("ShaderNodeEmission").outputs[0], mix.inputs[2])
    outer.links.new(mix.outputs[0], outer.nodes.new("NodeGroupOutput").inputs[0])
    made = bpy.data.materials.new("grouped")
    tree = made.node_tree
    tree.nodes.clear()
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = outer
    group.inputs[0].default_value = 0.25
    link(tree, group, tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    assert mean_under_a_white_sky(scene, made) == pytest.approx(0.75 * 0.6 + 0.25, abs=0.01)


def test_instances_of_a_collection(scene, tmp_path):
    sky(scene, (0.8, 0.8, 0.8))
    floor(scene)
    collection = bpy.data.collections.new("trees")
    tree = mesh(scene, "cone", material("BsdfDiffuse", color=(0.1, 0.5, 0.1)), place=(0, 0, 0.5), radius1=0.3, depth=1)
    scene.collection.objects.unlink(tree)
    collection.objects.link(tree)
    for i in range(6):
        empty = add(scene, f"copy {i}", None, (math.cos(i), math.sin(i), 0), (0, 0, i), (1, 1, 1 + 0.1 * i))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
    builder = blend.of_scene(scene)
    assert builder.text().count("ObjectInstance") == 6
    assert builder.text().count('Shape "trianglemesh"') == 2
    check(scene, tmp_path, 400)


def test_modifiers_are_those_of_renders(scene, tmp_path):
    """Levels and objects that views do not show."""
    sky(scene, (1, 1, 1))
    cube = mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(-1, 0, 0.5))
    cube.modifiers.new("round", "SUBSURF").levels = 0
    cube.modifiers["round"].render_levels = 3
    twin = mesh(scene, "cube", material("BsdfDiffuse", color=(0.8, 0.3, 0.1)), place=(1.5, 0, 0.5))
    twin.hide_viewport = True
    mesh(scene, "cube", place=(0, -2, 1)).hide_render = True
    check(scene, tmp_path, 128)
    assert cube.modifiers["round"].levels == 0 and twin.hide_viewport


def test_picture_on_a_floor(scene, tmp_path):
    sky(scene, (1, 1, 1))
    image = bpy.data.images.new("checks", 64, 64)
    pixels = np.ones((64, 64, 4), dtype=np.float32)
    pixels[:32, :32, 0] = 51 / 255
    pixels[32:, 32:, 1] = 153 / 255
    pixels[:32, 32:, 2] = 102 / 255
    image.pixels.foreach_set(pixels.ravel())
    made = material("BsdfDiffuse")
    tree = made.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    mapping = node(tree, "Mapping", scale=(2, 3, 1), location=(0.1, 0.3, 0))
    link(tree, node(tree, "UVMap"), mapping.inputs[0])
    link(tree, mapping, texture.inputs["Vector"])
    link(tree, texture, next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse").inputs["Color"])
    mesh(scene, "plane", made, size=6)
    # Between the pixels of a picture of 8 bits.
    check(scene, tmp_path, 256, tolerance=0.015)


def test_a_sky_with_directions(scene, tmp_path):
    tree = scene.world.node_tree
    coordinates, ramp = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeVectorMath")
    ramp.operation = "MULTIPLY_ADD"
    ramp.inputs[1].default_value, ramp.inputs[2].default_value = (0.4, 0.4, 0.4), (0.5, 0.5, 0.5)
    tree.links.new(coordinates.outputs["Generated"], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], tree.nodes["Background"].inputs["Color"])
    floor(scene, (0.5, 0.5, 0.5))
    camera(scene, (3, -6, 1), (0, 0, 1.5))
    check(scene, tmp_path, 128, cycles_spp=256)


def test_a_blackbody_has_the_colour_that_cycles_gives_it(scene, tmp_path):
    made = material("Emission", strength=2.0)
    tree = made.node_tree
    emission = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission")
    link(tree, node(tree, "Blackbody", temperature=3200.0), emission.inputs["Color"])
    mesh(scene, "plane", made, size=20)
    camera(scene, (0, 0, 5), (0, 0.01, 0))
    # Both are fits.
    check(scene, tmp_path, 4, tolerance=0.03)


def test_frames(scene, tmp_path):
    ball = mesh(scene, "uv_sphere", material("Emission", strength=2))
    for frame, x in ((1, -1.5), (3, 1.5)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    file = tmp_path / "moving.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    assert blend.main([str(file), "--render", str(tmp_path / "out.####.exr"), "--frames", "1-3", "--spp", "16"]) == 0
    places = []
    for frame in (1, 2, 3):
        image = wend.read(tmp_path / f"out.{frame:04}.exr").image[..., 0]
        places.append(float((image.sum(axis=0) * np.arange(SIZE)).sum() / image.sum()))
    assert places[0] < SIZE / 2 - 4 and abs(places[1] - SIZE / 2) < 1 and places[2] > SIZE / 2 + 4


def test_a_file_becomes_a_pbrt_scene(scene, tmp_path):
    floor(scene)
    lamp(scene, "POINT", 100, (0, 0, 3))
    file = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    environment = os.environ | {"PYTHONPATH": os.path.dirname(os.path.dirname(wend.__file__))}
    output = tmp_path / "scene.pbrt"
    subprocess.run([sys.executable, "-m", "wend.blend", str(file), "-o", str(output), "--resolution", "48x32"], check=True, env=environment)
    loaded = wend.load(output)
    assert loaded.resolution == (48, 32)


def test_what_is_missing_is_named_once(scene):
    made = material("BsdfPrincipled", thin_film_thickness=500)
    mesh(scene, "cube", made)
    mesh(scene, "cube", made)
    lamp(scene, "POINT", 1, (0, 0, 3))
    with pytest.warns(wend.SceneWarning) as told:
        blend.of_scene(scene)
    assert sum("Thin Film Thickness is left out" in str(w.message) and made.name in str(w.message) for w in told) == 1


@pytest.mark.parametrize(
    ("role", "value", "text"),
    [
        ("is_shadow_catcher", True, "shadow catcher"),
        ("visible_volume_scatter", False, "rays of volume scatter"),
    ],
)
def test_roles_that_are_not_there_are_named(scene, role, value, text):
    floor(scene)
    sky(scene, (1, 1, 1))
    setattr(mesh(scene, "cube"), role, value)
    with pytest.warns(wend.SceneWarning, match=f"object 'Cube': warning: .*{text}"):
        blend.of_scene(scene)


def test_the_command_tells_what_a_scene_costs_and_writes_holes(scene, tmp_path, capsys):
    floor(scene).is_holdout = True
    lamp(scene, "POINT", 100, (0, 0, 3))
    file, picture = tmp_path / "scene.blend", tmp_path / "out.exr"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    assert blend.main([str(file), "--render", str(picture), "--spp", "4", "--alpha"]) == 0
    assert f"{file}: " in (told := capsys.readouterr().err) and "made into a scene in" in told
    assert wend.read(picture)["alpha"].max() == 0


def test_hair_objects(scene):
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves([3, 2])
    for i, point in enumerate(curves.points):
        point.position, point.radius = (i, 2 * i, 0), 0.1 * (i + 1)
    add(scene, "hair", curves)
    sky(scene, (1, 1, 1))
    shapes = [dict(d[3]) for d in blend.of_scene(scene)._directives if d[:2] == ("Shape", ["curve"])]
    ends = [tuple(shape["point3 P"][[0, 9]]) for shape in shapes]
    assert ends == [(0, 1), (1, 2), (3, 4)]
    widths = [(shape["float width0"][0], shape["float width1"][0]) for shape in shapes]
    assert np.allclose(widths, [(0.2, 0.4), (0.4, 0.6), (0.8, 1.0)])


def test_errors(tmp_path, capsys, scene):
    broken = tmp_path / "broken.blend"
    broken.write_bytes(b"BLENDER-v300" + bytes(100))
    for arguments, text in (
        ([str(tmp_path / "no.blend"), "--render", "x.exr"], "no such file"),
        ([str(broken), "--render", "x.exr"], "broken.blend: error"),
        ([str(broken), "--render", "x.exr", "--resolution", "3"], "WIDTHxHEIGHT"),
        ([str(broken), "--render", "x.exr", "--frames", "1-4"], "####"),
        ([str(broken), "--render", "x.exr", "--frames", "b"], "expected A-B"),
    ):
        assert blend.main(arguments) == 2
        assert text in capsys.readouterr().err
    scene.camera = None
    with pytest.raises(wend.InputError, match="no camera"):
        blend.of_scene(scene)


def test_a_volume_glows_as_a_black_body(scene, tmp_path):
    fire = material("VolumePrincipled", "Volume", density=0.5, blackbody_intensity=1.0, temperature=3200.0, blackbody_tint=(1, 0.8, 0.9))
    # Its edges leave no block a sliver, whose noise would be as large as the tolerance.
    mesh(scene, "cube", fire, place=(0, 0, 0.8), stretch=(0.9, 0.9, 0.9))
    # The colours of black bodies are fits.
    check(scene, tmp_path, 400, tolerance=0.03)
