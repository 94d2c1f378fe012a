"""Textures of Blender that have no counterpart: what is baked of them, against Cycles."""

import warnings

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    add,
    blocks,
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
)

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def texture(kind, output=0, **inputs):
    """Links a texture to an input."""
    return lambda tree, socket: link(tree, node(tree, kind, **inputs), socket, output)


def told(scene, **options):
    with pytest.warns(wend.SceneWarning) as found:
        builder = blend.of_scene(scene, **options)
    return builder, [str(w.message) for w in found if w.category is wend.SceneWarning]


@pytest.mark.parametrize(
    "wire",
    [
        texture("TexNoise", 1, scale=3.0),
        texture("TexVoronoi", 1, scale=3.0),
        texture("TexWave", scale=2.0, distortion=3.0),
        texture("TexBrick", scale=3.0, mortar=(0.4, 0.3, 0.3)),
        texture("TexChecker", scale=4.0, color1=(0.8, 0.2, 0.1), color2=(0.1, 0.3, 0.7)),
        texture("TexGradient", 1),
        texture("TexMagic", scale=3.0),
        texture("TexCoord", "Generated"),
    ],
    ids=["noise", "voronoi", "wave", "brick", "checker", "gradient", "magic", "coordinates"],
)
def test_textures_by_the_object(scene, tmp_path, wire):
    sky(scene, (1, 1, 1))
    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire), place=(0, 0, 0.5), turn=(0, 0, 0.4))
    check(scene, tmp_path, 128, bake_resolution=1024)


def through(*kinds):
    """Links a chain of nodes, from noise on."""

    def wire(tree, socket):
        last = node(tree, "TexNoise", scale=3.0).outputs["Color"]
        for kind, inputs in kinds:
            made = node(tree, kind, **inputs)
            tree.links.new(last, next(s for s in made.inputs if s.name in ("Color", "Color1", "Value", "Fac", "Factor", "A") and s.enabled))
            last = made.outputs[0]
        tree.links.new(last, socket)

    return wire


@pytest.mark.parametrize(
    "wire",
    [
        through(("RGBCurve", {}), ("HueSaturation", {"hue": 0.7, "saturation": 1.5})),
        through(("BrightContrast", {"brightness": 0.1, "contrast": 0.3}), ("Gamma", {"gamma": 1.5})),
        through(("MapRange", {"from_min": 0.3, "from_max": 0.7}), ("Math", {"operation": "POWER"})),
        through(("ValToRGB", {}), ("Invert", {})),
        through(("MixRGB", {"blend_type": "OVERLAY"}), ("SeparateColor", {})),
    ],
    ids=["curves", "contrast", "range", "ramp", "mix"],
)
def test_nodes_of_colours_and_numbers(scene, tmp_path, wire):
    sky(scene, (1, 1, 1))
    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire), place=(0, 0, 0.5))
    check(scene, tmp_path, 64, bake_resolution=256)


def test_what_is_by_uv_alone_is_baked_by_uv(scene, tmp_path):
    """Whatever overlaps there, and wherever it is."""

    def wire(tree, socket):
        mapping = node(tree, "Mapping", scale=(3, 2, 1), rotation=(0, 0, 0.4))
        link(tree, node(tree, "TexCoord"), mapping.inputs[0], "UV")
        wave = node(tree, "TexWave", scale=1.0)
        link(tree, mapping, wave.inputs["Vector"])
        link(tree, wave, socket)

    sky(scene, (1, 1, 1))
    made = mesh(scene, "plane", takes("BsdfDiffuse", "Color", wire), size=6)
    for corner in made.data.uv_layers[0].uv:
        corner.vector = (2.5 * corner.vector[0] - 0.3, 1.5 * corner.vector[1])
    check(scene, tmp_path, 64, bake_resolution=512)
    assert "uvmatrix" in blend.of_scene(scene, bake_resolution=16).text()


def picture(name, values, space="sRGB"):
    height, width = values.shape[:2]
    image = bpy.data.images.new(name, width, height, float_buffer=space == "Non-Color")
    image.colorspace_settings.name = space
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = values
    image.pixels.foreach_set(pixels.ravel())
    return image


def test_a_turned_picture_is_taken_as_it_is(scene, tmp_path):
    coarse = np.random.default_rng(1).uniform(0.1, 0.9, (8, 8, 3)).repeat(8, axis=0).repeat(8, axis=1)
    image = picture("coarse", coarse, "Non-Color")

    def wire(tree, socket):
        mapping = node(tree, "Mapping", scale=(2, 3, 1), rotation=(0, 0, 0.7), location=(0.1, 0.3, 0))
        link(tree, node(tree, "TexCoord"), mapping.inputs[0], "UV")
        shown = node(tree, "TexImage", image=image)
        link(tree, mapping, shown.inputs["Vector"])
        link(tree, shown, socket)

    sky(scene, (1, 1, 1))
    mesh(scene, "plane", takes("BsdfDiffuse", "Color", wire), size=6)
    check(scene, tmp_path, 256)
    assert ".png" in blend.of_scene(scene).text() or "coarse" in blend.of_scene(scene).text()


