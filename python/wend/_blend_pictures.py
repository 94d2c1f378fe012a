"""Image textures of Blender as textures of the renderer."""

from __future__ import annotations

import math
import os
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._blend_reach import is_uv
from ._blend_wanted import Probe
from ._film import Film, opacity_of, read
from ._udim import Tile, encoded, laid_out, tile_of

if TYPE_CHECKING:
    from ._blend_nodes import Nodes

_WRAPS = {"REPEAT": "repeat", "EXTEND": "clamp", "CLIP": "black", "MIRROR": "mirror"}
#: Endings of files that are read as they are.
_READ = (".png", ".exr", ".jpg", ".jpeg", ".tga", ".bmp", ".hdr", ".pfm", ".qoi")
_LINEAR = ("Non-Color", "Linear Rec.709", "Raw", "Linear")


def picture_texture(nodes: Nodes, node: Any, kind: str, is_alpha: bool) -> str | None:
    """The name of a texture by the picture of an image node; None where it has to be baked.

    Args:
        kind: "rgb" or "float".
        is_alpha: whether its opacity is asked for, and not its colour.
    """
    image = node.image
    is_linear = image.colorspace_settings.name in _LINEAR
    faults = _faults_of_picture(node, kind, is_alpha)
    mapping = mapping_of(nodes, node, faults)
    if not (faults and nodes.bakery is not None) and not is_alpha and _is_multiplied(nodes, node):
        faults.append("the colours of a picture are taken as its file has them, whatever its opacity")
    if faults and nodes.bakery is not None:
        return None
    for fault in faults:
        nodes.warn(node, fault)
    if image.source == "TILED":
        return _of_tiles(nodes, node, kind, is_alpha, mapping)
    file = file_of(nodes, node, image)
    if file is None:
        return None
    parameters: dict[str, Any] = {
        "string filename": file,
        # An opacity is as it is.
        "string encoding": "linear" if is_linear or is_alpha else "sRGB",
        "string wrap": _WRAPS.get(node.extension, "repeat"),
    }
    if kind == "float" and not is_alpha:
        parameters["string channels"] = "luminance"
    if node.interpolation == "Closest":
        parameters["string filter"] = "point"
    elif node.interpolation != "Linear":
        nodes.warn(node, f"the interpolation {node.interpolation} of a picture is taken as Linear")
    return nodes.add_texture(kind, "imagemap", parameters | mapping)


#: The colour, and the opacity, that Blender shows where there is no tile.
_MISSING = (1.0, 0.0, 1.0, 1.0)


def _of_tiles(nodes: Nodes, node: Any, kind: str, is_alpha: bool, mapping: dict[str, Any]) -> str | None:
    """The name of a texture by one picture of all tiles; None where none of them has pixels, which is told."""
    image = node.image
    if isinstance(nodes.bakery, Probe):
        nodes.bakery.modes.add("picture")
        return ""
    is_linear = image.colorspace_settings.name in _LINEAR or is_alpha
    sheets = nodes.reader.sheets
    key = f"{image.name_full} {is_linear} {is_alpha}"
    if key not in sheets:
        files = _files_of_tiles(nodes, image)
        if not files:
            nodes.warn(node, f"a picture in tiles of which there is none is left out: {image.filepath}")
            return None
        pixels = {tile: partial(_pixels_of, file, is_linear, is_alpha) for tile, file in files.items()}
        missing = _MISSING[3:] * 3 if is_alpha else _MISSING[:3]
        sheet, matrix = laid_out(pixels, missing, lambda text: nodes.warn(node, text))
        sheets[key] = (nodes.reader.map_file(f"tiles{len(sheets)}.exr"), matrix)
        Film.of(sheet).save(sheets[key][0])
    file, matrix = sheets[key]
    before = np.eye(3)
    before[:2] = np.reshape(mapping.get("float uvmatrix", before[:2]), (2, 3))
    parameters = {"string filename": file, "string wrap": "clamp", "float uvmatrix": (matrix @ before)[:2].reshape(-1)}
    if kind == "float" and not is_alpha:
        parameters["string channels"] = "luminance"
    if node.interpolation == "Closest":
        parameters["string filter"] = "point"
    return nodes.add_texture(kind, "imagemap", parameters)


def _files_of_tiles(nodes: Nodes, image: Any) -> dict[Tile, str]:
    """Those that there are; all are written out where one cannot be read."""
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    numbers = {tile_of(tile.number): tile.number for tile in image.tiles}

    def named(pattern: str) -> dict[Tile, str]:
        names = {
            tile: pattern.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{tile[0] + 1}_v{tile[1] + 1}")
            for tile, number in numbers.items()
            if tile is not None
        }
        return {tile: name for tile, name in names.items() if os.path.isfile(name)}

    pattern = str(bpy.path.abspath(image.filepath, library=image.library))
    if not image.packed_file and not image.is_dirty and pattern.lower().endswith(_READ):
        return named(pattern)
    name = f"{bpy.path.clean_name(image.name)}.{len(nodes.reader.builder)}.<UDIM>.{_suffix(image)}"
    made = nodes.reader.map_file(name)
    _write(image, made)
    return named(made)


