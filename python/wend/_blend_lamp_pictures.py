"""What Blender's lamps shine with whose nodes are no constants, as pictures by Cycles."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bmesh  # type: ignore[import-not-found,import-untyped,unused-ignore]
import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt
from mathutils import Matrix  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._blend_nodes import Nodes, output_node
from ._blend_profiles import wants_profile
from ._film import read
from ._scene_reader import SceneReader, Silent

Floats = npt.NDArray[np.float64]

#: Of a panorama of directions, and of a picture of a flat lamp.
_WIDTH, _SIDE = 1024, 512


class LampPicture:
    """What multiplies the light of a lamp with these nodes over one without: of an area, seen by who looks at it, over
    its place; of a point or spot, cone included, over the directions of its own space."""

    def __init__(self, pixels: Floats, turn: Floats) -> None:
        self.pixels = pixels  #: rows from above
        self._turn = turn  #: from its own space to the world

    def towards(self, x: Floats, y: Floats, z: Floats) -> Floats:
        """In directions of its own space."""
        x, y, z = (self._turn[i, 0] * x + self._turn[i, 1] * y + self._turn[i, 2] * z for i in range(3))
        height, width = self.pixels.shape[:2]
        across = (0.5 + np.arctan2(x, y) / (2 * np.pi)) * width - 0.5
        down = np.clip(np.arccos(np.clip(z, -1, 1)) / np.pi * height - 0.5, 0, height - 1)
        left, top = np.floor(across).astype(int), np.minimum(down.astype(int), height - 2)
        u, v = (across - left)[..., None], (down - top)[..., None]
        rows = [(1 - u) * self.pixels[top + i, left % width] + u * self.pixels[top + i, (left + 1) % width] for i in (0, 1)]
        return np.asarray((1 - v) * rows[0] + v * rows[1])


def wants_picture(reader: SceneReader, lamp: Any) -> bool:
    """Whether a lamp has nodes that are no constants, as far as these can be rendered."""
    if lamp.type == "SUN" or not (lamp.use_nodes and lamp.node_tree and any(link.is_valid for link in lamp.node_tree.links)):
        return False
    nodes = Nodes(Silent(reader), "", "")
    output = output_node(lamp.node_tree)
    node = nodes.shader(output.inputs["Surface"]) if output is not None else None
    if node is None or node.bl_idname != "ShaderNodeEmission":
        return node is not None
    if lamp.type in ("POINT", "SPOT") and wants_profile(nodes, node.inputs["Strength"]):
        return False
    return any(nodes.known(node.inputs[name]) is None for name in ("Color", "Strength"))


def picture_of(lamp: Any, world: Any) -> LampPicture:
    """Of a lamp in Blender's data, by its place. Cycles is called."""
    turn = world.to_3x3().normalized()
    place = (world.to_3x3()).to_4x4()
    with _alone(lamp, place) as (scene, made):
        if lamp.type == "AREA":
            scale = world.to_scale()
            x, y = _size_of(lamp)
            x, y = x * abs(scale.x), y * abs(scale.y)
            area = x * y * (np.pi / 4 if lamp.shape in ("DISK", "ELLIPSE") else 1)
            made.energy, made.spread = area * np.pi, np.pi
            # In front of it: it shines along -z.
            back = Matrix.Rotation(np.pi, 4, "Y") @ Matrix.Translation((0, 0, 1))
            pixels = _seen_flat(scene, turn.to_4x4() @ back, x, y)
        else:
            made.energy, made.shadow_soft_size = 4 * np.pi, 0.0
            pixels = np.pi * _seen_around(scene)
    return LampPicture(pixels, np.array(turn, dtype=np.float64))


def _size_of(lamp: Any) -> tuple[float, float]:
    return float(lamp.size), float(lamp.size if lamp.shape in ("SQUARE", "DISK") else lamp.size_y)


@contextmanager
def _alone(lamp: Any, place: Any) -> Iterator[tuple[Any, Any]]:
    """A scene that has nothing but a copy of the lamp, white and normalised, at the origin, and a camera."""
    before = bpy.context.scene
    scene, made = bpy.data.scenes.new("wend.lamp"), lamp.copy()
    camera = bpy.data.cameras.new("wend.lamp")
    objects = [bpy.data.objects.new("wend.lamp", data) for data in (made, camera)]
    try:
        for object_ in objects:
            scene.collection.objects.link(object_)
        objects[0].matrix_world, objects[0].visible_camera = place, True
        made.color, made.exposure, made.normalize, made.use_temperature = (1, 1, 1), 0, True, False
        scene.camera = objects[1]
        scene.render.engine = "CYCLES"
        cycles = scene.cycles
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.max_bounces = 0
        cycles.pixel_filter_type, cycles.samples = "BOX", 2
        scene.render.resolution_percentage = 100
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.frame_set(before.frame_current, subframe=before.frame_subframe)
        yield scene, made
    finally:
        for object_ in objects:
            bpy.data.objects.remove(object_)
        bpy.data.cameras.remove(camera)
        bpy.data.lights.remove(made)
        bpy.data.scenes.remove(scene)


def _rendered(scene: Any, width: int, height: int) -> Floats:
    scene.render.resolution_x, scene.render.resolution_y = width, height
    with tempfile.TemporaryDirectory(prefix="wend-lamp-") as folder:
        scene.render.filepath, scene.render.use_file_extension = f"{folder}/lamp.exr", False
        bpy.ops.render.render(write_still=True, scene=scene.name)
        return np.array(read(scene.render.filepath).image, dtype=np.float64)


def _seen_flat(scene: Any, place: Any, width: float, height: float) -> Floats:
    """By a camera in front, of which the picture is so large."""
    scene.camera.matrix_world = place
    camera = scene.camera.data
    camera.type, camera.ortho_scale, camera.sensor_fit, camera.clip_start = "ORTHO", width, "HORIZONTAL", 1e-3
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = max(width / height, 1), max(height / width, 1)
    return _rendered(scene, _SIDE, _SIDE)


def _seen_around(scene: Any) -> Floats:
    """What a white sphere of radius 1 around the lamp reflects."""
    mesh, white = bpy.data.meshes.new("wend.lamp"), bpy.data.materials.new("wend.lamp")
    sphere = bpy.data.objects.new("wend.lamp", mesh)
    try:
        made = bmesh.new()
        bmesh.ops.create_uvsphere(made, u_segments=256, v_segments=128, radius=1)
        made.to_mesh(mesh)
        made.free()
        tree = white.node_tree
        tree.nodes.clear()
        diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
        tree.links.new(diffuse.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        mesh.materials.append(white)
        scene.collection.objects.link(sphere)
        scene.camera.rotation_euler = (np.pi / 2, 0, 0)
        scene.camera.data.type, scene.camera.data.panorama_type = "PANO", "EQUIRECTANGULAR"
        scene.camera.data.clip_start = 1e-3
        return _rendered(scene, _WIDTH, _WIDTH // 2)
    finally:
        bpy.data.objects.remove(sphere)
        bpy.data.meshes.remove(mesh)
        bpy.data.materials.remove(white)
