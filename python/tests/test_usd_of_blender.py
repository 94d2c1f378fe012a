"""Stages that Blender exports: the picture is that of the scene itself, as far as the exporter writes it."""

import math
import pathlib

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
# Blender has a USD of its own.
bpy.utils.expose_bundled_modules()
pytest.importorskip("pxr", reason="this Blender has no USD")

import wend.usd  # noqa: E402
from wend import blend  # noqa: E402

from blender_scene import SIZE, add, blocks, by_cycles, camera, lamp, link, material, mesh, node, scene, sky  # noqa: E402, F401

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")

Y_IS_UP = {"convert_orientation": True, "export_global_forward_selection": "NEGATIVE_Z", "export_global_up_selection": "Y"}


def plastic(**inputs):
    return material("BsdfPrincipled", **{"base_color": (0.6, 0.4, 0.2), "roughness": 0.5} | inputs)


def ground(scene):
    return mesh(scene, "plane", plastic(), size=20)


def ball(scene, made):
    return mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 0.5), radius=1.5, segments=32, ring_count=16)


def exported(scene, folder, **options):
    file = folder / "stage.usda"
    bpy.ops.wm.usd_export(filepath=str(file), **options)
    # A stage says nothing of filters: it has pbrt's.
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 1.5
    return file


def pictures(scene, file, spp, time=None):
    """Of Blender's scene, and of the stage."""
    size = (scene.render.resolution_x, scene.render.resolution_y)
    stage = wend.usd.read(file, resolution=size, spp=spp, time=time)
    return [wend.render(b.scene(), sampling="classical").image for b in (blend.of_scene(scene, spp=spp), stage)]


def check(scene, folder, spp=64, tolerance=0.01, **options):
    """Every block agrees, and there is something to see."""
    theirs, ours = map(blocks, pictures(scene, exported(scene, folder, **options), spp))
    assert theirs.mean() > 0.01
    error = np.abs(ours - theirs) / np.maximum(theirs, 0.05 * theirs.mean())
    assert error.max() <= tolerance, f"\n{np.round(ours / np.maximum(theirs, 1e-6), 3)}"


LAMPS = {
    "point": ("POINT", 200, (1, -1, 3), {"shadow_soft_size": 0.2}),
    "point without size": ("POINT", 200, (1, -1, 3), {"shadow_soft_size": 0}),
    "warm": ("POINT", 200, (1, -1, 3), {"shadow_soft_size": 0.2, "use_temperature": True, "temperature": 3000}),
    "coloured": ("POINT", 90, (1, -1, 3), {"shadow_soft_size": 0.2, "exposure": 1.5, "color": (1, 0.5, 0.2)}),
    "spot": ("SPOT", 600, (1, -1, 4), {"shadow_soft_size": 0, "spot_size": 0.9, "spot_blend": 0.4}),
    "soft spot": ("SPOT", 300, (1, -1, 4), {"shadow_soft_size": 0.3, "spot_size": 0.9, "spot_blend": 0.4}),
    "sun": ("SUN", 3, (0, 0, 5), {"angle": 0}),
    "wide sun": ("SUN", 3, (0, 0, 5), {"angle": 0.6}),
    "rectangle": ("AREA", 100, (1, -1, 4), {"shape": "RECTANGLE", "size": 1.0, "size_y": 0.4}),
    "square": ("AREA", 100, (1, -1, 4), {"shape": "SQUARE", "size": 0.7}),
    "disk": ("AREA", 100, (1, -1, 4), {"shape": "DISK", "size": 1.0}),
}


PLAIN, STRETCHED = (1, 1, 1), (2, 1, 3)


@pytest.mark.parametrize(
    ("name", "stretch"), [*((name, PLAIN) for name in LAMPS), *((name, STRETCHED) for name in ("point", "spot", "sun", "rectangle"))]
)
def test_lamps_have_their_strength(scene, tmp_path, name, stretch):
    kind, power, place, settings = LAMPS[name]
    ground(scene)
    lamp(scene, kind, power, place, (0.2, 0.1, 0.3), stretch, **settings)
    check(scene, tmp_path, 400 if name == "wide sun" else 64)


