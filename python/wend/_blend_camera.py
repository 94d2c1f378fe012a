"""Blender's camera and film."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._blend_motion import Motion
from ._blend_panorama import panorama_of
from ._blend_settings import tell_of_camera
from ._errors import InputError
from ._scene_reader import SceneReader

#: Of Blender's camera, which looks along -z, to pbrt's.
_CAMERA = np.diag([1.0, 1.0, -1.0, 1.0])


def expect_camera(scene: Any, eye: Any) -> None:
    """
    Raises:
        InputError: where `eye` is no object of a camera.
    """
    if eye is None or eye.type != "CAMERA":
        raise InputError(f"{scene.name}: error: the scene has no camera")


def add_view(
    reader: SceneReader, scene: Any, eye: Any, resolution: tuple[int, int] | None, spp: int, motion: Motion, brightness: float
) -> None:
    """Adds camera, film, filter, sampler and integrator.

    Args:
        eye: the camera's object.
        brightness: multiplies the picture.
    """
    add, render, cycles = reader.builder.add, scene.render, getattr(scene, "cycles", None)
    if resolution is None:
        resolution = size_of(render)
    _add_camera(reader, scene, eye, resolution, motion)
    film: dict[str, Any] = {"integer xresolution": resolution[0], "integer yresolution": resolution[1]}
    exposure = brightness * (float(cycles.film_exposure) if cycles is not None else 1.0)
    if exposure != 1:
        film["float iso"] = 100 * exposure
    if render.use_border:
        # From the left and from below; pbrt's from above.
        film["float cropwindow"] = (
            render.border_min_x,
            render.border_max_x,
            1 - render.border_max_y,
            1 - render.border_min_y,
        )
    add("Film", "rgb", film)
    if cycles is not None and cycles.pixel_filter_type == "BOX":
        add("PixelFilter", "box")
    else:
        radius = float(cycles.filter_width) if cycles is not None else 1.5
        add("PixelFilter", "gaussian", {"float xradius": radius, "float yradius": radius, "float sigma": radius / 3})
    add("Sampler", "sobol", {"integer pixelsamples": spp})
    add("Integrator", "volpath", {"integer maxdepth": 100})


def size_of(render: Any) -> tuple[int, int]:
    """Of the picture, in pixels: whole per cents of whole pixels, as Blender rounds them."""
    width, height = (side * render.resolution_percentage // 100 for side in (render.resolution_x, render.resolution_y))
    return max(width, 1), max(height, 1)


def _add_camera(reader: SceneReader, scene: Any, eye: Any, resolution: tuple[int, int], motion: Motion) -> None:
    camera = eye.data
    place = f"camera '{eye.name}'"
    reader.put(np.asarray(np.linalg.inv(_CAMERA @ motion.of_camera(eye)), dtype=np.float64))
    tell_of_camera(reader, place, camera)
    if motion.changes_lens:
        reader.tell(place, "a lens that changes while the shutter is open stays as it is at the frame")
    parameters = _lens_of(eye)
    if camera.type == "PANO":
        reader.builder.add("Camera", "panorama", parameters | panorama_of(reader, place, scene, camera, resolution))
        return
    parameters["float screenwindow"] = _window_of(scene, camera, resolution)
    if camera.type == "ORTHO":
        reader.builder.add("Camera", "orthographic", parameters)
    else:
        reader.builder.add("Camera", "perspective", parameters | {"float fov": 90})


def _lens_of(eye: Any) -> dict[str, Any]:
    """Of the depth of field."""
    camera = eye.data
    dof = camera.dof
    if not dof.use_dof:
        return {}
    distance = float(dof.focus_distance)
    if dof.focus_object is not None:
        matrix = np.array(eye.matrix_world.normalized(), dtype=np.float64)
        offset = np.array(dof.focus_object.matrix_world.translation) - np.array(eye.matrix_world.translation)
        distance = abs(float(offset @ matrix[:3, 2]))
    size = 1.0 if camera.type == "ORTHO" else camera.lens * 1e-3
    return {
        "float lensradius": size / (2 * max(dof.aperture_fstop, 1e-5)),
        "float focaldistance": max(distance, 1e-5),
    }


def _window_of(scene: Any, camera: Any, resolution: tuple[int, int]) -> Any:
    """What the camera sees at a distance of 1: left, right, bottom, top."""
    render = scene.render
    width = resolution[0] * render.pixel_aspect_x
    height = resolution[1] * render.pixel_aspect_y
    fit = camera.sensor_fit
    if fit == "AUTO":
        fit = "HORIZONTAL" if width >= height else "VERTICAL"
        sensor = camera.sensor_width
    else:
        sensor = camera.sensor_width if fit == "HORIZONTAL" else camera.sensor_height
    size = float(camera.ortho_scale) if camera.type == "ORTHO" else sensor / max(camera.lens, 1e-6)
    longest = width if fit == "HORIZONTAL" else height
    x, y = size * width / longest / 2, size * height / longest / 2
    # Shifts are parts of the larger side.
    return np.array(
        [-x + camera.shift_x * size, x + camera.shift_x * size, -y + camera.shift_y * size, y + camera.shift_y * size]
    )
