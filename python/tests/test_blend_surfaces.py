"""What artists add to Blender's surfaces, against Cycles."""

import warnings

import numpy as np
import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    add,
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
    set_input,
    sky,
    told,
)

import wend  # noqa: E402
from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


#: Cycles darkens what rough facets reflect several times by the colour once too often; as much comes back in all.
CHALK = 0.02


def ball(scene, made, flat=False):
    sky(scene, (0.5, 0.7, 1.0))
    arguments = {"place": (0, 0, 0.5), "radius": 1.5, "segments": 64, "ring_count": 32}
    if flat:
        mesh(scene, "cube", made, place=(0, 0, 0.5), turn=(0.3, 0.2, 0.5), stretch=(1.1, 1.3, 0.9))
    else:
        mesh(scene, "uv_sphere", made, smooth=True, **arguments)
    lamp(scene, "AREA", 400, (2, -3, 4), (0.8, 0.2, 0.3), size=1.5).visible_camera = False


@pytest.mark.parametrize(
    "inputs",
    [
        {"base_color": (0.5, 0.3, 0.2), "specular_tint": (1, 0.3, 0.1), "roughness": 0.4},
        {"base_color": (0.9, 0.6, 0.3), "specular_tint": (1, 0.3, 0.1), "metallic": 1.0, "roughness": 0.4},
        {"base_color": (0.5, 0.3, 0.2), "diffuse_roughness": 1.0},
        {"base_color": (0.5, 0.3, 0.2), "specular_ior_level": 0.9, "roughness": 0.4},
        {"base_color": (0.5, 0.3, 0.2), "specular_ior_level": 0.1, "roughness": 0.4},
        {"base_color": (0.6, 0.5, 0.4), "coat_weight": 1.0, "coat_roughness": 0.3, "coat_tint": (0.3, 0.6, 0.9)},
        {"base_color": (0.9, 0.6, 0.3), "metallic": 1.0, "roughness": 0.4, "anisotropic": 0.8},
        {"base_color": (0.9, 0.6, 0.3), "metallic": 1.0, "roughness": 0.4, "anisotropic": 0.6, "anisotropic_rotation": 0.15},
        {"base_color": (0.5, 0.3, 0.2), "sheen_weight": 1.0},
        {"base_color": (0.5, 0.3, 0.2), "sheen_weight": 0.7, "sheen_roughness": 0.3, "sheen_tint": (0.4, 0.7, 1.0)},
        {"base_color": (0.5, 0.3, 0.2), "sheen_weight": 1.0, "sheen_roughness": 0.9, "coat_weight": 1.0, "coat_roughness": 0.3},
    ],
    ids=["tint", "edge", "chalk", "level", "low level", "coat", "brushed", "turned", "sheen", "tinted sheen", "sheen on a coat"],
)
def test_principled(scene, tmp_path, inputs):
    ball(scene, material("BsdfPrincipled", **inputs))
    check(scene, tmp_path, 1000, tolerance=CHALK if "diffuse_roughness" in inputs else 0.01)


@pytest.mark.parametrize(
    ("kind", "inputs"),
    [
        ("BsdfDiffuse", {"color": (0.5, 0.3, 0.2), "roughness": 0.7}),
        ("BsdfAnisotropic", {"color": (0.7, 0.5, 0.3), "roughness": 0.4}),
        ("BsdfMetallic", {"base_color": (0.7, 0.5, 0.3), "edge_tint": (0.4, 0.6, 0.9), "roughness": 0.4}),
        ("BsdfSheen", {"color": (0.7, 0.5, 0.3), "roughness": 0.7}),
    ],
    ids=["diffuse", "glossy", "metallic", "sheen"],
)
def test_others(scene, tmp_path, kind, inputs):
    ball(scene, material(kind, **inputs))
    check(scene, tmp_path, 1000, tolerance=CHALK if kind == "BsdfDiffuse" else 0.01)


