"""Blender's lamps, in its units: watts of point, spot and area lights, watts per square metre of a sun."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ._blend_lamp_pictures import LampPicture
from ._blend_nodes import Nodes, output_node
from ._blend_profiles import profile_of, seen_along
from ._film import Film
from ._ies import Profile
from ._scene_reader import Places, SceneReader, unmirrored
from ._sky import add_thrown

Matrix = npt.NDArray[np.float64]

#: Half a turn around x: Blender's lamps shine along -z, pbrt's along z.
_TURNED = np.diag([1.0, -1.0, -1.0, 1.0])

#: The area that Cycles takes lamps without a size for.
_OF_POINTS = 4.0


def add(
    reader: SceneReader, name: str, lamp: Any, places: Places, is_seen: bool, picture: LampPicture | None, brightness: float
) -> None:
    """A lamp where the shutter opens and where it closes. `is_seen`: by the camera, as far as it has a size. `picture`:
    what its nodes are, where they are no constants. `brightness` multiplies what it shines with."""
    place = f"light '{name}'"
    kinds = {"POINT": _point, "SPOT": _spot, "SUN": _sun, "AREA": _area}
    strength, profile = np.ones(3), None
    if picture is not None:
        reader.tell(place, "the nodes of a light that are no constants become a picture, by Cycles")
    elif lamp.use_nodes and lamp.node_tree and any(link.is_valid for link in lamp.node_tree.links):
        strength, profile = _strength_of_nodes(reader, place, lamp)
    power = np.array(lamp.color, dtype=np.float64) * lamp.energy * 2.0 ** getattr(lamp, "exposure", 0.0) * strength * brightness
    if getattr(lamp, "use_temperature", False):
        power = power * np.array(lamp.temperature_color, dtype=np.float64)
    if getattr(getattr(lamp, "cycles", None), "is_portal", False) and lamp.type == "AREA":
        reader.tell(place, "a portal is left out")
        return
    if not lamp.use_shadow:
        reader.tell(place, "a light without shadows has them")
    if power.min() < 0:
        reader.tell(place, "negative power of a light is taken as none")
        power = np.maximum(power, 0)
    if getattr(getattr(lamp, "cycles", None), "max_bounces", 1024) < 128:
        reader.tell(place, f"light that was reflected more often than its {lamp.cycles.max_bounces} times is there")
    if power.max() <= 0:
        return
    with reader.builder.block():
        if picture is not None and lamp.type == "AREA":
            _area(reader, place, lamp, places, power, is_seen, picture)
        elif picture is not None:
            _pictured(reader, place, lamp, places, power, picture)
        elif profile is not None or (lamp.type == "SPOT" and _is_uneven(places)):
            _thrown(reader, place, lamp, places, power, profile)
        else:
            kinds[lamp.type](reader, place, lamp, places, power, is_seen)


def _strength_of_nodes(reader: SceneReader, place: str, lamp: Any) -> tuple[npt.NDArray[np.float64], Profile | None]:
    """Colour and strength of the emission that a lamp's nodes are, where they are no more than that, and its profile."""
    nodes = Nodes(reader, place, "")
    output = output_node(lamp.node_tree)
    node = nodes.shader(output.inputs["Surface"]) if output is not None else None
    if node is None:
        return np.zeros(3), None
    if node.bl_idname != "ShaderNodeEmission":
        reader.tell(place, "the nodes of a light are left out, but for an emission")
        return np.ones(3), None
    if lamp.type in ("POINT", "SPOT"):
        profile, factor = profile_of(nodes, node.inputs["Strength"])
        if profile is not None:
            return nodes.colour(node.inputs["Color"]) * factor, profile
    return nodes.colour(node.inputs["Color"]) * nodes.number(node.inputs["Strength"]), None


def _is_uneven(places: Places) -> bool:
    scale = np.linalg.norm(places[0, :3, :3], axis=-1)
    return bool(np.ptp(scale) > 1e-3 * scale.max())


