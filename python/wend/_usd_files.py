"""Files that stages name, and what is packed in them."""

from __future__ import annotations

import os
from typing import Any

from pxr import Ar  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._errors import InputError


def file_of(reader: Any, asset: Any) -> str:
    """What an asset is read from; what is packed is unpacked first.

    Raises:
        InputError: where there is no file; pipes and devices, which may never end, are none.
    """
    name = str(asset.resolvedPath or asset.path)
    if os.path.isfile(name):
        return name
    if Ar.IsPackageRelativePath(name) and os.path.isfile(Ar.SplitPackageRelativePathOuter(name)[0]):
        opened = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(name))
        if opened:
            made: str = reader.map_file(f"{len(reader.builder)}.{os.path.basename(name.rstrip(']'))}")
            with open(made, "wb") as out:
                out.write(opened.GetBuffer())
            return made
    raise InputError(f"{name}: error: there is no such file")
