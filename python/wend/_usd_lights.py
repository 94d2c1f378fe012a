"""Lights of USD, with the photometry that UsdLux documents: the intensity is a radiance, or, where it is normalised, the
radiance times the light's area; of a distant light, the irradiance across its direction."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdLux  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._film import Film, read
from ._scene_reader import Places
from ._sky import equal_area

Matrix = npt.NDArray[np.float64]

#: Half a turn around x, from -z to z.
_TURNED = np.diag([1.0, -1.0, -1.0, 1.0])


def add(reader: Any, prim: Any, world: Places) -> bool:
    """Whether there is a light then. `world` is where it is when the shutter opens and when it closes."""
    kinds = {
        "DistantLight": _distant,
        "DomeLight": _dome,
        "DomeLight_1": _dome,
        "SphereLight": _sphere,
        "RectLight": _rect,
        "DiskLight": _disk,
        "CylinderLight": _cylinder,
    }
    kind = str(prim.GetTypeName())
    if kind not in kinds:
        reader.warn(prim, f"a {kind} is left out")
        return False
    if prim.HasAPI(UsdLux.ShapingAPI):
        shaping = UsdLux.ShapingAPI(prim)
        if shaping.GetShapingFocusAttr().Get(reader.time) or shaping.GetShapingIesFileAttr().Get(reader.time):
            reader.warn(prim, "focus and IES profile of a light are left out")
    with reader.builder.block():
        kinds[kind](reader, prim, world)
    return True


def emission(reader: Any, prim: Any) -> npt.NDArray[np.float64]:
    """Colour times intensity times the power of two of the exposure."""
    light = UsdLux.LightAPI(prim)
    time = reader.time
    colour = np.array(light.GetColorAttr().Get(time), dtype=np.float64)
    if light.GetEnableColorTemperatureAttr().Get(time):
        colour = colour * blackbody_colour(light.GetColorTemperatureAttr().Get(time))
    factor = float(light.GetIntensityAttr().Get(time)) * 2.0 ** float(light.GetExposureAttr().Get(time))
    return np.asarray(colour * factor, dtype=np.float64)


def blackbody_colour(kelvin: float) -> npt.NDArray[np.float64]:
    """Of luminance 1."""
    return np.array(UsdLux.BlackbodyTemperatureAsRgb(float(kelvin)), dtype=np.float64)


def _radiance(reader: Any, prim: Any, area: float) -> npt.NDArray[np.float64]:
    normalised = UsdLux.LightAPI(prim).GetNormalizeAttr().Get(reader.time)
    return emission(reader, prim) / (max(area, 1e-30) if normalised else 1.0)


def _value(reader: Any, prim: Any, name: str) -> float:
    return float(prim.GetAttribute(f"inputs:{name}").Get(reader.time))


def _stand(reader: Any, prim: Any, world: Places, turned: bool = False) -> None:
    """Puts a light without a size. Their lights shine along -z; pbrt's, if turned, along z."""
    if not np.allclose(world[0], world[1], rtol=1e-12, atol=0):
        reader.warn(prim, "a light without a size stays where it is when the shutter opens")
    reader.builder.add("Transform", _TURNED @ world[0] if turned else world[0])


def _distant(reader: Any, prim: Any, world: Places) -> None:
    light = UsdLux.LightAPI(prim)
    half = math.radians(_value(reader, prim, "angle")) / 2
    irradiance = emission(reader, prim)
    if not light.GetNormalizeAttr().Get(reader.time) and half > 0:
        irradiance = irradiance * math.pi * math.sin(min(half, math.pi / 2)) ** 2
    if half > math.radians(1):
        reader.warn(prim, "a distant light is taken as a point in the sky: its shadows are hard")
    _stand(reader, prim, world, turned=True)
    reader.builder.add("LightSource", "distant", {"rgb L": irradiance, "point3 from": (0, 0, 0), "point3 to": (0, 0, 1)})


def _dome(reader: Any, prim: Any, world: Places) -> None:
    radiance = emission(reader, prim)
    dome = UsdLux.DomeLight_1(prim) if str(prim.GetTypeName()) == "DomeLight_1" else UsdLux.DomeLight(prim)
    texture = dome.GetTextureFileAttr().Get(reader.time)
    format_ = dome.GetTextureFormatAttr().Get(reader.time)
    _stand(reader, prim, world)
    if not texture or not texture.path:
        reader.builder.add("LightSource", "infinite", {"rgb L": radiance})
        return
    if format_ not in ("automatic", "latlong"):
        reader.warn(prim, f"a {format_} picture of a dome is taken as a latlong one")
    picture = read(texture.resolvedPath or texture.path).image
    file = reader.map_file(f"dome{len(reader.builder)}.exr")
    Film.of(equal_area(picture) * radiance.astype(np.float32)).save(file)
    reader.builder.add("LightSource", "infinite", {"string filename": file})


