"""Materials of Blender that shine with what one input of a node takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._blend_wanted import Wanted

#: Name of the attribute of corners that holds how places change with u.
TANGENT = "wend.u"


@dataclass
class Shining:
    """A copy of a material, and of the groups in it."""

    material: Any
    groups: list[Any] = field(default_factory=list)

    def remove(self) -> None:
        bpy.data.materials.remove(self.material)
        for group in self.groups:
            bpy.data.node_groups.remove(group)


def blank(image: Any) -> Any:
    """A material whose baking goes into a picture that nobody looks at."""
    made = bpy.data.materials.new("wend.aside")
    _aim(_tree_of(made), image)
    return made


def shining(wanted: Wanted, image: Any) -> Shining:
    """A copy of the material that shines with what is wanted, and is baked into the picture."""
    made = Shining(wanted.material.original.copy())
    root = tree = _tree_of(made.material)
    ways = []
    for name in wanted.groups:
        node = tree.nodes[name]
        node.node_tree = node.node_tree.copy()
        made.groups.append(node.node_tree)
        ways.append(node)
        tree = node.node_tree
    if wanted.node:
        emission = tree.nodes.new("ShaderNodeEmission")
        _connect(tree, wanted, emission)
        found = emission.outputs[0]
        for node in reversed(ways):
            found = _led_out(node, found)
        for output in [n for n in root.nodes if n.bl_idname == "ShaderNodeOutputMaterial"]:
            root.nodes.remove(output)
        root.links.new(found, root.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    _aim(root, image)
    return made


def _tree_of(material: Any) -> Any:
    if hasattr(material, "use_nodes") and not material.node_tree:
        material.use_nodes = True
    return material.node_tree


def _aim(tree: Any, image: Any) -> None:
    target = tree.nodes.new("ShaderNodeTexImage")
    target.image = image
    for node in tree.nodes:
        node.select = False
    target.select = True
    tree.nodes.active = target


def _led_out(group: Any, found: Any) -> Any:
    """Out of a group: the output of its node."""
    tree = group.node_tree
    item = tree.interface.new_socket("wend", in_out="OUTPUT", socket_type="NodeSocketShader")
    outputs = [n for n in tree.nodes if n.bl_idname == "NodeGroupOutput" and n.is_active_output]
    output = outputs[0] if outputs else tree.nodes.new("NodeGroupOutput")
    tree.links.new(found, next(s for s in output.inputs if s.identifier == item.identifier))
    return next(s for s in group.outputs if s.identifier == item.identifier)


def _connect(tree: Any, wanted: Wanted, emission: Any) -> None:
    node = tree.nodes[wanted.node]
    socket = next(s for s in node.inputs if s.identifier == wanted.socket)
    source = socket.links[0].from_socket
    if wanted.kind == "normal":
        if node.bl_idname == "ShaderNodeOutputMaterial":
            source = _bumped(tree, source)
        source = _in_the_frame(tree, source)
    tree.links.new(source, emission.inputs["Color"])


def _math(tree: Any, operation: str, *inputs: Any, scale: float | None = None) -> Any:
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        if isinstance(value, tuple):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    if scale is not None:
        node.inputs["Scale"].default_value = scale
    return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]


def _bumped(tree: Any, displacement: Any) -> Any:
    """The normal that a displacement, as a bump, makes."""
    normal = tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"]
    bump = tree.nodes.new("ShaderNodeBump")
    bump.inputs["Strength"].default_value = bump.inputs["Distance"].default_value = 1
    tree.links.new(_math(tree, "DOT_PRODUCT", displacement, normal), bump.inputs["Height"])
    return bump.outputs["Normal"]


def _in_the_frame(tree: Any, normal: Any) -> Any:
    """What a picture of normals says: along u, across it, and outwards, from -1 to 1 as 0 to 1."""
    n = tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"]
    attribute = tree.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = TANGENT
    turned = tree.nodes.new("ShaderNodeVectorTransform")
    turned.vector_type, turned.convert_from, turned.convert_to = "VECTOR", "OBJECT", "WORLD"
    tree.links.new(attribute.outputs["Vector"], turned.inputs[0])
    t = turned.outputs[0]
    across = _math(tree, "CROSS_PRODUCT", n, t)
    b = _math(tree, "NORMALIZE", across)
    s = _math(tree, "CROSS_PRODUCT", b, n)
    joined = tree.nodes.new("ShaderNodeCombineXYZ")
    for axis, socket in zip((s, b, n), joined.inputs):
        tree.links.new(_math(tree, "DOT_PRODUCT", normal, axis), socket)
    return _math(tree, "MULTIPLY_ADD", joined.outputs[0], (0.5, 0.5, 0.5), (0.5, 0.5, 0.5))
