"""Blender's cameras, and what moves before them, against Cycles."""

import warnings

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    SIZE,
    add,
    blocks,
    by_cycles,
    camera,
    check,
    floor,
    lamp,
    material,
    mesh,
    scene,
    sky,
    straight,
    told,
)

from wend import blend  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


@pytest.mark.parametrize(
    "settings",
    [
        {"type": "ORTHO", "ortho_scale": 5},
        {"lens": 35, "shift_x": 0.2, "shift_y": -0.1},
        {"sensor_fit": "VERTICAL", "sensor_height": 30, "lens": 40},
    ],
    ids=["orthographic", "shifted", "vertical"],
)
def test_cameras(scene, tmp_path, settings):
    scene.render.resolution_x = 2 * SIZE
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    mesh(scene, "cube", material("Emission", color=(1, 0, 0)), place=(1, 0.5, 0.5), stretch=(0.5, 0.3, 0.6))
    camera(scene, (0, -6, 3), (0, 0, 0.5), **settings)
    theirs = by_cycles(scene, tmp_path, 64)
    ours = wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image
    # Where the cube is, within a pixel's edge.
    assert np.abs(ours[..., 0] - theirs[..., 0]).mean() < 0.02


@pytest.mark.parametrize(("width", "height", "percentage"), [(1280, 720, 70), (1280, 720, 35), (33, 17, 50)])
def test_a_share_of_the_size_is_rounded_as_in_blender(scene, tmp_path, width, height, percentage):
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, percentage
    seen = by_cycles(scene, tmp_path, 1).shape
    assert blend.of_scene(scene).scene().resolution == (seen[1], seen[0])


def test_depth_of_field(scene, tmp_path):
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    mesh(scene, "cube", material("Emission", color=(1, 0.5, 0.2)), place=(0.5, 1, 0.5), stretch=(0.4, 0.4, 0.4))
    camera(scene, (0, -6, 3), (0, 0, 0.5))
    scene.camera.data.dof.use_dof = True
    scene.camera.data.dof.focus_distance = 3
    scene.camera.data.dof.aperture_fstop = 0.1
    check(scene, tmp_path, 1000)


@pytest.mark.parametrize("what", ["object", "camera", "instances"])
@pytest.mark.parametrize("position", ["START", "CENTER"])
def test_motion_blur(scene, tmp_path, what, position):
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    ball = mesh(scene, "cube", material("BsdfDiffuse", color=(0.9, 0.2, 0.1)), place=(0, 0, 1))
    if what == "instances":
        add(scene, "twin", ball.data, (0, 2, 2), size=(0.5, 0.5, 0.5))
    moving = scene.camera if what == "camera" else ball
    straight(moving)
    scene.frame_set(2)
    still = wend.render(blend.of_scene(scene, spp=16).scene(), sampling="classical").image
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter, scene.render.motion_blur_position = 0.8, position
    ours = check(scene, tmp_path, 1000)
    # What stood still would be refused.
    assert np.abs(blocks(still) / blocks(ours) - 1).max() > 0.05
    assert scene.frame_current == 2 and scene.frame_subframe == 0