def _sphere(reader: Any, prim: Any, world: Places) -> None:
    radius = _value(reader, prim, "radius")
    scale = _scales(world[0])
    area = 4 * math.pi * radius**2 * float(np.cbrt(np.prod(scale))) ** 2
    as_point = UsdLux.SphereLight(prim).GetTreatAsPointAttr().Get(reader.time)
    radiance = _radiance(reader, prim, area)
    cone, softness = _cone(reader, prim)
    if as_point or cone is not None:
        # From afar a sphere has this intensity. A cone makes a spot of it.
        intensity = radiance * (area / 4)
        if cone is None:
            _stand(reader, prim, world)
            reader.builder.add("LightSource", "point", {"rgb I": intensity})
            return
        _stand(reader, prim, world, turned=True)
        reader.builder.add(
            "LightSource",
            "spot",
            {
                "rgb I": intensity,
                "point3 from": (0, 0, 0),
                "point3 to": (0, 0, 1),
                "float coneangle": cone,
                "float conedeltaangle": cone * softness,
            },
        )
        return
    _shine(reader, prim, world, radiance, "sphere", {"float radius": radius})


def _cone(reader: Any, prim: Any) -> tuple[float | None, float]:
    if not prim.HasAPI(UsdLux.ShapingAPI):
        return None, 0.0
    shaping = UsdLux.ShapingAPI(prim)
    angle = float(shaping.GetShapingConeAngleAttr().Get(reader.time))
    softness = float(shaping.GetShapingConeSoftnessAttr().Get(reader.time))
    return (angle if angle < 90 else None), min(max(softness, 0.0), 1.0)


def _scales(world: Matrix) -> npt.NDArray[np.float64]:
    return np.asarray(np.linalg.norm(world[:3, :3], axis=1), dtype=np.float64)


def _shine(
    reader: Any, prim: Any, world: Places, radiance: npt.NDArray[np.float64], kind: str, parameters: dict[str, Any]
) -> None:
    if prim.GetTypeName() != "SphereLight" and _cone(reader, prim)[0] is not None:
        reader.warn(prim, "the cone of a light that is not a sphere is left out")
    reader.put(world)
    reader.builder.add("AreaLightSource", "diffuse", {"rgb L": radiance})
    # Lights reflect nothing.
    reader.builder.add("Material", "diffuse", {"rgb reflectance": (0, 0, 0)})
    reader.builder.add("Shape", kind, parameters)


def _rect(reader: Any, prim: Any, world: Places) -> None:
    x, y = _value(reader, prim, "width") / 2, _value(reader, prim, "height") / 2
    across, up = world[0, 0, :3] * 2 * x, world[0, 1, :3] * 2 * y
    if UsdLux.RectLight(prim).GetTextureFileAttr().Get(reader.time):
        reader.warn(prim, "the picture of a rectangular light is left out")
    radiance = _radiance(reader, prim, float(np.linalg.norm(np.cross(across, up))))
    # Seen from -z, where it shines, the corners go around against the clock.
    corners = [[-x, -y, 0], [-x, y, 0], [x, y, 0], [x, -y, 0]]
    _shine(reader, prim, world, radiance, "trianglemesh", {"point3 P": corners, "integer indices": [0, 1, 2, 0, 2, 3]})


def _disk(reader: Any, prim: Any, world: Places) -> None:
    radius = _value(reader, prim, "radius")
    area = math.pi * radius**2 * float(np.linalg.norm(np.cross(world[0, 0, :3], world[0, 1, :3])))
    radiance = _radiance(reader, prim, area)
    _shine(reader, prim, _TURNED @ world, radiance, "disk", {"float radius": radius})


def _cylinder(reader: Any, prim: Any, world: Places) -> None:
    radius, length = _value(reader, prim, "radius"), _value(reader, prim, "length")
    x, y, z = _scales(world[0])
    radiance = _radiance(reader, prim, 2 * math.pi * radius * math.sqrt(y * z) * length * x)
    # Theirs is along x, pbrt's along z.
    turn = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])
    parameters = {"float radius": radius, "float zmin": -length / 2, "float zmax": length / 2}
    _shine(reader, prim, turn @ world, radiance, "cylinder", parameters)
