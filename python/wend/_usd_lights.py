"""Lights of USD, with the photometry that UsdLux documents: the intensity is a radiance, or, where it is normalised, the
radiance times the light's area; of a distant light, the irradiance across its direction."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdGeom, UsdLux  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _ies
from . import _usd_blender as blender
from ._dome_formats import as_latlong, is_known
from ._film import Film, read
from ._scene_reader import Places, unmirrored
from ._sky import add_thrown
from ._usd_files import file_of

Matrix = npt.NDArray[np.float64]

#: From pbrt's pictures by latitude and longitude, whose middle is towards x and whose left is towards y, to a dome's.
_LATLONG = np.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])

#: Of the rim of a cone, in degrees: what is narrower is finer than such a picture.
_NARROW = 2.0

_IS_POINT = "a light that is shaped is taken as a point: its shadows are hard"

#: Half a turn around x, from -z to z.
_TURNED = np.diag([1.0, -1.0, -1.0, 1.0])


def is_light(prim: Any) -> bool:
    """Also one that only a plugin knows; shapes that shine are none."""
    is_known = prim.IsA(UsdLux.BoundableLightBase) or prim.IsA(UsdLux.NonboundableLightBase)
    return bool(is_known or prim.GetTypeName() == "PluginLight")


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
    if kind in ("DistantLight", "DomeLight", "DomeLight_1", "CylinderLight") and Shaping.of(reader, prim).is_any():
        reader.warn(prim, "the shaping of a light that is neither a sphere, a rectangle nor a disk is left out")
    _tell_of_others(reader, prim)
    with reader.builder.block():
        kinds[kind](reader, prim, world)
    return True


def _tell_of_others(reader: Any, prim: Any) -> None:
    """What a light says of whom it is for."""
    light = UsdLux.LightAPI(prim)
    if light.GetFiltersRel().GetTargets():
        reader.warn(prim, "filters of lights are left out")
    if any(attribute.Get(reader.time) != 1 for attribute in (light.GetDiffuseAttr(), light.GetSpecularAttr())):
        reader.warn(prim, "a light's factors of what is diffuse or specular are left out")
    shadow = UsdLux.ShadowAPI(prim)
    limits = (shadow.GetShadowDistanceAttr(), shadow.GetShadowFalloffAttr(), shadow.GetShadowColorAttr())
    if prim.HasAPI(UsdLux.ShadowAPI) and (
        not shadow.GetShadowEnableAttr().Get(reader.time) or any(attribute.HasAuthoredValue() for attribute in limits)
    ):
        reader.warn(prim, "shadows are black, reach everywhere, and are there where they are asked not to be")
    for collection in (light.GetLightLinkCollectionAPI(), light.GetShadowLinkCollectionAPI()):
        is_for_some = not collection.GetIncludeRootAttr().Get() or collection.GetMembershipExpressionAttr().HasAuthoredValue()
        if is_for_some or collection.GetExcludesRel().GetTargets() or collection.GetIncludesRel().GetTargets():
            reader.warn(prim, "lights that are for some things alone shine on all")


@dataclass
class Shaping:
    """What a light's shaping asks for."""

    cone: float | None  #: degrees from the axis; None: everywhere
    softness: float
    inner: float | None  #: of Blender's cones, where the rim begins, in degrees
    focus: float
    profile: str | None  #: a file of IES LM-63
    angle_scale: float
    is_normalised: bool
    #: Of Blender's cones, which objects that are scaled unevenly squeeze; None: round.
    stretch: npt.NDArray[np.float64] | None = None

    @staticmethod
    def of(reader: Any, prim: Any) -> Shaping:
        if not prim.HasAPI(UsdLux.ShapingAPI):
            return Shaping(None, 0.0, None, 0.0, None, 0.0, False)
        api, time = UsdLux.ShapingAPI(prim), reader.time
        angle = float(api.GetShapingConeAngleAttr().Get(time))
        file = api.GetShapingIesFileAttr().Get(time)
        return Shaping(
            angle if angle < 90 else None,
            min(max(float(api.GetShapingConeSoftnessAttr().Get(time)), 0.0), 1.0),
            blender.inner_angle(api.GetShapingConeSoftnessAttr(), angle),
            max(float(api.GetShapingFocusAttr().Get(time)), 0.0),
            file_of(reader, file) if file and file.path else None,
            float(api.GetShapingIesAngleScaleAttr().Get(time)),
            bool(api.GetShapingIesNormalizeAttr().Get(time)),
        )

    def is_any(self) -> bool:
        return self.cone is not None or self.needs_picture()

    def needs_picture(self) -> bool:
        """Whether a cone is not all, or one whose rim is wide and falls off as USD has it, by the angle."""
        is_soft = self.cone is not None and self.inner is None and self.cone * self.softness > _NARROW
        is_squeezed = self.inner is not None and self.cone is not None and self.stretch is not None
        return self.focus > 0 or self.profile is not None or is_soft or is_squeezed

    def factor(self, reader: Any, prim: Any, x: Matrix, y: Matrix, z: Matrix) -> Matrix:
        """What the light is multiplied with in directions of its own space, whose axis is -z."""
        off_axis = np.degrees(np.arccos(np.clip(-z, -1, 1)))
        factor = np.abs(z) ** self.focus
        if UsdLux.ShapingAPI(prim).GetShapingFocusTintAttr().Get(reader.time) != (0, 0, 0):
            reader.warn(prim, "the tint of a light's focus is left out")
        if self.profile is not None:
            # The cone does not count then.
            scale = self.angle_scale
            vertical = off_axis / scale if scale > 0 else (off_axis - 180) / -scale + 180 if scale < 0 else off_axis
            profile = _ies.read(self.profile)
            return factor * profile.at(vertical, np.degrees(np.arctan2(y, x))) / (profile.mean() if self.is_normalised else 1.0)
        if self.cone is None:
            return factor
        if self.inner is not None:
            return factor * self._factor_of_blender(x, y, z)
        start = self.cone * (1 - self.softness)
        t = np.clip((off_axis - start) / max(self.cone - start, 1e-6), 0, 1)
        return factor * (1 - t * t * (3 - 2 * t))

    def _factor_of_blender(self, x: Matrix, y: Matrix, z: Matrix) -> Matrix:
        """A smooth step of the cosine."""
        assert self.cone is not None and self.inner is not None
        across, beside, along = np.ones(3) if self.stretch is None else self.stretch
        ahead = -z / along
        cosine = ahead / np.sqrt((x / across) ** 2 + (y / beside) ** 2 + ahead**2)
        edge, full = math.cos(math.radians(self.cone)), math.cos(math.radians(self.inner))
        t = np.clip((cosine - edge) / max(full - edge, 1e-6), 0, 1)
        return np.asarray(t * t * (3 - 2 * t))


