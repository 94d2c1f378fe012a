"""What light goes through at facets: Blender's nodes of glass."""

from __future__ import annotations

from typing import Any

from ._blend_details import add_detail, tell_of_facets, tell_of_films
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
