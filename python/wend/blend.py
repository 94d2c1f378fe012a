"""Blender's scenes: `python -m wend.blend scene.blend --render picture.exr`, or `wend.blend.read(path)`.

Wants `bpy` (`pip install 'wend[blender]'`), or Blender itself. Lengths are Blender's units. What has no counterpart here is
told once for each kind, as a `SceneWarning` with the object, or material and node.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np

from ._builder import SceneBuilder
from ._errors import InputError
from ._progress import Bar
from ._scene_reader import Look

try:
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
except ImportError as error:
    raise ImportError("wend.blend wants bpy, which there is for Python 3.11 and 3.13: pip install 'wend[blender]'") from error

from . import _reader_command as command
from ._blend_bake import Bakeries
from ._blend_camera import add_view, expect_camera
from ._blend_lamp_pictures import picture_of, wants_picture
from ._blend_materials import look_of, wants_of
from ._blend_motion import Motion
from ._blend_objects import SOLID, ObjectReader
from ._blend_render_mode import as_rendered
from ._blend_roles import view_of
from ._blend_settings import tell_of_object, tell_of_scene
from ._blend_world import add_world, add_world_volume
from ._blend_world_fog import WorldFog, world_fog


def read(
    path: str | os.PathLike[str],
    *,
    frame: int | None = None,
    scene: str | None = None,
    camera: str | None = None,
    resolution: tuple[int, int] | None = None,
    spp: int = 64,
    maps: str | os.PathLike[str] | None = None,
    bake_resolution: int = 1024,
    progress: bool = False,
) -> SceneBuilder:
    """A .blend file, which is opened in place of what is open now, in the terms of the renderer.

    Args:
        path: the file.
        frame: of the animation; None: the one that the file was saved at.
        scene: its name; None: the one that the file was saved with.
        camera: name of an object; None: the scene's.
        resolution: (width, height) of the picture; None: the scene's.
        spp: samples per pixel.
        maps: folder for pictures that are made for the scene; None: one that goes away when the program ends.
        bake_resolution: width and height of pictures that are baked where textures have no counterpart.
        progress: show a bar (tqdm).

    Raises:
        InputError: for a file that cannot be opened, or a scene or camera that is not in it.

    Warns:
        SceneWarning: for what has no counterpart, each kind once.
    """
    file = os.fspath(path)
    try:
        if not os.path.exists(file):
            raise RuntimeError("no such file")
        bpy.ops.wm.open_mainfile(filepath=file, load_ui=False)
    except RuntimeError as error:
        raise InputError(f"{file}: error: {str(error).strip()}") from None
    return of_scene(
        _named(bpy.data.scenes, scene, "scene") or bpy.context.scene,
        name=file,
        frame=frame,
        camera=camera,
        resolution=resolution,
        spp=spp,
        maps=maps,
        bake_resolution=bake_resolution,
        progress=progress,
    )


def of_scene(
    scene: Any,
    *,
    name: str = "scene",
    frame: int | None = None,
    camera: str | None = None,
    resolution: tuple[int, int] | None = None,
    spp: int = 64,
    maps: str | os.PathLike[str] | None = None,
    depsgraph: Any = None,
    set_frame: Callable[[int, float], Any] | None = None,
    can_render: bool = True,
    bake_resolution: int = 1024,
    progress: bool = False,
) -> SceneBuilder:
    """The same of a scene that is open in Blender.

    Args:
        scene: a `bpy.types.Scene`.
        name: what messages call it; file names are relative to its folder.
        depsgraph: the evaluated scene, where a render is going on; None: it is evaluated here.
        set_frame: evaluates that at a frame and a part of one, for motion blur; None: as the scene does.
        can_render: whether Cycles may be called for what has no counterpart, such as a sky or a texture.
        frame, camera, resolution, spp, maps, bake_resolution, progress: as for `read`.
    """
    reader = _Reader(scene, name, maps, can_render, bake_resolution)
    if frame is not None and depsgraph is None:
        # Before the settings of renders are looked at, and the camera, which a marker may change.
        scene.frame_set(frame)
    eye = _named(scene.objects, camera, "camera") or scene.camera
    if set_frame is None:

        def set_frame(whole: int, part: float) -> None:
            scene.frame_set(whole, subframe=part)

    if depsgraph is not None:
        return reader.read(depsgraph, eye, resolution, spp, Motion(scene, eye, depsgraph, set_frame), progress)
    with as_rendered(scene):
        bpy.context.window.scene = scene
        depsgraph = bpy.context.evaluated_depsgraph_get()
        depsgraph.update()
        return reader.read(depsgraph, eye, resolution, spp, Motion(scene, eye, depsgraph, set_frame), progress)


def _named(things: Any, name: str | None, kind: str) -> Any:
    if name is None:
        return None
    if name not in things:
        raise InputError(f"{name}: error: no {kind} of that name: there are {', '.join(t.name for t in things) or 'none'}")
    return things[name]


class _Reader(ObjectReader):
    def __init__(
        self, scene: Any, name: str, maps: str | os.PathLike[str] | None, can_render: bool, bake_resolution: int
    ) -> None:
        super().__init__(name, maps, can_render)
        self.scene = scene
        self.bake_resolution = bake_resolution

    def read(
        self, depsgraph: Any, eye: Any, resolution: tuple[int, int] | None, spp: int, motion: Motion, progress: bool
    ) -> SceneBuilder:
        add = self.builder.add
        expect_camera(self.scene, eye)
        tell_of_scene(self, self.scene, depsgraph.view_layer)
        for name in motion.bent:
            self.tell(name, "what goes along a curve, or unevenly, while the shutter is open goes straight and evenly here")
        fog = self.world_fog(depsgraph) if self.can_render else None
        if fog is not None:
            fog.add(self)
        self.around = fog.name if fog is not None else add_world_volume(self, self.scene.world)
        if self.around is not None:
            add("MediumInterface", "", self.around)
        before_world = len(self.builder)
        add("WorldBegin")
        if fog is not None:
            fog.add_end(self)
        self.has_light = add_world(self, self.scene.world, self.can_render, not self.scene.render.film_transparent)
        # What the depsgraph gives is valid only while it is walked through: once to count, and once to read.
        seen = [self.is_seen(instance) for instance in depsgraph.object_instances]
        self.copies.count(depsgraph, seen)
        times = Counter(self.copies.key_of(i) for i, shown in zip(depsgraph.object_instances, seen) if shown)
        if self.can_render:
            self.bake(depsgraph, seen, times)
        self.find_regions(depsgraph, seen, eye)
        self.builder.insert(before_world, self.view_of(eye, resolution, spp, motion))
        bar = Bar(os.path.basename(self.builder.name), progress)
        for i, (instance, shown) in enumerate(zip(depsgraph.object_instances, seen)):
            if shown:
                object_ = instance.object
                tell_of_object(self, object_)
                bar.update(i / len(seen), object_.name)
                place = motion.places(instance)
                self.view = view_of(self, instance)
                self.region = self.regions.of(i)
                self.shapes = motion.shapes(object_)
                key = self.copies.key_of(instance)
                self.add_object(object_, place, key, times[key] > 1)
            elif instance.show_particles and not instance.is_instance and not instance.object.hide_render:
                # Strands are there, and what they grow on is not.
                self.view = view_of(self, instance)
                self.add_strands(instance.object, instance.object.name)
        bar.close()
        if not self.has_light:
            self.tell(f"scene '{self.scene.name}'", "no light: the picture is black")
        return self.builder

    def world_fog(self, depsgraph: Any) -> WorldFog | None:
        world = self.scene.world
        if not (world and world.use_nodes and world.node_tree):
            return None
        corners = [np.zeros((0, 3))]
        for instance in depsgraph.object_instances:
            if self.is_seen(instance) or instance.object.type == "CAMERA":
                place = np.array(instance.matrix_world)
                corners.append(np.array(instance.object.bound_box) @ place[:3, :3].T + place[:3, 3])
        return world_fog(self, world, np.concatenate(corners), self.bake_resolution)

    def bake(self, depsgraph: Any, seen: list[bool], times: Counter[str]) -> None:
        """Makes materials, and pictures of what has no counterpart."""
        self.bakeries = Bakeries(self, depsgraph, self.bake_resolution)
        lamps: dict[str, tuple[Any, Any]] = {}
        for instance, shown in zip(depsgraph.object_instances, seen):
            key = self.copies.key_of(instance)
            if shown and instance.object.type == "LIGHT" and key not in lamps and wants_picture(self, instance.object.data):
                lamps[key] = instance.object.data.original, instance.matrix_world.copy()
            if not shown or instance.object.type not in SOLID or self.bakeries.get(key):
                continue
            # Of what nodes of geometry make and place, an object is there only while it is the one that is looked at.
            placed = instance.instance_object
            is_passing = instance.is_instance and placed is not None and placed.data != instance.object.data
            bakery = self.bakeries.add(instance.object, key, times[key] > 1, is_passing)
            materials = [slot.material for slot in instance.object.material_slots if slot.material]
            for material in materials:
                bakery.decide(wants_of(self, material, bakery))
            for material in materials:
                look_of(self, material, bakery)
            if is_passing and bakery.is_wanted:
                bakery.mesh()
        self.bakeries.bake(self.scene)
        self._lamp_pictures = {key: picture_of(lamp, world) for key, (lamp, world) in lamps.items()}

    def find_regions(self, depsgraph: Any, seen: list[bool], eye: Any) -> None:
        """What volumes enclose, and glass in which there are lights or the camera."""
        place = np.array(eye.matrix_world.translation)
        lights, glass = [(place, place)], {}
        looks: dict[int, list[Look]] = {}
        for i, (instance, shown) in enumerate(zip(depsgraph.object_instances, seen)):
            object_ = instance.object
            if not shown or object_.type not in (*SOLID, "VOLUME", "LIGHT"):
                continue
            world = np.array(instance.matrix_world)
            corners = np.zeros((1, 3)) if object_.type == "LIGHT" else np.array(object_.bound_box)
            corners = corners @ world[:3, :3].T + world[:3, 3]
            box = corners.min(axis=0), corners.max(axis=0)
            bakery = self.bakeries.get(self.copies.key_of(instance)) if self.bakeries is not None else None
            materials = [slot.material for slot in object_.material_slots if slot.material] if object_.type in SOLID else []
            given = [look_of(self, material, bakery) for material in materials]
            is_filled = object_.type == "VOLUME" or any(look.medium is not None for look in given)
            if object_.type == "LIGHT" or is_filled or any(look.emission is not None for look in given):
                lights.append(box)
            if is_filled:
                looks[i] = given
            elif any(look.index != 1 for look in given):
                glass[i] = (*box, given)
        low, high = (np.array(side) for side in zip(*lights))
        looks |= {i: given for i, (a, b, given) in glass.items() if ((a <= low) & (high <= b)).all(axis=1).any()}
        for i, instance in enumerate(depsgraph.object_instances):
            if i in looks:
                self.regions.add(i, instance.object, np.array(instance.matrix_world), looks[i])
        self.regions.nest()

    def view_of(self, eye: Any, resolution: tuple[int, int] | None, spp: int, motion: Motion) -> SceneBuilder:
        """What stands before the world."""
        world, self.builder = self.builder, SceneBuilder()
        place = np.array(eye.matrix_world.translation)
        stands_in, around = self.regions.around(place), self.around or ""
        if stands_in != around:
            self.builder.add("MediumInterface", "", stands_in)
        # Within glass all is brighter by the index's square than in Cycles.
        add_view(self, self.scene, eye, resolution, spp, motion, 1 / self.regions.index_at(place[np.newaxis]) ** 2)
        if stands_in != around:
            self.builder.add("MediumInterface", "", around)
        view, self.builder = self.builder, world
        return view

    @staticmethod
    def is_seen(instance: Any) -> bool:
        object_ = instance.object
        by_points = ("VERTS", "FACES")
        is_copied = object_.parent is not None and object_.parent.instance_type in by_points
        if instance.is_instance:
            # What is copied to the points of its parent is there alone.
            by_others = is_copied and (instance.parent is None or instance.parent.instance_type not in by_points)
            return bool(instance.show_self) and not by_others
        return not object_.hide_render and bool(instance.show_self) and not is_copied


def _frames(text: str) -> list[int]:
    first, _, last = text.partition("-")
    try:
        frames = list(range(int(first), int(last or first) + 1))
    except ValueError:
        frames = []
    if not frames:
        raise InputError(f"--frames {text}: expected A-B, or one number")
    return frames


def _of_frame(name: str, frame: int | None) -> str:
    if frame is None or "#" not in name:
        return name
    digits = name.count("#")
    return name.replace("#" * digits, str(frame).zfill(digits))


def main(arguments: list[str] | None = None) -> int:
    """What `python -m wend.blend` does; the exit status."""
    parser = argparse.ArgumentParser(prog="python -m wend.blend", description="render a .blend file, or write it as a pbrt scene")
    parser.add_argument("file", help="scene.blend")
    parser.add_argument("--frames", metavar="A-B", help="one after another, #### in names being their numbers (default: the file's)")
    parser.add_argument("--scene", metavar="NAME", help="(default: the file's)")
    parser.add_argument("--camera", metavar="NAME", help="(default: the scene's)")
    parser.add_argument("--resolution", metavar="WxH", help="(default: the scene's)")
    parser.add_argument("--bake-resolution", type=int, default=1024, metavar="N", help="of textures that have no counterpart (1024)")
    command.add_options(parser)
    options = command.parsed(parser, arguments)

    def convert() -> None:
        resolution = command.size_of(options.resolution) if options.resolution else None
        if not 1 <= options.bake_resolution <= 16384:
            raise InputError(f"--bake-resolution {options.bake_resolution}: expected 1 to 16384")
        frames: list[int | None] = [None] if not options.frames else [*_frames(options.frames)]
        names = [options.output or "", options.render or ""]
        if len(frames) > 1 and any(name and "#" not in name for name in names):
            raise InputError("--frames: names need #### where the frame's number goes")
        for frame in frames:
            output, picture = (_of_frame(name, frame) for name in names)
            builder = read(
                options.file,
                frame=frame,
                scene=options.scene,
                camera=options.camera,
                resolution=resolution,
                spp=options.spp,
                maps=command.maps_of(output),
                bake_resolution=options.bake_resolution,
                progress=True,
            )
            command.deliver(builder, options, output, picture)

    return command.as_command(convert)


if __name__ == "__main__":
    sys.exit(main())
