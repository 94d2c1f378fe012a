"""Materials of USD: UsdPreviewSurface, MaterialX's standard_surface and OpenPBR, textures, and display colours."""

from __future__ import annotations

from typing import Any

import numpy as np
from pxr import UsdGeom, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._scene_reader import Look


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
            looks[key] = _surface(reader, material, key)
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
        kind_of_node = str(shader.GetIdAttr().Get())
        if kind_of_node != "UsdUVTexture" and not kind_of_node.startswith(("ND_image_", "ND_tiledimage_")):
            self.reader.warn(self.shader.GetPrim(), f"{kind_of_node} as {name} is left out")
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


#: What shaders of surfaces call the same things; the names that a shader has not are left out.
_WORDS: dict[str, dict[str, str]] = {
    "UsdPreviewSurface": {
        "colour": "diffuseColor",
        "metal": "metallic",
        "roughness": "roughness",
        "ior": "ior",
        "coat": "clearcoat",
        "coat_roughness": "clearcoatRoughness",
    },
    "ND_standard_surface_surfaceshader": {
        "colour": "base_color",
        "weight": "base",
        "metal": "metalness",
        "roughness": "specular_roughness",
        "ior": "specular_IOR",
        "coat": "coat",
        "coat_roughness": "coat_roughness",
        "coat_ior": "coat_IOR",
        "clear": "transmission",
        "clear_colour": "transmission_color",
        "clear_depth": "transmission_depth",
        "clear_scatter": "transmission_scatter",
        "clear_g": "transmission_scatter_anisotropy",
        "inside": "subsurface",
        "inside_colour": "subsurface_color",
        "inside_radius": "subsurface_radius",
        "inside_scale": "subsurface_scale",
        "inside_g": "subsurface_anisotropy",
        "shine": "emission",
        "shine_colour": "emission_color",
    },
    "ND_open_pbr_surface_surfaceshader": {
        "colour": "base_color",
        "weight": "base_weight",
        "metal": "base_metalness",
        "roughness": "specular_roughness",
        "ior": "specular_ior",
        "coat": "coat_weight",
        "coat_roughness": "coat_roughness",
        "coat_ior": "coat_ior",
        "clear": "transmission_weight",
        "clear_colour": "transmission_color",
        "clear_depth": "transmission_depth",
        "clear_scatter": "transmission_scatter",
        "clear_g": "transmission_scatter_anisotropy",
        "inside": "subsurface_weight",
        "inside_colour": "subsurface_color",
        "inside_radius": "subsurface_radius",
        "inside_radii": "subsurface_radius_scale",
        "inside_g": "subsurface_scatter_anisotropy",
        "shine": "emission_luminance",
        "shine_colour": "emission_color",
    },
}