def _thrown(reader: SceneReader, place: str, lamp: Any, places: Places, power: Any, profile: Profile | None) -> None:
    """A point or a spot as a point whose light goes by a profile, or in a cone that is scaled unevenly."""
    radius = float(lamp.shadow_soft_size)
    if radius > 0:
        reader.tell(place, "a lamp with a profile, or a cone that is not round, is taken as a point: its shadows are hard")
    held = reader.held(places, place)
    scale = np.maximum(np.linalg.norm(held[:3, :3], axis=-1), 1e-30)

    def factor(x: Matrix, y: Matrix, z: Matrix) -> Matrix:
        result = np.ones_like(z) if profile is None else seen_along(profile, x, y, z)
        if lamp.type == "SPOT":
            along = -z / scale[2]
            cosine = along / np.sqrt((x / scale[0]) ** 2 + (y / scale[1]) ** 2 + along**2)
            edge = math.cos(min(float(lamp.spot_size) / 2, math.radians(89.9)))
            t = np.clip((cosine - edge) / max(float(lamp.spot_blend) * (1 - edge), 1e-6), 0, 1)
            result = result * t * t * (3 - 2 * t)
        return result

    area = 4 * math.pi * radius**2 if radius > 0 else _OF_POINTS
    reader.builder.add("Transform", _unscaled(held))
    add_thrown(reader, power * _unnormalised(lamp, area) / (4 * math.pi), factor)


def _pictured(reader: SceneReader, place: str, lamp: Any, places: Places, power: Any, picture: LampPicture) -> None:
    """A point or a spot that throws a picture."""
    radius = float(lamp.shadow_soft_size)
    if radius > 0:
        reader.tell(place, "a point or spot with a picture is taken as one without a size: its shadows are hard")
    area = 4 * math.pi * radius**2 if radius > 0 else _OF_POINTS
    reader.builder.add("Transform", _unscaled(reader.held(places, place)))
    add_thrown(reader, power * _unnormalised(lamp, area) / (4 * math.pi), picture.towards, 1024)


def _shine(
    reader: SceneReader,
    radiance: Any,
    is_seen: bool,
    kind: str,
    parameters: dict[str, Any],
    profile: dict[str, Any],
    picture: LampPicture | None = None,
) -> None:
    # Lamps are in nobody's way.
    around = reader.around or ""
    reader.builder.add("MediumInterface", around, around)
    light: dict[str, Any] = {"rgb L": radiance}
    if picture is not None:
        light = {"string filename": reader.map_file(f"lamp{len(reader.builder)}.exr")}
        Film.of((picture.pixels * radiance).astype(np.float32)).save(light["string filename"])
    reader.builder.add("AreaLightSource", "diffuse", light | {"bool solid": False} | profile)
    reader.builder.add("Material", "interface")
    reader.builder.add("Shape", kind, parameters if is_seen else parameters | {"string cameraview": "hidden"})


def _point(reader: SceneReader, place: str, lamp: Any, places: Places, power: Any, is_seen: bool) -> None:
    radius = float(lamp.shadow_soft_size)
    if radius > 0:
        power = power * _unnormalised(lamp, 4 * math.pi * radius**2)
        reader.put(unmirrored(_unscaled(places)))
        _shine(reader, power / (4 * math.pi**2 * radius**2), is_seen, "sphere", {"float radius": radius}, {})
    else:
        power = power * _unnormalised(lamp, _OF_POINTS)
        reader.builder.add("Transform", _unscaled(reader.held(places, place)))
        reader.builder.add("LightSource", "point", {"rgb I": power / (4 * math.pi)})


def _spot(reader: SceneReader, place: str, lamp: Any, places: Places, power: Any, is_seen: bool) -> None:
    half = min(float(lamp.spot_size) / 2, math.radians(89.9))
    edge = math.cos(half)
    # Cycles blends by the cosine, over this part of it.
    inner = math.acos(min(edge + float(lamp.spot_blend) * (1 - edge), 1.0))
    if lamp.use_square:
        reader.tell(place, "a square spot is round")
    cone = {"float coneangle": math.degrees(half), "float conedeltaangle": math.degrees(half - inner)}
    radius = float(lamp.shadow_soft_size)
    if radius > 0:
        # The cone of what moves does not turn.
        turns = np.abs(places[0, :3, :3] - places[1, :3, :3]).max() > 1e-6
        held = np.array([reader.held(places, place)] * 2) if turns else places
        reader.put(unmirrored(_TURNED @ _unscaled(held)))
        radiance = power * _unnormalised(lamp, 4 * math.pi * radius**2) / (4 * math.pi**2 * radius**2)
        _shine(reader, radiance, is_seen, "sphere", {"float radius": radius}, cone)
        return
    power = power * _unnormalised(lamp, _OF_POINTS)
    reader.builder.add("Transform", _TURNED @ _unscaled(reader.held(places, place)))
    towards = {"point3 from": (0, 0, 0), "point3 to": (0, 0, 1)}
    reader.builder.add("LightSource", "spot", {"rgb I": power / (4 * math.pi)} | towards | cone)


