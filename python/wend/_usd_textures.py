"""Inputs of USD's shaders: constants, and pictures as textures of the renderer."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._film import Film, read
from ._usd_files import file_of

Matrix = npt.NDArray[np.float64]

_WRAPS = {"repeat": "repeat", "periodic": "repeat", "clamp": "clamp", "black": "black", "constant": "black", "mirror": "mirror"}
_CHANNELS = {"r": 0, "g": 1, "b": 2, "outr": 0, "outg": 1, "outb": 2}


#: How many nodes are followed from an input to its picture.
_DEEPEST = 16


@dataclass
class Picture:
    """What a texture's node says: its value is the pixel times `scale` plus `bias`."""

    file: str
    is_encoded: bool  #: in sRGB, as far as it has 8 bits
    wrap: str
    channel: str  #: of its outputs
    scale: Matrix = field(default_factory=lambda: np.ones(4))
    bias: Matrix = field(default_factory=lambda: np.zeros(4))
    uv_matrix: Matrix = field(default_factory=lambda: np.eye(3))  #: columns are points
    coordinates: str | None = None  #: the primvar; None: the usual one

    def pixels(self) -> npt.NDArray[np.float32]:
        """The values, linear, (height, width, 3); of one channel three times."""
        image = np.asarray(read(self.file).image, dtype=np.float64)
        if not self.is_encoded and has_bytes(self.file):
            # They were decoded.
            image = np.where(image <= 0.0031308, 12.92 * image, 1.055 * np.maximum(image, 0.0031308) ** (1 / 2.4) - 0.055)
        image = image * self.scale[:3] + self.bias[:3]
        channel = _CHANNELS.get(self.channel)
        return (image if channel is None else np.repeat(image[:, :, [channel]], 3, axis=2)).astype(np.float32)