def test_a_mesh_without_uvs_is_given_some(scene, tmp_path):
    sky(scene, (1, 1, 1))
    ball = mesh(scene, "uv_sphere", takes("BsdfDiffuse", "Color", texture("TexNoise", 1, scale=2.0)), True, place=(0, 0, 0.5))
    ball.data.uv_layers.remove(ball.data.uv_layers[0])
    check(scene, tmp_path, 64, bake_resolution=256)
    assert not ball.data.uv_layers and "wend" not in " ".join(bpy.data.scenes.keys() + bpy.data.materials.keys() + bpy.data.images.keys())


def test_overlapping_uvs_are_made_anew_and_pictures_with_them(scene, tmp_path):
    sky(scene, (1, 1, 1))
    image = picture("random", np.random.default_rng(1).uniform(0, 1, (64, 64, 3)))

    def wire(tree, socket):
        mix = node(tree, "MixRGB", color2=(0.1, 0.9, 0.2))
        link(tree, node(tree, "TexGradient"), mix.inputs[0], 1)
        link(tree, node(tree, "TexImage", image=image), mix.inputs[1])
        link(tree, mix, socket)

    cube = mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire), place=(0, 0, 0.5))
    for i, corner in enumerate(cube.data.uv_layers[0].uv):
        corner.vector = ((0, 0), (1, 0), (1, 1), (0, 1))[i % 4]
    check(scene, tmp_path, 64, bake_resolution=512)


def test_vertex_colours_of_a_mesh_with_modifiers(scene, tmp_path):
    sky(scene, (1, 1, 1))
    cube = mesh(scene, "cube", takes("BsdfPrincipled", "Base Color", texture("VertexColor", layer_name="paint"), roughness=0.5), place=(0, 0, 0.5))
    paint = cube.data.color_attributes.new("paint", "FLOAT_COLOR", "POINT")
    for colour, vertex in zip(paint.data, cube.data.vertices):
        colour.color = (*(0.4 * vertex.co + type(vertex.co)((0.5, 0.5, 0.5))), 1)
    cube.modifiers.new("round", "SUBSURF").levels = 2
    cube.modifiers["round"].render_levels = 2
    check(scene, tmp_path, 256, bake_resolution=256)


def test_objects_that_share_a_material_are_baked_apart(scene, tmp_path):
    sky(scene, (1, 1, 1))
    shared = takes("BsdfDiffuse", "Color", texture("TexGradient", 1))
    link(shared.node_tree, node(shared.node_tree, "TexCoord"), next(n for n in shared.node_tree.nodes if n.bl_idname == "ShaderNodeTexGradient").inputs[0], "Object")
    mesh(scene, "cube", shared, place=(-1, 0, 0.5), size=1.2)
    ball = mesh(scene, "uv_sphere", shared, True, place=(1, 0, 0.5))
    add(scene, "twin", ball.data, (0, 2, 0.5))
    check(scene, tmp_path, 64, bake_resolution=256)
    builder, texts = told(scene, bake_resolution=16)
    assert sum("is baked, 16 x 16" in text for text in texts) == 2
    assert builder.text().count("ObjectInstance") == 2


def test_a_group_that_varies_inside(scene, tmp_path):
    inner = bpy.data.node_groups.new("inner", "ShaderNodeTree")
    inner.interface.new_socket("Scale", in_out="INPUT", socket_type="NodeSocketFloat")
    inner.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    matt, cells = inner.nodes.new("ShaderNodeBsdfDiffuse"), inner.nodes.new("ShaderNodeTexVoronoi")
    inner.links.new(inner.nodes.new("NodeGroupInput").outputs[0], cells.inputs["Scale"])
    inner.links.new(cells.outputs["Color"], matt.inputs["Color"])
    inner.links.new(matt.outputs[0], inner.nodes.new("NodeGroupOutput").inputs[0])
    made = material()
    group = made.node_tree.nodes.new("ShaderNodeGroup")
    group.node_tree = inner
    group.inputs[0].default_value = 2.5
    link(made.node_tree, group, made.node_tree.get_output_node("CYCLES").inputs["Surface"])
    sky(scene, (1, 1, 1))
    mesh(scene, "cube", made, place=(0, 0, 0.5))
    check(scene, tmp_path, 64, bake_resolution=512)
    assert len(bpy.data.node_groups) == 1 and len(inner.interface.items_tree) == 2


