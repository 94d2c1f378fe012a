"""Volumes of Blender that are not the same everywhere, against Cycles."""

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
    told,
)

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def texture(kind, socket, output=0, vector=None, after=None, **settings):
    """Links a texture, mapped, to an input of a shader."""

    def wire(tree, shader):
        made = node(tree, kind, **settings)
        if vector is not None:
            mapping = node(tree, "Mapping", scale=(2, 1, 1.5), location=(0.2, 0.3, 0.1))
            link(tree, node(tree, "TexCoord"), mapping.inputs[0], vector)
            link(tree, mapping, made.inputs["Vector"])
        found = made.outputs[output]
        tree.links.new(found if after is None else after(tree, found), shader.inputs[socket])

    return wire


def line(factor, offset=0.0):
    def after(tree, found):
        made = node(tree, "Math", operation="MULTIPLY_ADD")
        made.inputs[1].default_value, made.inputs[2].default_value = factor, offset
        tree.links.new(found, made.inputs[0])
        return made.outputs[0]

    return after


def ramp(tree, found):
    made = node(tree, "ValToRGB")
    made.color_ramp.elements[0].position, made.color_ramp.elements[1].position = 0.45, 0.6
    tree.links.new(found, made.inputs[0])
    return line(4)(tree, made.outputs[0])


def ranged(tree, found):
    made = node(tree, "MapRange", to_max=5.0, from_min=0.4)
    tree.links.new(found, made.inputs[0])
    return made.outputs[0]


def fog(kind, wire, **inputs):
    made = material(kind, "Volume", **inputs)
    wire(made.node_tree, next(n for n in made.node_tree.nodes if n.bl_idname == f"ShaderNode{kind}"))
    return made


FOGS = {
    "noise": lambda: fog("VolumeScatter", texture("TexNoise", "Density", 0, "Object", line(6, -2)), color=(0.9, 0.7, 0.5)),
    "generated": lambda: fog("VolumePrincipled", texture("TexNoise", "Density", after=ramp), color=(0.8, 0.6, 0.5)),
    "wave": lambda: fog("VolumeScatter", texture("TexWave", "Density", 0, "Generated", line(2)), anisotropy=0.5),
    "cells": lambda: fog("VolumeScatter", texture("TexVoronoi", "Density", "Distance", "Object", ranged)),
    "gradient": lambda: fog("VolumeAbsorption", texture("TexGradient", "Density", 0, "Object", line(2)), color=(0.3, 0.5, 0.7)),
    "colours": lambda: fog("VolumeScatter", texture("TexNoise", "Color", "Color", "Object"), density=2.0),
    "glow": lambda: fog(
        "VolumePrincipled",
        texture("TexNoise", "Emission Strength", 0, "Object", line(3, -1)),
        density=0.5,
        emission_color=(1, 0.5, 0.2),
    ),
}


def box(scene, made, **settings):
    sky(scene, (0.3, 0.4, 0.5))
    floor(scene)
    lamp(scene, "AREA", 300, (1, -2, 4), (0.4, 0.2, 0), size=1)
    return mesh(scene, "cube", made, place=(0.2, 0.1, 0.9), turn=(0.3, 0.2, 0.5), stretch=(0.9, 0.7, 0.6), **settings)


@pytest.mark.parametrize("name", FOGS)
def test_fog_that_varies(scene, tmp_path, name):
    box(scene, FOGS[name]())
    check(scene, tmp_path, 500, tolerance=0.015, cycles_spp=1000)


def test_each_copy_has_its_own_fog(scene, tmp_path):
    """By the object's random number, and by the place in the world."""

    def wire(tree, shader):
        made = node(tree, "Math", operation="MULTIPLY")
        link(tree, node(tree, "ObjectInfo"), made.inputs[0], "Random")
        made.inputs[1].default_value = 4
        link(tree, made, shader.inputs["Density"])

    first = box(scene, fog("VolumeScatter", wire))
    for i, x in enumerate((-1.6, 1.8)):
        other = bpy.data.objects.new(f"copy {i}", first.data)
        scene.collection.objects.link(other)
        other.location, other.scale = (x, 0.5, 0.6), (0.5, 0.5, 0.5)
    check(scene, tmp_path, 1000, tolerance=0.015)


def test_what_is_baked_inside_is_named_with_its_size(scene):
    box(scene, FOGS["noise"]())
    assert "Density of node 'Volume Scatter' is baked, " in told(scene, bake_resolution=64)


def test_voxels_are_where_their_values_are(scene):
    """Of a density that is a coordinate of the object, each voxel has that of its middle."""

    def wire(tree, shader):
        link(tree, node(tree, "TexCoord"), shader.inputs["Color"], "Generated")

    box(scene, fog("VolumeScatter", wire))
    text = blend.of_scene(scene, bake_resolution=16).text()
    values = text[text.index("rgb sigma_s") :].split("[", 1)[1].split("]", 1)[0]
    size = [int(text.split(f"integer n{axis}", 1)[1].split("[", 1)[1].split("]", 1)[0]) for axis in "xyz"]
    found = np.array(values.split(), dtype=float).reshape(*reversed(size), 3)
    z, y, x = np.meshgrid(*((np.arange(n) + 0.5) / n for n in reversed(size)), indexing="ij")
    # Blender bakes two thousandths of a pixel beside its middle.
    np.testing.assert_allclose(found, np.stack([x, y, z], axis=-1), atol=5e-4)
    assert wend.render(blend.of_scene(scene, spp=1, bake_resolution=16).scene()).image.max() > 0


def test_a_world_that_varies_by_nothing_is_even(scene):
    """Cycles takes very long for worlds whose volume varies."""
    density = 0.05
    floor(scene)
    mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(0.3, 0, 0.5), stretch=(0.5, 0.5, 0.5))
    lamp(scene, "AREA", 300, (1, -2, 4), (0.4, 0.2, 0), size=1)
    tree = scene.world.node_tree
    shader = node(tree, "VolumeScatter", color=(0.9, 0.7, 0.5), density=density)
    link(tree, shader, tree.get_output_node("CYCLES").inputs["Volume"])
    even = wend.render(blend.of_scene(scene, spp=200).scene(), sampling="classical").image
    texture("TexNoise", "Density", 0, "Object", line(0, density))(tree, shader)
    assert "as its mean" in told(scene, bake_resolution=16)
    baked = wend.render(blend.of_scene(scene, spp=200, bake_resolution=16).scene(), sampling="classical").image
    np.testing.assert_allclose(baked.mean(axis=(0, 1)), even.mean(axis=(0, 1)), rtol=0.02)
