"""What Blender's surfaces show by the angle from which they are seen, and by their side, against Cycles."""

import warnings

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
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
from wend._blend_angles import _reflected  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def mixed(wire, *shaders):
    """A mixture of two shaders by what `wire` links to its factor."""
    made = material("MixShader")
    tree = made.node_tree
    mix = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeMixShader")
    for socket, (kind, inputs) in zip(mix.inputs[1:], shaders):
        link(tree, node(tree, kind, **inputs), socket)
    wire(tree, mix.inputs[0])
    return made


def by(kind, output=0, **inputs):
    return lambda tree, socket: link(tree, node(tree, kind, **inputs), socket, output)


def ramp(tree, socket):
    """From a colour to another by the angle."""
    made = node(tree, "ValToRGB")
    made.color_ramp.elements[0].position, made.color_ramp.elements[0].color = 0.2, (0.9, 0.1, 0.1, 1)
    made.color_ramp.elements[1].position, made.color_ramp.elements[1].color = 0.8, (0.1, 0.2, 0.9, 1)
    link(tree, node(tree, "LayerWeight", blend=0.4), made.inputs[0], "Facing")
    link(tree, made, socket)


def on_a_floor(scene, made):
    floor(scene)
    sky(scene, (0.5, 0.6, 0.8))
    mesh(scene, "uv_sphere", made, smooth=True, place=(0, 0, 1), segments=64, ring_count=32)
    lamp(scene, "SUN", 2, (0, 0, 9), (0.5, 0.3, 0), angle=0.5)


MATT = ("BsdfDiffuse", {"color": (0.7, 0.2, 0.1)})
BLUE = ("BsdfDiffuse", {"color": (0.1, 0.2, 0.8)})
GLOSSY = ("BsdfGlossy", {"color": (0.9, 0.9, 0.9), "roughness": 0.3})


@pytest.mark.parametrize(
    "wire",
    [
        by("Fresnel", ior=1.45),
        by("LayerWeight", "Fresnel", blend=0.3),
        by("LayerWeight", "Facing", blend=0.5),
        by("LayerWeight", "Facing", blend=0.8),
    ],
    ids=["fresnel", "layer", "facing", "facing-steep"],
)
@pytest.mark.parametrize("second", [BLUE, ("BsdfTransparent", {})], ids=["matt", "transparent"])
def test_mixtures_by_the_angle(scene, tmp_path, wire, second):
    on_a_floor(scene, mixed(wire, MATT, second))
    check(scene, tmp_path, 500)


@pytest.mark.parametrize("sampling", ["classical", "full"])
def test_a_glossy_coat_by_fresnel(scene, tmp_path, sampling):
    on_a_floor(scene, mixed(by("Fresnel", ior=1.45), MATT, GLOSSY))
    check(scene, tmp_path, 500, tolerance=0.015, sampling=sampling)


def test_colours_by_the_angle(scene, tmp_path):
    on_a_floor(scene, takes("BsdfDiffuse", "Color", ramp))
    check(scene, tmp_path, 500)


def test_roughness_by_the_angle(scene, tmp_path):
    on_a_floor(scene, takes("BsdfPrincipled", "Roughness", by("LayerWeight", "Facing", blend=0.5), metallic=1.0))
    check(scene, tmp_path, 500, tolerance=0.015)


def test_sides_differ(scene, tmp_path):
    floor(scene)
    sky(scene, (0.5, 0.6, 0.8))
    made = mixed(by("NewGeometry", "Backfacing"), MATT, BLUE)
    mesh(scene, "plane", made, size=2, place=(-1.2, 0, 1), turn=(2.2, 0, 0))
    mesh(scene, "plane", made, size=2, place=(1.2, 0, 1), turn=(0.8, 0, 0))
    mesh(scene, "plane", made, size=1, place=(0, -1, 2), turn=(0.8, 0, 0), stretch=(-1, 1, 1))
    check(scene, tmp_path, 500)


@pytest.mark.parametrize("behind", [MATT, ("BsdfTransparent", {})], ids=["matt", "transparent"])
def test_a_front_alone_shines(scene, tmp_path, behind):
    """Also where its object is mirrored."""
    floor(scene)
    made = mixed(by("NewGeometry", "Backfacing"), ("Emission", {"strength": 5.0}), behind)
    mesh(scene, "plane", made, size=2, place=(-1.2, 0, 1.2), turn=(2.2, 0, 0))
    mesh(scene, "plane", made, size=1, place=(0, -1, 2), turn=(0.8, 0, 0), stretch=(-1, 1, 1))
    check(scene, tmp_path, 1000)


def test_a_front_alone_shines_by_a_picture(scene, tmp_path):
    floor(scene)
    made = mixed(by("NewGeometry", "Backfacing"), ("Emission", {"strength": 5.0}), MATT)
    checks = node(made.node_tree, "TexChecker", scale=3.0, color1=(1, 0.3, 0.1), color2=(0.1, 0.3, 1))
    link(made.node_tree, checks, next(n for n in made.node_tree.nodes if n.bl_idname == "ShaderNodeEmission").inputs[0])
    mesh(scene, "plane", made, size=2, place=(-1.2, 0, 1.2), turn=(2.2, 0, 0))
    check(scene, tmp_path, 1000, tolerance=0.015, bake_resolution=256)


def test_light_of_both_sides_that_differs_is_named(scene):
    mesh(scene, "plane", takes("Emission", "Strength", by("NewGeometry", "Backfacing")))
    with pytest.warns(wend.SceneWarning, match="whose back alone shines"):
        blend.of_scene(scene)
    mesh(scene, "cube", mixed(by("NewGeometry", "Backfacing"), ("Emission", {"strength": 5.0}), ("Emission", {})))
    with pytest.warns(wend.SceneWarning, match="is as in front"):
        blend.of_scene(scene)


def test_angles_need_no_warning(scene):
    on_a_floor(scene, mixed(by("Fresnel"), MATT, GLOSSY))
    with warnings.catch_warnings():
        warnings.simplefilter("error", wend.SceneWarning)
        blend.of_scene(scene)


def test_angles_with_bumps_are_named(scene):
    def bumped(tree, socket):
        weight, bump = node(tree, "LayerWeight"), node(tree, "Bump")
        link(tree, node(tree, "TexNoise"), bump.inputs["Height"])
        link(tree, bump, weight.inputs["Normal"])
        link(tree, weight, socket, "Facing")

    on_a_floor(scene, mixed(bumped, MATT, GLOSSY))
    with pytest.warns(wend.SceneWarning, match="depends on from where it is seen"):
        blend.of_scene(scene)


@pytest.mark.parametrize("index", [0.6, 1.0, 1.5, 2.5])
def test_fresnels_equations(index):
    assert _reflected(1.0, index) == pytest.approx(((index - 1) / (index + 1)) ** 2, abs=1e-12)
    assert _reflected(0.0, index) == pytest.approx(1.0)
    # At Brewster's angle nothing is reflected of light that is polarized along the plane.
    cosine = float(np.cos(np.arctan(index)))
    expected = 0.5 * ((index**2 - 1) / (index**2 + 1)) ** 2
    assert _reflected(cosine, index) == pytest.approx(expected, abs=1e-12)
