"""Files that stages name, and what is packed in them."""

from __future__ import annotations

import os
import re
from typing import Any

from pxr import Ar, Sdf, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._errors import InputError
from ._udim import Tile, tile_of


def name_of(asset: Any) -> str:
    """Where the asset should be."""
    return str(asset.resolvedPath or asset.path)


def file_of(reader: Any, asset: Any) -> str:
    """What an asset is read from; what is packed is unpacked first.

    Raises:
        InputError: where there is no file; pipes and devices, which may never end, are none.
    """
    found = file_called(reader, name_of(asset))
    if found is None:
        raise InputError(f"{name_of(asset)}: error: there is no such file")
    return found


def file_called(reader: Any, name: str) -> str | None:
    """The same by its name; None where there is no file."""
    if os.path.isfile(name):
        return name
    unpacked: dict[str, str] = reader.unpacked
    if name in unpacked:
        return unpacked[name]
    if Ar.IsPackageRelativePath(name) and os.path.isfile(Ar.SplitPackageRelativePathOuter(name)[0]):
        opened = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(name))
        if opened:
            made: str = reader.map_file(f"{len(unpacked)}.{os.path.basename(name.rstrip(']'))}")
            with open(made, "wb") as out:
                out.write(opened.GetBuffer())
            unpacked[name] = made
            return made
    return None


def tiles_of(attribute: Any, asset: Any) -> dict[Tile, str] | None:
    """Names of the tiles that an asset of many has, by the layer that the attribute has it of; None for one file."""
    pattern = str(asset.path)
    by_place = "<UVTILE>" in pattern
    if not by_place and not UsdShade.UdimUtils.IsUdimIdentifier(pattern):
        return None
    specs = [spec for spec in attribute.GetPropertyStack() if spec.HasInfo("default") or spec.HasInfo("timeSamples")]
    layer = specs[0].layer if specs else None
    if by_place:
        return _tiles_by_place(Sdf.ComputeAssetPathRelativeToLayer(layer, pattern) if layer else pattern)
    found = UsdShade.UdimUtils.ResolveUdimTilePaths(pattern, layer)
    tiles = {tile_of(int(number)): str(name) for name, number in found}
    return {tile: name for tile, name in tiles.items() if tile is not None}


def _tiles_by_place(pattern: str) -> dict[Tile, str]:
    """Of names with the tile's column and row in them (u1_v1), as MaterialX has them."""
    folder, name = os.path.split(pattern)
    before, _, after = name.partition("<UVTILE>")
    of_tile = re.compile(re.escape(before) + r"u([1-9]\d{0,2})_v([1-9]\d{0,2})" + re.escape(after))
    found = [(of_tile.fullmatch(file), file) for file in (sorted(os.listdir(folder)) if os.path.isdir(folder) else [])]
    return {(int(m[1]) - 1, int(m[2]) - 1): os.path.join(folder, file) for m, file in found if m}