def test_a_coat_darkens_what_shines_below_it(scene, tmp_path):
    """All in all: seen from aside it is darker than ours, and from above brighter."""
    inputs = {"base_color": (0, 0, 0), "roughness": 0.5, "coat_weight": 0.8, "coat_roughness": 0.3, "coat_tint": (0.2, 0.5, 0.9)}
    made = material("BsdfPrincipled", emission_color=(0.2, 0.4, 1), emission_strength=5.0, specular_ior_level=0, **inputs)
    mesh(scene, "uv_sphere", made, smooth=True, radius=1.5, segments=64, ring_count=32)
    camera(scene, (0, -60, 0), (0, 0, 0), lens=500)
    theirs = by_cycles(scene, tmp_path, 200).mean(axis=(0, 1))
    ours = wend.render(blend.of_scene(scene, spp=200).scene(), sampling="classical").image.mean(axis=(0, 1))
    np.testing.assert_allclose(ours, theirs, rtol=0.01)


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        ({"base_color": (1.4, 0.3, 0.1)}, "Base Color above 1"),
        ({"coat_weight": 1.0, "emission_strength": 1.0}, "a coat darkens"),
        ({"sheen_weight": 1.0, "emission_strength": 1.0}, "sheen does not darken"),
        ({"ior": 0.8}, "an IOR below 1"),
    ],
    ids=["too bright", "coat", "sheen", "index"],
)
def test_what_is_not_quite_so_is_named(scene, inputs, words):
    mesh(scene, "cube", material("BsdfPrincipled", **inputs))
    sky(scene, (1, 1, 1))
    assert words in told(scene)


@pytest.mark.parametrize(
    ("roughness", "distribution"),
    [(0.0, "MULTI_GGX"), (0.5, "MULTI_GGX"), (0.5, "GGX")],
    ids=["mirror", "reflecting several times", "reflecting once"],
)
def test_what_is_glossy_has_its_colour_at_every_angle(scene, tmp_path, roughness, distribution):
    made = material("BsdfAnisotropic", color=(0.8, 0.4, 0.1), roughness=roughness, distribution=distribution)
    sky(scene, (0.5, 0.7, 1.0))
    mesh(scene, "plane", material("BsdfDiffuse", color=(0.6, 0.4, 0.2)), size=6)
    mesh(scene, "cube", made, place=(0, 0, 1), turn=(0.3, 0.2, 0.7))
    camera(scene, (0, -6, 2), (0, 0, 0.8))
    check(scene, tmp_path, 1000, cycles_spp=500)


def test_flat_faces_are_brushed_around_the_object(scene, tmp_path):
    ball(scene, material("BsdfPrincipled", base_color=(0.9, 0.6, 0.3), metallic=1.0, roughness=0.4, anisotropic=0.8), flat=True)
    check(scene, tmp_path, 1000)


