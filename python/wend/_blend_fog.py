"""Volumes of Blender that are not the same everywhere, as media by voxels that Cycles bakes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._blend_nodes import Nodes, output_node
from ._blend_reach import Reach
from ._blend_volumes import coefficients
from ._blend_wanted import Wanted

if TYPE_CHECKING:
    from ._scene_reader import SceneReader

Array = npt.NDArray[np.float64]
#: Makes a picture of what is wanted, on places of the object.
Bake = Callable[[Wanted, Array], npt.NDArray[np.float32]]

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


class _Seen:
    """Finds what varies, of all that is asked for."""

    def __init__(self, nodes: Nodes, material: Any) -> None:
        self._nodes, self._material = nodes, material
        self.found: list[Wanted] = []
        self.is_by_place = False

    def _note(self, socket: Any) -> None:
        if self._nodes.known(socket) is not None:
            return
        wanted, reach = _wanted_of(self._nodes, self._material, socket)
        if wanted not in self.found:
            self.found.append(wanted)
        self.is_by_place = self.is_by_place or reach.is_by_place
        if reach.sees:
            label = f"{socket.name} of node '{socket.node.name}'"
            self._nodes.warn(reach.sees, f"{label} depends on from where it is seen, and is baked as seen from above")

    def number(self, socket: Any) -> float:
        self._note(socket)
        return 1.0

    def colour(self, socket: Any) -> Array:
        self._note(socket)
        return np.full(3, 0.5)


class _Baked:
    """What was baked, and constants."""

    def __init__(self, nodes: Nodes, material: Any, baked: dict[Wanted, Array]) -> None:
        self._nodes, self._material, self._baked = nodes, material, baked

    def number(self, socket: Any) -> Any:
        found = self._find(socket)
        return self._nodes.number(socket) if found is None else found @ _LUMINANCE[:, None]

    def colour(self, socket: Any) -> Any:
        found = self._find(socket)
        return self._nodes.colour(socket) if found is None else found

    def _find(self, socket: Any) -> Array | None:
        if self._nodes.known(socket) is not None:
            return None
        return self._baked.get(_wanted_of(self._nodes, self._material, socket)[0])


def _wanted_of(nodes: Nodes, material: Any, socket: Any) -> tuple[Wanted, Reach]:
    reach = Reach(nodes, "")
    reach.follow(socket)
    groups = nodes.groups_to(socket.node.id_data)
    return Wanted(material, groups, socket.node.name, socket.identifier, "rgb", is_even=reach.is_even), reach


def _followed(reader: SceneReader, material: Any) -> tuple[Nodes, Any]:
    """The shader node of its volume."""
    nodes = Nodes(reader, f"material '{material.name}'", material.name, material)
    output = output_node(material.node_tree)
    return nodes, nodes.shader(output.inputs["Volume"]) if output is not None else None


@dataclass
class Fog:
    """The medium inside an object: see `fog_of`."""

    reader: SceneReader
    material: Any  #: as in Blender's data: what is evaluated does not last
    varying: list[Wanted]  #: what is to be baked
    is_by_place: bool = False  #: whether copies of the object differ
    low: Array = field(default_factory=lambda: np.zeros(3))  #: the box around it, in the object's own coordinates
    high: Array = field(default_factory=lambda: np.ones(3))
    size: tuple[int, int, int] = (1, 1, 1)  #: voxels along x, y and z
    parameters: dict[str, Any] | None = None  #: of the medium, once it is baked; None: there is none

    def spread(self, corners: Array, scale: Array, side: int) -> None:
        """Chooses the voxels: about `side`² of them, as wide as long and high in the world.

        Args:
            corners: of the object's box.
            scale: the object's, along x, y and z.
            side: of pictures.
        """
        low, high = corners.min(axis=0), corners.max(axis=0)
        least = 1e-4 * max(float((high - low).max()), 1e-6)
        is_flat = high - low < least
        self.low, self.high = np.where(is_flat, low - least, low), np.where(is_flat, high + least, high)
        if not all(wanted.is_even for wanted in self.varying):
            lengths = np.maximum((self.high - self.low) * scale, 1e-30)
            step = (float(np.prod(lengths)) / side**2) ** (1 / 3)
            x, y, z = (int(n) for n in np.clip(np.round(lengths / step), 1, 512))
            self.size = x, y, z

    def tell(self, where: str) -> None:
        sizes = " x ".join(map(str, self.size))
        for wanted in self.varying:
            label = f"{wanted.socket} of node '{wanted.node}'"
            self.reader.tell(where, f"material '{self.material.name}', {label} is baked, {sizes} voxels", each=True)

    def fill(self, bake: Bake) -> None:
        """Makes the voxels."""
        steps = [(np.arange(n) + 0.5) / n for n in self.size]
        z, y, x = np.meshgrid(*reversed(steps), indexing="ij")
        places = self.low + np.stack([x, y, z], axis=-1) * (self.high - self.low)
        baked = {wanted: bake(wanted, places).reshape(-1, 3).astype(np.float64) for wanted in self.varying}
        nodes, node = _followed(self.reader, self.material)
        found = coefficients(nodes, node, _Baked(nodes, self.material, baked))
        if found is not None:
            self.parameters = self._medium(*found)

    def _medium(self, scattering: Array, absorption: Array, emission: Array, phase: dict[str, Any]) -> dict[str, Any] | None:
        count = int(np.prod(self.size))
        s, a, e = (np.maximum(np.broadcast_to(x, (count, 3)), 0) for x in (scattering, absorption, emission))
        if max(s.max(), a.max(), e.max()) <= 0:
            return None
        box = {"point3 p0": self.low, "point3 p1": self.high, "string wrap": "clamp"}
        box |= {f"integer n{axis}": n for axis, n in zip("xyz", self.size)}
        density = (s + a).max(axis=1)
        if e.max() <= 0:
            total = density.sum()
            even = s.sum(axis=0) / total, a.sum(axis=0) / total
            if all(np.abs(x - density[:, None] * mean).max() <= 1e-5 * density.max() for x, mean in zip((s, a), even)):
                one = {"string type": "uniformgrid", "float density": density.astype(np.float32)}
                return box | one | {"rgb sigma_s": even[0], "rgb sigma_a": even[1]} | phase
        glow = {"rgb glow": e.astype(np.float32)} if e.max() > 0 else {}
        each = {"string type": "rgbgrid", "rgb sigma_s": s.astype(np.float32), "rgb sigma_a": a.astype(np.float32)}
        return box | each | glow | phase


def fog_of(reader: SceneReader, material: Any) -> Fog | None:
    """Of a material with a volume, in Blender's data; None where that is the same everywhere."""
    nodes, node = _followed(reader, material)
    seen = _Seen(nodes, material)
    coefficients(nodes, node, seen)
    return Fog(reader, material, seen.found, seen.is_by_place) if seen.found else None
