"""What tests of Blender's scenes share: scenes in a few lines, and pictures against Cycles'."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from cycles_reference import reference  # noqa: E402

from wend import blend  # noqa: E402

#: In each direction; a block has 64 pixels.
BLOCKS = 4
SIZE = 32


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    sky(scene, (0, 0, 0))
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = SIZE, SIZE, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.pixel_filter_type = "BOX"
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_light_tree = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    for kind in ("max", "diffuse", "glossy", "transmission", "volume", "transparent_max"):
        setattr(cycles, f"{kind}_bounces", 128)
    camera(scene, (0, -6, 3), (0, 0, 0.5))
    return scene


def sky(scene, colour, strength=1.0):
    background = scene.world.node_tree.nodes["Background"]
    background.inputs[0].default_value = (*colour, 1)
    background.inputs[1].default_value = strength


def add(scene, name, data, place=(0, 0, 0), turn=(0, 0, 0), size=(1, 1, 1)):
    made = bpy.data.objects.new(name, data)
    scene.collection.objects.link(made)
    made.location, made.rotation_euler, made.scale = place, turn, size
    return made


def camera(scene, eye, target, **settings):
    if scene.camera is None:
        scene.camera = add(scene, "camera", bpy.data.cameras.new("camera"))
    from mathutils import Vector

    scene.camera.location = eye
    scene.camera.rotation_euler = (Vector(target) - Vector(eye)).to_track_quat("-Z", "Y").to_euler()
    for name, value in settings.items():
        setattr(scene.camera.data, name, value)


def mesh(scene, primitive, material=None, smooth=False, place=(0, 0, 0), turn=(0, 0, 0), stretch=(1, 1, 1), **arguments):
    getattr(bpy.ops.mesh, f"primitive_{primitive}_add")(location=place, rotation=turn, **arguments)
    made = bpy.context.object
    made.scale = stretch
    if smooth:
        made.data.shade_smooth()
    if material is not None:
        made.data.materials.append(material)
    return made


def lamp(scene, kind, power, place, turn=(0, 0, 0), stretch=(1, 1, 1), **settings):
    data = bpy.data.lights.new(kind, kind)
    data.energy = power
    for name, value in settings.items():
        setattr(data, name, value)
    return add(scene, kind, data, place, turn, stretch)


def material(kind=None, output="Surface", **inputs):
    """Of one shader node, with these values of its inputs."""
    made = bpy.data.materials.new(kind or "material")
    tree = made.node_tree
    tree.nodes.clear()
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    if kind is not None:
        link(tree, node(tree, kind, **inputs), end.inputs[output])
    return made


def node(tree, kind, **inputs):
    made = tree.nodes.new(f"ShaderNode{kind}")
    for name, value in inputs.items():
        set_input(made, name, value)
    return made


def set_input(node_, name, value):
    label = name.replace("_", " ")
    found = next((i for i in node_.inputs if i.name.lower() == label.lower()), None)
    if found is None:
        setattr(node_, name, value)
    elif found.type == "RGBA":
        found.default_value = (*value, 1)
    else:
        found.default_value = value


def link(tree, made, socket, output=0):
    """`output`: its number or name."""
    tree.links.new(made.outputs[output], socket)


def takes(kind, socket, wire, **inputs):
    """A material of one shader node, of which `wire` links an input: it is given the tree and the input."""
    made = material(kind, **inputs)
    shader = next(n for n in made.node_tree.nodes if n.bl_idname == f"ShaderNode{kind}")
    wire(made.node_tree, shader.inputs[socket])
    return made


def floor(scene, reflectance=(0.6, 0.4, 0.2)):
    return mesh(scene, "plane", material("BsdfDiffuse", color=reflectance), size=20)


def by_cycles(scene, tmp_path, spp, seed=0):
    scene.cycles.samples, scene.cycles.seed = spp, seed
    scene.render.filepath = str(tmp_path / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    scene.cycles.seed = 0  # which is ours, too
    return wend.read(scene.render.filepath).image


def blocks(picture):
    side = picture.shape[0] // BLOCKS
    return picture.reshape(BLOCKS, side, BLOCKS, side, 3).mean(axis=(1, 3))


def agree(ours, theirs, tolerance=0.01):
    """Means of blocks."""
    error = np.abs(ours - theirs) / np.maximum(theirs, 0.05 * theirs.mean())
    assert error.max() <= tolerance, f"\n{np.round(ours / np.maximum(theirs, 1e-6), 3)}"


def check(scene, tmp_path, spp=256, tolerance=0.01, sampling="classical", cycles_spp=None, keeps=True, **options):
    """The picture, after every block was found to agree. `options` are those of `of_scene`. `keeps`: whether the
    scene is the same each time, so that Cycles' picture may be kept."""

    def render(seed):
        return blocks(by_cycles(scene, tmp_path, cycles_spp or spp, seed))

    # Where Cycles is quick it renders each time.
    theirs = reference(render) if keeps and (cycles_spp or spp) >= 600 else render(0)
    ours = wend.render(blend.of_scene(scene, spp=spp, **options).scene(), sampling=sampling).image
    agree(blocks(ours), theirs, tolerance)
    return ours


def told(scene, **options):
    with pytest.warns(wend.SceneWarning) as found:
        blend.of_scene(scene, **options)
    return " ".join(str(w.message) for w in found if w.category is wend.SceneWarning)


def straight(moving):
    """Moves it along x from frame 1 to 3, without the ease that Blender gives to keys."""
    start = moving.location.x
    for frame, x in ((1, -1.5), (3, 1.5)):
        moving.location.x = start + x
        moving.keyframe_insert("location", frame=frame)
    for curve in moving.animation_data.action.layers[0].strips[0].channelbags[0].fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