def environment(scene, folder, turn=None):
    u, v = (np.arange(64) + 0.5) / 64, (np.arange(32) + 0.5) / 32
    pixels = np.zeros((32, 64, 3), dtype=np.float32)
    pixels[..., 0] = 0.2 + 0.8 * np.cos(2 * np.pi * u) ** 2
    pixels[..., 1] = 1.1 - v[:, None]
    pixels[..., 2] = 0.3 + 0.3 * np.sin(2 * np.pi * u)
    wend.Film.of(pixels).save(folder / "sky.exr")
    tree = scene.world.node_tree
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(str(folder / "sky.exr"))
    tree.links.new(picture.outputs[0], tree.nodes["Background"].inputs[0])
    tree.nodes["Background"].inputs[1].default_value = 1.0
    if turn is not None:
        mapping = node(tree, "Mapping", rotation=turn)
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs[0])
        tree.links.new(mapping.outputs[0], picture.inputs[0])
    camera(scene, (3, -6, 1), (0, 0, 1.5))


CENTIMETRES = {"convert_scene_units": "CENTIMETERS"}


@pytest.mark.parametrize(
    ("turn", "options"),
    [(None, {}), ((0, 0, 1), {}), ((0.3, 0.2, 1), {}), (None, Y_IS_UP), ((0.3, 0.2, 1), Y_IS_UP | CENTIMETRES)],
    ids=["straight", "turned", "tilted", "y is up", "tilted, y is up"],
)
def test_skies_are_where_they_are(scene, tmp_path, turn, options):
    ground(scene)
    environment(scene, tmp_path, turn)
    # The two read the sky by pictures of their own, and have noise of their own.
    check(scene, tmp_path, 400, **options)


SHIFTED = {"lens": 35, "shift_x": 0.2, "shift_y": -0.1}
VERTICAL = {"sensor_fit": "VERTICAL", "sensor_height": 30, "lens": 40}
SQUARE, WIDE, HIGH = (SIZE, SIZE), (2 * SIZE, SIZE), (SIZE, 2 * SIZE)


@pytest.mark.parametrize(
    ("settings", "size", "options"),
    [
        *(({}, size, {}) for size in (SQUARE, WIDE, HIGH)),
        *((settings, size, {}) for settings in (SHIFTED, VERTICAL) for size in (WIDE, HIGH)),
        (SHIFTED, WIDE, Y_IS_UP),
        (SHIFTED, WIDE, CENTIMETRES),
    ],
)
def test_cameras_see_the_same(scene, tmp_path, settings, size, options):
    scene.render.resolution_x, scene.render.resolution_y = size
    glow = plastic(base_color=(0, 0, 0), specular_ior_level=0.0, emission_color=(1, 1, 1), emission_strength=1.0)
    mesh(scene, "cube", glow, place=(1, 0.5, 0.5), stretch=(0.5, 0.3, 0.6))
    camera(scene, (0, -6, 3), (0, 0, 0.5), **settings)
    theirs, ours = pictures(scene, exported(scene, tmp_path, **options), 64)
    # But for the noise of its edges.
    assert theirs.max() == pytest.approx(1, rel=1e-4) and theirs.mean() > 0.02
    assert np.abs(ours - theirs).mean() < 0.01 * theirs.mean()


def test_what_is_out_of_focus(scene, tmp_path):
    ground(scene)
    sky(scene, (0.8, 0.8, 0.8))
    mesh(scene, "cube", plastic(base_color=(0.8, 0.2, 0.2)), place=(0, -2, 0.5), stretch=(0.5, 0.5, 0.5))
    focus = scene.camera.data.dof
    focus.use_dof, focus.focus_distance, focus.aperture_fstop = True, 8, 0.2
    check(scene, tmp_path)


SURFACES = {
    "plastic": {"base_color": (0.8, 0.4, 0.1)},
    "metal": {"base_color": (0.9, 0.6, 0.3), "metallic": 1.0, "roughness": 0.4},
    "coated": {"metallic": 0.5, "roughness": 0.6, "coat_weight": 0.7, "coat_roughness": 0.3},
    "shining": {"emission_color": (1, 0.5, 0.2), "emission_strength": 3.0},
    "strong": {"specular_ior_level": 0.9},
}


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("network", [False, True], ids=["preview", "MaterialX"])
def test_surfaces_reflect_the_same(scene, tmp_path, name, network):
    ground(scene)
    sky(scene, (0.5, 0.7, 1))
    ball(scene, plastic(**SURFACES[name]))
    lamp(scene, "AREA", 400, (2, -3, 4), (0.8, 0.2, 0.3), size=1.5)
    check(scene, tmp_path, 256, generate_materialx_network=network)


