"""The world around a scene of Blender, as light of the renderer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from ._blend_volumes import volume_parameters
from ._blend_nodes import Nodes, output_node
from ._film import Film, read
from ._scene_reader import SceneReader

#: From pbrt's pictures by latitude and longitude, whose middle is towards x and whose left is towards y, to Blender's
#: world: there the middle is towards y, and the left towards -x.
_LATLONG = np.array([[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])

#: Of a panorama, all pixels together, and then once more of those that are bright.
_SAMPLES = 1 << 23

#: The share of all light that makes a pixel a bright one.
_BRIGHT = 1e-3


def add_world(reader: SceneReader, world: Any, can_render: bool, is_seen: bool) -> bool:
    """Adds the light of the world; whether there is any. What is not one colour is rendered by Cycles as a panorama, if
    that can be done here. `is_seen`: by the camera."""
    view = {} if is_seen and (world is None or world.cycles_visibility.camera) else {"string cameraview": "hidden"}
    tree = world.node_tree if world and world.use_nodes else None
    output = output_node(tree) if tree else None
    if output is None:
        return _add_even(reader, np.array(world.color, dtype=np.float64) if world else np.zeros(3), view)
    nodes = Nodes(reader, f"world '{world.name}'", f" world {world.name}")
    node = nodes.shader(output.inputs["Surface"])
    if node is None:
        return False
    if node.bl_idname == "ShaderNodeBackground":
        colour, strength = nodes.known(node.inputs["Color"]), nodes.known(node.inputs["Strength"])
        if colour is not None and strength is not None:
            return _add_even(reader, np.broadcast_to(colour, 3) * float(strength[0]), view)
    if not can_render:
        nodes.warn(node, "a world that is not one colour is left out: it cannot be rendered while a render is going on")
        return False
    width = _width_of(world)
    nodes.warn(node, f"a world that is not one colour becomes a picture of {width} x {width // 2}, by Cycles")
    if view or not _depends_on_rays(world.node_tree):
        return _add_panorama(reader, nodes, world, width, _PATH, view)
    # What lights, and what the camera sees.
    shines = _add_panorama(reader, nodes, world, width, _PATH, {"string cameraview": "hidden"})
    is_shown = _add_panorama(reader, nodes, world, width, _OF_CAMERA, {"string cameraview": "only"})
    return shines or is_shown


def add_world_volume(reader: SceneReader, world: Any) -> str | None:
    """The name of the medium that fills the world; None where there is none."""
    tree = world.node_tree if world and world.use_nodes else None
    output = output_node(tree) if tree else None
    if output is None:
        return None
    nodes = Nodes(reader, f"world '{world.name}'", f" world {world.name}")
    node = nodes.shader(output.inputs["Volume"])
    parameters = volume_parameters(nodes, node) if node else None
    if parameters is None:
        return None
    name = f" world {world.name}"
    reader.make_medium(name, parameters)
    return name


def _add_even(reader: SceneReader, colour: Any, view: dict[str, Any]) -> bool:
    if colour.max() <= 0:
        return False
    reader.builder.add("LightSource", "infinite", {"rgb L": colour} | view)
    return True


#: Of a Light Path node, for rays of diffuse surfaces; all others are 0.
_PATH = {"Is Diffuse Ray": 1.0, "Is Reflection Ray": 1.0, "Ray Depth": 1.0, "Diffuse Depth": 1.0}

#: For those of the camera.
_OF_CAMERA = {"Is Camera Ray": 1.0}


def _depends_on_rays(tree: Any) -> bool:
    groups = [node.node_tree for node in tree.nodes if node.bl_idname == "ShaderNodeGroup" and node.node_tree]
    is_asked = (any(o.is_linked for o in node.outputs) for node in tree.nodes if node.bl_idname == "ShaderNodeLightPath")
    return any(is_asked) or any(map(_depends_on_rays, groups))


@contextmanager
def _seen_by(nodes: Nodes, world: Any, path: dict[str, float]) -> Iterator[Any]:
    """A copy of the world in which rays of a camera see what those do of which a Light Path node says this."""
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    made, groups = world.copy(), []
    made.cycles_visibility.camera = True

    def settle(tree: Any) -> None:
        for node in list(tree.nodes):
            if node.bl_idname == "ShaderNodeGroup" and node.node_tree:
                node.node_tree = node.node_tree.copy()
                groups.append(node.node_tree)
                settle(node.node_tree)
            elif node.bl_idname == "ShaderNodeLightPath":
                for link in [link for output in node.outputs for link in output.links]:
                    if link.from_socket.name != "Is Camera Ray":
                        nodes.warn(node, "a world that depends on the kind of ray is as diffuse surfaces see it, but for the camera")
                    value = tree.nodes.new("ShaderNodeValue")
                    value.outputs[0].default_value = path.get(link.from_socket.name, 0.0)
                    tree.links.new(value.outputs[0], link.to_socket)

    try:
        settle(made.node_tree)
        yield made
    finally:
        bpy.data.worlds.remove(made)
        for group in groups:
            bpy.data.node_groups.remove(group)


def _width_of(world: Any) -> int:
    width = 2048
    for other in world.node_tree.nodes:
        if other.bl_idname == "ShaderNodeTexEnvironment" and other.image:
            width = min(max(int(other.image.size[0]), 512), 4096)
    return width


def _add_panorama(
    reader: SceneReader, nodes: Nodes, world: Any, width: int, path: dict[str, float], view: dict[str, Any]
) -> bool:
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    before = bpy.context.scene
    scene = bpy.data.scenes.new("panorama")
    camera = bpy.data.cameras.new("panorama")
    eye = bpy.data.objects.new("panorama", camera)
    file = reader.map_file(f"world{len(reader.builder)}.exr")
    try:
        scene.collection.objects.link(eye)
        eye.rotation_euler = (np.pi / 2, 0, 0)
        camera.type = "PANO"
        camera.panorama_type = "EQUIRECTANGULAR"
        scene.camera = eye
        scene.render.engine = "CYCLES"
        scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
        scene.cycles.sample_clamp_direct = 0
        scene.cycles.pixel_filter_type = "BOX"
        scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, width // 2, 100
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.render.filepath, scene.render.use_file_extension = file, False
        scene.frame_set(before.frame_current, subframe=before.frame_subframe)
        with _seen_by(nodes, world, path) as scene.world:
            picture = _rendered(scene, width * width // 2)
            _refine(scene, picture)
    finally:
        bpy.data.objects.remove(eye)
        bpy.data.cameras.remove(camera)
        bpy.data.scenes.remove(scene)
    Film.of(picture).save(file)
    with reader.builder.block():
        reader.builder.add("Transform", _LATLONG)
        reader.builder.add("LightSource", "infinite", {"string filename": file, "string mapping": "equirectangular"} | view)
    return bool(picture.max() > 0)


def _rendered(scene: Any, pixels: int) -> npt.NDArray[np.float32]:
    """What the scene's camera sees, of which so many pixels are rendered."""
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    scene.cycles.samples = min(max(_SAMPLES // pixels, 4), 16384)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return np.array(read(scene.render.filepath).image)


def _refine(scene: Any, picture: npt.NDArray[np.float32]) -> None:
    """Renders the rectangle of all bright pixels once more. A sun is a few of them, has most of the light, and that is
    as exact as it has samples."""
    height, width = picture.shape[:2]
    light = picture.sum(axis=2) * np.sin((np.arange(height) + 0.5) * np.pi / height)[:, None]
    rows, columns = np.nonzero(light > _BRIGHT * light.sum())
    if not len(rows):
        return
    # Its neighbours may have missed their part of it.
    top, left = max(rows.min() - 2, 0), max(columns.min() - 2, 0)
    bottom, right = min(rows.max() + 3, height), min(columns.max() + 3, width)
    if (bottom - top) * (right - left) > picture[..., 0].size // 4:
        return
    render = scene.render
    render.use_border, render.use_crop_to_border = True, False
    render.border_min_x, render.border_max_x = left / width, right / width
    render.border_min_y, render.border_max_y = 1 - bottom / height, 1 - top / height
    finer = _rendered(scene, int((bottom - top) * (right - left)))
    # Outside of the rectangle it is black.
    np.copyto(picture, finer, where=finer.any(axis=2, keepdims=True))
