"""Materials of USD: UsdPreviewSurface, MaterialX's standard_surface and OpenPBR, textures, and display colours."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdGeom, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _usd_blender as blender
from ._scene_reader import Look
from ._usd_colours import Colours, display_colour, display_opacity
from ._usd_material_words import COAT_IOR, COAT_ROUGHNESS, NOT_HERE, SHEEN_ROUGHNESS, WORDS
from ._usd_textures import Inputs, kind_of


def shines(reader: Any, prim: Any) -> bool:
    """Whether the prim, or some of its faces, give light by their material."""
    if not prim.IsA(UsdGeom.Gprim):
        return False
    subsets = UsdGeom.Subset.GetGeomSubsets(UsdGeom.Mesh(prim), UsdGeom.Tokens.face, "materialBind") if prim.IsA(UsdGeom.Mesh) else []
    return any(look_of(reader, prim, bound).shine is not None for bound in (prim, *(subset.GetPrim() for subset in subsets)))


@dataclass
class UsdLook(Look):
    """What a shape of USD is given."""

    shine: dict[str, Any] | None = None  #: parameters of its light; None: it is dark
    coordinates: str | None = None  #: the primvar that its pictures lie by; None: the usual one
    colours: str | None = None  #: the primvar that is its base colour; None: the material has one
    fallback: Any = (0.0, 0.0, 0.0)  #: the colour where there is no such primvar
    weight: float = 1.0  #: which both are multiplied by
    #: what takes its texture coordinates to those that it is given; columns are points
    frame: npt.NDArray[np.float64] = field(default_factory=lambda: np.eye(3))
    parameters: dict[str, Any] = field(default_factory=dict)  #: of the material

    @property
    def has_pictures(self) -> bool:
        """Whether some of it lies by texture coordinates."""
        given = [*self.parameters, *self.shape_parameters, *(self.shine or {})]
        return any(name.startswith("texture ") or name in ("string normalmap", "string filename") for name in given)


def look_of(reader: Any, prim: Any, bound: Any) -> UsdLook:
    """Makes the material if it is not there yet, wherever the builder is."""
    looks: dict[str, UsdLook] = reader.materials
    # What is bound for all purposes is taken where nothing is bound for renders.
    material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial(reader.binding_purpose)
    if material:
        key = str(material.GetPath())
        if key not in looks:
            looks[key] = _surface(reader, material, key)
        return looks[key]
    colour = display_colour(prim, reader.time)
    colours = Colours.of(prim, "displayColor", reader.time)
    varies = colours is not None and colours.vary()
    opacity = display_opacity(reader, prim)
    key = "displayColor {:.6g} {:.6g} {:.6g}".format(*colour) + f"{' varied' * varies} {opacity.get('float alpha', '')}".rstrip()
    if key not in looks:
        parameters = {"string type": "diffuse", "rgb reflectance": np.clip(colour, 0, 1)}
        reader.builder.add("MakeNamedMaterial", key, parameters)
        looks[key] = UsdLook(key, shape_parameters=opacity, colours="displayColor" if varies else None, parameters=parameters)
    return looks[key]


class _Surface:
    """A shader of a surface, by the words of `_usd_material_words`.

    Args:
        reader: of the stage.
        shader: of a kind that has words.
        key: what its material is called.
    """

    def __init__(self, reader: Any, shader: Any, key: str) -> None:
        self.reader, self.key = reader, key
        self.kind = kind_of(shader)
        self.is_preview = self.kind == "UsdPreviewSurface"
        self.words = WORDS[self.kind]
        self.inputs = Inputs(reader, shader, key)
        self.look = UsdLook(key)

    def constant(self, word: str, fallback: Any) -> Any:
        return self.inputs.constant(self.words[word], fallback) if word in self.words else fallback

    def add_to(
        self, parameters: dict[str, Any], word: str, ours: str, kind: str, fallback: Any, factor: float = 1.0
    ) -> None:
        if word in self.words:
            self.inputs.add_to(parameters, self.words[word], ours, kind, fallback, factor)

    def made(self) -> UsdLook:
        """The look, after its material was made."""
        for name, idle in NOT_HERE[self.kind].items():
            if self.inputs.is_connected(name) or (idle is not None and float(self.inputs.constant(name, idle)) != idle):
                self.reader.warn(self.inputs.shader.GetPrim(), f"{name} is left out")
        for word in ("clear", "inside"):
            if 0 < float(self.constant(word, 0)) < 1:
                whole = "all or nothing, by whether it is above 1/2"
                self.reader.warn(self.inputs.shader.GetPrim(), f"{self.words[word]} is taken as {whole}")
        self._find_frame()
        self._shine()
        is_clear = self._opacity() if self.is_preview else float(self.constant("clear", 0)) > 0.5
        ior = float(self.constant("ior", 1.5))
        if is_clear:
            parameters = self._glass(ior)
        elif self.is_preview and blender.is_matt(self.inputs):
            parameters = {"string type": "diffuse"}
            self.add_to(parameters, "colour", "reflectance", "rgb", self._grey())
        elif float(self.constant("inside", 0)) > 0.5:
            parameters = self._wax(ior)
        else:
            parameters = self._solid(ior)
        if parameters["string type"] != "principled" and self._has_sheen():
            self.reader.warn(self.inputs.shader.GetPrim(), "the sheen of what is clear or waxen is left out")
        if "opacity" in self.words:
            opacity = self.constant("opacity", 1)
            if np.min(opacity) < 1:
                self.look.shape_parameters["float alpha"] = float(np.clip(np.mean(opacity), 0, 1))
        self._normals(parameters)
        self._colours(parameters)
        self.look.parameters = parameters
        self.reader.builder.add("MakeNamedMaterial", self.key, parameters)
        named = self.inputs.coordinates
        if named:
            self.look.coordinates = named[0]
            if any(name != named[0] for name in named):
                self.reader.warn(self.inputs.shader.GetPrim(), "all pictures of a material lie by the coordinates of the first")
        return self.look

    def _colours(self, parameters: dict[str, Any]) -> None:
        """Where the base colour is one of the shape's."""
        found = self.inputs.primvar(self.words["colour"])
        # What is clear or waxen has none, or another one.
        if found is not None and parameters["string type"] in ("diffuse", "principled"):
            self.look.colours, self.look.fallback = found
            self.look.weight = float(self.constant("weight", 1))

    def _find_frame(self) -> None:
        """Where pictures lie that have no place of their own here: of what shines, and of normals. The shape's coordinates
        are theirs, and all others' are taken back."""
        names = [self.words["shine_colour"]] if self._strength() > 0 else []
        for name in [*names, "normal"] if self.is_preview else names:
            picture = self.inputs.picture(name, is_packed=name == "normal") if self.inputs.is_connected(name) else None
            if picture is not None:
                turn = picture.uv_matrix[:2, :2]
                if turn[0, 1] == turn[1, 0] == 0 and np.diag(turn).min() > 0:
                    self.look.frame = self.inputs.frame = picture.uv_matrix
                    return

    def _strength(self) -> float:
        """Of what it shines with."""
        return float(self.constant("shine", 1.0 if self.is_preview else 0.0))

    def _tell_of_place(self, picture: Any, what: str) -> None:
        if not np.allclose(picture.uv_matrix, self.look.frame, atol=1e-9):
            self.reader.warn(self.inputs.shader.GetPrim(), f"a picture {what} lies where another one of its material does")

    def _shine(self) -> None:
        name = self.words["shine_colour"]
        strength = self._strength()
        picture = self.inputs.picture(name) if strength > 0 else None
        if picture is not None:
            picture.scale = picture.scale * strength
            self._tell_of_place(picture, "that shines")
            self.look.shine = {"string filename": self.inputs.made(picture), "bool twosided": True}
            return
        colour = np.array(self.inputs.constant(name, (0, 0, 0) if self.is_preview else (1, 1, 1)), dtype=np.float64) * strength
        if colour.max() > 0:
            self.look.shine = {"rgb L": colour, "bool twosided": True}

    def _opacity(self) -> bool:
        """Of a preview surface: whether it is clear."""
        threshold = float(self.inputs.constant("opacityThreshold", 0))
        is_presence = str(self.inputs.constant("opacityMode", "transparent")) == "presence"
        if self.inputs.is_connected("opacity"):
            if threshold > 0:
                self.reader.warn(self.inputs.shader.GetPrim(), "the opacityThreshold of a picture is left out")
            self._add_alpha("opacity")
            return False
        opacity = float(self.inputs.constant("opacity", 1))
        if threshold > 0:
            opacity = 1.0 if opacity >= threshold else 0.0
            self.look.shape_parameters["float alpha"] = opacity
            return False
        if opacity < 1 and (is_presence or opacity > 0.01):
            self.look.shape_parameters["float alpha"] = opacity
            if not is_presence and not blender.wrote(self.inputs.shader.GetInput("opacity").GetAttr()):
                self.reader.warn(self.inputs.shader.GetPrim(), "an opacity between 0 and 1 takes its share of what is reflected as well")
        return opacity <= 0.01 and not is_presence

    def _add_alpha(self, name: str) -> None:
        self.inputs.add_to(self.look.shape_parameters, name, "alpha", "float", 1.0)

    def _facets(self) -> dict[str, Any]:
        # All of them square the roughness: that is the facets' alpha.
        roughness = float(self.constant("roughness", self._roughness()))
        return {"float roughness": roughness**2, "bool remaproughness": False}

    def _has_sheen(self) -> bool:
        name = self.words.get("sheen")
        return name is not None and (self.inputs.is_connected(name) or float(self.inputs.constant(name, 0)) > 0)

    def _roughness(self) -> float:
        return 0.5 if self.is_preview else 0.2 if self.kind == "ND_standard_surface_surfaceshader" else 0.3

    def _grey(self) -> tuple[float, float, float]:
        return (0.18, 0.18, 0.18) if self.is_preview else (0.8, 0.8, 0.8)

    def _glass(self, ior: float) -> dict[str, Any]:
        parameters = self._facets() | {"string type": "dielectric", "float eta": ior}
        if float(self.constant("clear_depth", 0)) > 0:
            self.look.medium = _inside_of_glass(self.reader, self.key, self.constant)
        elif "clear_colour" in self.words:
            colour = np.clip(np.array(self.constant("clear_colour", (1, 1, 1)), dtype=np.float64), 0, 1)
            # Blender's is that of two boundaries.
            is_of_two = blender.wrote(self.inputs.shader.GetInput(self.words["clear_colour"]).GetAttr())
            parameters["rgb transmittance"] = np.sqrt(colour) if is_of_two else colour
        return parameters

    def _wax(self, ior: float) -> dict[str, Any]:
        parameters = self._facets() | {"string type": "subsurface", "float eta": ior, "float g": float(self.constant("inside_g", 0))}
        self.add_to(parameters, "inside_colour", "reflectance", "rgb", self._grey())
        radius = np.array(self.constant("inside_radius", (1, 1, 1)), dtype=np.float64) * float(self.constant("inside_scale", 1))
        radii = radius
        if "inside_radii" in self.words:
            radii = radius * np.array(self.constant("inside_radii", (1, 0.5, 0.25)), dtype=np.float64)
        parameters["rgb mfp"] = np.maximum(np.broadcast_to(radii, 3), 1e-6)
        return parameters

    def _solid(self, ior: float) -> dict[str, Any]:
        parameters: dict[str, Any] = {"string type": "principled", "float eta": ior}
        self.add_to(parameters, "colour", "reflectance", "rgb", self._grey(), float(self.constant("weight", 1)))
        self.add_to(parameters, "roughness", "roughness", "float", self._roughness())
        self.add_to(parameters, "metal", "metallic", "float", 0.0)
        self.add_to(parameters, "coat", "coat", "float", 0.0)
        self.add_to(parameters, "coat_roughness", "coatroughness", "float", COAT_ROUGHNESS.get(self.kind, 0.0))
        parameters["float coateta"] = float(self.constant("coat_ior", ior if self.is_preview else COAT_IOR.get(self.kind, 1.6)))
        if self._has_sheen():
            self.add_to(parameters, "sheen", "sheen", "float", 0.0)
            self.add_to(parameters, "sheen_colour", "sheentint", "rgb", (1.0, 1.0, 1.0))
            self.add_to(parameters, "sheen_roughness", "sheenroughness", "float", SHEEN_ROUGHNESS.get(self.kind, 0.5))
        specular = blender.specular(self.inputs) if self.is_preview else float(self.constant("specular", 1))
        if specular != 1 and self.kind == "ND_standard_surface_surfaceshader":
            parameters["float specular"] = specular
        elif specular != 1:
            # Another index, which reflects so much more.
            root = min(((ior - 1) / (ior + 1)) ** 2 * max(specular, 0.0), 0.99) ** 0.5
            parameters["float eta"] = (1 + root) / (1 - root) if ior >= 1 else (1 - root) / (1 + root)
        self._details(parameters, ior)
        return parameters

    def _details(self, parameters: dict[str, Any], ior: float) -> None:
        """Tints, chalk, and how it is brushed."""
        if self.is_preview:
            self._reflected_colour(parameters)
            return
        for word, ours in (("tint", "speculartint"), ("coat_colour", "coattint")):
            if self.inputs.is_connected(self.words[word]) or np.min(self.constant(word, 1)) < 1:
                self.add_to(parameters, word, ours, "rgb", (1.0, 1.0, 1.0))
        if self.inputs.is_connected(self.words["chalk"]) or float(self.constant("chalk", 0)) > 0:
            self.add_to(parameters, "chalk", "diffuseroughness", "float", 0.0)
        brushed = float(self.constant("brushed", 0))
        if brushed > 0:
            # The square of how much rougher facets are along one direction than across it.
            parameters["float anisotropy"] = min(brushed / 0.9, 1.0)
            if self.kind == "ND_open_pbr_surface_surfaceshader" and "float roughness" in parameters:
                mean = 2 * max(1 - brushed, 0.1) / (1 + (1 - brushed) ** 2)
                parameters["float roughness"] = float(parameters["float roughness"]) * mean**0.25

    def _reflected_colour(self, parameters: dict[str, Any]) -> None:
        """Of a preview surface that is given by what it reflects from above."""
        if int(self.inputs.constant("useSpecularWorkflow", 0)) == 0:
            return
        colour = np.clip(np.array(self.constant("tint", (0, 0, 0)), dtype=np.float64), 0, 1)
        root = min(max(float(colour.max()), 1e-6), 0.99) ** 0.5
        parameters.pop("texture metallic", None)
        parameters |= {"float metallic": 0.0, "float eta": (1 + root) / (1 - root)}
        if colour.max() > 0:
            parameters["rgb speculartint"] = colour / colour.max()

    def _normals(self, parameters: dict[str, Any]) -> None:
        if not self.is_preview:
            return
        if not self.inputs.is_connected("normal"):
            if not np.allclose(self.inputs.constant("normal", (0, 0, 1)), (0, 0, 1)):
                self.reader.warn(self.inputs.shader.GetPrim(), "a normal that is the same everywhere is left out")
            return
        picture = self.inputs.picture("normal", is_packed=True)
        if picture is None:
            return
        unpacked = np.allclose(picture.scale[:3], 2) and np.allclose(picture.bias[:3], -1)
        if picture.is_encoded or not (unpacked or (np.allclose(picture.scale[:3], 1) and np.allclose(picture.bias[:3], 0))):
            self.reader.warn(self.inputs.shader.GetPrim(), "a picture of normals is taken as they are packed in 8 bits")
        self._tell_of_place(picture, "of normals")
        parameters["string normalmap"] = picture.file


def _surface(reader: Any, material: Any, key: str) -> UsdLook:
    of_materialx, plain = (material.ComputeSurfaceSource(context)[0] for context in ("mtlx", ""))
    names = [kind_of(shader) if shader else "no surface" for shader in (of_materialx, plain)]
    if names[0] in WORDS:
        return _Surface(reader, of_materialx, key).made()
    if names[1] in WORDS:
        reader.warn(material.GetPrim(), f"of a material of {names[0]} the {names[1]} is taken")
        return _Surface(reader, plain, key).made()
    reader.warn(material.GetPrim(), f"a material of {names[0]} is taken as grey")
    reader.builder.add("MakeNamedMaterial", key, {"string type": "diffuse", "rgb reflectance": (0.18, 0.18, 0.18)})
    return UsdLook(key)


def _inside_of_glass(reader: Any, key: str, constant: Any) -> str | None:
    """A medium that colours what is `clear_depth` thick as it should, and scatters; none for clear glass."""
    depth = float(constant("clear_depth", 0))
    colour = np.clip(np.array(constant("clear_colour", (1, 1, 1)), dtype=np.float64), 1e-6, 1)
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
