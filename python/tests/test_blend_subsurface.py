"""Subsurface scattering of Blender, against the random walks of Cycles."""

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    check,
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

SKIN = {"base_color": (0.8, 0.5, 0.3), "subsurface_weight": 1.0, "subsurface_radius": (1, 0.5, 0.25)}


def ball(scene, made):
    mesh(scene, "uv_sphere", made, True, place=(0, 0, 0.5), radius=1.5, segments=64, ring_count=32)


def lit(scene, light):
    if light == "sky":
        sky(scene, (0.8, 1, 1.2))
    else:
        sky(scene, (0.3, 0.3, 0.3))
        lamp(scene, "SUN", 3, (0, 0, 5), (0.9, 0.3, 0), angle=0.1)


@pytest.mark.parametrize("light", ["sky", "sun"])
@pytest.mark.parametrize(
    "inputs",
    [
        {"subsurface_scale": 0.3, "roughness": 0.5},
        {"subsurface_scale": 10.0, "roughness": 0.3},
        {"subsurface_scale": 3.0, "subsurface_anisotropy": 0.6, "subsurface_weight": 0.5},
        {"subsurface_scale": 0.5, "subsurface_method": "RANDOM_WALK_SKIN"},
    ],
    ids=["near", "far", "forward", "skin"],
)
def test_random_walks(scene, tmp_path, inputs, light):
    ball(scene, material("BsdfPrincipled", **(SKIN | inputs)))
    lit(scene, light)
    check(scene, tmp_path, 400, tolerance=0.03)


def test_random_walks_that_are_guided(scene, tmp_path):
    ball(scene, material("BsdfPrincipled", **(SKIN | {"subsurface_scale": 1.0})))
    lit(scene, "sun")
    check(scene, tmp_path, 400, tolerance=0.03, sampling="full")


def test_the_shader_without_a_surface(scene, tmp_path):
    ball(scene, material("SubsurfaceScattering", color=(0.8, 0.5, 0.3), scale=1.0, radius=(1, 0.5, 0.25)))
    lit(scene, "sun")
    check(scene, tmp_path, 400, tolerance=0.03)


def test_colours_that_vary(scene, tmp_path):
    def wire(tree, socket):
        ramp = node(tree, "ValToRGB")
        ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (0.2, 0.4, 0.9, 1), (0.9, 0.6, 0.3, 1)
        link(tree, node(tree, "TexGradient"), ramp.inputs[0], 1)
        link(tree, ramp, socket)

    inputs = {name: value for name, value in SKIN.items() if name != "base_color"}
    ball(scene, takes("BsdfPrincipled", "Base Color", wire, subsurface_scale=0.3, **inputs))
    lit(scene, "sky")
    check(scene, tmp_path, 400, tolerance=0.03, bake_resolution=256)


def test_what_does_not_absorb_is_as_bright_as_the_light(scene):
    sky(scene, (1, 1, 1))
    ball(scene, material("BsdfPrincipled", **(SKIN | {"base_color": (1, 1, 1), "subsurface_scale": 1.0, "roughness": 0.0})))
    ours = wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image
    assert ours.mean() == pytest.approx(1, abs=0.02) and np.isfinite(ours).all()
