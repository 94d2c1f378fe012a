"""Fibres that stand on a surface, as Cycles has them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._blend_nodes import Nodes


def add_sheen(nodes: Nodes, material: dict[str, Any], inputs: Any) -> bool:
    """Adds the sheen of a Principled to a material "principled"; whether there is any."""
    weight, tint = nodes.known(inputs["Sheen Weight"]), nodes.known(inputs["Sheen Tint"])
    if weight is not None and weight[0] <= 0:
        return False
    nodes.add_to(material, inputs["Sheen Weight"], "sheen", "float")
    nodes.add_to(material, inputs["Sheen Roughness"], "sheenroughness", "float")
    if tint is None or np.abs(tint - 1).max() > 1e-6:
        nodes.add_to(material, inputs["Sheen Tint"], "sheentint", "rgb")
    return True


def fibres(nodes: Nodes, node: Any) -> dict[str, Any]:
    """A material of nothing else."""
    if node.distribution != "MICROFIBER":
        nodes.warn(node, f"the distribution {node.distribution} is taken as MICROFIBER")
    material: dict[str, Any] = {"string type": "principled", "rgb reflectance": (0, 0, 0), "float specular": 0, "float sheen": 1}
    nodes.add_to(material, node.inputs["Color"], "sheentint", "rgb")
    nodes.add_to(material, node.inputs["Roughness"], "sheenroughness", "float")
    return material
