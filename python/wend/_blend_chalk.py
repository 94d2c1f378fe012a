"""Diffuse surfaces with a roughness, as Cycles has them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._blend_nodes import Nodes


def add_roughness(nodes: Nodes, material: dict[str, Any], roughness: Any, colour: Any) -> None:
    """Adds the roughness of a diffuse base to a material "principled".

    Cycles multiplies what facets reflect several times by the colour once more than it has met them. Where colour and
    roughness are constant, the colour is made duller so that as much comes back in all.
    """
    value, given = nodes.known(roughness), nodes.known(colour)
    if value is not None and value[0] <= 0:
        return
    nodes.add_to(material, roughness, "diffuseroughness", "float")
    if value is None or given is None:
        nodes.warn(roughness.node, f"a diffuse surface of a {roughness.name} that varies, or of a colour, is up to 4 % brighter")
        return
    wanted = np.clip(np.broadcast_to(given, 3), 0, 1)
    sigma = min(float(value[0]), 1.0)
    # The albedo of single reflections, as a mean over directions (portsmouth2025).
    even = 1 / (1 + (0.5 - 2 / (3 * np.pi)) * sigma)
    once = even * (1 + sigma * (2 / 3 - 28 / (15 * np.pi)))

    def albedo(base: Any, power: int) -> Any:
        return base * once + base**power * once * (1 - once) / (1 - base * (1 - once))

    low, high = np.zeros(3), np.ones(3)
    for _ in range(40):
        middle = (low + high) / 2
        is_dark = albedo(middle, 2) < albedo(wanted, 3)
        low, high = np.where(is_dark, middle, low), np.where(is_dark, high, middle)
    material["rgb reflectance"] = (low + high) / 2