def _sun(reader: SceneReader, place: str, lamp: Any, places: Places, power: Any, is_seen: bool) -> None:
    reader.builder.add("Transform", _TURNED @ _unscaled(reader.held(places, place)))
    power = power * _unnormalised(lamp, math.pi * math.sin(min(lamp.angle / 2, math.pi / 2)) ** 2)
    parameters: dict[str, Any] = {"rgb L": power, "point3 from": (0, 0, 0), "point3 to": (0, 0, 1)}
    parameters["float angle"] = min(math.degrees(lamp.angle), 180.0)
    reader.builder.add("LightSource", "distant", parameters if is_seen else parameters | {"string cameraview": "hidden"})


def _area(
    reader: SceneReader,
    place: str,
    lamp: Any,
    places: Places,
    power: Any,
    is_seen: bool,
    picture: LampPicture | None = None,
) -> None:
    spread = math.degrees(getattr(lamp, "spread", math.pi))
    profile = {"float spread": max(spread, 0.5)} if spread < 179.9 else {}
    x = float(lamp.size) / 2
    y = x if lamp.shape in ("SQUARE", "DISK") else float(lamp.size_y) / 2
    across, up = places[0, 0, :3], places[0, 1, :3]
    stretched = float(np.linalg.norm(np.cross(across, up)))
    is_round = lamp.shape in ("DISK", "ELLIPSE")
    area = (math.pi if is_round else 4.0) * x * y * stretched
    radiance = power * _unnormalised(lamp, area) / (math.pi * max(area, 1e-30))
    if is_round and picture is not None:
        reader.put(places)
        _shine(reader, radiance, is_seen, "trianglemesh", _polygon(x, y), profile, picture)
        return
    if is_round:
        reader.put(np.diag([x, y, 1, 1]) @ _TURNED @ unmirrored(places))
        _shine(reader, radiance, is_seen, "disk", {"float radius": 1}, profile)
        return
    # Seen from -z, where it shines, the corners go around against the clock.
    corners = [[-x, -y, 0], [-x, y, 0], [x, y, 0], [x, -y, 0]]
    reader.put(places)
    flat = {"point3 P": corners, "integer indices": [0, 1, 2, 0, 2, 3]}
    if picture is not None:
        # Upright and unmirrored for who looks at it: its left is at +x.
        flat["point2 uv"] = [[1, 0], [1, 1], [0, 1], [0, 0]]
    _shine(reader, radiance, is_seen, "trianglemesh", flat, profile, picture)


#: Corners of what stands for a round lamp with a picture.
_CORNERS = 48


def _polygon(x: float, y: float) -> dict[str, Any]:
    """As large as an ellipse of these radii, its picture over the square around that."""
    turns = 2 * math.pi * np.arange(_CORNERS) / _CORNERS
    wider = math.sqrt(2 * math.pi / _CORNERS / math.sin(2 * math.pi / _CORNERS))
    # Seen from -z they go around against the clock.
    corners = wider * np.stack([np.cos(turns), -np.sin(turns)], axis=1)
    points = np.concatenate([[[0.0, 0.0]], corners])
    triangles = [(0, 1 + i, 1 + (i + 1) % _CORNERS) for i in range(_CORNERS)]
    uvs = 0.5 + 0.5 * points * (-1, 1)
    placed = np.concatenate([points * (x, y), np.zeros((len(points), 1))], axis=1)
    return {"point3 P": placed, "integer indices": triangles, "point2 uv": np.clip(uvs, 0, 1)}


def _unnormalised(lamp: Any, area: float) -> float:
    """What multiplies the power of a lamp whose radiance does not depend on its size."""
    return 1.0 if getattr(lamp, "normalize", True) or area <= 0 else area


def _unscaled(world: Matrix) -> Matrix:
    """Point lights, spots and suns have no size that an object's scale could change. Of one matrix or of several."""
    result = world.copy()
    result[..., :3, :3] /= np.maximum(np.linalg.norm(result[..., :3, :3], axis=-1, keepdims=True), 1e-30)
    return result