def _surface(reader: Any, material: Any, key: str) -> Look:
    shader = material.ComputeSurfaceSource("mtlx")[0]
    if not shader or shader.GetIdAttr().Get() not in _WORDS:
        name = shader.GetIdAttr().Get() if shader else "no surface"
        reader.warn(material.GetPrim(), f"a material of {name} is taken as grey")
        reader.builder.add("MakeNamedMaterial", key, {"string type": "diffuse", "rgb reflectance": (0.18, 0.18, 0.18)})
        return Look(key)
    name = str(shader.GetIdAttr().Get())
    words = _WORDS[name]
    inputs = _Inputs(reader, shader, key)

    def constant(word: str, fallback: Any) -> Any:
        return inputs.constant(words[word], fallback) if word in words else fallback

    look = Look(key)
    if name == "UsdPreviewSurface":
        emission = np.array(inputs.constant("emissiveColor", (0, 0, 0)), dtype=np.float64)
        opacity = float(inputs.constant("opacity", 1))
        is_clear = opacity <= 0.01
        if not is_clear and opacity < 1:
            look.shape_parameters["float alpha"] = opacity
        _tell_of_others(reader, inputs, {"displacement": 0, "useSpecularWorkflow": 0})
    else:
        emission = float(constant("shine", 0)) * np.array(constant("shine_colour", (1, 1, 1)), dtype=np.float64)
        is_clear = float(constant("clear", 0)) > 0.5
        _tell_of_others(reader, inputs, {"sheen": 0, "fuzz_weight": 0, "thin_film_weight": 0})
    if emission.max() > 0:
        look.emission = tuple(float(x) for x in emission)
    roughness = 0.5 if name == "UsdPreviewSurface" else 0.2

    def facets() -> dict[str, Any]:
        # All of them square the roughness: that is the facets' alpha.
        return {"float roughness": float(constant("roughness", roughness)) ** 2, "bool remaproughness": False}

    ior = float(constant("ior", 1.5))
    grey = (0.18, 0.18, 0.18) if name == "UsdPreviewSurface" else (0.8, 0.8, 0.8)
    parameters: dict[str, Any]
    if is_clear:
        parameters = facets() | {"string type": "dielectric", "float eta": ior}
        look.medium = _inside_of_glass(reader, key, constant)
    elif float(constant("inside", 0)) > 0.5:
        parameters = facets() | {"string type": "subsurface", "float eta": ior, "float g": float(constant("inside_g", 0))}
        inputs.add_to(parameters, words["inside_colour"], "reflectance", "rgb", grey)
        radius = np.array(constant("inside_radius", (1, 1, 1)), dtype=np.float64) * float(constant("inside_scale", 1))
        radii = radius * np.array(constant("inside_radii", (1, 1, 1)), dtype=np.float64)
        parameters["rgb mfp"] = np.maximum(np.broadcast_to(radii, 3), 1e-6)
    else:
        parameters = {"string type": "principled", "float eta": ior}
        inputs.add_to(parameters, words["colour"], "reflectance", "rgb", grey)
        inputs.add_to(parameters, words["roughness"], "roughness", "float", roughness)
        inputs.add_to(parameters, words["metal"], "metallic", "float", 0.0)
        inputs.add_to(parameters, words["coat"], "coat", "float", 0.0)
        inputs.add_to(parameters, words["coat_roughness"], "coatroughness", "float", 0.01 if name == "UsdPreviewSurface" else 0.1)
        parameters["float coateta"] = float(constant("coat_ior", ior if name == "UsdPreviewSurface" else 1.5))
        if "rgb reflectance" in parameters:
            parameters["rgb reflectance"] = np.array(parameters["rgb reflectance"]) * float(constant("weight", 1))
    reader.builder.add("MakeNamedMaterial", key, parameters)
    return look


def _tell_of_others(reader: Any, inputs: _Inputs, plain: dict[str, float]) -> None:
    for name, value in plain.items():
        if float(inputs.constant(name, value)) != value:
            reader.warn(inputs.shader.GetPrim(), f"{name} is left out")


def _inside_of_glass(reader: Any, key: str, constant: Any) -> str | None:
    """A medium that colours what is `clear_depth` thick as it should, and scatters; none for clear glass."""
    depth = float(constant("clear_depth", 0))
    colour = np.clip(np.array(constant("clear_colour", (1, 1, 1)), dtype=np.float64), 1e-6, 1)
    if depth <= 0:
        if colour.min() < 1:
            reader.warn(reader.stage.GetPrimAtPath(key), "a colour of transmission without a depth is left out")
        return None
    scattering = np.broadcast_to(np.array(constant("clear_scatter", (0, 0, 0)), dtype=np.float64), 3) / depth
    absorption = -np.log(colour) / depth - scattering
    # Where more is scattered than goes missing, all channels absorb more, so that none is negative.
    absorption = absorption - min(float(absorption.min()), 0.0)
    if max(absorption.max(), scattering.max()) <= 0:
        return None
    reader.builder.add(
        "MakeNamedMedium",
        key,
        {
            "string type": "homogeneous",
            "rgb sigma_a": absorption,
            "rgb sigma_s": scattering,
            "float g": float(constant("clear_g", 0)),
        },
    )
    return key