@pytest.mark.parametrize("network", [False, True], ids=["preview", "MaterialX"])
def test_thin_surfaces_let_the_same_through(scene, tmp_path, network):
    sky(scene, (1, 1, 1))
    mesh(scene, "plane", plastic(base_color=(0, 0, 0), specular_ior_level=0.0, alpha=0.4), turn=(1, 0, 0), size=20)
    for image in pictures(scene, exported(scene, tmp_path, generate_materialx_network=network), 256):
        assert image.mean() == pytest.approx(0.6, rel=0.01)


def test_glass_is_only_in_materialx(scene, tmp_path):
    ground(scene)
    sky(scene, (0.5, 0.7, 1))
    ball(scene, plastic(base_color=(0.9, 0.6, 0.8), transmission_weight=1.0, roughness=0.2))
    check(scene, tmp_path, 400, generate_materialx_network=True)


def test_a_diffuse_surface_is_matt(scene, tmp_path):
    sky(scene, (0.5, 0.7, 1))
    mesh(scene, "plane", material("BsdfDiffuse", color=(0.6, 0.4, 0.2)), size=20)
    ball(scene, material("BsdfDiffuse", color=(0.2, 0.5, 0.8)))
    check(scene, tmp_path)


def picture(colours, folder, space="sRGB"):
    """Of four quarters."""
    image = bpy.data.images.new("quarters", 64, 64)
    pixels = np.ones((2, 32, 2, 32, 4), dtype=np.float32)
    pixels[..., :3] = np.array(colours, dtype=np.float32).reshape(2, 1, 2, 1, -1)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(folder / "quarters.png"), "PNG"
    image.save()
    image.colorspace_settings.name = space
    return image


def textured(image, sockets, **inputs):
    made = material("BsdfPrincipled", **inputs)
    tree = made.node_tree
    shader = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    for name in sockets:
        link(tree, texture, shader.inputs[name])
    return made, tree, texture


COLOURS = [(51, 255, 255), (255, 255, 255), (255, 255, 102), (51, 153, 255)]


@pytest.mark.parametrize("is_placed", [False, True], ids=["plain", "placed"])
def test_pictures_lie_where_they_are(scene, tmp_path, is_placed):
    sky(scene, (1, 1, 1))
    made, tree, texture = textured(picture(np.array(COLOURS) / 255, tmp_path), ["Base Color"], roughness=0.5)
    if is_placed:
        mapping = node(tree, "Mapping", scale=(2, 3, 1), location=(0.1, 0.3, 0))
        link(tree, node(tree, "UVMap"), mapping.inputs[0])
        link(tree, mapping, texture.inputs["Vector"])
    mesh(scene, "plane", made, size=6)
    check(scene, tmp_path)


def test_pictures_are_numbers(scene, tmp_path):
    """Grey ones: of others Blender takes the luminance, and writes that it is red."""
    environment(scene, tmp_path)
    image = picture([(v / 255,) for v in (51, 153, 102, 255)], tmp_path, "Non-Color")
    made, _, _ = textured(image, ["Roughness", "Metallic"], base_color=(0.8, 0.5, 0.2))
    mesh(scene, "plane", made, size=6)
    camera(scene, (0, -6, 3), (0, 0, 0.5))
    check(scene, tmp_path, 400)


def test_channels_are_numbers(scene, tmp_path):
    """Against Cycles: the reader of Blender's own files has no channels."""
    environment(scene, tmp_path)
    made, tree, texture = textured(picture(np.array(COLOURS) / 255, tmp_path, "Non-Color"), [], base_color=(0.8, 0.5, 0.2))
    parts = tree.nodes.new("ShaderNodeSeparateColor")
    link(tree, texture, parts.inputs[0])
    shader = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    link(tree, parts, shader.inputs["Roughness"], 1)
    link(tree, parts, shader.inputs["Metallic"], 2)
    mesh(scene, "plane", made, size=6)
    camera(scene, (0, -6, 3), (0, 0, 0.5))
    file = exported(scene, tmp_path)
    theirs = blocks(by_cycles(scene, tmp_path, 400))
    ours = blocks(wend.render(wend.usd.read(file, resolution=(SIZE, SIZE), spp=400).scene(), sampling="classical").image)
    assert np.abs(ours / theirs - 1).max() < 0.02


@pytest.mark.parametrize("use_instancing", [False, True])
def test_copies_of_a_collection(scene, tmp_path, use_instancing):
    ground(scene)
    sky(scene, (0.8, 0.8, 0.8))
    collection = bpy.data.collections.new("trees")
    tree = mesh(scene, "cone", plastic(base_color=(0.1, 0.5, 0.1)), place=(0, 0, 0.5), radius1=0.3, depth=1)
    scene.collection.objects.unlink(tree)
    collection.objects.link(tree)
    for i in range(6):
        empty = add(scene, f"copy {i}", None, (math.cos(i), math.sin(i), 0), (0, 0, i), (1, 1, 1 + 0.1 * i))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
    check(scene, tmp_path, use_instancing=use_instancing)


