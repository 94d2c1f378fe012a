"""Values of Blender's nodes that depend on from where a surface is seen, and on nothing that varies over it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._blend_nodes import Nodes

Colour = npt.NDArray[np.float64]

#: Where values are taken, from 0 to 1; linear between.
_COSINES = np.linspace(0, 1, 129)


@dataclass(frozen=True)
class View:
    """From where a surface is seen."""

    cosine: float  #: with the surface's normal, its magnitude
    is_behind: bool = False


def value_seen(node: Any, output: str, inputs: list[Colour | None], view: View) -> Colour | None:
    """What Fresnel, Layer Weight and the side of Geometry are; None for all else, and where normals vary."""
    kind = node.bl_idname
    if kind == "ShaderNodeNewGeometry" and output == "Backfacing":
        return np.array([float(view.is_behind)])
    if kind not in ("ShaderNodeFresnel", "ShaderNodeLayerWeight") or inputs[0] is None or node.inputs["Normal"].is_linked:
        return None
    given = float(inputs[0][0])
    if output == "Facing":
        power = 2 * given if given < 0.5 else 0.5 / (1 - min(given, 1 - 1e-5))
        return np.array([1 - view.cosine ** max(power, 0.0)])
    index = max(given, 1e-5) if kind == "ShaderNodeFresnel" else 1 / max(1 - given, 1e-5)
    return np.array([_reflected(view.cosine, 1 / index if view.is_behind else index)])


def _reflected(cosine: float, index: float) -> float:
    """By Fresnel's equations, of light without polarization."""
    squared = index**2 - 1 + cosine**2
    if squared <= 0:
        return 1.0
    within = float(np.sqrt(squared))
    across = (within - cosine) / (within + cosine)
    along = (cosine * (within + cosine) - 1) / (cosine * (within - cosine) + 1)
    return 0.5 * across**2 * (1 + along**2)


def left_by_coat(weight: float, index: float, tint: Colour) -> Colour:
    """Of the light that a surface shines with evenly, what a coat lets through, in all: what it does not reflect, and of
    that what it does not absorb."""
    cosines = (np.arange(128) + 0.5) / 128
    passed = np.array([1 - weight * _reflected(float(cosine), index) for cosine in cosines])
    lengths = 1 / np.sqrt(1 - (1 - cosines**2) / max(index, 1.0) ** 2)
    absorbed = 1 - weight + weight * np.clip(tint, 0, 1) ** lengths[:, None]
    return np.asarray((2 * cosines * passed) @ absorbed / len(cosines), dtype=np.float64)


def texture_by_view(nodes: Nodes, socket: Any, kind: str, power: float) -> str | None:
    """The name of a texture by the angle of view and the side; None where an input depends on more, or on neither."""
    if nodes.seen_at(socket, View(1.0)) is None:
        return None
    sides = []
    for is_behind in (False, True):
        values = [nodes.seen_at(socket, View(float(cosine), is_behind)) for cosine in _COSINES]
        made = [_converted(value, kind, power) for value in values if value is not None]
        if len(made) < len(_COSINES):
            return None
        sides.append(np.array(made if np.ptp(made, axis=0).max() > 0 else made[:1]))
    front, back = (nodes.add_texture(kind, "facing", {"float values": side.ravel()}) for side in sides)
    return nodes.add_texture(kind, "sides", {"texture tex1": front, "texture tex2": back})


def _converted(value: Colour, kind: str, power: float) -> Colour:
    if kind == "rgb":
        return np.clip(np.broadcast_to(value, 3), 0, 1)
    number = float(value @ np.array([0.2126, 0.7152, 0.0722])) if len(value) == 3 else float(value[0])
    return np.array([max(number, 0.0) ** power])
