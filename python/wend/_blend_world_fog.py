"""Volumes of Blender's worlds that are not the same everywhere."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt

from ._blend_bake import inside, studio
from ._blend_fog import Fog, fog_of
from ._blend_nodes import output_node
from ._blend_shapes import box_of
from ._scene_reader import SceneReader

#: Of nodes, what is set otherwise, or says nothing of what they do.
_APART = {"name", "parent", "select", "dimensions", "inputs", "outputs", "color_ramp", "mapping", "bl_idname"}


class WorldFog:
    """Around a scene by voxels, and beyond that as its mean."""

    def __init__(self, name: str, fog: Fog) -> None:
        self.name, self._fog = name, fog

    def add(self, reader: SceneReader) -> None:
        """The medium, which the camera stands in."""
        assert self._fog.parameters is not None
        reader.builder.add("MakeNamedMedium", self.name, self._fog.parameters)

    def add_end(self, reader: SceneReader) -> None:
        """What is beyond, and the boundary."""
        add, given = reader.builder.add, self._fog.parameters or {}
        density = np.mean(given.get("float density", 1.0))
        mean = {key: density * np.reshape(given[key], (-1, 3)).mean(axis=0) for key in ("rgb sigma_s", "rgb sigma_a")}
        phase = {key: given[key] for key in given if key in ("float g", "string phase", "float weights", "float alpha")}
        add("MakeNamedMedium", f"{self.name} beyond", {"string type": "homogeneous"} | mean | phase)
        corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        # A little within the voxels, which end there.
        low, high = self._fog.low, self._fog.high
        points = low + (high - low) * (0.5 + 0.999 * (np.array(corners, dtype=np.float64) - 0.5))
        with reader.builder.block():
            add("MediumInterface", self.name, f"{self.name} beyond")
            add("Material", "interface")
            add("Shape", "trianglemesh", box_of(points))


def world_fog(reader: SceneReader, world: Any, corners: npt.NDArray[np.float64], side: int) -> WorldFog | None:
    """None where the world's volume is the same everywhere, or there is none.

    Args:
        reader: of the scene.
        world: with nodes.
        corners: of what is in the scene.
        side: of pictures that are baked.
    """
    output = output_node(world.node_tree)
    if output is None or not output.inputs["Volume"].is_linked or not len(corners):
        return None
    with _as_material(world) as material:
        fog = fog_of(reader, material)
        if fog is None:
            return None
        low, high = corners.min(axis=0), corners.max(axis=0)
        around = 0.1 * np.linalg.norm(high - low) + 1e-3
        fog.spread(np.array([low - around, high + around]), np.ones(3), side)
        where = f"world '{world.name}'"
        fog.tell(where)
        reader.tell(where, "beyond the scene a volume that varies is as its mean")
        like = bpy.data.meshes.new("wend.bake")
        try:
            # Generated coordinates are places there.
            like.use_auto_texspace = False
            like.texspace_location, like.texspace_size = (0.5, 0.5, 0.5), (0.5, 0.5, 0.5)
            with studio(bpy.context.scene) as scene:
                fog.fill(lambda wanted, places: inside(scene, wanted, places, like))
        finally:
            bpy.data.meshes.remove(like)
    return WorldFog(f" world {world.name}", fog) if fog.parameters is not None else None


@contextmanager
def _as_material(world: Any) -> Iterator[Any]:
    """The world's nodes as those of a material, by the same names."""
    made = bpy.data.materials.new(world.name)
    tree = made.node_tree
    tree.nodes.clear()
    try:
        copies = {}
        for node in world.node_tree.nodes:
            kind = "ShaderNodeOutputMaterial" if node.bl_idname == "ShaderNodeOutputWorld" else node.bl_idname
            if kind != "ShaderNodeBackground":
                copies[node.name] = _copied(node, tree.nodes.new(kind))
        for link in world.node_tree.links:
            origin, end = copies.get(link.from_node.name), copies.get(link.to_node.name)
            if origin is not None and end is not None:
                sockets = _place(link.from_node.outputs, link.from_socket), _place(link.to_node.inputs, link.to_socket)
                if sockets[0] < len(origin.outputs) and sockets[1] < len(end.inputs):
                    tree.links.new(origin.outputs[sockets[0]], end.inputs[sockets[1]])
        yield made
    finally:
        bpy.data.materials.remove(made)


def _place(sockets: Any, socket: Any) -> int:
    return [other.identifier for other in sockets].index(socket.identifier)


def _copied(node: Any, made: Any) -> Any:
    made.name = node.name
    for known in node.bl_rna.properties:
        if not known.is_readonly and known.identifier not in _APART:
            setattr(made, known.identifier, getattr(node, known.identifier))
    if hasattr(node, "color_ramp"):
        _copy_ramp(node.color_ramp, made.color_ramp)
    if hasattr(node, "mapping") and hasattr(node.mapping, "curves"):
        _copy_curves(node.mapping, made.mapping)
    for sockets, others in ((node.inputs, made.inputs), (node.outputs, made.outputs)):
        for socket, other in zip(sockets, others):
            if hasattr(socket, "default_value") and hasattr(other, "default_value"):
                other.default_value = socket.default_value
    return made


def _copy_ramp(ramp: Any, made: Any) -> None:
    made.color_mode, made.interpolation, made.hue_interpolation = ramp.color_mode, ramp.interpolation, ramp.hue_interpolation
    while len(made.elements) < len(ramp.elements):
        made.elements.new(1.0)
    for element, other in zip(ramp.elements, made.elements):
        other.position, other.color = element.position, element.color


def _copy_curves(mapping: Any, made: Any) -> None:
    for curve, other in zip(mapping.curves, made.curves):
        while len(other.points) < len(curve.points):
            other.points.new(0.5, 0.5)
        for point, copy in zip(curve.points, other.points):
            copy.location, copy.handle_type = point.location, point.handle_type
    made.extend = mapping.extend
    made.update()
