"""Pictures on Blender's lamps, against Cycles."""

import numpy as np
import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import check, floor, lamp, link, material, mesh, node, scene, sky, told  # noqa: E402, F401

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def picture():
    """Whose four edges and channels differ; smooth, as the lamps' pictures are coarse."""
    made = bpy.data.images.new("picture", 64, 64, float_buffer=True)
    y, x = np.mgrid[0:64, 0:64] / 64
    pixels = np.stack([x, y**2, 0.5 + 0.5 * np.cos(5 * x + 3 * y), np.ones_like(x)], axis=-1)
    made.pixels.foreach_set(pixels.astype(np.float32).ravel())
    made.pack()
    return made


def shines_by_a_picture(data, vector=None):
    data.use_nodes = True
    tree = data.node_tree
    emission = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeEmission")
    made = node(tree, "TexImage", image=picture())
    if vector is not None:
        link(tree, node(tree, "TexCoord"), made.inputs[0], vector)
    link(tree, made, emission.inputs["Color"])


LAMPS = {
    "square": ("AREA", {"size": 1.5}, None),
    "oblong": ("AREA", {"shape": "RECTANGLE", "size": 2, "size_y": 0.8, "spread": 1.5}, None),
    "disk": ("AREA", {"shape": "DISK", "size": 1.5}, None),
    "point": ("POINT", {"shadow_soft_size": 0}, None),
    "point by normals": ("POINT", {"shadow_soft_size": 0}, "Normal"),
    "spot": ("SPOT", {"shadow_soft_size": 0, "spot_size": 1.2, "spot_blend": 0.2}, None),
    "spot by normals": ("SPOT", {"shadow_soft_size": 0, "spot_size": 1.2}, "Normal"),
}


def stage(scene, name):
    kind, settings, vector = LAMPS[name]
    floor(scene, (0.6, 0.6, 0.6))
    # What the lamp leaves dark is not noise alone.
    sky(scene, (0.1, 0.1, 0.1))
    mesh(scene, "cube", material("BsdfDiffuse", color=(0.2, 0.5, 0.8)), place=(0.3, 0, 0.3), stretch=(0.3, 0.3, 0.3))
    made = lamp(scene, kind, 300, (0.5, -0.5, 2.5), (0.2, 0.3, 0.4), **settings)
    shines_by_a_picture(made.data, vector)


@pytest.mark.parametrize("name", LAMPS)
def test_a_lamp_with_a_picture(scene, tmp_path, name):
    stage(scene, name)
    # One block of the oblong one is 2 % brighter.
    check(scene, tmp_path, 2000 if LAMPS[name][0] == "AREA" else 500, 0.025 if name == "oblong" else 0.015, cycles_spp=1000)


def test_pictures_on_lamps_are_named(scene):
    stage(scene, "spot")
    assert "no constants become a picture" in told(scene)