@pytest.mark.parametrize("smooth", [False, True])
def test_what_deforms_is_blurred(scene, tmp_path, smooth):
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    lamp(scene, "SUN", 2, (0, 0, 5), (0.5, 0.3, 0), angle=0)
    ball = mesh(scene, "uv_sphere", material("BsdfDiffuse", color=(0.9, 0.2, 0.1)), smooth, place=(0, 0, 1))
    ball.shape_key_add(name="rest")
    key = ball.shape_key_add(name="long")
    for point in key.data:
        point.co.x, point.co.z = 2.5 * point.co.x, 0.5 * point.co.z
    for frame, value in ((1, 0.0), (3, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    for curve in ball.data.shape_keys.animation_data.action.layers[0].strips[0].channelbags[0].fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.frame_set(1)
    still = wend.render(blend.of_scene(scene, spp=64).scene(), sampling="classical").image
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.8
    scene.render.motion_blur_position = "START"
    ours = check(scene, tmp_path, 1000, tolerance=0.015)
    # What stood still would be refused.
    assert np.abs(blocks(still) / blocks(ours) - 1).max() > 0.05


def test_what_changes_its_number_of_points_is_named(scene):
    cube = mesh(scene, "cube")
    array = cube.modifiers.new("array", "ARRAY")
    array.count = 1
    array.keyframe_insert("count", frame=1)
    array.count = 3
    array.keyframe_insert("count", frame=3)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.8
    with pytest.warns(wend.SceneWarning, match="changes its number of points"):
        assert "P1" not in blend.of_scene(scene).text()


def test_what_goes_along_a_curve_while_the_shutter_is_open_is_named(scene):
    cube = mesh(scene, "cube")
    for frame, place in ((1, (0, 0, 0)), (2, (1, 1, 0)), (3, (2, 0, 0))):
        cube.location = place
        cube.keyframe_insert("location", frame=frame)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.8
    assert f"object '{cube.name}': warning: what goes along a curve" in told(scene)


def test_what_goes_straight_is_not_named(scene):
    straight(mesh(scene, "cube"))
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.8
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        blend.of_scene(scene)
    assert not [w for w in found if "curve" in str(w.message)]


def test_a_lens_that_changes_while_the_shutter_is_open_is_named(scene):
    for frame, lens in ((1, 30), (3, 60)):
        scene.camera.data.lens = lens
        scene.camera.data.keyframe_insert("lens", frame=frame)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.8
    assert "a lens that changes while the shutter is open" in told(scene)


PANORAMAS = {
    "around": {"panorama_type": "EQUIRECTANGULAR"},
    "a part": {"panorama_type": "EQUIRECTANGULAR", "longitude_min": -1.0, "longitude_max": 2.0, "latitude_min": -1.2, "latitude_max": 0.3},
    "equidistant": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 4.0},
    "equisolid": {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_lens": 11.0, "fisheye_fov": 3.5, "sensor_width": 30.0},
    "polynomial": {"panorama_type": "FISHEYE_LENS_POLYNOMIAL", "fisheye_fov": 2.6, "fisheye_polynomial_k1": -0.06},
    "ball": {"panorama_type": "MIRRORBALL"},
    "face": {"panorama_type": "EQUIANGULAR_CUBEMAP_FACE"},
    "cylinder": {"panorama_type": "CENTRAL_CYLINDRICAL", "central_cylindrical_range_v_max": 1.5, "central_cylindrical_radius": 1.2},
    "shifted": {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_fov": 6.0, "shift_x": 0.1, "shift_y": -0.2},
    "with a lens": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 4.0, "lens": 500.0},
}


@pytest.mark.parametrize("name", PANORAMAS)
def test_panoramas(scene, tmp_path, name):
    scene.render.resolution_x = 2 * SIZE if name in ("around", "equisolid", "cylinder") else SIZE
    floor(scene)
    sky(scene, (0.2, 0.3, 0.5))
    for place, colour in (((2, 0, 0.5), (1, 0, 0)), ((-2, 1, 1), (0, 1, 0)), ((0.5, -2, 0.5), (0, 0, 1))):
        mesh(scene, "cube", material("Emission", color=colour), place=place, stretch=(0.5, 0.5, 0.5))
    camera(scene, (0, 0, 1), (1, 2, 1.3), type="PANO", **PANORAMAS[name])
    if name == "with a lens":
        scene.camera.data.dof.use_dof = True
        scene.camera.data.dof.focus_distance, scene.camera.data.dof.aperture_fstop = 1.5, 0.8
    theirs = by_cycles(scene, tmp_path, 1600)
    ours = wend.render(blend.of_scene(scene, spp=1600).scene(), sampling="classical").image
    # Wide ones are two squares.
    for left in range(0, ours.shape[1], SIZE):
        a, b = (blocks(picture[:, left : left + SIZE]) for picture in (ours, theirs))
        error = np.abs(a - b) / np.maximum(b, 0.05 * b.mean())
        assert error.max() <= 0.01, f"\n{np.round(a / np.maximum(b, 1e-6), 3)}"
    # What the film does not see is dark in both.
    assert not (ours[theirs.max(axis=2) == 0] > 0.02).any() and not (theirs[ours.max(axis=2) == 0] > 0.02).any()
