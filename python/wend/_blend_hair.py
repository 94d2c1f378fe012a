"""Hair of Blender's Principled node, as Cycles has it (chiang2016)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ._blend_nodes import Colour, Nodes

#: What pigments absorb, by red, green and blue, of Cycles.
_EUMELANIN = np.array([0.506, 0.841, 1.653])
_PHEOMELANIN = np.array([0.343, 0.733, 1.924])


def hair_of(nodes: Nodes, node: Any) -> dict[str, Any]:
    """The material of a Principled Hair node."""
    if node.model != "CHIANG":
        nodes.warn(node, "hair by Huang's model is taken as Chiang's")
    for label in ("Coat", "Random Color", "Random Roughness"):
        socket = nodes.input(node, label)
        if socket.enabled and (socket.is_linked or socket.default_value > 0):
            nodes.warn(node, f"{label} of hair is left out")
    material: dict[str, Any] = {"string type": "hair", "float eta": max(nodes.number(nodes.input(node, "IOR")), 1.001)}
    nodes.add_to(material, nodes.input(node, "Roughness"), "beta_m", "float")
    across = nodes.input(node, "Radial Roughness")
    if across.enabled:
        nodes.add_to(material, across, "beta_n", "float")
    # The other way round there.
    material["float alpha"] = -math.degrees(nodes.number(nodes.input(node, "Offset")))
    if node.parametrization == "ABSORPTION":
        material["rgb sigma_a"] = np.maximum(nodes.colour(nodes.input(node, "Absorption Coefficient")), 0)
    elif node.parametrization == "MELANIN":
        amount = -math.log(max(1 - nodes.number(nodes.input(node, "Melanin")), 1e-4))
        red = min(max(nodes.number(nodes.input(node, "Melanin Redness")), 0.0), 1.0)
        tint = _absorption(nodes.colour(nodes.input(node, "Tint")), float(material.get("float beta_n", 0.3)))
        material["rgb sigma_a"] = amount * ((1 - red) * _EUMELANIN + red * _PHEOMELANIN) + tint
    else:
        nodes.add_to(material, nodes.input(node, "Color"), "reflectance", "rgb")
    return material


def _absorption(colour: Colour, across: float) -> Colour:
    """What makes hair of this colour (chiang2016)."""
    fit = np.polyval([0.245, 5.574, -10.73, 2.532, -0.215, 5.969], across)
    return np.asarray((np.log(np.clip(colour, 1e-5, 1)) / fit) ** 2)