def test_metal_by_index(scene, tmp_path):
    """Between what is seen from above and the edge, colours are Schlick's."""
    made = material("BsdfMetallic", fresnel_type="PHYSICAL_CONDUCTOR", roughness=0.4)
    gold = next(n for n in made.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfMetallic")
    gold.inputs["IOR"].default_value, gold.inputs["Extinction"].default_value = (0.18, 0.42, 1.37), (3.42, 2.35, 1.77)
    ball(scene, made)
    check(scene, tmp_path, 1000, tolerance=0.02)


def test_bumps_of_glass(scene, tmp_path):
    """Under a lamp that it shows, and whose light it gathers on the floor."""
    made = material("BsdfGlass", distribution="GGX", roughness=0.2)
    tree = made.node_tree
    noise, bump = node(tree, "TexNoise", scale=2.0), node(tree, "Bump", strength=0.5)
    link(tree, node(tree, "TexCoord"), noise.inputs["Vector"], "Object")
    link(tree, noise, bump.inputs["Height"])
    link(tree, bump, next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfGlass").inputs["Normal"])
    sky(scene, (0.3, 0.5, 0.9))
    floor(scene)
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    lamp(scene, "AREA", 200, (2, -3, 3), (0.9, 0.2, 0.5), size=2)
    check(scene, tmp_path, 4000)


#: Light goes to and fro among strands.
HAIR = 0.025


@pytest.mark.parametrize(
    ("kind", "inputs"),
    [
        ("MELANIN", {"melanin": 0.6}),
        ("MELANIN", {"melanin": 0.3, "melanin_redness": 0.9, "offset": 0.2}),
    ],
    ids=["brown", "red, tilted"],
)
def test_hair(scene, tmp_path, kind, inputs):
    made = material("BsdfHairPrincipled")
    shader = next(n for n in made.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfHairPrincipled")
    shader.model, shader.parametrization = "CHIANG", kind
    for name, value in inputs.items():
        set_input(shader, name, value)
    strands = 30
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves([4] * strands)
    points = [
        (x, y, z)
        for i, x in enumerate(np.linspace(-2, 2, strands))
        for y, z in ((0, -1.5), (0.2 * (i % 3), 0), (0.1 * (i % 2), 1), (0, 2.5))
    ]
    curves.attributes["position"].data.foreach_set("vector", np.array(points, dtype=np.float32).ravel())
    curves.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", np.full(4 * strands, 0.05, dtype=np.float32))
    curves.materials.append(made)
    add(scene, "hair", curves)
    scene.cycles_curves.shape = "THICK"
    sky(scene, (0.3, 0.4, 0.5))
    lamp(scene, "AREA", 150, (2, -3, 3), (0.9, 0.2, 0.5), size=2)
    check(scene, tmp_path, 1500, tolerance=HAIR)


@pytest.mark.parametrize(("children", "grows_on"), [("NONE", True), ("SIMPLE", True), ("NONE", False)])
def test_strands_of_particles(scene, tmp_path, children, grows_on):
    """Whose radii are diameters, whose parents are not seen where they have children, and that may be there alone."""
    sky(scene, (0.5, 0.6, 0.7))
    floor(scene)
    made = mesh(scene, "uv_sphere", material("BsdfDiffuse", color=(0.4, 0.2, 0.1)), place=(0, 0, 1), segments=16, ring_count=8)
    made.modifiers.new("hair", "PARTICLE_SYSTEM")
    settings = made.particle_systems[0].settings
    made.show_instancer_for_render = grows_on
    settings.type, settings.count, settings.hair_length = "HAIR", 114, 0.6
    # At each vertex: on faces Blender puts them elsewhere each time.
    settings.emit_from, settings.use_emit_random = "VERT", False
    settings.root_radius, settings.tip_radius, settings.radius_scale = 4, 2, 0.01
    settings.child_type, settings.rendered_child_count = children, 2
    scene.cycles_curves.shape = "THICK"
    check(scene, tmp_path, 1024, tolerance=HAIR, keeps=False)


def test_what_rays_of_the_camera_go_through_is_there_for_others(scene, tmp_path):
    """A panel that shines in the middle of the picture, and is not seen there."""
    floor(scene)
    sky(scene, (0.1, 0.1, 0.1))
    made = material("MixShader")
    tree = made.node_tree
    mixed = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader")
    link(tree, node(tree, "LightPath"), mixed.inputs[0], "Is Camera Ray")
    link(tree, node(tree, "Emission", color=(1, 0.6, 0.3), strength=5.0), mixed.inputs[1])
    link(tree, node(tree, "BsdfTransparent"), mixed.inputs[2])
    mesh(scene, "plane", made, place=(0, 0, 1.5), turn=(0.4, 0, 0), size=1)
    check(scene, tmp_path, 500)


@pytest.mark.parametrize("share", [None, 0.3])
def test_what_is_transparent_has_its_colour(scene, tmp_path, share):
    """A ball, or its mixture with a matt one; the shadow of it is not black."""
    floor(scene)
    sky(scene, (0.5, 0.6, 0.8))
    made = material("BsdfTransparent", color=(0.8, 0.3, 0.2))
    if share is not None:
        made = material("MixShader")
        tree = made.node_tree
        mixed = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader")
        mixed.inputs[0].default_value = share
        link(tree, node(tree, "BsdfTransparent", color=(0.8, 0.3, 0.2)), mixed.inputs[1])
        link(tree, node(tree, "BsdfDiffuse", color=(0.1, 0.1, 0.8)), mixed.inputs[2])
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    lamp(scene, "SUN", 2, (0, 0, 9), (0.5, 0.3, 0), angle=0.5)
    check(scene, tmp_path, 500, tolerance=0.015)


def _all_told(scene):
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        blend.of_scene(scene)
    return [str(w.message) for w in found]


@pytest.mark.parametrize("has_slots", [False, True], ids=["no slot", "an empty slot"])
def test_what_has_no_material_is_as_a_new_one(scene, tmp_path, has_slots):
    ball(scene, None, flat=True)
    if has_slots:
        made = scene.objects["Cube"]
        for other in (material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), None):
            made.data.materials.append(other)
        for i, face in enumerate(made.data.polygons):
            face.material_index = i % 4
    check(scene, tmp_path, 1000)


def test_smooth_faces_whose_normals_lean_far_from_them_are_named(scene):
    sky(scene, (1, 1, 1))
    ball(scene, None)
    mesh(scene, "cube", None)
    assert not [w for w in _all_told(scene) if "lean" in w]
    mesh(scene, "cylinder", None, vertices=8, smooth=True).name = "pipe"
    assert [w for w in _all_told(scene) if "object 'pipe': warning: smooth faces whose normals lean" in w]
