"""What readers of foreign scenes share: a builder that they fill, what they have to say, and files that they make."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._builder import SceneBuilder
from ._errors import SceneWarning

#: (2, 4, 4): where something is when the shutter opens and when it closes; points are rows, multiplied from the left.
Places = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Brush:
    """Along which way a surface is brushed."""

    axis: int  #: x, y or z of the object: around it
    turns: float  #: further, around the normal


@dataclass
class Look:
    """What a shape is given."""

    name: str | None  #: of the material; None: an interface, which is not seen
    emission: tuple[float, ...] | None = None
    medium: str | None = None  #: inside
    fog: Any = None  #: what that is, where it varies: has `parameters` of a medium, in the shape's own coordinates
    shape_parameters: dict[str, Any] = field(default_factory=dict)
    brushed: Brush | None = None  #: None: along its texture coordinates, if at all
    shown: str | None = None  #: file of a picture that it shines with, in place of the emission
    refracts: bool = False
    index: float = 1.0  #: of what is below it, where it refracts
    is_one_sided: bool = False  #: its front alone shines


class SceneReader:
    """The base of readers.

    Args:
        file: what messages call the scene; names in it are relative to its folder.
        maps: folder for pictures that are made for the scene; None: one that goes away when the program ends.
    """

    def __init__(self, file: str, maps: str | os.PathLike[str] | None) -> None:
        self.builder = SceneBuilder(name=file, folder=os.path.dirname(file) or ".")
        self.materials: dict[str, Look] = {}
        self.opaque_pictures: dict[int, bool] = {}  #: what is known of those that were looked through, by their addresses
        #: pictures that are made of tiles, and the matrices that take coordinates to theirs
        self.sheets: dict[Any, tuple[str, npt.NDArray[np.float64]]] = {}
        self.around: str | None = None  #: the medium that fills the world
        self.media: dict[str, dict[str, Any]] = {}  #: parameters of those that are the same everywhere, by name
        self._told: set[str] = set()
        self._maps = None if maps is None else Path(maps)

    def tell(self, place: str, text: str, *, each: bool = False) -> None:
        """Warns, once for each text; `each`: once for each place and text."""
        key = f"{place} {text}" if each else text
        if key not in self._told:
            self._told.add(key)
            warnings.warn(f"{place}: warning: {text}", SceneWarning, stacklevel=3)

    def make_medium(self, name: str, parameters: dict[str, Any]) -> None:
        """One that is the same everywhere."""
        self.media[name] = parameters | {"string type": "homogeneous"}
        self.builder.add("MakeNamedMedium", name, self.media[name])

    def map_file(self, name: str) -> str:
        """A file for a picture that is made for the scene."""
        if self._maps is None:
            self._maps = Path(tempfile.mkdtemp(prefix="wend-maps-"))
            atexit.register(shutil.rmtree, self._maps, ignore_errors=True)
        self._maps.mkdir(parents=True, exist_ok=True)
        return str(self._maps / name)

    def held(self, places: Places, where: str) -> npt.NDArray[np.float64]:
        """Where something that cannot move is when the shutter is half open; says so where it would move."""
        if np.allclose(places[0], places[1], rtol=1e-12, atol=0):
            return np.asarray(places[0])
        self.tell(where, "what moves while the shutter is open is as when it is half open")
        return halfway(places)

    def put(self, places: Places) -> None:
        """What follows is there, and moves between them."""
        add = self.builder.add
        if np.allclose(places[0], places[1], rtol=1e-12, atol=0):
            add("Transform", places[0])
            return
        for when, place in zip(("StartTime", "EndTime"), places):
            add("ActiveTransform", when)
            add("Transform", place)
        add("ActiveTransform", "All")


class Silent(SceneReader):
    """Makes what nobody sees."""

    def __init__(self, reader: SceneReader) -> None:
        super().__init__("", None)
        self.opaque_pictures = reader.opaque_pictures

    def tell(self, place: str, text: str, *, each: bool = False) -> None:
        pass


def unmirrored(places: Places) -> Places:
    """For what looks the same mirrored along x: with that, a place that mirrors is one that does not. pbrt's disks and
    spheres shine to the other side where they are mirrored."""
    flips = np.where(np.linalg.det(places[..., :3, :3]) < 0, -1.0, 1.0)
    result = places.copy()
    result[..., 0, :3] *= flips[..., None]
    return result


def halfway(places: Places) -> npt.NDArray[np.float64]:
    """Half way between two places: of turns, half the turn."""
    turns, stretches = [], []
    for block in (places[0, :3, :3], places[1, :3, :3], (places[0, :3, :3] + places[1, :3, :3]) / 2):
        left, sizes, right = np.linalg.svd(block)
        turns.append(left @ right)
        stretches.append(right.T @ np.diag(sizes) @ right)
    result: npt.NDArray[np.float64] = (places[0] + places[1]) / 2
    # Points are rows: they are stretched, and then turned.
    before = [turn @ stretch @ turn.T for turn, stretch in zip(turns[:2], stretches[:2])]
    result[:3, :3] = (before[0] + before[1]) / 2 @ turns[2]
    return result
