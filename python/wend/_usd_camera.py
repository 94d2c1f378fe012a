"""Cameras of USD, and a view of all where there is none."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pxr import Gf, Tf, Usd, UsdGeom  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _usd_settings as settings
from ._errors import InputError
from ._usd_subdivision import View

#: How many instancers may be within what others copy.
_DEEPEST = 32


def find(reader: Any, path: str | None) -> Any:
    """The prim: of that path, or the one of the stage's render settings, or the first; None where the stage has none."""
    if path is None:
        named = settings.camera_of(reader.stage)
        if named is not None:
            return named
        return next((p for p in reader.prims(reader.stage.GetPseudoRoot()) if p.IsA(UsdGeom.Camera)), None)
    prim = reader.stage.GetPrimAtPath(path)
    if not prim or not prim.IsA(UsdGeom.Camera):
        raise InputError(f"{path}: error: no camera of the stage")
    return prim


def add(reader: Any, prim: Any, resolution: tuple[int, int]) -> None:
    if prim is None:
        reader.warn(reader.stage.GetPseudoRoot(), "no camera: one is put where all can be seen")
        view_of_all(reader, resolution)
        return
    camera = UsdGeom.Camera(prim)
    lens = camera.GetCamera(reader.time)
    shutter = [camera.GetShutterOpenAttr().Get(reader.time), camera.GetShutterCloseAttr().Get(reader.time)]
    if shutter[0] < shutter[1] and not reader.time.IsDefault() and settings.has_blur(reader.stage):
        reader.shutter = [Usd.TimeCode(reader.time.GetValue() + offset) for offset in shutter]
        reader.transforms = [UsdGeom.XformCache(time) for time in reader.shutter]
    _tell_of_clipping(reader, prim, camera)
    sizes = np.array([lens.horizontalAperture, lens.verticalAperture, lens.focalLength])
    if not (np.isfinite(sizes).all() and sizes.min() > 0):
        raise InputError(f"{prim.GetPath()}: error: a camera needs apertures and a focal length above 0, not {sizes.tolist()}")
    # A tenth of a scene unit, which is a millimetre where that is a centimetre.
    width, height = lens.horizontalAperture, lens.verticalAperture
    shift = (lens.horizontalApertureOffset, lens.verticalApertureOffset)
    width, height = settings.aperture(reader.stage, width, height, resolution)
    window = np.array([shift[0] - width / 2, shift[0] + width / 2, shift[1] - height / 2, shift[1] + height / 2])
    # A camera of USD looks along its -z.
    places = reader.world(prim)
    reader.put(np.asarray(np.linalg.inv(np.diag([1, 1, -1, 1]) @ places), dtype=np.float64))
    is_parallel = lens.projection == Gf.Camera.Orthographic
    pixel = width / (10 if is_parallel else lens.focalLength) / resolution[0]
    reader.refinement.view = View(places[0, 3, :3], pixel, is_parallel)
    if is_parallel:
        reader.builder.add("Camera", "orthographic", {"float screenwindow": window / 10})
        return
    parameters: dict[str, Any] = {"float fov": 90, "float screenwindow": window / lens.focalLength}
    f_stop = lens.fStop if settings.has_depth_of_field(reader.stage) else 0
    if f_stop > 0 and not lens.focusDistance > 0:
        reader.warn(prim, "a camera that is focused on nothing sees all sharply")
    elif f_stop > 0:
        parameters["float lensradius"] = lens.focalLength / 10 / (2 * f_stop)
        parameters["float focaldistance"] = lens.focusDistance
    reader.builder.add("Camera", "perspective", parameters)


def exposure(reader: Any, prim: Any) -> float:
    """What a camera multiplies radiance with.

    Raises:
        InputError: where that is no number above 0.
    """
    if prim is None:
        return 1.0
    camera = UsdGeom.Camera(prim)
    if hasattr(camera, "ComputeLinearExposureScale"):
        factor = float(camera.ComputeLinearExposureScale(reader.time))
    else:
        # Before USD 25.05 all of a camera's exposure was this.
        factor = float(np.exp2(camera.GetExposureAttr().Get(reader.time)))
    if not (math.isfinite(factor) and factor > 0):
        raise InputError(f"{prim.GetPath()}: error: the camera's exposure multiplies with {factor:.4g}")
    return factor


def _tell_of_clipping(reader: Any, prim: Any, camera: Any) -> None:
    near = camera.GetClippingRangeAttr()
    # A tenth of a metre is what Blender's cameras have by themselves.
    if near.HasAuthoredValue() and near.Get(reader.time)[0] * UsdGeom.GetStageMetersPerUnit(reader.stage) > 0.1001:
        reader.warn(prim, f"what is nearer than {near.Get(reader.time)[0]:.4g} is not clipped")
    if camera.GetClippingPlanesAttr().Get(reader.time):
        reader.warn(prim, "planes that clip are left out")


def view_of_all(reader: Any, resolution: tuple[int, int]) -> None:
    aspect = resolution[0] / resolution[1]
    box = _bounds(reader)
    middle = np.zeros(3) if box.IsEmpty() else np.array(box.GetMidpoint())
    radius = 1.0 if box.IsEmpty() else max(float(np.linalg.norm(np.array(box.GetSize()))) / 2, 1e-6)
    upwards = np.array([0, 0, 1.0]) if UsdGeom.GetStageUpAxis(reader.stage) == UsdGeom.Tokens.z else np.array([0, 1.0, 0])
    forwards = np.array([0, 1.0, 0]) if upwards[2] else np.array([0, 0, -1.0])
    fov = 40.0
    eye = middle + (0.35 * upwards - forwards) * radius / math.sin(math.radians(fov / 2)) / min(aspect, 1)
    reader.refinement.view = View(eye, 2 * math.tan(math.radians(fov / 2)) / min(resolution))
    # The camera's own axes are of the other hand, as pbrt's are.
    reader.builder.add("Scale", -1, 1, 1)
    reader.builder.add("LookAt", eye, middle, upwards)
    reader.builder.add("Camera", "perspective", {"float fov": fov})


def _bounds(reader: Any) -> Any:
    """Of what is to be seen, in the world."""
    bounds = UsdGeom.BBoxCache(reader.time, reader.purposes)
    box = Gf.Range3d()
    for prim in reader.prims(reader.stage.GetPseudoRoot()):
        # USD never ends with an instancer that copies itself.
        if not prim.IsA(UsdGeom.Boundable) or _copies_itself(reader.stage, prim, []):
            continue
        try:
            box.UnionWith(bounds.ComputeWorldBound(prim).ComputeAlignedRange())
        except Tf.ErrorException:
            # What is wrong with it is said where it is read.
            continue
    return box


def _copies_itself(stage: Any, prim: Any, above: list[Any]) -> bool:
    """`above` are the instancers that it is within a copy of."""
    if not prim.IsA(UsdGeom.PointInstancer):
        return False
    if prim.GetPath() in above:
        return True
    roots = (stage.GetPrimAtPath(target) for target in UsdGeom.PointInstancer(prim).GetPrototypesRel().GetForwardedTargets())
    parts = (part for root in roots if root for part in Usd.PrimRange(root))
    return len(above) > _DEEPEST or any(_copies_itself(stage, part, [*above, prim.GetPath()]) for part in parts)