def emission(reader: Any, prim: Any) -> npt.NDArray[np.float64]:
    """Colour times intensity times the power of two of the exposure."""
    light = UsdLux.LightAPI(prim)
    time = reader.time
    colour = np.array(light.GetColorAttr().Get(time), dtype=np.float64)
    if light.GetEnableColorTemperatureAttr().Get(time) and not blender.has_no_temperature(light):
        colour = colour * blackbody_colour(light.GetColorTemperatureAttr().Get(time))
    factor = float(light.GetIntensityAttr().Get(time)) * 2.0 ** float(light.GetExposureAttr().Get(time))
    result = np.asarray(colour * factor, dtype=np.float64)
    if not np.isfinite(result).all():
        raise ValueError(f"a light of {result.tolist()}")
    if result.min() < 0:
        reader.warn(prim, "light that is negative is left out")
    return np.maximum(result, 0)


def blackbody_colour(kelvin: float) -> npt.NDArray[np.float64]:
    """Of luminance 1. UsdLux never ends with what is no number."""
    if not math.isfinite(kelvin):
        raise ValueError(f"a colour temperature of {kelvin}")
    return np.array(UsdLux.BlackbodyTemperatureAsRgb(float(kelvin)), dtype=np.float64)


def _is_normalised(reader: Any, prim: Any) -> bool:
    return bool(UsdLux.LightAPI(prim).GetNormalizeAttr().Get(reader.time))


def _radiance(reader: Any, prim: Any, area: float) -> npt.NDArray[np.float64]:
    """Nothing of what has no area, which is told."""
    if not area > 0:
        reader.warn(prim, "a light without an area gives no light")
        return np.zeros(3)
    return emission(reader, prim) / (area if _is_normalised(reader, prim) else 1.0)


def _value(reader: Any, prim: Any, name: str) -> float:
    return float(prim.GetAttribute(f"inputs:{name}").Get(reader.time))


def _stand(reader: Any, prim: Any, world: Places, turned: bool = False) -> None:
    """Puts a light without a size. Their lights shine along -z; pbrt's, if turned, along z."""
    place = world[0]
    if not np.allclose(world[0], world[1], rtol=1e-12, atol=0):
        reader.warn(prim, "a light without a size stays where it is at the time of the picture")
        place = reader.place_at_time(prim, world)
    reader.builder.add("Transform", _TURNED @ place if turned else place)


