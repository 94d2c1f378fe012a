"""Inputs of USD's shaders: constants, and pictures as textures of the renderer."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._film import Film, opacity_of, read
from ._udim import Tile, encoded, laid_out
from ._usd_files import file_called, name_of, tiles_of
from ._usd_spaces import has_bytes, is_encoded_space, is_grey

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

#: Nodes of pictures.
_PICTURES = ("UsdUVTexture", "ND_image_", "ND_tiledimage_")

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

    @property
    def is_opacity(self) -> bool:
        return self.channel in ("a", "outa")

    def pixels(self) -> npt.NDArray[np.float32]:
        """The values, linear, (height, width, 3); of one channel three times."""
        if self.is_opacity:
            opacity = opacity_of(self.file) * self.scale[3] + self.bias[3]
            return np.repeat(opacity[:, :, None], 3, axis=2).astype(np.float32)
        image = np.asarray(read(self.file).image, dtype=np.float64)
        if not self.is_encoded and (has_bytes(self.file) or self.file.lower().endswith(".png")):
            # They were decoded.
            image = np.asarray(encoded(image), dtype=np.float64)
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
        #: what takes texture coordinates to those that the shape is given
        self.frame = np.eye(3)

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
            if kind.startswith("ND_extract_color") and depth < _DEEPEST:
                inputs = Inputs(self.reader, maker, self.key)
                value, _ = inputs._source("in", depth + 1)
                return (None, attribute) if value is None else (tuple(value)[inputs._channel()], None)
            if kind.startswith(_PICTURES):
                inputs = Inputs(self.reader, maker, self.key)
                if not inputs._is_there():
                    return inputs._missing(str(attribute.GetBaseName())), None
            return None, attribute
        space = str(attribute.GetColorSpace()) if attribute.HasColorSpace() else ""
        if is_encoded_space(space) is not False and attribute.GetTypeName().role == "Color":
            what = f"colours of the space {space}, not those of pictures,"
            self.reader.warn(attribute.GetPrim(), f"{what} are taken as linear ones of sRGB")
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
            pixels = picture.pixels() if picture.is_opacity else None
            if pixels is not None and np.ptp(pixels) == 0:
                parameters[f"{kind} {ours}"] = pixels[0, 0, 0] if kind == "float" else pixels[0, 0]
                return
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
                channel = "rgba"[inputs._channel()]
            elif not kind.startswith("ND_convert_color"):
                break
            _, output = inputs._source("in")
        return output, inputs, channel

    def _channel(self) -> int:
        """Of a node that takes one of a colour."""
        return min(max(int(self.constant("index", 0)), 0), 3)

    def _is_there(self) -> bool:
        """Whether a texture's node has a picture; what it has not is told."""
        asset = self.constant("file", None)
        if asset is None or not asset.path:
            self.reader.warn(self.shader.GetPrim(), "a texture without a file has its fallback")
            return False
        tiles = tiles_of(self._file_attribute(), asset)
        if tiles or (tiles is None and file_called(self.reader, name_of(asset)) is not None):
            return True
        self.reader.warn(self.shader.GetPrim(), f"{name_of(asset)}: there is no such file: its texture has its fallback")
        return False

    def _file_attribute(self) -> Any:
        """What says which file it is."""
        given = self.shader.GetInput("file")
        return (given.GetValueProducingAttributes() or [given.GetAttr()])[0]

    def _missing(self, channel: str) -> Any:
        """What a texture's node has where there is no picture, as it is: neither scaled nor moved."""
        if kind_of(self.shader) != "UsdUVTexture":
            value = self.constant("default", 0.0)
            return tuple(value)[:3] if np.ndim(value) else value
        value = tuple(float(x) for x in self.constant("fallback", (0, 0, 0, 1)))
        place = "rgba".find(channel.removeprefix("out"))
        return value[place] if place >= 0 and len(channel.removeprefix("out")) == 1 else value[:3]

    def picture(self, name: str, is_packed: bool = False) -> Picture | None:
        """What an input is connected to; None where that is no picture, which is told if it is something else.

        Args:
            is_packed: of normals as files have them, which are not scaled and moved.
        """
        output, inputs, channel = self._origin(name)
        if inputs is None or output is None:
            return None
        kind = kind_of(inputs.shader)
        if not kind.startswith(_PICTURES):
            if kind.startswith(_PRIMVARS) and name in _BASES and channel is None:
                return None
            self.reader.warn(self.shader.GetPrim(), f"{kind} as {name} is left out")
            return None
        asset = inputs.constant("file", None)
        is_usd = kind == "UsdUVTexture"
        tiles = tiles_of(inputs._file_attribute(), asset)
        path = file_called(self.reader, name_of(asset) if tiles is None else next(iter(tiles.values())))
        if path is None:
            # The tiles of a package that went away meanwhile.
            return None
        picture = Picture(path, inputs._is_encoded(kind, path), inputs._wrap(is_usd), channel or str(output.GetBaseName()))
        if is_usd:
            picture.scale = np.array(inputs.constant("scale", (1, 1, 1, 1)), dtype=np.float64)
            picture.bias = np.array(inputs.constant("bias", (0, 0, 0, 0)), dtype=np.float64)
        elif kind.startswith("ND_tiledimage_"):
            picture.uv_matrix = inputs._tiled()
        inputs._find_coordinates("st" if is_usd else "texcoord", picture)
        if tiles is not None:
            inputs._lay_out(picture, tiles, is_packed)
        if picture.coordinates is not None:
            self.coordinates.append(picture.coordinates)
        return picture

    def _tiled(self) -> Matrix:
        """Of a node that lays a picture out again and again: its offset is taken away."""
        names = {"uvtiling": (1, 1), "uvoffset": (0, 0), "realworldimagesize": (1, 1), "realworldtilesize": (1, 1)}
        values = (np.array(self.constant(name, value), dtype=np.float64) for name, value in names.items())
        tiling, offset, of_image, of_tile = values
        scale = of_tile / np.where(of_image == 0, 1, of_image)
        return _placed(tiling * scale, 0.0, -offset * scale)

    def _lay_out(self, picture: Picture, tiles: dict[Tile, str], is_packed: bool) -> None:
        """Makes one picture of tiles, with what its node has where there is none."""
        missing = np.broadcast_to((0.5, 0.5, 1) if is_packed else self._missing(picture.channel), 3)
        if is_packed:
            picture.scale, picture.bias, picture.is_encoded = np.ones(4), np.zeros(4), False
        key = (tuple(tiles.values()), is_packed, picture.channel, picture.is_encoded, *picture.scale, *picture.bias, *missing)
        sheets = self.reader.sheets
        if key not in sheets:
            files = {tile: file_called(self.reader, name) for tile, name in tiles.items()}
            pixels = {tile: replace(picture, file=file).pixels for tile, file in files.items() if file is not None}
            # Normals are repeated, so that those before the first tile are to be there.
            begins = (0, 0) if is_packed else None
            sheet, matrix = laid_out(pixels, missing, lambda text: self.reader.warn(self.shader.GetPrim(), text), begins)
            sheets[key] = (self.reader.map_file(f"tiles{len(sheets)}.exr"), matrix)
            Film.of(sheet).save(sheets[key][0])
        picture.file, matrix = sheets[key]
        picture.uv_matrix = matrix @ picture.uv_matrix
        # The sheet has the values themselves, of one channel in all of its own.
        picture.scale, picture.bias, picture.is_encoded, picture.wrap = np.ones(4), np.zeros(4), False, "clamp"
        picture.channel = "r" if picture.is_opacity else picture.channel

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
        is_srgb = is_encoded_space(space)
        if is_srgb is None:
            self.reader.warn(self.shader.GetPrim(), f"the colour space {space} is taken as linear, with the primaries of sRGB")
        return bool(is_srgb)

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
                if int(inputs.constant("index", 0)) != 0:
                    self.reader.warn(inputs.shader.GetPrim(), "texture coordinates of another index than 0 are taken as the first")
                return
            else:
                self.reader.warn(inputs.shader.GetPrim(), f"{kind} as coordinates of a texture is left out")
                return

    def _texture(self, name: str, picture: Picture, kind: str) -> str:
        parameters: dict[str, Any] = {"string wrap": picture.wrap}
        scale = picture.scale[:3]
        if kind == "float" and picture.channel not in _CHANNELS and not picture.is_opacity:
            self.reader.warn(self.shader.GetPrim(), "of a texture for a number the luminance is taken")
            parameters["string channels"] = "luminance"
        is_plain = picture.channel not in _CHANNELS and np.ptp(scale) <= 1e-6 and np.abs(picture.bias[:3]).max() <= 1e-6
        if kind == "float" or picture.is_opacity or not is_plain:
            parameters |= {"string filename": self.made(picture), "string encoding": "linear"}
        else:
            encoding = "sRGB" if picture.is_encoded else "linear"
            parameters |= {"string filename": picture.file, "string encoding": encoding, "float scale": float(scale.mean())}
        matrix = picture.uv_matrix @ np.linalg.inv(self.frame)
        if not np.allclose(matrix, np.eye(3), atol=1e-9):
            parameters["float uvmatrix"] = matrix[:2].reshape(-1)
        texture = f"{self.key} {name}"
        self.reader.builder.add("Texture", texture, "spectrum" if kind == "rgb" else "float", "imagemap", parameters)
        return texture

    def made(self, picture: Picture) -> str:
        """A file with the values of a picture."""
        is_made = picture.file in (file for file, _ in self.reader.sheets.values())
        if is_made and np.all(picture.scale == 1) and not np.any(picture.bias):
            return picture.file
        self.reader.pictures += 1
        file: str = self.reader.map_file(f"texture{self.reader.pictures}.exr")
        Film.of(picture.pixels()).save(file)
        return file


def _placed(scale: Matrix, turn: float, place: Matrix) -> Matrix:
    """Scaled, then turned against the clock, then moved."""
    c, s = np.cos(turn), np.sin(turn)
    result = np.eye(3)
    result[:2, :2] = np.array([[c, -s], [s, c]]) @ np.diag(scale[:2])
    result[:2, 2] = place[:2]
    return result
