"""Sums of Blender's shaders."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ._blend_nodes import Nodes
from ._blend_surface import Surface, reflecting


def added(nodes: Nodes, node: Any, first: Surface, second: Surface) -> Surface:
    """Both at once, by the node that adds them."""
    for one, other in ((first, second), (second, first)):
        if not (one.is_clear or one.alpha or _is_made(one)):
            other = _certain(nodes, node, other) if one.emission.max() > 0 or one.shines_by_a_picture else other
            varies = one.shines_by_a_picture or other.shines_by_a_picture
            return replace(other, emission=one.emission + other.emission, shines_by_a_picture=varies)
    first, second = _certain(nodes, node, first), _certain(nodes, node, second)
    emission = first.emission + second.emission
    varies = first.shines_by_a_picture or second.shines_by_a_picture
    through = _diffuse_both_ways(first.material, second.material) or _diffuse_both_ways(second.material, first.material)
    if through is not None:
        return Surface(through, emission=emission, shines_by_a_picture=varies)
    if first.is_held_out or second.is_held_out:
        nodes.warn(node, "a holdout in a sum is black")
    bright = _brightness(first), _brightness(second)
    # How often which is looked at: it changes the noise alone.
    amount = {"string type": "sum", "float amount": bright[1] / (bright[0] + bright[1])}
    return Surface(mixed=(first, second, amount), emission=emission, shines_by_a_picture=varies)


def _is_made(surface: Surface) -> bool:
    return surface.material is not None or surface.mixed is not None


def _certain(nodes: Nodes, node: Any, surface: Surface) -> Surface:
    """The same without an opacity: what is let through passes a pane that reflects nothing."""
    if not surface.is_clear and not surface.alpha:
        return surface
    nodes.warn(node, "what is transparent in a sum lets no light of lamps without a size through")
    pane = Surface({"string type": "thindielectric", "float eta": 1.0})
    if surface.is_clear:
        return replace(pane, emission=surface.emission, shines_by_a_picture=surface.shines_by_a_picture)
    amount = {name.replace("alpha", "amount"): value for name, value in surface.alpha.items()}
    varies = surface.shines_by_a_picture or (surface.emission.max() > 0 and "float amount" not in amount)
    seen = reflecting(replace(surface, alpha={}, emission=np.zeros(3)))
    return Surface(mixed=(pane, seen, amount), emission=surface.emission * amount.get("float amount", 1), shines_by_a_picture=varies)


def _brightness(surface: Surface) -> float:
    """About how much of the light is scattered; never nothing."""
    if surface.mixed is not None:
        first, second, amount = surface.mixed
        parts, share = (_brightness(first), _brightness(second)), amount.get("float amount", 0.5)
        return parts[0] + parts[1] if "string type" in amount else (1 - share) * parts[0] + share * parts[1]
    material = surface.material or {}
    known = [np.max(value) for name, value in material.items() if name in ("rgb reflectance", "rgb transmittance")]
    if material.get("string type") in ("principled", "dielectric", "thindielectric") or not known:
        return 0.5
    return float(max(*known, 0.05))


def _diffuse_both_ways(matt: dict[str, Any] | None, through: dict[str, Any] | None) -> dict[str, Any] | None:
    """One material of a diffuse surface and of one that lets light through, if both have the same bumps."""
    if not matt or not through or matt["string type"] != "diffuse" or through["string type"] != "diffusetransmission":
        return None
    if repr(_details(matt)) != repr(_details(through)):
        return None
    kept = {name: value for name, value in through.items() if not name.endswith(" reflectance")}
    return kept | {name: value for name, value in matt.items() if name.endswith(" reflectance")}


def _details(material: dict[str, Any]) -> list[tuple[str, Any]]:
    colours = (" reflectance", " transmittance", " type")
    return sorted((name, value) for name, value in material.items() if not name.endswith(colours))