def _distant(reader: Any, prim: Any, world: Places) -> None:
    light = UsdLux.LightAPI(prim)
    half = math.radians(_value(reader, prim, "angle")) / 2
    irradiance = emission(reader, prim) * blender.sun_factor(reader, light)
    if not _is_normalised(reader, prim) and half > 0:
        irradiance = irradiance * math.pi * math.sin(min(half, math.pi / 2)) ** 2
    _stand(reader, prim, world, turned=True)
    parameters: dict[str, Any] = {"rgb L": irradiance, "point3 from": (0, 0, 0), "point3 to": (0, 0, 1)}
    reader.builder.add("LightSource", "distant", parameters | {"float angle": min(math.degrees(2 * half), 180.0)})


def _dome(reader: Any, prim: Any, world: Places) -> None:
    radiance = emission(reader, prim)
    dome = UsdLux.DomeLight_1(prim) if str(prim.GetTypeName()) == "DomeLight_1" else UsdLux.DomeLight(prim)
    texture = dome.GetTextureFileAttr().Get(reader.time)
    format_ = dome.GetTextureFormatAttr().Get(reader.time)
    file = file_of(reader, texture) if texture and texture.path else None
    picture = read(file).image if file is not None else np.ones((1, 1, 3), dtype=np.float32)
    if np.ptp(picture, axis=(0, 1)).max() == 0:
        _stand(reader, prim, world)
        reader.builder.add("LightSource", "infinite", {"rgb L": radiance * picture[0, 0]})
        return
    local = np.array(UsdGeom.Xformable(prim).GetLocalTransformation(reader.time))
    _stand(reader, prim, _LATLONG @ _pole(reader, prim) @ blender.turned_sky(reader, prim, local) @ world)
    is_made = is_known(str(format_))
    if is_made:
        reader.warn(prim, f"the middle of a {format_} picture of a dome is where that of a latlong one is")
        picture = as_latlong(picture, str(format_))
    elif format_ not in ("automatic", "latlong"):
        reader.warn(prim, f"a {format_} picture of a dome is taken as a latlong one")
    sky: dict[str, Any] = {"string filename": file, "string mapping": "equirectangular"}
    if np.ptp(radiance) == 0 and not is_made:
        sky["float scale"] = float(radiance[0])
    else:
        sky["string filename"] = reader.map_file(f"dome{len(reader.builder)}.exr")
        Film.of(picture * radiance.astype(np.float32)).save(sky["string filename"])
    reader.builder.add("LightSource", "infinite", sky)


def _pole(reader: Any, prim: Any) -> Matrix:
    """What turns the pole of a dome, which is y, to where it is asked to be."""
    if str(prim.GetTypeName()) != "DomeLight_1":
        return np.eye(4)
    axis = UsdLux.DomeLight_1(prim).GetPoleAxisAttr().Get()
    is_z = axis == "Z" or (axis == "scene" and UsdGeom.GetStageUpAxis(reader.stage) == UsdGeom.Tokens.z)
    return np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]) if is_z else np.eye(4)


def _sphere(reader: Any, prim: Any, world: Places) -> None:
    radius = _value(reader, prim, "radius")
    stretch = blender.stretch(prim, world)
    world = blender.unscaled(prim, world)
    scale = _scales(world[0])
    area = 4 * math.pi * radius**2 * float(np.cbrt(np.prod(scale))) ** 2
    # From afar a sphere has this intensity, however small it is where it is normalised.
    intensity = emission(reader, prim) / 4 * (1.0 if _is_normalised(reader, prim) else area)
    shaping = replace(Shaping.of(reader, prim), stretch=stretch)
    is_point = UsdLux.SphereLight(prim).GetTreatAsPointAttr().Get(reader.time)
    if shaping.needs_picture():
        _throw(reader, prim, world, shaping, intensity, is_flat=False)
    elif shaping.cone is not None:
        rim = shaping.cone * shaping.softness if shaping.inner is None else shaping.cone - shaping.inner
        cone = {"float coneangle": shaping.cone, "float conedeltaangle": rim}
        if not is_point and radius > 0:
            light = {"rgb L": _radiance(reader, prim, area)} | cone
            _shine(reader, prim, _TURNED @ world, light, "sphere", {"float radius": radius})
            return
        _stand(reader, prim, world, turned=True)
        towards: dict[str, Any] = {"point3 from": (0, 0, 0), "point3 to": (0, 0, 1)}
        reader.builder.add("LightSource", "spot", {"rgb I": intensity} | towards | cone)
    elif is_point:
        _stand(reader, prim, world)
        reader.builder.add("LightSource", "point", {"rgb I": intensity})
    else:
        _shine(reader, prim, world, {"rgb L": _radiance(reader, prim, area)}, "sphere", {"float radius": radius})


