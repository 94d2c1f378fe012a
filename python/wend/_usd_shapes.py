"""Geometry of USD as arrays of the renderer."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import Sdf, UsdGeom  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _usd_subdivision as subdivision
from ._usd_colours import COLOURS, Colours
from ._usd_materials import look_of
from ._usd_triangles import triangulate

Parameters = dict[str, Any]


def mesh_parts(
    reader: Any, prim: Any, world: npt.NDArray[np.float64], in_object: bool
) -> Iterator[tuple[Any, tuple[str, Parameters]]]:
    """The mesh, in the parts that materials are bound to: what is bound to, and the shape. `world` is where it is."""
    mesh = UsdGeom.Mesh(prim)
    time = reader.time
    points, end_points = _points(reader, prim)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get(time) or [], dtype=np.int64)
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get(time) or [], dtype=np.int64)
    if not len(counts):
        return
    if counts.min() < 0 or counts.sum() != len(corners) or corners.min() < 0 or corners.max() >= len(points):
        reader.warn(prim, "a mesh whose faces are not of its points is left out")
        return
    scheme = mesh.GetSubdivisionSchemeAttr().Get(time)
    is_left_handed = mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded
    parts = _parts(mesh, time, len(counts))
    looks = [look_of(reader, prim, bound) for bound, chosen in parts if chosen.any()]
    by = _first(reader, prim, "texture coordinates", [look.coordinates for look in looks])
    coordinates = _coordinates(reader, prim, by)
    named = _first(reader, prim, "colours", [look.colours for look in looks])
    colours = Colours.of(prim, named, time) if named is not None else None
    values = _values(reader, prim, counts, corners, len(points), end_points is not None, coordinates, colours)
    if scheme != UsdGeom.Tokens.none:
        faces = subdivision.Faces(counts, corners, scheme, is_left_handed)
        surface = subdivision.surface(reader, prim, points, faces, values.get("point2 uv"), world, in_object)
        if surface is not None:
            if end_points is not None:
                surface["point3 P1"] = end_points
            for bound, chosen in parts:
                holes = np.flatnonzero(~chosen[faces.of_face]).astype(np.int32)
                if len(holes) < len(faces.of_face):
                    yield bound, ("subdivision", surface | ({"integer holeIndices": holes} if len(holes) else {}))
            return
    triangles, of_triangle = triangulate(points, counts, corners)
    if is_left_handed:
        triangles = triangles[:, ::-1]
    if scheme != UsdGeom.Tokens.none:
        values["normal3 N"] = (_smooth_normals(points, corners[triangles]), UsdGeom.Tokens.vertex)
        if end_points is not None:
            values["normal3 N1"] = (_smooth_normals(end_points, corners[triangles]), UsdGeom.Tokens.vertex)
    if end_points is not None:
        values["point3 P1"] = (end_points, UsdGeom.Tokens.vertex)
    for bound, chosen in parts:
        selected = chosen[of_triangle]
        if selected.any():
            yield bound, ("trianglemesh", _mesh(points, corners, triangles[selected], of_triangle[selected], values))


def _first(reader: Any, prim: Any, what: str, names: list[str | None]) -> str | None:
    """Of what is read by the materials of a mesh."""
    named = [name for name in names if name]
    if any(name != named[0] for name in named):
        reader.warn(prim, f"all parts of a mesh have the {what} of the first: {named[0]}")
    return named[0] if named else None


def _points(reader: Any, prim: Any) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32] | None]:
    """Where the shutter opens, and where it closes if they move."""
    based = UsdGeom.PointBased(prim)

    def at(time: Any) -> npt.NDArray[np.float32]:
        still = time == reader.time
        found = based.GetPointsAttr().Get(time) if still else based.ComputePointsAtTime(time, reader.time)
        return np.array(found or [], dtype=np.float32).reshape(-1, 3)

    # Of as many as there are at the time, by their velocities if they have any.
    start, end = (at(time) for time in reader.shutter)
    return start, None if np.array_equal(start, end) else end


def _values(
    reader: Any,
    prim: Any,
    counts: npt.NDArray[np.int64],
    corners: npt.NDArray[np.int64],
    points: int,
    moves: bool,
    coordinates: tuple[npt.NDArray[np.float32], str] | None,
    colours: Colours | None,
) -> dict[str, tuple[npt.NDArray[np.float32], str]]:
    """Normals, texture coordinates and colours, with their interpolation. Subdivision surfaces have their own normals, and
    no colours."""
    mesh = UsdGeom.Mesh(prim)
    values = {}
    if mesh.GetSubdivisionSchemeAttr().Get(reader.time) == UsdGeom.Tokens.none:
        normals = _normals(mesh, reader.shutter[0])
        if normals is not None:
            values["normal3 N"] = normals
            end_normals = _normals(mesh, reader.shutter[1])
            if moves and end_normals is not None:
                values["normal3 N1"] = end_normals
        if colours is not None and colours.vary():
            values[COLOURS] = (colours.values.astype(np.float32), colours.interpolation)
    if coordinates is not None:
        values["point2 uv"] = coordinates
    sizes = {
        UsdGeom.Tokens.constant: 1,
        UsdGeom.Tokens.uniform: len(counts),
        UsdGeom.Tokens.vertex: points,
        UsdGeom.Tokens.varying: points,
        UsdGeom.Tokens.faceVarying: len(corners),
    }
    for name in list(values):
        array, kind = values[name]
        if sizes.get(kind) != len(array):
            reader.warn(prim, f"{name.split()[1]} of another number than the mesh has are left out")
            del values[name]
    if moves and ("normal3 N" in values) != ("normal3 N1" in values):
        # They belong together.
        values.pop("normal3 N", None)
        values.pop("normal3 N1", None)
    return values


def _parts(mesh: Any, time: Any, count: int) -> list[tuple[Any, npt.NDArray[np.bool_]]]:
    """What materials are bound to, and its faces; holes belong to nothing."""
    rest = np.ones(count, dtype=bool)
    holes = np.array(mesh.GetHoleIndicesAttr().Get(time) or [], dtype=np.int64)
    rest[holes[(holes >= 0) & (holes < count)]] = False
    parts = []
    keep = rest.copy()
    for subset in UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, "materialBind"):
        chosen = np.zeros(count, dtype=bool)
        indices = np.array(subset.GetIndicesAttr().Get(time) or [], dtype=np.int64)
        chosen[indices[(indices >= 0) & (indices < count)]] = True
        parts.append((subset.GetPrim(), chosen & keep))
        rest &= ~chosen
    return [*parts, (mesh.GetPrim(), rest)]


def _mesh(
    points: npt.NDArray[np.float32],
    corners: npt.NDArray[np.int64],
    triangles: npt.NDArray[np.int64],
    faces: npt.NDArray[np.int64],
    values: dict[str, tuple[npt.NDArray[np.float32], str]],
) -> Parameters:
    """`triangles` count corners. Points stay shared where every value is one of a point."""
    vertices = corners[triangles].astype(np.int32)
    values = {name: _of_points(array, kind, corners, len(points)) for name, (array, kind) in values.items()}
    if all(kind in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying) for _, kind in values.values()):
        parameters: Parameters = {"point3 P": points, "integer indices": vertices}
        return parameters | {name: array for name, (array, _) in values.items()}
    flat = vertices.reshape(-1)
    parameters = {"point3 P": points[flat], "integer indices": np.arange(len(flat), dtype=np.int32)}
    of_corner: dict[str, npt.NDArray[np.integer[Any]]] = {
        UsdGeom.Tokens.constant: np.zeros(len(flat), dtype=np.int64),
        UsdGeom.Tokens.uniform: np.repeat(faces, 3),
        UsdGeom.Tokens.vertex: flat,
        UsdGeom.Tokens.varying: flat,
        UsdGeom.Tokens.faceVarying: triangles.reshape(-1),
    }
    return parameters | {name: array[of_corner[kind]] for name, (array, kind) in values.items()}


def _of_points(
    array: npt.NDArray[np.float32], kind: str, corners: npt.NDArray[np.int64], points: int
) -> tuple[npt.NDArray[np.float32], str]:
    """Values of corners as those of points, where all corners of a point have the same: many exporters write no others."""
    if kind != UsdGeom.Tokens.faceVarying:
        return array, kind
    # Some corner of each point; of what is no corner the first, which nobody sees.
    some = np.zeros(points, dtype=np.int64)
    some[corners] = np.arange(len(corners))
    of_points = array[some]
    same = np.array_equal(of_points[corners], array)
    return (of_points, UsdGeom.Tokens.vertex) if same else (array, kind)


def _normals(mesh: Any, time: Any) -> tuple[npt.NDArray[np.float32], str] | None:
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    if primvar and primvar.HasValue():
        return np.array(primvar.ComputeFlattened(time), dtype=np.float32).reshape(-1, 3), primvar.GetInterpolation()
    found = mesh.GetNormalsAttr().Get(time)
    return (np.array(found, dtype=np.float32).reshape(-1, 3), mesh.GetNormalsInterpolation()) if found else None


def _coordinates(reader: Any, prim: Any, wanted: str | None) -> tuple[npt.NDArray[np.float32], str] | None:
    """Those that are asked for, or the usual ones."""
    api = UsdGeom.PrimvarsAPI(prim)
    names = ["st", "UVMap"] if wanted is None else [wanted, "st", "UVMap"]
    named = [*map(api.GetPrimvar, filter(Sdf.Path.IsValidNamespacedIdentifier, names))]
    for primvar in [*named, *api.GetPrimvarsWithValues()]:
        # Older files have plain pairs of numbers; some programs a third coordinate.
        is_one = primvar in named or primvar.GetTypeName().role == "TextureCoordinate"
        if primvar and primvar.HasValue() and is_one:
            array = np.array(primvar.ComputeFlattened(reader.time), dtype=np.float32)
            if array.ndim == 2 and array.shape[1] in (2, 3):
                if wanted not in (None, primvar.GetPrimvarName()):
                    reader.warn(prim, f"texture coordinates {wanted} are not there: {primvar.GetPrimvarName()} are taken")
                return np.ascontiguousarray(array[:, :2]), primvar.GetInterpolation()
    return None


def _smooth_normals(points: npt.NDArray[np.float32], triangles: npt.NDArray[np.int64]) -> npt.NDArray[np.float32]:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], across)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    # A point of no face has no normal; any will do.
    return np.where(length > 0, normals / np.maximum(length, 1e-30), np.array([0, 0, 1], dtype=np.float32)).astype(np.float32)


def box_mesh(low: npt.NDArray[np.float64], high: npt.NDArray[np.float64]) -> Parameters:
    corner = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    return {"point3 P": low + corner * (high - low), "integer indices": np.array(triangles, dtype=np.int32)}


def primitive_mesh(prim: Any, time: Any) -> Parameters | None:
    """A cube, plane, cylinder, cone or capsule, also with two radii; None for another prim."""
    segments = 64
    kind = prim.GetTypeName()

    def value(name: str, fallback: float) -> float:
        found = prim.GetAttribute(name).Get(time)
        return fallback if found is None else float(found)

    if kind == "Cube":
        half = value("size", 2) / 2
        return box_mesh(np.full(3, -half), np.full(3, half))
    axis = prim.GetAttribute("axis").Get(time) or "Z"
    if kind == "Plane":
        x, y = value("width", 2) / 2, value("length", 2) / 2
        points = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]])
        return {"point3 P": _along(points, axis), "integer indices": np.array([0, 1, 2, 0, 2, 3], dtype=np.int32)}
    radius, half = value("radius", 1), value("height", 2) / 2
    bottom, top = value("radiusBottom", radius), value("radiusTop", radius)
    if kind in ("Cylinder", "Cylinder_1"):
        profile = [(0.0, -half), (bottom, -half), (top, half), (0.0, half)]
    elif kind == "Cone":
        profile = [(0.0, -half), (radius, -half), (0.0, half)]
    elif kind in ("Capsule", "Capsule_1"):
        half = value("height", 1) / 2
        radii = [value(name, value("radius", 0.5)) for name in ("radiusBottom", "radiusTop")]
        angles = np.linspace(0, np.pi / 2, segments // 4 + 1)
        below, above = ([(r * np.cos(a), half + r * np.sin(a)) for a in angles] for r in radii)
        profile = [(r, -z) for r, z in reversed(below)] + above
    else:
        return None
    return _turned(np.array(profile), segments, axis)


def _turned(profile: npt.NDArray[np.float64], segments: int, axis: str) -> Parameters:
    """The surface of a profile (radius, height) around the axis, facing outwards for one that goes up."""
    turn = 2 * np.pi * np.arange(segments) / segments
    radius, height = profile[:, :1], profile[:, 1:]
    points = np.stack([radius * np.cos(turn), radius * np.sin(turn), height + 0 * turn], axis=-1).reshape(-1, 3)
    k, i = np.meshgrid(np.arange(len(profile) - 1), np.arange(segments), indexing="ij")
    a, b = k * segments + i, k * segments + (i + 1) % segments
    triangles = np.concatenate([np.stack([a, b, b + segments], -1), np.stack([a, b + segments, a + segments], -1)])
    triangles = triangles.reshape(-1, 3)
    p = points[triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    return {"point3 P": _along(points, axis), "integer indices": triangles[area > 0].astype(np.int32)}


def _along(points: npt.NDArray[np.float64], axis: str) -> npt.NDArray[np.float64]:
    """What was made around z, around another axis: the cyclic order of the axes keeps the surface's sides."""
    return np.roll(points, {"Z": 0, "X": 1, "Y": 2}[axis], axis=-1)
