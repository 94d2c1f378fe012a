"""Blender's geometry as arrays of the renderer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._scene_reader import Brush, Look, SceneReader

Parameters = dict[str, Any]


def _taken(collection: Any, attribute: str, width: int, kind: type) -> npt.NDArray[Any]:
    values: npt.NDArray[Any] = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width) if width > 1 else values


@dataclass
class Geometry:
    """What of a mesh changes with time."""

    points: npt.NDArray[np.float32]
    normals: npt.NDArray[np.float32] | None  #: of points, where smooth faces have those
    corner_normals: npt.NDArray[np.float32] | None

    @staticmethod
    def of(mesh: Any) -> Geometry:
        # Flat faces need no normals, smooth ones have those of their points.
        domain = mesh.normals_domain
        return Geometry(
            _taken(mesh.vertices, "co", 3, np.float32),
            _taken(mesh.vertex_normals, "vector", 3, np.float32) if domain == "POINT" else None,
            _taken(mesh.corner_normals, "vector", 3, np.float32) if domain == "CORNER" else None,
        )

    def goes_with(self, other: Geometry) -> bool:
        """Whether both may be the same mesh at two times."""

        def shape_of(array: npt.NDArray[np.float32] | None) -> tuple[int, ...]:
            return () if array is None else array.shape

        pairs = ((self.points, other.points), (self.normals, other.normals), (self.corner_normals, other.corner_normals))
        return all(shape_of(a) == shape_of(b) for a, b in pairs)

    def taken(
        self, names: tuple[str, str], points: npt.NDArray[np.int32], corners: npt.NDArray[np.int32] | None
    ) -> Parameters:
        """Points and normals of vertices, which are points, and corners where they need that."""
        parameters: Parameters = {names[0]: self.points[points]}
        if self.normals is not None:
            parameters[names[1]] = self.normals[points]
        elif self.corner_normals is not None:
            parameters[names[1]] = self.corner_normals[corners]
        return parameters


def is_open(mesh: Any) -> bool:
    """Whether it has a rim: an edge of one face alone."""
    edges = _taken(mesh.loops, "edge_index", 1, np.int32)
    return bool((np.bincount(edges) == 1).any()) if len(edges) else False


def triangles_of(mesh: Any) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
    """Points, and numbers of those of each triangle."""
    mesh.calc_loop_triangles()
    return _taken(mesh.vertices, "co", 3, np.float32).astype(np.float64), _taken(mesh.loop_triangles, "vertices", 3, np.int32)


def mesh_parts(
    mesh: Any, ends: tuple[Geometry, Geometry] | None, uvs: npt.NDArray[np.float32] | None = None
) -> Iterator[tuple[int, Parameters]]:
    """Of an evaluated mesh, the triangles of each material: its number, and the parameters of a "trianglemesh".

    Args:
        mesh: as it is at the frame.
        ends: what goes with it where the shutter opens and where it closes; None: it does not change.
        uvs: of corners, in place of the mesh's; None: those.
    """
    mesh.calc_loop_triangles()
    if not len(mesh.loop_triangles):
        return
    corners = _taken(mesh.loop_triangles, "loops", 3, np.int32)
    vertices = _taken(mesh.loop_triangles, "vertices", 3, np.int32)
    materials = _taken(mesh.loop_triangles, "material_index", 1, np.int32)
    start, end = ends or (Geometry.of(mesh), None)
    layer = next((layer for layer in mesh.uv_layers if layer.active_render), None)
    coordinates = uvs
    if coordinates is None and layer is not None:
        coordinates = _taken(layer.uv, "vector", 2, np.float32)
    for number in np.unique(materials):
        chosen = materials == number
        if coordinates is None and start.corner_normals is None:
            points, indices = np.unique(vertices[chosen], return_inverse=True)
            loops = None
        else:
            points, loops = vertices[chosen].reshape(-1), corners[chosen].reshape(-1)
            indices = np.arange(len(points))
        parameters: Parameters = {"integer indices": indices.reshape(-1, 3).astype(np.int32)}
        parameters |= start.taken(("point3 P", "normal3 N"), points, loops)
        if end is not None:
            parameters |= end.taken(("point3 P1", "normal3 N1"), points, loops)
        if coordinates is not None:
            parameters["point2 uv"] = coordinates[loops]
        yield int(number), parameters


#: Triangles of a mesh that are looked at.
_SOME = 20000


def lean(parts: list[tuple[Look, Parameters]]) -> float:
    """By how many degrees the normals of a mesh lean from its faces, on average over their area."""
    total = area = 0.0
    for _, parameters in parts:
        if "normal3 N" in parameters:
            indices = parameters["integer indices"]
            corners = indices[:: max(len(indices) // _SOME, 1)]
            a, b, c = (parameters["point3 P"][corners[:, k]].astype(np.float64) for k in range(3))
            across = np.cross(b - a, c - a)
            size = np.linalg.norm(across, axis=1)
            normals = np.asarray(parameters["normal3 N"], dtype=np.float64)[corners]
            cosines = np.einsum("ijk,ik->ij", normals, across / np.maximum(size, 1e-30)[:, None]).clip(-1, 1)
            # As far as the eye is concerned a normal has two sides.
            total += float(size @ np.degrees(np.arccos(np.abs(cosines))).mean(axis=1))
            area += float(size.sum())
    return total / area if area > 0 else 0.0


#: Of the size of a mesh, how far below it what it encloses begins where it is partly there.
_BELOW = 2e-4


def shrunk(parameters: Parameters) -> Parameters:
    """A mesh a little below another one, without what is of surfaces alone."""
    indices = np.asarray(parameters["integer indices"])

    def below(points: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        # Points at one place stay together.
        places, of_place = np.unique(points, axis=0, return_inverse=True)
        corners = of_place.reshape(-1)[indices]
        a, b, c = (places[corners[:, k]].astype(np.float64) for k in range(3))
        across = np.cross(b - a, c - a)
        normals = np.zeros((len(places), 3))
        for k in range(3):
            np.add.at(normals, corners[:, k], across)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        size = float(np.linalg.norm(np.ptp(places, axis=0)))
        return np.asarray(points - _BELOW * size * normals[of_place.reshape(-1)], dtype=np.float32)

    moved = {name: below(parameters[name]) for name in ("point3 P", "point3 P1") if name in parameters}
    return moved | {"integer indices": parameters["integer indices"]}


def brush(reader: SceneReader, name: str, parts: list[tuple[Look, Parameters]], place: npt.NDArray[np.float64]) -> None:
    """Adds to those parts of a mesh that are brushed along which way: around an axis of the box of all points. As Cycles
    has it, that goes to the world as normals do, by `place`, which has points as rows."""
    if all(look.brushed is None for look, _ in parts):
        return
    points = np.concatenate([parameters["point3 P"] for _, parameters in parts]).astype(np.float64)
    low, high = points.min(axis=0), points.max(axis=0)
    for look, parameters in parts:
        if look.brushed is not None:
            offset = (parameters["point3 P"] - (low + high) / 2) / np.maximum(high - low, 1e-30)
            along = _brushed(reader, name, parameters, look.brushed, offset)
            inverse = np.linalg.pinv(place[:3, :3])
            parameters["vector3 S"] = (along @ inverse.T @ inverse).astype(np.float32)


def _brushed(
    reader: SceneReader, name: str, parameters: Parameters, brush: Brush, offset: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    first, second = [(1, 2), (2, 0), (0, 1)][brush.axis]
    along = np.zeros_like(offset)
    along[:, first], along[:, second] = -offset[:, second], offset[:, first]
    if brush.turns != 0:
        if "normal3 N" not in parameters:
            reader.tell(f"object '{name}'", "how flat faces are brushed is not turned")
        else:
            normals = np.asarray(parameters["normal3 N"], dtype=np.float64)
            flat = along - normals * (normals * along).sum(axis=1, keepdims=True)
            angle = 2 * np.pi * brush.turns
            along = np.cos(angle) * flat + np.sin(angle) * np.cross(normals, flat)
    return along


def hair_segments(curves: Any) -> Iterator[Parameters]:
    """Of a hair object, each curve as the parameters of a "curve": a B-spline through its points."""
    points = _taken(curves.points, "position", 3, np.float32)
    radii = _taken(curves.points, "radius", 1, np.float32)
    for curve in curves.curves:
        first, count = curve.first_point_index, curve.points_length
        yield from _segments(points[first : first + count], radii[first : first + count])


def strands(system: Any, modifier: Any, object_: Any) -> Iterator[Parameters]:
    """Of a particle system that grows hair, in the world."""
    settings = system.settings
    steps = 2**settings.render_step + 1
    # They are diameters, whatever they are called.
    root, tip = (settings.radius_scale / 2 * width for width in (settings.root_radius, settings.tip_radius))
    radii = _tapered(root, tip, settings.shape, steps)
    if settings.use_close_tip:
        radii[-1] = 0
    parents, children = len(system.particles), len(system.child_particles)
    # Where there are children their parents are not seen.
    for particle in range(parents if settings.child_type != "NONE" and children else 0, parents + children):
        points = [system.co_hair(object=object_, particle_no=particle, step=step) for step in range(steps)]
        yield from _segments(np.array(points, dtype=np.float32), radii)


def _tapered(root: float, tip: float, shape: float, steps: int) -> npt.NDArray[np.float32]:
    """Radii along a strand: as Cycles has it, straight where the shape is 0."""
    left = np.linspace(1, 0, steps)
    power = 1 + shape if shape < 0 else 1 / (1 - min(shape, 0.999999))
    return np.asarray(left**power * (root - tip) + tip, dtype=np.float32)


def _segments(points: npt.NDArray[np.float32], radii: npt.NDArray[np.float32]) -> Iterator[Parameters]:
    """Straight pieces where there are few points; a Catmull-Rom curve, as Bezier pieces, through more."""
    if len(points) < 2:
        return
    before = np.concatenate([2 * points[:1] - points[1:2], points[:-1]])
    after = np.concatenate([points[1:], 2 * points[-1:] - points[-2:-1]])
    tangents = (after - before) / 2
    for i in range(len(points) - 1):
        pieces = np.stack(
            [points[i], points[i] + tangents[i] / 3, points[i + 1] - tangents[i + 1] / 3, points[i + 1]]
        )
        yield {
            "point3 P": pieces,
            "string type": "round",
            "float width0": 2 * float(radii[i]),
            "float width1": 2 * float(radii[i + 1]),
        }


def box_of(corners: npt.NDArray[np.float64]) -> Parameters:
    """The box around points, with outward faces."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    points = np.array([[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)], dtype=np.float32)
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    triangles = [[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)]
    return {"point3 P": points, "integer indices": np.array(triangles, dtype=np.int32)}
