"""What artists add to Blender's surfaces, against Cycles."""

import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    check,
    lamp,
    material,
    mesh,
    scene,
    sky,
)

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


def test_flat_faces_are_brushed_around_the_object(scene, tmp_path):
    ball(scene, material("BsdfPrincipled", base_color=(0.9, 0.6, 0.3), metallic=1.0, roughness=0.4, anisotropic=0.8), flat=True)
    check(scene, tmp_path, 1000)
