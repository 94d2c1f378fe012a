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

_WRAPS = {
    "repeat": "repeat",
    "periodic": "repeat",
    "clamp": "clamp",
    "black": "black",
    "constant": "black",
    "mirror": "mirror",
    # No file that is read here has such metadata.
    "useMetadata": "black",
}
_CHANNELS = {"r": 0, "g": 1, "b": 2, "outr": 0, "outg": 1, "outb": 2}


#: Inputs that may be colours of the shape: see `Inputs.primvar`.
_BASES = ("diffuseColor", "base_color")

#: Nodes that read a primvar.
_PRIMVARS = ("UsdPrimvarReader_", "ND_geompropvalue_")

#: How many nodes are followed from an input to its picture.
_DEEPEST = 16


def kind_of(shader: Any) -> str:
    """A shader's identifier; of those that MaterialX has of the preview surface's nodes, the plain one."""
    identifier = str(shader.GetIdAttr().Get())
    for plain in ("UsdPreviewSurface", "UsdUVTexture", "UsdPrimvarReader", "UsdTransform2d"):
        if identifier.startswith(f"ND_{plain}"):
            return plain if plain != "UsdPrimvarReader" else identifier.removeprefix("ND_")
    return identifier


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

    def _source(self, name: str, depth: int = 0) -> tuple[Any, Any]:
        """The value, or the output of a shader that makes it."""
        given = self.shader.GetInput(name)
        if not given:
            return None, None
        attributes = given.GetValueProducingAttributes()
        if not attributes:
            return None, None
        attribute = attributes[0]
        if UsdShade.Output.IsOutput(attribute):
            maker = UsdShade.Shader(attribute.GetPrim())
            kind = kind_of(maker)
            if kind.startswith("ND_constant_") and depth < _DEEPEST:
                return Inputs(self.reader, maker, self.key)._source("value", depth + 1)
            if kind.startswith("ND_convert_color") and depth < _DEEPEST:
                value, _ = Inputs(self.reader, maker, self.key)._source("in", depth + 1)
                return (None, attribute) if value is None else (tuple(value)[:3], None)
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

    def add_to(
        self, parameters: dict[str, Any], name: str, ours: str, kind: str, fallback: Any, factor: float = 1.0
    ) -> None:
        """Adds the parameter, as a constant or a texture, times a factor. `kind` is "rgb" or "float"."""
        value, _ = self._source(name)
        picture = self.picture(name)
        if picture is not None:
            picture.scale, picture.bias = picture.scale * factor, picture.bias * factor
            parameters[f"texture {ours}"] = self._texture(name, picture, kind)
        else:
            # What is no number ends here.
            parameters[f"{kind} {ours}"] = np.array(fallback if value is None else value) * factor

    def primvar(self, name: str) -> tuple[str, Any] | None:
        """The primvar that an input is connected to, and the value where there is none; None for anything else."""
        _, inputs, channel = self._origin(name)
        if inputs is None or channel is not None:
            return None
        kind = kind_of(inputs.shader)
        if not kind.startswith(_PRIMVARS):
            return None
        is_usd = kind.startswith("Usd")
        called = inputs.constant("varname" if is_usd else "geomprop", None)
        fallback = inputs.constant("fallback" if is_usd else "default", (0.0, 0.0, 0.0))
        return (str(called), np.broadcast_to(np.array(fallback, dtype=np.float64)[:3], 3)) if called else None

    def _origin(self, name: str) -> tuple[Any, Inputs | None, str | None]:
        """The output that an input's value comes from, its node, and the channel that is taken of it, if it is one; through
        nodes that convert it. None where nothing is connected."""
        _, output = self._source(name)
        inputs, channel = None, None
        for _ in range(_DEEPEST):
            if output is None:
                return None, None, None
            inputs = Inputs(self.reader, UsdShade.Shader(output.GetPrim()), self.key)
            kind = kind_of(inputs.shader)
            if kind.startswith("ND_extract_color"):
                channel = "rgba"[min(max(int(inputs.constant("index", 0)), 0), 3)]
            elif not kind.startswith("ND_convert_color"):
                break
            _, output = inputs._source("in")
        return output, inputs, channel

    def picture(self, name: str) -> Picture | None:
        """What an input is connected to; None where that is no picture, which is told if it is something else."""
        output, inputs, channel = self._origin(name)
        if inputs is None or output is None:
            return None
        kind = kind_of(inputs.shader)
        if kind != "UsdUVTexture" and not kind.startswith(("ND_image_", "ND_tiledimage_")):
            if kind.startswith(_PRIMVARS) and name in _BASES and channel is None:
                return None
            self.reader.warn(self.shader.GetPrim(), f"{kind} as {name} is left out")
            return None
        file = inputs.constant("file", None)
        if not file or not file.path:
            return None
        is_usd = kind == "UsdUVTexture"
        path = file_of(self.reader, file)
        picture = Picture(path, inputs._is_encoded(kind, path), inputs._wrap(is_usd), channel or str(output.GetBaseName()))
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

    def _is_encoded(self, kind: str, file: str) -> bool:
        """Whether a texture's node has colours in sRGB; what it does not say is taken so, if they are colours of 8 bits."""
        if kind.startswith("ND_") and "_color" not in kind:
            # Numbers are never converted there.
            return False
        attribute = self.shader.GetInput("file").GetAttr()
        named = str(attribute.GetColorSpace()) if attribute.HasColorSpace() else ""
        space = named or str(self.constant("sourceColorSpace", "auto"))
        if space == "auto":
            return has_bytes(file) and not is_grey(file)
        return space.lower().startswith("srgb")

    def _wrap(self, is_usd: bool) -> str:
        """What is beyond the edges."""
        names = ("wrapS", "wrapT") if is_usd else ("uaddressmode", "vaddressmode")
        # MaterialX repeats, also by its own nodes of USD's names.
        is_plain = not str(self.shader.GetIdAttr().Get()).startswith("ND_")
        fallback = "useMetadata" if is_plain else "periodic"
        across, upwards = (_WRAPS.get(str(self.constant(name, fallback)), "repeat") for name in names)
        if across != upwards:
            self.reader.warn(self.shader.GetPrim(), f"a picture goes on upwards as it does sideways ({names[0]})")
        return across

    def _find_coordinates(self, name: str, picture: Picture) -> None:
        """Follows the coordinates of a texture's node to their primvar, through transforms."""
        inputs = self
        for _ in range(_DEEPEST):
            _, output = inputs._source(name)
            if output is None:
                return
            inputs = Inputs(self.reader, UsdShade.Shader(output.GetPrim()), self.key)
            kind = kind_of(inputs.shader)
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


def is_grey(file: str) -> bool:
    """Whether a picture has one channel, and perhaps an opacity; of PNG and JPEG files."""
    with open(file, "rb") as opened:
        head = opened.read(1 << 16)
    if head.startswith(b"\x89PNG"):
        return len(head) > 25 and head[25] in (0, 4)
    place = 2
    # JPEG: segments up to the one of the frame, which has the number of channels.
    while head.startswith(b"\xff\xd8") and place + 9 < len(head) and head[place] == 0xFF:
        if head[place + 1] in (0xC0, 0xC1, 0xC2):
            return head[place + 9] == 1
        place += 2 + int.from_bytes(head[place + 2 : place + 4], "big")
    return False


def has_bytes(file: str) -> bool:
    """Whether a picture's numbers are of 8 bits, which are read as sRGB."""
    name = file.lower()
    if name.endswith(".png"):
        with open(file, "rb") as opened:
            head = opened.read(25)
        return len(head) == 25 and head[24] <= 8
    return name.endswith((".jpg", ".jpeg", ".tga", ".bmp", ".qoi", ".gif"))
