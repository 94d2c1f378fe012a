"""Facets that light goes through, or that reflect all of it: Blender's nodes of glass, and mirrors."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._blend_details import add_detail, tell_of_facets, tell_of_films
from ._blend_facets import brighter_by_several
from ._blend_nodes import Nodes


def dielectric(nodes: Nodes, roughness: Any, ior: float) -> dict[str, Any]:
    material: dict[str, Any] = {"string type": "dielectric", "float eta": ior, "bool remaproughness": False}
    nodes.add_to(material, roughness, "roughness", "float", power=2)
    return material


def glass_of(nodes: Nodes, node: Any) -> dict[str, Any]:
    """Of a node Glass, or Refraction, which does not reflect: all that can pass does, and the rest is lost."""
    material = dielectric(nodes, node.inputs["Roughness"], max(nodes.number(node.inputs["IOR"]), 1e-3))
    nodes.add_to(material, node.inputs["Color"], "transmittance", "rgb")
    if node.bl_idname == "ShaderNodeBsdfGlass":
        nodes.add_to(material, node.inputs["Color"], "reflectance", "rgb")
    else:
        material |= {"bool antireflective": True, "rgb reflectance": (0, 0, 0)}
    tell_of_films(nodes, node)
    tell_of_facets(nodes, node, node.inputs["Roughness"], "GGX")
    add_detail(nodes, node, material)
    return material


#: Up to it what facets reflect several times is less than one in 200.
_SMOOTH = 0.15

#: What is clipped above 1 is less than that.
_WHITE = 1.005


def mirror_of(nodes: Nodes, node: Any) -> dict[str, Any] | None:
    """Of a Glossy node, which reflects its colour from everywhere. None where it is brushed, or where what facets reflect
    several times is not known, or brighter than facets that reflect once can be."""
    brushed, roughness, colour = (nodes.known(node.inputs[name]) for name in ("Anisotropy", "Roughness", "Color"))
    values = None
    if brushed is None or brushed[0] != 0:
        return None
    if node.distribution != "GGX" and colour is not None and roughness is not None:
        values = brighter_by_several(np.clip(np.broadcast_to(colour, 3), 0, 1), float(np.clip(roughness[0], 0, 1)))
        # White facets lose as much as is clipped.
        if values.max() > _WHITE:
            return None
    elif node.distribution != "GGX" and (roughness is None or roughness[0] > _SMOOTH):
        return None
    # Of this index a metal reflects all, from everywhere.
    material: dict[str, Any] = {"string type": "conductor", "rgb eta": (0, 0, 0), "rgb k": (1, 1, 1), "bool remaproughness": False}
    nodes.add_to(material, node.inputs["Roughness"], "roughness", "float", power=2)
    if values is None:
        nodes.add_to(material, node.inputs["Color"], "tint", "rgb")
    else:
        material["texture tint"] = nodes.add_texture("rgb", "facing", {"float values": np.minimum(values, 1).ravel()})
    if node.distribution != "GGX":
        tell_of_facets(nodes, node, node.inputs["Roughness"], "MULTI_GGX")
    add_detail(nodes, node, material)
    return material


def lets_through(material: dict[str, Any]) -> bool:
    """Whether it is glass."""
    return bool(material["string type"] == "dielectric")