def test_roughness_and_metal_that_vary(scene, tmp_path):
    sky(scene, (0.3, 0.3, 0.3))
    lamp(scene, "AREA", 400, (2, -3, 4), (0.8, 0.2, 0.3), size=1.5).visible_camera = False
    made = takes("BsdfPrincipled", "Roughness", texture("TexMagic", 1, scale=3.0), base_color=(0.5, 0.3, 0.1))
    principled = made.node_tree.nodes["Principled BSDF"]
    texture("TexNoise", scale=2.0)(made.node_tree, principled.inputs["Metallic"])
    mesh(scene, "uv_sphere", made, True, place=(0, 0, 0.5), radius=1.5, segments=64, ring_count=32)
    check(scene, tmp_path, 600, bake_resolution=256)


def test_a_mixture_by_a_texture(scene, tmp_path):
    made = material()
    tree = made.node_tree
    mix = node(tree, "MixShader")
    texture("TexWave", 1, scale=1.5)(tree, mix.inputs[0])
    link(tree, node(tree, "BsdfDiffuse", color=(0.8, 0.1, 0.1)), mix.inputs[1])
    link(tree, node(tree, "BsdfTransparent"), mix.inputs[2])
    link(tree, mix, tree.get_output_node("CYCLES").inputs["Surface"])
    floor(scene)
    sky(scene, (1, 1, 1))
    mesh(scene, "cube", made, place=(0, 0, 1.2))
    check(scene, tmp_path, 600, bake_resolution=512)


def test_light_that_varies(scene, tmp_path):
    floor(scene)
    checks = texture("TexChecker", scale=4.0, color1=(2, 0.5, 0.1), color2=(0.1, 0.3, 3))
    mesh(scene, "plane", takes("Emission", "Color", checks, strength=2.0), place=(0, 1.5, 1.2), turn=(1.2, 0, 0))
    # Half of it is noise.
    check(scene, tmp_path, 1500, tolerance=0.015, bake_resolution=512)


def bumps(tree, socket):
    bump = node(tree, "Bump", strength=0.8, distance=0.3)
    link(tree, node(tree, "TexNoise", scale=2.0), bump.inputs["Height"])
    link(tree, bump, socket)


def half_strength(tree, socket):
    y, x = np.mgrid[:64, :64] / 64 * 2 * np.pi
    normals = np.stack([0.5 + 0.12 * np.sin(2 * x), 0.5 + 0.12 * np.sin(3 * y), np.full_like(x, 0.9)], axis=2)
    weak = node(tree, "NormalMap", strength=0.5)
    link(tree, node(tree, "TexImage", image=picture("normals", normals, "Non-Color")), weak.inputs["Color"])
    link(tree, weak, socket)


@pytest.mark.parametrize("shape", ["plane", "uv_sphere"])
@pytest.mark.parametrize("wire", [bumps, half_strength], ids=["bump", "normal map"])
def test_bumps_and_the_strength_of_normal_maps(scene, tmp_path, shape, wire):
    sky(scene, (0.1, 0.1, 0.1))
    lamp(scene, "SUN", 3, (0, 0, 5), (0.9, 0.3, 0), angle=0.1)
    made = takes("BsdfDiffuse", "Normal", wire, color=(0.8, 0.8, 0.8))
    made.cycles.use_bump_map_correction = False
    mesh(scene, shape, made, True, place=(0, 0, 0.5), turn=(0.1, 0.2, 0.7), stretch=(1.6, 1.6, 1.6))
    # Where a normal faces away from the eye nothing is reflected, and Cycles reflects: at the edge of a ball.
    bumped = check(scene, tmp_path, 300, tolerance=0.01 if shape == "plane" else 0.02, bake_resolution=512)
    made.node_tree.links.remove(made.node_tree.nodes["Diffuse BSDF"].inputs["Normal"].links[0])
    smooth = wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image
    # What is left out would be refused.
    assert np.abs(blocks(smooth) / blocks(bumped) - 1).max() > 0.02


def test_displacement_is_a_bump(scene, tmp_path):
    made = material("BsdfDiffuse", color=(0.8, 0.8, 0.8))
    tree = made.node_tree
    displacement = node(tree, "Displacement", scale=0.3)
    link(tree, node(tree, "TexNoise", scale=2.0), displacement.inputs["Height"])
    link(tree, displacement, tree.get_output_node("CYCLES").inputs["Displacement"])
    sky(scene, (0.1, 0.1, 0.1))
    lamp(scene, "SUN", 3, (0, 0, 5), (0.9, 0.3, 0), angle=0.1)
    mesh(scene, "uv_sphere", made, True, place=(0, 0, 0.5), radius=1.5)
    check(scene, tmp_path, 300, bake_resolution=512)


