"""Where things of Blender are when the shutter opens and when it closes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._blend_shapes import Geometry

Matrix = npt.NDArray[np.float64]

#: Where the frame lies between the opening of the shutter (0) and its closing.
_SHARES = {"START": 0.0, "CENTER": 0.5, "END": 1.0}


def rows(matrix: Any) -> Matrix:
    """Of a matrix of Blender, with points as rows."""
    return np.array(matrix, dtype=np.float64).T


class Motion:
    """Places and shapes at both ends of the shutter; one place twice where there is no motion blur.

    Args:
        scene: whose frame is rendered.
        eye: the camera.
        depsgraph: evaluated at that frame, before and afterwards.
        set_frame: evaluates it at a frame and a part of one.
    """

    def __init__(self, scene: Any, eye: Any, depsgraph: Any, set_frame: Callable[[int, float], Any]) -> None:
        self._ends: list[dict[Any, Matrix]] = []
        self._shapes: list[dict[str, Geometry]] = []
        self.bent: list[str] = []  #: what does not go straight and evenly
        self.changes_lens = False
        render = scene.render
        self.is_on = bool(render.use_motion_blur) and render.motion_blur_shutter > 0
        if not self.is_on:
            return
        frame, part = scene.frame_current, scene.frame_subframe
        opening = frame + part - _SHARES[render.motion_blur_position] * render.motion_blur_shutter
        lenses = []
        for share in (0, 0.5, 1):
            time = opening + share * render.motion_blur_shutter
            whole = int(np.floor(time))
            set_frame(whole, float(time - whole))
            depsgraph.update()
            places, shapes = {}, {}
            for instance in depsgraph.object_instances:
                places[_key(instance)] = rows(instance.matrix_world)
                name = instance.object.name_full
                if share != 0.5 and name not in shapes and _may_change(scene, instance.object):
                    shapes[name] = _shape_of(instance.object)
            if eye is not None:
                seen_by = eye.evaluated_get(depsgraph)
                places[None] = rows(seen_by.matrix_world.normalized())
                lenses.append(_lens(seen_by.data))
            if share == 0.5:
                half_way = places
                continue
            self._ends.append(places)
            self._shapes.append({name: shape for name, shape in shapes.items() if shape is not None})
        self.changes_lens = any(lens != lenses[0] for lens in lenses)
        start, end = self._ends
        bent = [key for key, place in half_way.items() if key in start and key in end and _is_bent(start[key], place, end[key])]
        self.bent = sorted(f"object '{key[0]}'" if key else "the camera" for key in bent)
        set_frame(frame, part)
        depsgraph.update()

    def places(self, instance: Any) -> Matrix:
        """(2, 4, 4), of an instance of the depsgraph."""
        still = not getattr(getattr(instance.object, "cycles", None), "use_motion_blur", True)
        return self._between(_key(instance), rows(instance.matrix_world), still)

    def shapes(self, object_: Any) -> tuple[Geometry, Geometry] | None:
        """Of a mesh that changes its shape, or its number of points; None for others."""
        name = object_.name_full
        if any(name not in shapes for shapes in self._shapes) or not self._shapes:
            return None
        start, end = (shapes[name] for shapes in self._shapes)
        return None if start.points.shape == end.points.shape and np.array_equal(start.points, end.points) else (start, end)

    def of_camera(self, eye: Any) -> Matrix:
        """(2, 4, 4), without a scale."""
        return self._between(None, rows(eye.matrix_world.normalized()), False)

    def _between(self, key: Any, now: Matrix, still: bool) -> Matrix:
        # What is not there all the time stays where it is at the frame.
        if still or not self._ends or any(key not in places for places in self._ends):
            return np.array([now, now])
        return np.array([places[key] for places in self._ends])


def _is_bent(start: Matrix, half_way: Matrix, end: Matrix) -> bool:
    """Whether something is elsewhere half way than between both ends, by where its origin is."""
    least = 0.05
    a, b, c = start[3, :3], half_way[3, :3], end[3, :3]
    return bool(np.linalg.norm(b - (a + c) / 2) > least * max(np.linalg.norm(b - a), np.linalg.norm(c - b)) + 1e-5 * np.linalg.norm(b))


def _lens(camera: Any) -> tuple[float, ...]:
    return (camera.lens, camera.ortho_scale, camera.shift_x, camera.shift_y) if hasattr(camera, "lens") else ()


def _may_change(scene: Any, object_: Any) -> bool:
    cycles = getattr(object_, "cycles", None)
    if object_.type != "MESH" or not (getattr(cycles, "use_motion_blur", True) and getattr(cycles, "use_deform_motion", True)):
        return False
    original = object_.original
    return bool(original.is_deform_modified(scene, "RENDER") or original.is_modified(scene, "RENDER"))


def _shape_of(object_: Any) -> Geometry | None:
    mesh = object_.to_mesh()
    if mesh is None:
        return None
    try:
        return Geometry.of(mesh)
    finally:
        object_.to_mesh_clear()


def _key(instance: Any) -> Any:
    parent = instance.parent.name_full if instance.is_instance and instance.parent else ""
    return instance.object.name_full, parent, tuple(instance.persistent_id) if instance.is_instance else ()
