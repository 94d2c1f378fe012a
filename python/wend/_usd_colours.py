"""Colours that prims of USD have themselves: the display colour, and what shaders read of others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import Sdf, UsdGeom  # type: ignore[import-not-found,import-untyped,unused-ignore]

#: The parameter of a shape that holds them on their way to a material; no word of the renderer.
COLOURS = "rgb colours"


@dataclass
class Colours:
    """Those of a primvar."""

    values: npt.NDArray[np.float64]  #: (N, 3)
    interpolation: str

    @staticmethod
    def of(prim: Any, name: str, time: Any) -> Colours | None:
        """Of the prim or what it inherits from; None where there are none."""
        if not Sdf.Path.IsValidNamespacedIdentifier(name):
            return None
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
        found = primvar.ComputeFlattened(time) if primvar and primvar.HasValue() else None
        if found is None or np.size(found) == 0:
            return None
        values = np.array(found, dtype=np.float64)
        if not primvar.GetTypeName().isArray:
            values = values[np.newaxis]
        if values.ndim == 1:
            values = np.repeat(values[:, np.newaxis], 3, axis=1)
        return Colours(values[:, :3], str(primvar.GetInterpolation()))

    def mean(self) -> tuple[float, float, float]:
        """Of all values."""
        red, green, blue = self.values.mean(axis=0)
        return (float(red), float(green), float(blue))

    def vary(self) -> bool:
        """Whether they are not all the same."""
        return bool(np.ptp(self.values, axis=0).max() > 0)


def display_colour(prim: Any, time: Any) -> tuple[float, float, float]:
    """The prim's as one, or 0.18 grey, which is what USD falls back on."""
    colours = Colours.of(prim, "displayColor", time)
    return (0.18, 0.18, 0.18) if colours is None else colours.mean()


def display_opacity(reader: Any, prim: Any) -> dict[str, Any]:
    """As a parameter of the shape; nothing where all of it is there."""
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayOpacity")
    found = primvar.ComputeFlattened(reader.time) if primvar and primvar.HasValue() else None
    # Of those that are inherited some are one number.
    values = np.atleast_1d(np.array([] if found is None else found, dtype=np.float64))
    if not values.size or values.min() >= 1:
        return {}
    if np.ptp(values) > 0:
        reader.warn(prim, "of an opacity that varies the mean is taken")
    return {"float alpha": float(np.clip(np.mean(values), 0, 1))}


def coloured(reader: Any, prim: Any, look: Any, given: npt.NDArray[np.float32] | None, indices: Any) -> str:
    """The name of the look's material with the colours of a prim, which is made for it.

    Args:
        given: those of the mesh's points; None: all of it has their mean.
        indices: of the mesh.
    """
    parameters = {name: value for name, value in look.parameters.items() if not name.endswith(" reflectance")}
    name = f"{look.name} of {prim.GetPath()}"
    if given is not None:
        name += f" {len(reader.builder)}"
        texture = {"float values": np.clip(given * look.weight, 0, 1), "integer indices": indices}
        reader.builder.add("Texture", name, "spectrum", "mesh", texture)
        parameters["texture reflectance"] = name
    elif name in reader.materials:
        return name
    else:
        reader.materials[name] = look
        colours = Colours.of(prim, look.colours, reader.time)
        if colours is not None and colours.vary():
            reader.warn(prim, "of colours that vary over what is no mesh of plain faces the mean is taken")
        colour = np.array(look.fallback if colours is None else colours.mean())
        parameters["rgb reflectance"] = np.clip(colour * look.weight, 0, 1)
    reader.builder.add("MakeNamedMaterial", name, parameters)
    return name