def test_what_is_baked_is_told_once_for_each_input(scene):
    made = takes("BsdfPrincipled", "Base Color", texture("TexNoise", 1))
    texture("TexVoronoi")(made.node_tree, made.node_tree.nodes["Principled BSDF"].inputs["Roughness"])
    cube = mesh(scene, "cube", made)
    add(scene, "twin", cube.data, (3, 0, 0))
    lamp(scene, "POINT", 1, (0, 0, 3))
    _, texts = told(scene, bake_resolution=32)
    baked = [text for text in texts if "is baked, 32 x 32" in text]
    assert len(baked) == 2 and all("object 'Cube'" in text and made.name in text and "Principled BSDF" in text for text in baked)


def test_what_has_no_faces_or_no_finite_uvs(scene):
    wavy = takes("BsdfDiffuse", "Color", texture("TexNoise", 1))
    points = bpy.data.meshes.new("points")
    points.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    points.materials.append(wavy)
    add(scene, "points", points)
    by_uv = takes("BsdfDiffuse", "Color", texture("TexNoise", 1))
    tree = by_uv.node_tree
    link(tree, node(tree, "UVMap"), next(n for n in tree.nodes if n.bl_idname == "ShaderNodeTexNoise").inputs["Vector"])
    for made in (wavy, by_uv):
        mesh(scene, "plane", made).data.uv_layers[0].uv[0].vector = (np.nan, np.inf)
    sky(scene, (1, 1, 1))
    assert blend.of_scene(scene, bake_resolution=8).scene(resolution=(8, 8))


def to_the_camera(tree, socket):
    made = node(tree, "VectorTransform", convert_to="CAMERA")
    link(tree, node(tree, "NewGeometry"), made.inputs[0], "Normal")
    link(tree, made, socket)


@pytest.mark.parametrize(
    ("wire", "name"),
    [
        (texture("CameraData", 1), "Camera Data"),
        (texture("NewGeometry", "Incoming"), "Geometry"),
        (to_the_camera, "Vector Transform"),
    ],
    ids=["camera", "incoming", "transform"],
)
def test_what_depends_on_the_eye_is_named(scene, wire, name):
    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire))
    lamp(scene, "POINT", 1, (0, 0, 3))
    _, texts = told(scene, bake_resolution=16)
    assert any(name in text and "from where it is seen" in text for text in texts)


@pytest.mark.parametrize("wire", [texture("TexNoise"), texture("TexCoord", "Generated")], ids=["noise", "coordinates"])
@pytest.mark.parametrize("by", ["key", "modifier"])
def test_what_lies_by_a_shape_that_is_deformed_is_named(scene, wire, by):
    made = mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire))
    lamp(scene, "POINT", 1, (0, 0, 3))
    _, before = told(scene, bake_resolution=16)
    if by == "modifier":
        made.modifiers.new("round", "CAST")
    else:
        made.shape_key_add(name="first")
        made.shape_key_add(name="second").value = 1
    _, texts = told(scene, bake_resolution=16)
    assert any("as it is deformed" in text for text in texts) and not any("as it is deformed" in text for text in before)


def test_what_differs_between_sides_and_varies_is_named(scene):
    def wire(tree, socket):
        made = node(tree, "Math", operation="MULTIPLY")
        link(tree, node(tree, "NewGeometry"), made.inputs[0], "Backfacing")
        link(tree, node(tree, "TexNoise"), made.inputs[1])
        link(tree, made, socket)

    mesh(scene, "cube", takes("BsdfDiffuse", "Color", wire))
    lamp(scene, "POINT", 1, (0, 0, 3))
    _, texts = told(scene, bake_resolution=16)
    assert any("baked as it is in front" in text for text in texts)


@pytest.mark.parametrize("output", ["Random", "Color"])
def test_objects_with_one_mesh_look_as_each_is(scene, tmp_path, output):
    sky(scene, (1, 1, 1))
    made = takes("BsdfDiffuse", "Color", texture("ObjectInfo", output))
    first = mesh(scene, "cube", made, size=0.8, place=(-1.5, 0, 0.4))
    objects = [first, *(add(scene, f"copy {i}", first.data, (i - 0.5, 0, 0.4), (0, 0, 0.3 * i)) for i in range(3))]
    for i, copy in enumerate(objects):
        copy.color = (0.2 * i + 0.1, 0.8 - 0.2 * i, 0.3, 1)
    check(scene, tmp_path, 128)


def test_what_is_even_needs_no_warning(scene):
    made = takes("BsdfDiffuse", "Color", texture("ObjectInfo", "Color"))
    first = mesh(scene, "cube", made)
    add(scene, "copy", first.data, (2, 0, 0)).color = (1, 0, 0, 1)
    lamp(scene, "SUN", 1, (0, 0, 9))
    with warnings.catch_warnings():
        warnings.simplefilter("error", wend.SceneWarning)
        blend.of_scene(scene)
