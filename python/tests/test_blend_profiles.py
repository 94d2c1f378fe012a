"""Blender's lamps whose light goes by a profile, or into a cone that is scaled, against Cycles."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    camera,
    check,
    floor,
    lamp,
    link,
    scene,
    sky,
    told,
)

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def profile(last, step=5):
    """The text of one that is brightest below and at an azimuth of 40 degrees, in even steps up to this one."""
    v, h = np.arange(0, 181, step), np.arange(0, last + 1, step)
    beside = np.sin(np.radians(v)) * np.cos(np.radians(h[:, None] - 40))
    candela = 500 + 300 * np.cos(np.radians(v)) + 250 * beside
    rows = [v, h, *np.round(candela, 3)]
    head = f"IESNA:LM-63-1995\nTILT=NONE\n1 1000 2 {len(v)} {len(h)} 1 1 0 0 0\n.5 1 10\n"
    return head + "\n".join(" ".join(map(str, row)) for row in rows) + "\n"


def with_profile(scene, kind, text, **settings):
    """A lamp that hangs askew."""
    file = bpy.data.texts.new("profile")
    file.write(text)
    made = lamp(scene, kind, 1, (0, 0, 2), (0.3, 0.2, 0.9), shadow_soft_size=0, **settings).data
    made.use_nodes = True
    tree = made.node_tree
    source = tree.nodes.new("ShaderNodeTexIES")
    source.mode, source.ies = "INTERNAL", file
    source.inputs["Strength"].default_value = 2.0
    twice = tree.nodes.new("ShaderNodeMath")
    twice.operation = "MULTIPLY"
    twice.inputs[1].default_value = 1.5
    link(tree, source, twice.inputs[0])
    link(tree, twice, next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission").inputs["Strength"])
    return source


@pytest.mark.parametrize("last", [90, 180, 360])
def test_a_profile_counts(scene, tmp_path, last):
    floor(scene)
    with_profile(scene, "POINT", profile(last))
    check(scene, tmp_path, 256)


def test_a_profile_of_a_spot_counts_within_its_cone(scene, tmp_path):
    floor(scene)
    with_profile(scene, "SPOT", profile(360), spot_size=2.6, spot_blend=0.9)
    camera(scene, (0, -2, 4), (0.3, 0.3, 0))
    check(scene, tmp_path, 256)


def test_profiles_that_cannot_be_read_are_named(scene):
    source = with_profile(scene, "POINT", "no profile")
    assert "cannot be read is left out: profile: error: no line TILT=" in told(scene)
    source.mode, source.filepath = "EXTERNAL", "//nowhere.ies"
    assert "nowhere.ies: error: No such file" in told(scene)


def test_a_spot_that_is_scaled_has_an_oval_cone(scene, tmp_path):
    floor(scene)
    lamp(
        scene, "SPOT", 500, (0.5, -0.5, 3), (0.1, 0.2, 0.4), (2, 1, 1.5),
        spot_size=0.8, spot_blend=0.4, shadow_soft_size=0,
    )  # fmt: skip
    check(scene, tmp_path, 256)
