"""Materials of USD: UsdPreviewSurface, its textures, and display colours."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pxr import UsdGeom, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]


@dataclass
class Look:
    """What a shape is given."""

    name: str
    emission: tuple[float, ...] | None = None
    shape_parameters: dict[str, Any] = field(default_factory=dict)


def display_colour(prim: Any, time: Any) -> tuple[float, float, float]:
    """The prim's, or 0.18 grey, which is what USD falls back on."""
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayColor")
    values = primvar.ComputeFlattened(time) if primvar and primvar.HasValue() else None
    if not values:
        return (0.18, 0.18, 0.18)
    red, green, blue = np.array(values, dtype=np.float64).reshape(-1, 3).mean(axis=0)
    return (float(red), float(green), float(blue))


def look_of(reader: Any, prim: Any, bound: Any) -> Look:
    """Makes the material if it is not there yet; the builder is inside the shape's block."""
    looks: dict[str, Look] = reader.materials
    material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
    if material:
        key = str(material.GetPath())
        if key not in looks:
            looks[key] = _preview_surface(reader, material, key)
        return looks[key]
    colour = display_colour(prim, reader.time)
    key = "displayColor {:.6g} {:.6g} {:.6g}".format(*colour)
    if key not in looks:
        parameters = {"string type": "diffuse", "rgb reflectance": np.clip(colour, 0, 1)}
        reader.builder.add("MakeNamedMaterial", key, parameters)
        looks[key] = Look(key)
    return looks[key]


class _Inputs:
    """Of a shader: constants, and textures of the renderer."""

    def __init__(self, reader: Any, shader: Any, key: str) -> None:
        self.reader, self.shader, self.key = reader, shader, key

    def _source(self, name: str) -> tuple[Any, Any]:
        """The value, or the shader that makes it."""
        given = self.shader.GetInput(name)
        if not given:
            return None, None
        attributes = given.GetValueProducingAttributes()
        if not attributes:
            return None, None
        attribute = attributes[0]
        if UsdShade.Output.IsOutput(attribute):
            return None, attribute
        return attribute.Get(self.reader.time), None

    def constant(self, name: str, fallback: Any) -> Any:
        value, output = self._source(name)
        if output is not None:
            self.reader.warn(self.shader.GetPrim(), f"a texture of {name} is left out")
        return fallback if value is None else value

    def add_to(self, parameters: dict[str, Any], name: str, ours: str, kind: str, fallback: Any) -> None:
        """Adds the parameter, as a constant or a texture. `kind` is "rgb" or "float"."""
        value, output = self._source(name)
        texture = None if output is None else self._texture(name, output, kind)
        if texture is not None:
            parameters[f"texture {ours}"] = texture
        else:
            parameters[f"{kind} {ours}"] = fallback if value is None else value

    def _texture(self, name: str, output: Any, kind: str) -> str | None:
        shader = UsdShade.Shader(output.GetPrim())
        if shader.GetIdAttr().Get() != "UsdUVTexture":
            self.reader.warn(self.shader.GetPrim(), f"{shader.GetIdAttr().Get()} as {name} is left out")
            return None
        inputs = _Inputs(self.reader, shader, self.key)
        file = inputs.constant("file", None)
        if not file or not file.path:
            return None
        space = inputs.constant("sourceColorSpace", "auto")
        encoding = {"raw": "linear", "sRGB": "sRGB"}.get(str(space), "linear" if kind == "float" else "sRGB")
        parameters: dict[str, Any] = {"string filename": file.resolvedPath or file.path, "string encoding": encoding}
        wrap = {"repeat": "repeat", "clamp": "clamp", "black": "black"}.get(str(inputs.constant("wrapS", "repeat")))
        parameters["string wrap"] = wrap or "repeat"
        scale = np.array(inputs.constant("scale", (1, 1, 1, 1)), dtype=np.float64)
        if np.ptp(scale[:3]) > 1e-6 or np.abs(np.array(inputs.constant("bias", (0, 0, 0, 0)))).max() > 1e-6:
            self.reader.warn(shader.GetPrim(), "bias, and scale by channel, of a texture are left out")
        parameters["float scale"] = float(scale[:3].mean())
        if kind == "float":
            self.reader.warn(shader.GetPrim(), "of a texture for a number the mean of red, green and blue is taken")
        texture = f"{self.key} {name}"
        self.reader.builder.add("Texture", texture, "spectrum" if kind == "rgb" else "float", "imagemap", parameters)
        return texture


def _preview_surface(reader: Any, material: Any, key: str) -> Look:
    shader = material.ComputeSurfaceSource()[0]
    if not shader or shader.GetIdAttr().Get() != "UsdPreviewSurface":
        name = shader.GetIdAttr().Get() if shader else "no surface"
        reader.warn(material.GetPrim(), f"a material of {name} is taken as its display colour")
        colour = (0.18, 0.18, 0.18)
        reader.builder.add("MakeNamedMaterial", key, {"string type": "diffuse", "rgb reflectance": colour})
        return Look(key)
    inputs = _Inputs(reader, shader, key)
    look = Look(key)
    emission = tuple(float(x) for x in inputs.constant("emissiveColor", (0, 0, 0)))
    if max(emission) > 0:
        look.emission = emission
    roughness = float(inputs.constant("roughness", 0.5))
    ior = float(inputs.constant("ior", 1.5))
    opacity = float(inputs.constant("opacity", 1))
    for name, plain in (("clearcoat", 0), ("displacement", 0), ("useSpecularWorkflow", 0)):
        if float(inputs.constant(name, plain)) != plain:
            reader.warn(shader.GetPrim(), f"{name} is left out")
    # Its roughness is the square root of the facets' alpha.
    parameters: dict[str, Any] = {"float roughness": roughness**2, "bool remaproughness": False}
    if float(inputs.constant("metallic", 0)) > 0.5:
        parameters["string type"] = "conductor"
        inputs.add_to(parameters, "diffuseColor", "reflectance", "rgb", (0.18, 0.18, 0.18))
    elif opacity <= 0.01:
        parameters |= {"string type": "dielectric", "float eta": ior}
    else:
        parameters |= {"string type": "coateddiffuse", "float eta": ior}
        inputs.add_to(parameters, "diffuseColor", "reflectance", "rgb", (0.18, 0.18, 0.18))
        if opacity < 1:
            look.shape_parameters["float alpha"] = opacity
    reader.builder.add("MakeNamedMaterial", key, parameters)
    return look