class Inputs:
    """Of a shader.

    Args:
        reader: of the stage.
        key: of the material, which textures are named by.
    """

    def __init__(self, reader: Any, shader: Any, key: str) -> None:
        self.reader, self.shader, self.key = reader, shader, key
        #: names of the primvars that textures lie by
        self.coordinates: list[str] = []

    def _source(self, name: str) -> tuple[Any, Any]:
        """The value, or the output of a shader that makes it."""
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

    def is_connected(self, name: str) -> bool:
        """To something that varies."""
        return self._source(name)[1] is not None

    def constant(self, name: str, fallback: Any) -> Any:
        value, output = self._source(name)
        if output is not None:
            self.reader.warn(self.shader.GetPrim(), f"a texture of {name} is left out")
        return fallback if value is None else value

    def add_to(self, parameters: dict[str, Any], name: str, ours: str, kind: str, fallback: Any) -> None:
        """Adds the parameter, as a constant or a texture. `kind` is "rgb" or "float"."""
        value, _ = self._source(name)
        picture = self.picture(name)
        if picture is not None:
            parameters[f"texture {ours}"] = self._texture(name, picture, kind)
        else:
            parameters[f"{kind} {ours}"] = fallback if value is None else value

    def picture(self, name: str) -> Picture | None:
        """What an input is connected to; None where that is no picture, which is told if it is something else."""
        _, output = self._source(name)
        channel = None
        for _ in range(_DEEPEST):
            if output is None:
                return None
            shader = UsdShade.Shader(output.GetPrim())
            kind = str(shader.GetIdAttr().Get())
            inputs = Inputs(self.reader, shader, self.key)
            if kind.startswith("ND_extract_color"):
                channel = "rgba"[min(max(int(inputs.constant("index", 0)), 0), 3)]
            elif not kind.startswith("ND_convert_color"):
                break
            _, output = inputs._source("in")
        if kind != "UsdUVTexture" and not kind.startswith(("ND_image_", "ND_tiledimage_")):
            self.reader.warn(self.shader.GetPrim(), f"{kind} as {name} is left out")
            return None
        file = inputs.constant("file", None)
        if not file or not file.path:
            return None
        is_usd = kind == "UsdUVTexture"
        picture = Picture(
            file_of(self.reader, file),
            inputs._is_encoded(),
            _WRAPS.get(str(inputs.constant("wrapS" if is_usd else "uaddressmode", "repeat")), "repeat"),
            channel or str(output.GetBaseName()),
        )
        if is_usd:
            picture.scale = np.array(inputs.constant("scale", (1, 1, 1, 1)), dtype=np.float64)
            picture.bias = np.array(inputs.constant("bias", (0, 0, 0, 0)), dtype=np.float64)
        elif kind.startswith("ND_tiledimage_"):
            tiling, offset = (inputs.constant(name, value) for name, value in (("uvtiling", (1, 1)), ("uvoffset", (0, 0))))
            picture.uv_matrix = _placed(np.array(tiling, dtype=np.float64), 0.0, np.array(offset, dtype=np.float64))
        inputs._find_coordinates("st" if is_usd else "texcoord", picture)
        if picture.coordinates is not None:
            self.coordinates.append(picture.coordinates)
        return picture

    def _is_encoded(self) -> bool:
        """Whether a texture's node has colours in sRGB; what it does not say is taken so."""
        attribute = self.shader.GetInput("file").GetAttr()
        named = str(attribute.GetColorSpace()) if attribute.HasColorSpace() else ""
        space = named or str(self.constant("sourceColorSpace", "auto"))
        return space in ("auto", "sRGB") or space.lower().startswith("srgb")

    def _find_coordinates(self, name: str, picture: Picture) -> None:
        """Follows the coordinates of a texture's node to their primvar, through transforms."""
        inputs = self
        for _ in range(_DEEPEST):
            _, output = inputs._source(name)
            if output is None:
                return
            inputs = Inputs(self.reader, UsdShade.Shader(output.GetPrim()), self.key)
            kind = str(inputs.shader.GetIdAttr().Get())
            if kind == "UsdTransform2d":
                scale, place = (
                    np.array(inputs.constant(n, v), dtype=np.float64) for n, v in (("scale", (1, 1)), ("translation", (0, 0)))
                )
                turn = np.radians(float(inputs.constant("rotation", 0.0)))
                # What is nearer to the texture comes last.
                picture.uv_matrix = picture.uv_matrix @ _placed(scale, turn, place)
                name = "in"
            elif kind.startswith(("UsdPrimvarReader", "ND_geompropvalue")):
                varname = inputs.constant("varname" if kind.startswith("Usd") else "geomprop", None)
                picture.coordinates = str(varname) if varname else None
                return
            elif kind.startswith("ND_texcoord"):
                return
            else:
                self.reader.warn(inputs.shader.GetPrim(), f"{kind} as coordinates of a texture is left out")
                return

    def _texture(self, name: str, picture: Picture, kind: str) -> str:
        parameters: dict[str, Any] = {"string wrap": picture.wrap}
        scale = picture.scale[:3]
        is_opacity = picture.channel in ("a", "outa")
        if is_opacity:
            # Of a file with an opacity a number is the opacity.
            scale = picture.scale[3:]
            if picture.bias[3] != 0:
                self.reader.warn(self.shader.GetPrim(), "the bias of an opacity is left out")
        elif kind == "float" and picture.channel not in _CHANNELS:
            self.reader.warn(self.shader.GetPrim(), "of a texture for a number the luminance is taken")
            parameters["string channels"] = "luminance"
        is_plain = picture.channel not in _CHANNELS and np.ptp(scale) <= 1e-6 and np.abs(picture.bias[:3]).max() <= 1e-6
        if not is_opacity and (kind == "float" or not is_plain):
            parameters |= {"string filename": self.made(picture), "string encoding": "linear"}
        else:
            encoding = "sRGB" if picture.is_encoded and kind == "rgb" else "linear"
            parameters |= {"string filename": picture.file, "string encoding": encoding, "float scale": float(scale.mean())}
        if not np.array_equal(picture.uv_matrix, np.eye(3)):
            parameters["float uvmatrix"] = picture.uv_matrix[:2].reshape(-1)
        texture = f"{self.key} {name}"
        self.reader.builder.add("Texture", texture, "spectrum" if kind == "rgb" else "float", "imagemap", parameters)
        return texture

    def made(self, picture: Picture) -> str:
        """A file with the values of a picture."""
        file: str = self.reader.map_file(f"texture{len(self.reader.builder)}.exr")
        Film.of(picture.pixels()).save(file)
        return file


def _placed(scale: Matrix, turn: float, place: Matrix) -> Matrix:
    """Scaled, then turned against the clock, then moved."""
    c, s = np.cos(turn), np.sin(turn)
    result = np.eye(3)
    result[:2, :2] = np.array([[c, -s], [s, c]]) @ np.diag(scale[:2])
    result[:2, 2] = place[:2]
    return result


def has_bytes(file: str) -> bool:
    """Whether a picture's numbers are of 8 bits, which are read as sRGB."""
    name = file.lower()
    if name.endswith(".png"):
        with open(file, "rb") as opened:
            head = opened.read(25)
        return len(head) == 25 and head[24] <= 8
    return name.endswith((".jpg", ".jpeg", ".tga", ".bmp", ".qoi", ".gif"))
