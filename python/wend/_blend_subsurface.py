"""Subsurface scattering as Cycles has it: what is inside, and how light gets there."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._blend_nodes import Nodes

_Numbers = npt.NDArray[np.float64]

#: Of Cycles' fit, by powers of the anisotropy: a factor and a power of the arcus tangens that counts for dark colours, the
#: same for bright ones, and what is inside of either, as logarithms of an excess.
_DARK = np.array(
    [
        [1.8260523782, -1.28451056436, -1.79904629312, 9.19393289202, -22.8215585862, 32.0234874259, -23.6264803333, 7.21067002658],
        [1.09686102424, -0.394704063468, 1.05258115941, -8.83963712726, 28.8643230661, -46.8802913581, 38.5402837518, -12.7181042538],
    ]
)  # fmt: skip
_BRIGHT = np.array(
    [
        [0.496310210422, 0.360146581622, -2.15139309747, 17.8896899217, -55.2984010333, 82.065982243, -58.5106008578, 15.8478295021],
        [2.40602999408, -2.51814844609, 9.18494908356, -79.2191708682, 259.082868209, -403.613804597, 302.85712436, -87.4370473567],
    ]
)  # fmt: skip
_INSIDE_DARK = (4.98511194385, 0.127355959438)
_INSIDE_DARK_LOG = np.array([0, 31.1491581433, -201.847017512, 841.576016723, -2018.09288505, 2731.71560286, -1935.41424244, 559.009054474])
_INSIDE_BRIGHT = (4.23190299701, 0.00310603949088)
_INSIDE_BRIGHT_LOG = np.array([0, 76.7316253952, -594.356773233, 2448.8834203, -5576.68528998, 7116.60171912, -4763.54467887, 1303.5318055])


def albedo_inside(colour: npt.ArrayLike, anisotropy: float) -> _Numbers:
    """Of collisions, that make a surface of this colour under even light: Cycles' fit."""
    colour = np.clip(np.asarray(colour, dtype=np.float64), 0, 1)
    powers = anisotropy ** np.arange(8)
    (dark, dark_power), (bright, bright_power) = _DARK @ powers, _BRIGHT @ powers
    steep_dark = _INSIDE_DARK[0] + _INSIDE_DARK[1] * np.exp(_INSIDE_DARK_LOG @ powers)
    steep_bright = _INSIDE_BRIGHT[0] + _INSIDE_BRIGHT[1] * np.exp(_INSIDE_BRIGHT_LOG @ powers)
    part = colour**0.25
    found = (1 - part) * dark * np.arctan(steep_dark * colour) ** dark_power
    found += part * bright * np.arctan(steep_bright * colour) ** bright_power
    return np.asarray(np.clip(found, 0, 0.999999))


def add_inside(nodes: Nodes, node: Any, material: dict[str, Any], colour: Any, method: str, names: dict[str, Any]) -> None:
    """Adds to a material "principled" what is inside of it.

    Args:
        nodes: of the material.
        node: that scatters below its surface.
        material: its parameters, which are added to.
        colour: the input that gives the colour of the surface.
        method: of Cycles.
        names: its inputs, by "radius", "scale", "anisotropy" and "roughness"; "ior": a number.
    """
    if method == "BURLEY":
        nodes.warn(node, "the method of Christensen and Burley is taken as a random walk")
    # Christensen and Burley's has none.
    anisotropy = min(max(nodes.number(names["anisotropy"]), 0.0), 0.9) if method != "BURLEY" else 0.0
    ior = min(max(float(names["ior"]), 1.01), 3.8)
    given = np.maximum(nodes.colour(names["radius"]) * nodes.number(names["scale"]), 0)
    value = nodes.known(colour)
    is_skin = method == "RANDOM_WALK_SKIN"
    if is_skin:
        if value is None:
            nodes.warn(node, "how far light goes in skin is taken for one colour")
        radius = given * _spread(np.broadcast_to(nodes.value_of(colour), 3), ior)
        # Half of it goes in evenly, the other half through facets of their own.
        material["float subsurfaceeven"], material["float subsurfaceroughness"] = 0.5, 1.0
    else:
        radius = given / (4 * np.pi)
        nodes.add_to(material, names["roughness"], "subsurfaceroughness", "float")
    # Where nothing goes in, it goes in by little.
    radius = np.maximum(radius, max(1e-4 * float(radius.max()), 1e-7))
    material |= {"float subsurfaceeta": ior, "float g": anisotropy, "rgb mfp": radius * (1 - anisotropy)}
    picture = nodes.baked(colour, "albedo", anisotropy) if value is None else None
    if picture is not None:
        material["texture subsurfacealbedo"] = nodes.add_texture("rgb", "imagemap", picture)
    else:
        material["rgb subsurfacealbedo"] = albedo_inside(np.broadcast_to(nodes.colour(colour), 3), anisotropy)


def _spread(colour: _Numbers, ior: float) -> _Numbers:
    """What Cycles multiplies the radius of skin by: that of a dipole of this colour (jensen2001)."""
    returned = (-1.440 / ior + 0.710) / ior + 0.668 + 0.0636 * ior
    depth = 4 / 3 * (1 + returned) / (1 - returned)
    low, high = np.zeros(3), np.ones(3)
    for _ in range(40):
        middle = (low + high) / 2
        root = np.sqrt(3 * (1 - middle))
        is_dark = 0.5 * middle * (1 + np.exp(-depth * root)) * np.exp(-root) < np.minimum(colour, 0.995)
        low, high = np.where(is_dark, middle, low), np.where(is_dark, high, middle)
    return np.asarray(np.sqrt(3 * (1 - np.where(colour < 1e-4, 0, high))))
