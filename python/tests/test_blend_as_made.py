"""Scenes of Blender as artists make them: groups, muted nodes, opacities, worlds and instances, against Cycles."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
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
    takes,
    told,
)

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def squares(tmp_path, name="map", opacity=False, side=256):
    """A picture of eight by eight random squares, read from a file."""
    values = np.random.default_rng(3).random((8, 8, 4)).astype(np.float32) * 0.8 + 0.1
    pixels = np.kron(values, np.ones((side // 8, side // 8, 1), dtype=np.float32))
    if not opacity:
        pixels[..., 3] = 1
    made = bpy.data.images.new(name, side, side, alpha=opacity)
    made.pixels.foreach_set(pixels.ravel())
    made.filepath_raw, made.file_format = str(tmp_path / f"{name}.png"), "PNG"
    made.save()
    return bpy.data.images.load(made.filepath_raw)


def picture(image, output="Color", **settings):
    """Links a picture to an input."""

    def wire(tree, socket):
        made = node(tree, "TexImage", **settings)
        made.image = image
        link(tree, made, socket, output)

    return wire


# ---- Groups and muted nodes ----


def product():
    """A group that multiplies two numbers."""
    group = bpy.data.node_groups.new("product", "ShaderNodeTree")
    for name in ("a", "b"):
        group.interface.new_socket(name, in_out="INPUT", socket_type="NodeSocketFloat")
    group.interface.new_socket("result", in_out="OUTPUT", socket_type="NodeSocketFloat")
    begin, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    made = node(group, "Math", operation="MULTIPLY")
    for i in range(2):
        group.links.new(begin.outputs[i], made.inputs[i])
    group.links.new(made.outputs[0], end.inputs[0])
    return group


def test_one_group_may_follow_itself(scene, tmp_path):
    """Its inputs are those of where it is."""

    def wire(tree, socket):
        group = product()
        first, second = (tree.nodes.new("ShaderNodeGroup") for _ in range(2))
        first.node_tree = second.node_tree = group
        first.inputs[0].default_value, first.inputs[1].default_value = 0.9, 0.8
        tree.links.new(first.outputs[0], second.inputs[0])
        second.inputs[1].default_value = 0.3
        tree.links.new(second.outputs[0], socket)

    sky(scene, (1, 1, 1))
    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire), place=(0, 0, 0.5))
    check(scene, tmp_path, 64)


def test_one_group_may_vary_once(scene, tmp_path):
    """What one of them takes lies by the object, and what the other does by UV."""

    def wire(tree, socket):
        group = product()
        first, second = (tree.nodes.new("ShaderNodeGroup") for _ in range(2))
        first.node_tree = second.node_tree = group
        mixed = node(tree, "Mix", data_type="FLOAT")
        link(tree, node(tree, "TexChecker", scale=3.0), first.inputs[0], 1)
        first.inputs[1].default_value = 0.9
        second.inputs[0].default_value, second.inputs[1].default_value = 0.5, 0.5
        tree.links.new(second.outputs[0], mixed.inputs[2])
        tree.links.new(first.outputs[0], mixed.inputs[3])
        tree.links.new(mixed.outputs[0], socket)

    sky(scene, (1, 1, 1))
    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire), place=(0, 0, 0.5), turn=(0, 0, 0.4))
    check(scene, tmp_path, 128, bake_resolution=512)


def test_what_has_no_surface_is_black(scene, tmp_path):
    sky(scene, (1, 1, 1))
    muted = material("BsdfDiffuse", color=(0.8, 0.2, 0.1))
    next(n for n in muted.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse").mute = True
    without_output = material("BsdfDiffuse")
    without_output.node_tree.nodes.clear()
    for x, made in ((-1.5, material()), (0, muted), (1.5, without_output)):
        mesh(scene, "cube", made, place=(x, 0, 0.5))
    check(scene, tmp_path, 128, tolerance=0.015)


def test_a_sum_with_nothing_is_the_other(scene, tmp_path):
    sky(scene, (1, 1, 1))
    made = material()
    tree = made.node_tree
    total = node(tree, "AddShader")
    link(tree, total, tree.nodes[0].inputs["Surface"])
    link(tree, node(tree, "BsdfDiffuse", color=(0.8, 0.2, 0.1)), total.inputs[0])
    muted = node(tree, "Emission", color=(0.1, 0.2, 0.8))
    muted.mute = True
    link(tree, muted, total.inputs[1])
    mesh(scene, "cube", made, place=(0, 0, 0.5))
    check(scene, tmp_path, 64)


def mixed_with_nothing(tree, kind=None, muted=False):
    """0.4 of nothing, and the rest of it or a node of that kind."""
    mixed = node(tree, "MixShader")
    mixed.inputs[0].default_value = 0.4
    if kind is not None:
        link(tree, node(tree, kind), mixed.inputs[1])
    if muted:
        other = node(tree, "BsdfDiffuse")
        other.mute = True
        link(tree, other, mixed.inputs[2])
    return mixed


NOTHING = {
    "sum": lambda tree: node(tree, "AddShader"),
    "mixture": mixed_with_nothing,
    "dark": lambda tree: node(tree, "Emission", strength=0.0),
}


def made_by(makes):
    made = material()
    tree = made.node_tree
    link(tree, makes(tree), tree.nodes[0].inputs["Surface"])
    return made


@pytest.mark.parametrize("inside", [False, True])
@pytest.mark.parametrize("kind", NOTHING)
def test_nothing_is_black_around_no_volume(scene, tmp_path, kind, inside):
    sky(scene, (1, 1, 1))
    made = made_by(NOTHING[kind])
    if inside:
        link(made.node_tree, node(made.node_tree, "VolumeAbsorption", color=(0.8, 0.2, 0.1)), made.node_tree.nodes[0].inputs["Volume"])
    mesh(scene, "cube", made, place=(0, 0, 0.5))
    check(scene, tmp_path, 256)


@pytest.mark.parametrize("muted", [False, True])
@pytest.mark.parametrize("kind", ["BsdfTransparent", "BsdfDiffuse"])
def test_a_share_of_nothing_is_black(scene, tmp_path, kind, muted):
    sky(scene, (1, 1, 1))
    mesh(scene, "plane", made_by(lambda tree: mixed_with_nothing(tree, kind, muted)), size=4)
    check(scene, tmp_path, 512, tolerance=0.02)


@pytest.mark.parametrize("kind", ["VolumeAbsorption", "VolumeScatter"])
def test_a_share_lets_light_into_a_volume(scene, tmp_path, kind):
    """In 4 x 4 blocks within 1 %; one that is passed as if no volume were there shows it 30 % darker."""
    sky(scene, (0.3, 0.4, 0.5))
    lamp(scene, "AREA", 200, (3, -2, 4), (0.6, 0.5, 0), size=1.0)
    floor(scene)
    made = takes("MixShader", 2, lambda tree, socket: link(tree, node(tree, "BsdfDiffuse", color=(0.8, 0.3, 0.2)), socket), factor=0.5)
    tree = made.node_tree
    link(tree, node(tree, "BsdfTransparent"), next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader").inputs[1])
    link(tree, node(tree, kind, color=(0.5, 0.7, 0.9), density=0.8), tree.nodes[0].inputs["Volume"])
    mesh(scene, "cube", made, place=(0, 0, 1.05))
    check(scene, tmp_path, 1024)


def test_an_output_for_cycles_comes_before_one_for_all(scene, tmp_path):
    sky(scene, (1, 1, 1))
    made = material("BsdfDiffuse", color=(0.8, 0.2, 0.1))
    tree = made.node_tree
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    end.target, end.is_active_output = "CYCLES", False
    link(tree, node(tree, "BsdfDiffuse", color=(0.1, 0.8, 0.1)), end.inputs["Surface"])
    mesh(scene, "cube", made, place=(0, 0, 0.5))
    check(scene, tmp_path, 64)


# ---- Pictures ----


@pytest.mark.parametrize("kind", ["POINT", "TEXTURE", "VECTOR", "NORMAL"])
def test_mappings_of_each_kind(scene, tmp_path, kind):
    image = squares(tmp_path)

    def wire(tree, socket):
        made, mapping = node(tree, "TexImage"), node(tree, "Mapping")
        made.image = image
        mapping.inputs["Scale"].default_value, mapping.inputs["Rotation"].default_value = (2, 1.5, 1), (0, 0, 0.4)
        mapping.vector_type = kind
        link(tree, node(tree, "TexCoord"), mapping.inputs["Vector"], "UV")
        link(tree, mapping, made.inputs["Vector"])
        link(tree, made, socket)

    sky(scene, (1, 1, 1))
    mesh(scene, "plane", takes("BsdfDiffuse", "Color", wire), size=4)
    check(scene, tmp_path, 128, tolerance=0.015, bake_resolution=1024)


def test_a_mapping_of_the_node_itself(scene, tmp_path):
    image = squares(tmp_path)

    def wire(tree, socket):
        made = node(tree, "TexImage")
        made.image = image
        made.texture_mapping.scale, made.texture_mapping.translation = (2, 3, 1), (0.1, 0.2, 0)
        link(tree, made, socket)

    sky(scene, (1, 1, 1))
    mesh(scene, "plane", takes("BsdfDiffuse", "Color", wire), size=4)
    check(scene, tmp_path, 128, tolerance=0.015, bake_resolution=1024)


def test_pixels_that_are_not_interpolated(scene, tmp_path):
    sky(scene, (1, 1, 1))
    wire = picture(squares(tmp_path, side=8), interpolation="Closest")
    mesh(scene, "plane", takes("BsdfDiffuse", "Color", wire), size=4)
    check(scene, tmp_path, 128)


@pytest.mark.parametrize("mode", ["STRAIGHT", "CHANNEL_PACKED", "NONE"])
@pytest.mark.parametrize("used", ["colour", "opacity", "both"])
def test_opacities_of_pictures(scene, tmp_path, mode, used):
    """Colours are multiplied by an opacity that nobody asks for."""
    image = squares(tmp_path, opacity=True)
    image.alpha_mode = mode
    made = material("BsdfPrincipled", roughness=1.0, base_color=(0.2, 0.3, 0.4))
    tree = made.node_tree
    texture, surface = node(tree, "TexImage"), tree.nodes["Principled BSDF"]
    texture.image = image
    if used != "opacity":
        link(tree, texture, surface.inputs["Base Color"])
    if used != "colour":
        link(tree, texture, surface.inputs["Alpha"], "Alpha")
    sky(scene, (1, 1, 1))
    mesh(scene, "plane", made, size=4)
    check(scene, tmp_path, 128, tolerance=0.015, bake_resolution=1024)


def test_opaque_pictures_with_an_opacity_are_not_baked(scene, tmp_path):
    image = squares(tmp_path, opacity=True)
    pixels = np.ones(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_set(pixels)
    image.save()
    mesh(scene, "plane", takes("BsdfDiffuse", "Color", picture(image)), size=4)
    assert image.depth == 32 and "map.png" in blend.of_scene(scene).text()


@pytest.mark.parametrize("projection", ["FLAT", "BOX"])
def test_pictures_are_looked_through_once_and_only_where_that_matters(scene, tmp_path, monkeypatch, projection):
    from wend import _blend_pictures

    image, looked = squares(tmp_path, opacity=True), []
    decides = _blend_pictures._is_opaque
    monkeypatch.setattr(_blend_pictures, "_is_opaque", lambda image: looked.append(image) or decides(image))
    for _ in range(3):
        made = takes("BsdfDiffuse", "Color", picture(image, projection=projection))
        mesh(scene, "plane", made, size=4)
    blend.of_scene(scene)
    assert len(looked) == (projection == "FLAT")


def test_a_colour_as_a_number_is_its_luminance(scene, tmp_path):
    image = bpy.data.images.new("flat", 8, 8)
    image.pixels.foreach_set(np.tile(np.array([0.1, 0.9, 0.2, 1], dtype=np.float32), 64))
    image.filepath_raw, image.file_format = str(tmp_path / "flat.png"), "PNG"
    image.save()
    sky(scene, (1, 1, 1))
    surface = {"roughness": 1.0, "base_color": (0.8, 0.3, 0.1)}
    wire = picture(bpy.data.images.load(image.filepath_raw))
    made = takes("BsdfPrincipled", "Alpha", wire, **surface)
    mesh(scene, "plane", made, size=4)
    check(scene, tmp_path, 256, tolerance=0.015)


# ---- Light ----


def test_what_shines_and_is_transparent(scene, tmp_path):
    """The camera sees the share that is there, and so does the floor."""
    sky(scene, (0.1, 0.1, 0.1))
    floor(scene)
    made = material()
    tree = made.node_tree
    mixed = node(tree, "MixShader")
    mixed.inputs[0].default_value = 0.4
    link(tree, node(tree, "BsdfTransparent"), mixed.inputs[1])
    link(tree, node(tree, "Emission", color=(1, 0.6, 0.3), strength=3.0), mixed.inputs[2])
    link(tree, mixed, tree.nodes[0].inputs["Surface"])
    mesh(scene, "plane", made, place=(0, 0, 1), size=1.5)
    check(scene, tmp_path, 256, tolerance=0.015)


def test_what_shines_through_a_mask(scene, tmp_path):
    sky(scene, (0.1, 0.1, 0.1))
    floor(scene)
    made = material()
    tree = made.node_tree
    mixed = node(tree, "MixShader")
    picture(squares(tmp_path))(tree, mixed.inputs[0])
    link(tree, node(tree, "BsdfTransparent"), mixed.inputs[1])
    link(tree, node(tree, "Emission", color=(1, 0.6, 0.3), strength=3.0), mixed.inputs[2])
    link(tree, mixed, tree.nodes[0].inputs["Surface"])
    mesh(scene, "plane", made, place=(0, 0, 1), size=1.5)
    check(scene, tmp_path, 256, tolerance=0.015)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("caustics_reflective", "caustics of reflections, which are switched off, are there"),
        ("caustics_refractive", "caustics of refractions, which are switched off, are there"),
        ("use_fast_gi", "the fast approximation of global illumination is left out: all of it is there"),
    ],
)
def test_light_that_is_switched_off_is_named(scene, name, words):
    floor(scene)
    setattr(scene.cycles, name, not getattr(scene.cycles, name))
    assert f"scene 'Scene': warning: {words}" in told(scene)


def test_shadows_that_are_not_transparent_are_named(scene):
    made = material("BsdfPrincipled", alpha=0.3)
    made.use_transparent_shadow = False
    mesh(scene, "plane", made)
    assert "transparent shadows that are switched off are there" in told(scene)


# ---- What is there ----


def at_frame(scene, tmp_path, frame):
    scene.frame_set(1)
    ours = blend.of_scene(scene, frame=frame, spp=64).scene()
    scene.frame_set(frame)
    agree(blocks(wend.render(ours, sampling="classical").image), blocks(by_cycles(scene, tmp_path, 64)))


def test_markers_change_the_camera(scene, tmp_path):
    sky(scene, (1, 1, 1))
    mesh(scene, "cube", material("BsdfDiffuse", color=(0.5, 0.3, 0.1)), place=(0, 0, 0.5))
    above = add(scene, "above", bpy.data.cameras.new("above"), (0, 0, 6))
    for name, frame, eye in (("a", 1, scene.camera), ("b", 10, above)):
        scene.timeline_markers.new(name, frame=frame).camera = eye
    at_frame(scene, tmp_path, 12)


@pytest.mark.parametrize("is_hidden", [False, True])
def test_what_appears_in_time_is_there(scene, tmp_path, is_hidden):
    sky(scene, (1, 1, 1))
    made = mesh(scene, "cube", material("BsdfDiffuse", color=(0.5, 0.3, 0.1)), place=(0, 0, 0.5))
    for frame, value in ((1, not is_hidden), (10, is_hidden)):
        made.hide_render = value
        made.keyframe_insert("hide_render", frame=frame)
    at_frame(scene, tmp_path, 12)


@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
@pytest.mark.parametrize("is_shown", [False, True])
def test_instances_at_points_and_faces(scene, tmp_path, kind, is_shown):
    """What is copied is not where it is itself; whether the instancer is there is a setting of renders."""
    sky(scene, (1, 1, 1))
    instancer = mesh(scene, "plane", material("BsdfDiffuse", color=(0.2, 0.8, 0.1)), size=2)
    copied = mesh(scene, "cube", material("BsdfDiffuse", color=(0.8, 0.2, 0.1)), size=0.4)
    copied.location = (0, 0, 0.5)
    copied.parent = instancer
    instancer.instance_type = kind
    instancer.show_instancer_for_render, instancer.show_instancer_for_viewport = is_shown, not is_shown
    check(scene, tmp_path, 64)


def cube(scene):
    sky(scene, (1, 1, 1))
    return mesh(scene, "cube", material("BsdfDiffuse", color=(0.8, 0.2, 0.1)), place=(0, 0, 0.5))


def test_what_is_hidden_by_the_eye_is_rendered(scene, tmp_path):
    made = cube(scene)
    made.hide_set(True)
    check(scene, tmp_path, 64)
    assert made.hide_get()


@pytest.mark.parametrize("is_in_another", [False, True])
def test_what_is_in_a_collection_hidden_by_the_eye_is_rendered(scene, tmp_path, is_in_another):
    made = cube(scene)
    outer, inner = (bpy.data.collections.new(name) for name in ("outer", "inner"))
    scene.collection.children.link(outer)
    outer.children.link(inner)
    scene.collection.objects.unlink(made)
    inner.objects.link(made)
    hidden = scene.view_layers[0].layer_collection.children["outer"]
    hidden = hidden if is_in_another else hidden.children["inner"]
    hidden.hide_viewport = True
    assert check(scene, tmp_path, 64).min() < 0.5
    assert hidden.hide_viewport


@pytest.mark.parametrize("change", ["hide_render", "hide_viewport", "levels", "shown"])
def test_what_is_in_an_instanced_collection_alone_is_as_in_renders(scene, tmp_path, change):
    made = cube(scene)
    other = mesh(scene, "plane", material("BsdfDiffuse", color=(0.1, 0.2, 0.8)))
    if change in ("hide_render", "hide_viewport"):
        setattr(made, change, True)
    elif change == "levels":
        modifier = made.modifiers.new("smooth", "SUBSURF")
        modifier.levels, modifier.render_levels = 0, 3
    else:
        modifier = made.modifiers.new("row", "ARRAY")
        modifier.show_viewport, modifier.count = False, 2
    asset = bpy.data.collections.new("asset")
    for object_ in (made, other):
        scene.collection.objects.unlink(object_)
        asset.objects.link(object_)
    empty = add(scene, "empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", asset
    check(scene, tmp_path, 64)
    assert made.hide_viewport == (change == "hide_viewport")