def _throw(
    reader: Any, prim: Any, world: Places, shaping: Shaping, intensity: npt.NDArray[np.float64], is_flat: bool
) -> None:
    """A light as a point whose intensity is shaped by direction; on its axis it is what is given. `is_flat`: it shines
    forwards alone, by the cosine."""
    reader.warn(prim, _IS_POINT)

    def factor(x: Matrix, y: Matrix, z: Matrix) -> Matrix:
        return shaping.factor(reader, prim, x, y, z) * (np.maximum(-z, 0) if is_flat else 1.0)

    _stand(reader, prim, world)
    add_thrown(reader, intensity, factor)


def _scales(world: Matrix) -> npt.NDArray[np.float64]:
    return np.asarray(np.linalg.norm(world[:3, :3], axis=1), dtype=np.float64)


def _shine(
    reader: Any, prim: Any, world: Places, light: dict[str, Any], kind: str, parameters: dict[str, Any]
) -> None:
    reader.put(world if kind == "trianglemesh" else unmirrored(world))
    if blender.is_unseen(reader, prim):
        reader.builder.add("AreaLightSource", "diffuse", light | {"bool solid": False})
        reader.builder.add("Material", "interface")
        parameters = parameters | {"string cameraview": "hidden"}
    else:
        reader.builder.add("AreaLightSource", "diffuse", light)
        # Lights reflect nothing.
        reader.builder.add("Material", "diffuse", {"rgb reflectance": (0, 0, 0)})
    reader.builder.add("Shape", kind, parameters)


def _rect(reader: Any, prim: Any, world: Places) -> None:
    x, y = _value(reader, prim, "width") / 2, _value(reader, prim, "height") / 2
    across, up = world[0, 0, :3] * 2 * x, world[0, 1, :3] * 2 * y
    area = float(np.linalg.norm(np.cross(across, up)))
    radiance = _radiance(reader, prim, area)
    texture = UsdLux.RectLight(prim).GetTextureFileAttr().Get(reader.time)
    # Seen from -z, where it shines, the corners go around against the clock.
    corners = [[-x, -y, 0], [-x, y, 0], [x, y, 0], [x, -y, 0]]
    parameters = {"point3 P": corners, "integer indices": [0, 1, 2, 0, 2, 3]}
    picture = read(file_of(reader, texture)).image if texture and texture.path else None
    if _is_thrown(reader, prim, world, radiance * area * (1 if picture is None else picture.mean(axis=(0, 1)))):
        if picture is not None:
            reader.warn(prim, "of the picture of a light that is shaped the mean is taken")
    elif picture is None:
        _shine(reader, prim, world, {"rgb L": radiance}, "trianglemesh", parameters)
    else:
        file = reader.map_file(f"rect{len(reader.builder)}.exr")
        Film.of(picture * radiance.astype(np.float32)).save(file)
        # Upright and unmirrored for who looks at it: its left is at +x.
        coordinates = [[1, 0], [1, 1], [0, 1], [0, 0]]
        _shine(reader, prim, world, {"string filename": file}, "trianglemesh", parameters | {"point2 uv": coordinates})


def _is_thrown(reader: Any, prim: Any, world: Places, intensity: npt.NDArray[np.float64]) -> bool:
    """Whether a flat light is shaped, and then it is there."""
    shaping = Shaping.of(reader, prim)
    if shaping.is_any():
        _throw(reader, prim, world, shaping, intensity, is_flat=True)
    return shaping.is_any()


def _disk(reader: Any, prim: Any, world: Places) -> None:
    radius = _value(reader, prim, "radius")
    area = math.pi * radius**2 * float(np.linalg.norm(np.cross(world[0, 0, :3], world[0, 1, :3])))
    radiance = _radiance(reader, prim, area)
    if not _is_thrown(reader, prim, world, radiance * area):
        _shine(reader, prim, _TURNED @ world, {"rgb L": radiance}, "disk", {"float radius": radius})


def _cylinder(reader: Any, prim: Any, world: Places) -> None:
    radius, length = _value(reader, prim, "radius"), _value(reader, prim, "length")
    x, y, z = _scales(world[0])
    if radius == 0 and UsdLux.CylinderLight(prim).GetTreatAsLineAttr().Get(reader.time):
        reader.warn(prim, "a light that is a line is a thousandth as thick as it is long")
        radius = length / 1000
    radiance = _radiance(reader, prim, 2 * math.pi * radius * math.sqrt(y * z) * length * x)
    # Theirs is along x, pbrt's along z.
    turn = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])
    parameters = {"float radius": radius, "float zmin": -length / 2, "float zmax": length / 2}
    _shine(reader, prim, turn @ world, {"rgb L": radiance}, "cylinder", parameters)