def test_surfaces_with_modifiers(scene, tmp_path):
    ground(scene)
    sky(scene, (0.8, 0.8, 0.8))
    modifier = mesh(scene, "cube", plastic(base_color=(0.8, 0.2, 0.2)), place=(0, 0, 1)).modifiers.new("smooth", "SUBSURF")
    modifier.levels = modifier.render_levels = 3
    check(scene, tmp_path)


def test_hair_is_as_wide_and_ends_where_it_does(scene, tmp_path):
    ground(scene)
    sky(scene, (0.8, 0.8, 0.8))
    random = np.random.default_rng(1)
    hair = bpy.data.hair_curves.new("hair")
    hair.add_curves([6] * 40)
    points = np.zeros((40, 6, 3), dtype=np.float32)
    lean = np.linspace(0, 0.6, 6)[None, :, None] ** 2 * random.uniform(-1, 1, (40, 1, 2))
    points[..., :2] = random.uniform(-1, 1, (40, 1, 2)) + lean
    points[..., 2] = np.linspace(0, 1.5, 6)
    hair.attributes["position"].data.foreach_set("vector", points.ravel())
    radii = hair.attributes.get("radius") or hair.attributes.new("radius", "FLOAT", "POINT")
    radii.data.foreach_set("value", np.tile(np.linspace(0.05, 0.01, 6), 40).astype(np.float32))
    hair.materials.append(plastic(base_color=(0.8, 0.2, 0.1)))
    add(scene, "hair", hair)
    check(scene, tmp_path)


def test_volumes_have_their_place_and_density(scene, tmp_path):
    """Their material is not written: they are grey and as dense as the grid says."""
    file = pathlib.Path(__file__).parents[3] / "shared/scenes/smoke/smoke.vdb"
    if not file.exists():
        pytest.skip("the collection of shared files is not there")
    volume = bpy.data.volumes.new("smoke")
    volume.filepath = str(file)
    made = add(scene, "smoke", volume)
    made.data.materials.append(material("VolumePrincipled", "Volume", color=(0.18, 0.18, 0.18), density=1.0))
    sky(scene, (1, 1, 1))
    bpy.context.view_layer.update()
    corners = np.array(made.evaluated_get(bpy.context.evaluated_depsgraph_get()).bound_box)
    size = float(np.ptp(corners, axis=0).max())
    made.scale, made.location = (2 / size,) * 3, -corners.mean(axis=0) * 2 / size
    camera(scene, (1, -4, 1), (0, 0, 0))
    check(scene, tmp_path, 400)


def test_frames_are_those_of_the_animation(scene, tmp_path):
    """Objects, lamps and their strength; between keys by Blender's own curves."""
    ground(scene)
    sky(scene, (0.3, 0.3, 0.3))
    cube = mesh(scene, "cube", plastic(base_color=(0.8, 0.2, 0.2)), stretch=(0.5, 0.5, 0.5))
    light = lamp(scene, "POINT", 100, (-2, -1, 3), shadow_soft_size=0.1)
    for frame, x in ((1, -1), (5, 1)):
        cube.location, light.location, light.data.energy = (x, 0, 0.5), (2 * x, -1, 3), 100 * frame
        for owner, path in ((cube, "location"), (light, "location"), (light.data, "energy")):
            owner.keyframe_insert(path, frame=frame)
    scene.frame_start, scene.frame_end = 1, 5
    file = exported(scene, tmp_path, export_animation=True)
    for frame in (1, 2, 5):
        scene.frame_set(frame)
        theirs, ours = map(blocks, pictures(scene, file, 64, time=frame))
        np.testing.assert_allclose(ours, theirs, rtol=0.01)


def test_the_words_are_told_of_what_blender_means(scene, tmp_path):
    lamp(scene, "SUN", 3, (0, 0, 5))
    lamp(scene, "AREA", 100, (1, -1, 4))
    environment(scene, tmp_path)
    with pytest.warns(wend.SceneWarning) as told:
        wend.usd.read(exported(scene, tmp_path))
    texts = " ".join(str(warning.message) for warning in told)
    for words in ("four times as strong", "not seen by the camera", "pole along z"):
        assert words in texts
