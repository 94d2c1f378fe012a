"""What several of Blender's surface nodes have in common: normals, tints, how they are brushed, and what is told of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._blend_angles import left_by_coat
from ._blend_nodes import Colour, Nodes
from ._blend_pictures import file_of, mapping_of
from ._scene_reader import Brush


def add_detail(nodes: Nodes, node: Any, parameters: dict[str, Any]) -> None:
    """Normals beyond those of the shape: of normal maps, bumps, and displacement that is one."""
    socket = node.inputs.get("Normal")
    with nodes.aside():
        found = nodes.source(socket) if socket is not None else None
        if found is None or not found.is_output:
            found, socket = None, nodes.displacement
        file = _normal_map(nodes, found.node) if found is not None else None
    if file is None and socket is not None and (found is not None or nodes.displacement is not None):
        picture = nodes.baked(socket, "normal")
        file = picture["string filename"] if picture is not None else None
    if file is not None:
        parameters["string normalmap"] = file
    elif found is not None:
        nodes.warn(found.node, f"{found.node.bl_idname.removeprefix('ShaderNode')} as Normal is left out")


def share_left(nodes: Nodes, node: Any, coat: float, has_sheen: bool, varies: bool) -> Colour:
    """Of what a Principled surface shines with, the share that goes through its coat, and all where that is baked, which
    `varies` says. What is not exact is named."""
    if has_sheen:
        nodes.warn(node, "sheen does not darken what shines below it")
    if coat <= 0:
        return np.ones(3)
    nodes.warn(node, "a coat darkens what shines below it by the same from all sides")
    index, tint = nodes.number(node.inputs["Coat IOR"]), nodes.colour(node.inputs["Coat Tint"])
    return np.ones(3) if varies else left_by_coat(coat, max(index, 1e-3), tint)


def _normal_map(nodes: Nodes, node: Any) -> str | None:
    """The file of one that can be taken as it is."""
    if node.bl_idname != "ShaderNodeNormalMap" or node.space != "TANGENT" or nodes.bakes_all:
        return None
    picture = nodes.source(node.inputs["Color"])
    if picture is None or not picture.is_output or picture.node.bl_idname != "ShaderNodeTexImage" or not picture.node.image:
        return None
    texture, uv_name = picture.node, nodes.bakery.uv_name if nodes.bakery is not None else ""
    is_plain = texture.extension == "REPEAT" and texture.projection == "FLAT" and node.uv_map in ("", uv_name)
    is_plain = is_plain and texture.image.source != "TILED"
    strength = nodes.known(node.inputs["Strength"])
    faults: list[str] = []
    mapping = mapping_of(nodes, texture, faults)
    if nodes.bakery is None:
        if strength is None or strength[0] != 1:
            nodes.warn(node, "the strength of a normal map is taken as 1")
    elif not is_plain or faults or mapping or strength is None or strength[0] != 1:
        return None
    return file_of(nodes, texture, texture.image)


def add_tint(nodes: Nodes, material: dict[str, Any], socket: Any, name: str) -> None:
    value = nodes.known(socket)
    if value is None or np.abs(value - 1).max() > 1e-6:
        nodes.add_to(material, socket, name, "rgb")


def brush_of(nodes: Nodes, node: Any, amount: Any, turn: Any, material: dict[str, Any]) -> Brush | None:
    """How a surface is brushed; None: it is not, or along its texture coordinates."""
    value = nodes.known(amount)
    if value is not None and value[0] == 0:
        return None
    if value is not None and value[0] < 0:
        nodes.warn(node, f"{amount.name} below 0 is taken as 0")
        return None
    nodes.add_to(material, amount, "anisotropy", "float")
    turns = nodes.number(turn)
    with nodes.aside():
        found = nodes.source(node.inputs["Tangent"])
    if found is None or not found.is_output:
        return Brush(2, turns)
    if found.node.bl_idname == "ShaderNodeTangent" and found.node.direction_type == "RADIAL":
        return Brush("XYZ".index(found.node.axis), turns)
    if found.node.bl_idname != "ShaderNodeTangent":
        nodes.warn(node, f"{found.node.bl_idname.removeprefix('ShaderNode')} as Tangent is taken as that of the texture coordinates")
    if turns != 0:
        nodes.warn(node, f"{turn.name} of a tangent by texture coordinates is left out")
    return None


def tell_of_films(nodes: Nodes, node: Any) -> None:
    thickness = node.inputs.get("Thin Film Thickness")
    if thickness is not None and (thickness.is_linked or thickness.default_value != 0):
        nodes.warn(node, "Thin Film Thickness is left out")


def tell_of_facets(nodes: Nodes, node: Any, roughness: Any, ours: str) -> None:
    """Of a distribution of facets that is not the one there is here."""
    value = nodes.known(roughness)
    if node.distribution != ours and (value is None or value[0] > 0):
        nodes.warn(node, f"the distribution {node.distribution} is taken as {ours}")


def linked_to(nodes: Nodes, socket: Any) -> Any:
    with nodes.aside():
        found = nodes.source(socket)
    return found.as_pointer() if found is not None and found.is_output else None


def conductor(index: Colour, extinction: Colour) -> dict[str, Any]:
    """The colours of a metal, from above and at the edge: by Fresnel's equations there, and by Schlick's between."""

    def reflected(cosine: float) -> Colour:
        root = np.sqrt((np.maximum(index, 1e-3) + 1j * extinction) ** 2 - 1 + cosine**2)
        across = (cosine - root) / (cosine + root)
        along = across * (cosine * root - 1 + cosine**2) / (cosine * root + 1 - cosine**2)
        return np.asarray((np.abs(across) ** 2 + np.abs(along) ** 2) / 2)

    above = reflected(1.0)
    edge = above + (1 - above) * (6 / 7) ** 5
    return {"rgb reflectance": np.clip(above, 0, 1), "rgb speculartint": np.clip(reflected(1 / 7) / edge, 0, 1)}
