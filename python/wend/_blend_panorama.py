"""Blender's panoramic cameras: fisheyes, cylinders, parts of the sphere."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._scene_reader import SceneReader


def panorama_of(
    reader: SceneReader, place: str, scene: Any, camera: Any, resolution: tuple[int, int]
) -> dict[str, Any]:
    """The parameters of a camera "panorama"."""
    # Until Blender 5 these are settings of Cycles.
    settings = camera if hasattr(camera, "panorama_type") else camera.cycles
    kind = settings.panorama_type
    fisheye = {"float fov": min(float(np.rad2deg(settings.fisheye_fov)), 720.0)}
    own: dict[str, Any]
    if kind == "FISHEYE_EQUIDISTANT":
        half = np.deg2rad(fisheye["float fov"]) / 2
        window, own = (-half, half, -half, half), {"string mapping": "equidistant"} | fisheye
    elif kind == "FISHEYE_EQUISOLID":
        width, height = _sensor_of(scene, camera, resolution)
        x, y = width / (2 * settings.fisheye_lens), height / (2 * settings.fisheye_lens)
        window, own = (-x, x, -y, y), {"string mapping": "equisolid"} | fisheye
        own["float fov"] = min(own["float fov"], 360.0)
    elif kind == "FISHEYE_LENS_POLYNOMIAL":
        width, height = _sensor_of(scene, camera, resolution)
        # The sign is the other way round there.
        coefficients = [-getattr(settings, f"fisheye_polynomial_k{i}") for i in range(5)]
        window = (-width / 2, width / 2, -height / 2, height / 2)
        own = {"string mapping": "polynomial", "float coefficients": np.array(coefficients)} | fisheye
    elif kind == "MIRRORBALL":
        window, own = (-1, 1, -1, 1), {"string mapping": "mirrorball"}
    elif kind == "EQUIANGULAR_CUBEMAP_FACE":
        eighth = np.pi / 4
        window, own = (-eighth, eighth, -eighth, eighth), {"string mapping": "cubeface"}
    elif kind == "CENTRAL_CYLINDRICAL":
        name, radius = "central_cylindrical", max(settings.central_cylindrical_radius, 1e-6)
        ends = [getattr(settings, f"{name}_range_{end}") for end in ("u_min", "u_max", "v_min", "v_max")]
        window = (ends[0], ends[1], ends[2] / radius, ends[3] / radius)
        own = {"string mapping": "cylindrical"}
    else:
        if kind != "EQUIRECTANGULAR":
            reader.tell(place, f"a panoramic camera of the kind {kind} is taken as an equirectangular one")
        names = ("longitude_min", "longitude_max", "latitude_min", "latitude_max")
        window, own = tuple(getattr(settings, name) for name in names), {"string mapping": "equirectangular"}
    return own | {"float screenwindow": _shifted(window, camera)}


def _shifted(window: Any, camera: Any) -> Any:
    left, right, bottom, top = (float(edge) for edge in window)
    x, y = camera.shift_x * (right - left), camera.shift_y * (top - bottom)
    return np.array([left + x, right + x, bottom + y, top + y])


def _sensor_of(scene: Any, camera: Any, resolution: tuple[int, int]) -> tuple[float, float]:
    """What the picture takes of the sensor, in millimetres."""
    render = scene.render
    width, height = resolution[0] * render.pixel_aspect_x, resolution[1] * render.pixel_aspect_y
    fit = camera.sensor_fit
    if fit == "AUTO":
        is_wide, size = width >= height, camera.sensor_width
    else:
        is_wide = fit == "HORIZONTAL"
        size = camera.sensor_width if is_wide else camera.sensor_height
    return (size, size * height / width) if is_wide else (size * width / height, size)