def _pixels_of(file: str, is_linear: bool, is_alpha: bool) -> npt.NDArray[np.float32]:
    """The values of a file, of 8 bits as they are or decoded."""
    if is_alpha:
        return np.repeat(opacity_of(file)[:, :, None], 3, axis=2)
    image = read(file).image
    return encoded(image) if is_linear and not file.lower().endswith((".exr", ".hdr", ".pfm")) else image


def _faults_of_picture(node: Any, kind: str, is_alpha: bool) -> list[str]:
    """What of an image node a texture by its file cannot be."""
    image = node.image
    space = image.colorspace_settings.name
    faults = []
    if space != "sRGB" and space not in _LINEAR:
        faults.append(f"the colour space {space} of a picture is taken as sRGB")
    if image.source not in ("FILE", "GENERATED", "TILED"):
        faults.append(f"a picture of the kind {image.source} is not read")
    if node.extension not in _WRAPS:
        faults.append(f"the extension {node.extension} of a picture is taken as repetition")
    if node.projection != "FLAT":
        faults.append(f"the projection {node.projection} of a picture is left out")
    if is_alpha and (kind == "rgb" or image.channels < 4 or image.alpha_mode == "NONE"):
        faults.append("the opacity of a picture is taken as its colour")
    return faults


def _is_multiplied(nodes: Nodes, node: Any) -> bool:
    """Whether Blender sees other colours than the file has: multiplied by its opacity, unless somebody asks for that."""
    image = node.image
    has_opacity = image.channels == 4 and image.depth not in (24, 8)
    may_be = image.colorspace_settings.name not in ("Non-Color", "Raw") and image.alpha_mode in ("STRAIGHT", "PREMUL")
    if not has_opacity or not may_be or node.outputs["Alpha"].is_linked != image.is_float:
        return False
    # All of its pixels are decoded for that.
    known = nodes.reader.opaque_pictures
    key = image.as_pointer()
    if key not in known:
        known[key] = _is_opaque(image)
    return not known[key]


def _is_opaque(image: Any) -> bool:
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    return bool(pixels[3::4].min(initial=1.0) >= 1)


def mapping_of(nodes: Nodes, node: Any, faults: list[str]) -> dict[str, Any]:
    """Of texture coordinates, an affine map; what it leaves out is added to `faults`."""
    parameters: dict[str, Any] = {}
    if _has_own_mapping(node.texture_mapping):
        faults.append("the mapping that a picture's node has itself is left out")
    with nodes.aside():
        found = nodes.source(node.inputs["Vector"])
        if found is None or not found.is_output:
            return parameters
        mapping = found.node
        if mapping.bl_idname == "ShaderNodeMapping":
            given = [nodes.known(nodes.input(mapping, name)) for name in ("Scale", "Rotation", "Location")]
            if any(x is None for x in given) or mapping.vector_type != "POINT" or np.abs(given[1][:2]).max() > 1e-6:  # type: ignore[index]
                faults.append("of a mapping, only scale, place and a turn in the plane that are constant are taken")
            else:
                scale, turn, place = (np.broadcast_to(x, 3) for x in given)  # type: ignore[arg-type]
                c, s = math.cos(turn[2]), math.sin(turn[2])
                parameters["float uvmatrix"] = (
                    c * scale[0], -s * scale[1], place[0], s * scale[0], c * scale[1], place[1]
                )  # fmt: skip
            found = nodes.source(mapping.inputs["Vector"])
    uv_name = nodes.bakery.uv_name if nodes.bakery is not None else ""
    if found is not None and found.is_output and not is_uv(found, uv_name):
        label = found.node.bl_idname.removeprefix("ShaderNode")
        faults.append(f"texture coordinates of {label} are taken as UV")
    return parameters


def _has_own_mapping(mapping: Any) -> bool:
    """Whether the settings of a texture's node change where it lies; older files have such."""
    axes = (mapping.mapping_x, mapping.mapping_y, mapping.mapping_z)
    is_moved = any(mapping.translation) or any(mapping.rotation) or any(x != 1 for x in mapping.scale)
    return is_moved or axes != ("X", "Y", "Z") or mapping.use_min or mapping.use_max


def file_of(nodes: Nodes, node: Any, image: Any) -> str | None:
    """The file of a picture, written out where it has none that can be read; None without pixels, which is told."""
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    if isinstance(nodes.bakery, Probe):
        nodes.bakery.modes.add("picture")
        return ""
    if image.source == "FILE" and not image.packed_file and image.filepath:
        path = str(bpy.path.abspath(image.filepath, library=image.library))
        if path.lower().endswith(_READ):
            return path
    if image.source in ("FILE", "GENERATED") and image.size[0] > 0:
        file = nodes.reader.map_file(f"{bpy.path.clean_name(image.name)}.{len(nodes.reader.builder)}.{_suffix(image)}")
        _write(image, file)
        return str(file)
    nodes.warn(node, f"a picture of the kind {image.source}, or without pixels, is left out")
    return None


def _suffix(image: Any) -> str:
    return "exr" if image.is_float else "png"


def _write(image: Any, file: str) -> None:
    before = image.file_format
    image.file_format = "OPEN_EXR" if image.is_float else "PNG"
    image.save(filepath=file, save_copy=True)
    image.file_format = before
