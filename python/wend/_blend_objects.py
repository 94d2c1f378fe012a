"""Objects of Blender as shapes, lights and volumes."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np

from . import _blend_lights as lights
from ._blend_bake import Bakeries
from ._blend_copies import Copies
from ._blend_lamp_pictures import LampPicture
from ._blend_materials import look_of
from ._blend_nodes import Nodes, output_node
from ._blend_regions import Region, Regions
from ._blend_shapes import Geometry, box_of, brush, hair_segments, is_open, lean, mesh_parts, shrunk, strands
from ._blend_volumes import glow_parameters, volume_parameters
from ._scene_reader import Look, SceneReader

#: Degrees by which smooth faces may lean from their normals without a word.
_BENT = 22

#: Kinds of objects that have a surface once they are evaluated.
SOLID = ("MESH", "CURVE", "SURFACE", "META", "FONT")


class ObjectReader(SceneReader):
    """Adds objects, and knows what they share.

    Args:
        can_render: whether Cycles may be called.
    """

    def __init__(self, name: str, maps: str | os.PathLike[str] | None, can_render: bool) -> None:
        super().__init__(name, maps)
        self.can_render = can_render
        self.bakeries: Bakeries | None = None  #: where Cycles may be called
        self.has_light = False
        self._fogs = 0
        self._media: set[str] = set()  #: names of those that objects have, together with what is around them
        self._lamp_pictures: dict[str, LampPicture] = {}
        self._objects: dict[str, str] = {}
        #: of the object at hand, where it changes its shape
        self.shapes: tuple[Geometry, Geometry] | None = None
        self.copies = Copies(self, can_render)
        self.view = "shown"  #: of the object at hand: what it is to the camera
        self.regions = Regions(self)
        self.region: Region | None = None  #: of the object at hand, if it has a volume

    def add_object(self, object_: Any, place: Any, key: str, is_copied: bool) -> None:
        kind, name = object_.type, object_.name
        if kind == "LIGHT":
            index = self.regions.index_at(place[0, 3:, :3]) if object_.data.type != "SUN" else 1.0
            lights.add(self, name, object_.data, place, object_.visible_camera, self._lamp_pictures.get(key), index**2)
            self.has_light = True
        elif kind in SOLID:
            self.add_solid(object_, place, key, is_copied)
        elif kind == "CURVES":
            look = look_of(self, object_.material_slots[0].material if object_.material_slots else None)
            for segment in hair_segments(object_.data):
                self.add_shape(place, look, ("curve", segment), name)
        elif kind == "VOLUME":
            self.add_volume(object_, place, name)
        elif kind not in ("EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"):
            self.tell(f"object '{name}'", f"a {kind} is left out")

    def add_strands(self, object_: Any, name: str) -> None:
        """Of its particles."""
        for system in getattr(object_, "particle_systems", []):
            if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
                slots = object_.material_slots
                number = min(system.settings.material, len(slots)) - 1
                look = look_of(self, slots[number].material if slots else None)
                for segment in strands(system, None, object_):
                    self.add_shape(_place(np.eye(4)), look, ("curve", segment), name)

    def add_solid(self, object_: Any, place: Any, key: str, is_copied: bool) -> None:
        name = object_.name
        self.add_strands(object_, name)
        materials = [slot.material for slot in object_.material_slots]
        seen_key = f"{self.view} {key}"
        if is_copied and seen_key in self._objects:
            with self.builder.block():
                self.put(place)
                self.builder.add("ObjectInstance", self._objects[seen_key])
            return
        mesh = object_.to_mesh()
        if mesh is None:
            return
        bakery = self.bakeries.get(key) if self.bakeries is not None else None
        ends = self.shapes
        if ends is not None and not all(end.goes_with(Geometry.of(mesh)) for end in ends):
            self.tell(f"object '{name}'", "what changes its number of points while the shutter is open is as at the frame")
            ends = None
        try:
            parts = [
                (look_of(self, materials[min(number, len(materials) - 1)] if materials else None, bakery), parameters)
                for number, parameters in mesh_parts(mesh, ends, bakery.uvs if bakery is not None else None)
            ]
            if any(look.refracts for look, _ in parts) and is_open(mesh):
                self.tell(
                    f"object '{name}'",
                    "glass with a rim, such as a pane without thickness, shows what is behind it by its index: darker or brighter",
                )
        finally:
            object_.to_mesh_clear()
        if lean(parts) > _BENT:
            self.tell(
                f"object '{name}'",
                f"smooth faces whose normals lean from them by more than {_BENT} degrees are darker than in Cycles (by up to 4 % "
                "where it is 25 degrees, and up to 20 % where it is 50)",
            )
        brush(self, name, parts, np.eye(4) if is_copied else place[0])
        # What shines or holds a medium is no part of an object that is placed several times.
        if not is_copied or any(look.emission is not None or look.medium is not None for look, _ in parts):
            for look, parameters in parts:
                self.add_shape(place, look, ("trianglemesh", parameters), name)
            return
        shared = self._objects[seen_key] = f"{name} {len(self._objects)}"
        with self.builder.block("Object", shared):
            for look, parameters in parts:
                self.add_shape(_place(np.eye(4)), look, ("trianglemesh", parameters), name)
        with self.builder.block():
            self.put(place)
            self.builder.add("ObjectInstance", shared)

    def add_shape(self, place: Any, look: Look, shape: tuple[str, dict[str, Any]], name: str) -> None:
        kind, parameters = shape
        add = self.builder.add
        if look.medium is not None and look.shape_parameters and kind == "trianglemesh":
            # What a surface lets through by its share goes into the volume, which begins right below it.
            inside = Look(None, medium=look.medium, fog=look.fog)
            self.add_shape(place, inside, (kind, shrunk(parameters)), name)
            look = replace(look, medium=None, fog=None)
        if look.medium is not None:
            look = self.filled(look, place, name)
        light = self.light_of(look, place, parameters) if look.emission is not None and kind == "trianglemesh" else {}
        if light and look.index != 1 and not look.is_one_sided:
            self.add_glow_inside(place, look, light, parameters)
            look = replace(look, is_one_sided=True)
        with self.builder.block():
            self.put(place)
            if look.name is None:
                add("Material", "interface")
            else:
                add("NamedMaterial", look.name)
            if look.medium is not None:
                add("MediumInterface", look.medium, self.regions.outside(self.region))
            if look.emission is not None:
                if kind == "curve":
                    self.tell(f"object '{name}'", "hair does not shine")
                else:
                    add("AreaLightSource", "diffuse", light | {"bool twosided": not look.is_one_sided, "bool alphaonce": True})
                    self.has_light = True
            seen = {"string cameraview": self.view} if self.view != "shown" else {}
            add("Shape", kind, parameters | look.shape_parameters | seen)

    def light_of(self, look: Look, place: Any, parameters: dict[str, Any]) -> dict[str, Any]:
        """Parameters of what a mesh shines with."""
        points = parameters["point3 P"]
        some = points[:: max(len(points) // 8, 1)] @ place[0, :3, :3] + place[0, 3, :3]
        light = {"rgb L": look.emission} if look.shown is None else {"string filename": look.shown}
        return light | {"float scale": self.regions.index_at(some, self.region) ** 2}

    def add_glow_inside(self, place: Any, look: Look, light: dict[str, Any], parameters: dict[str, Any]) -> None:
        """What the inner side of glass shines with. In Cycles it comes out as bright as it is, and here by the index's
        square darker."""
        inner = shrunk(parameters)
        inner["integer indices"] = np.ascontiguousarray(np.asarray(inner["integer indices"])[:, ::-1])
        uvs = {name: value for name, value in parameters.items() if name == "point2 uv"}
        brighter = {"float scale": light["float scale"] * look.index**2, "bool solid": False}
        with self.builder.block():
            self.put(place)
            self.builder.add("Material", "interface")
            self.builder.add("AreaLightSource", "diffuse", light | brighter)
            self.builder.add("Shape", "trianglemesh", inner | uvs | look.shape_parameters)

    def filled(self, look: Look, place: Any, name: str) -> Look:
        """With the medium that is there, which is what all volumes there are together."""
        if look.fog is not None and look.fog.parameters is None:
            return replace(look, medium=None, fog=None)
        medium, parameters = self.regions.inside(self.region, look)
        if look.fog is not None and self.region is None:
            self._fogs += 1
            medium += f" {self._fogs}"
        if medium not in self.media and medium not in self._media:
            self._media.add(medium)
            with self.builder.block():
                self.builder.add("Transform", self.held(place, f"object '{name}'") if look.fog is not None else np.eye(4))
                self.builder.add("MakeNamedMedium", medium, parameters)
        return replace(look, medium=medium, fog=None)

    def add_volume(self, object_: Any, place: Any, name: str) -> None:
        volume = object_.data
        where = f"object '{name}'"
        material = object_.material_slots[0].material if object_.material_slots else None
        output = output_node(material.node_tree) if material and material.node_tree else None
        nodes = Nodes(self, f"material '{material.name}'" if material else where, name)
        node = nodes.shader(output.inputs["Volume"]) if output is not None else None
        parameters = volume_parameters(nodes, node) if node is not None else None
        if not volume.grids.is_loaded:
            volume.grids.load()
        file = volume.grids.frame_filepath or bpy.path.abspath(volume.filepath)
        if node is None or parameters is None or not file or not len(volume.grids):
            self.tell(where, "a volume without a file, or a material with a volume, is left out")
            return
        grid, grids = "density", [g.name for g in volume.grids]
        if node.bl_idname == "ShaderNodeVolumePrincipled":
            grid = node.inputs["Density Attribute"].default_value or "density"
            if node.inputs["Color Attribute"].default_value in grids:
                self.tell(where, "the colours of a volume's grid are left out: it has that of the shader")
        elif "density" not in grids:
            grid = grids[0]
        place = self.held(place, where)
        density = 1.0
        if volume.render.space == "OBJECT":
            # As opaque whatever its size: coefficients are of the object's own lengths.
            sizes = np.linalg.norm(place[:3, :3], axis=1)
            if np.ptp(sizes) > 1e-4 * sizes.max():
                self.tell(where, "a volume of uneven scale is as opaque as its mean scale makes it")
            density = 1 / max(float(sizes.mean()), 1e-30)
        # What it shines with is given apart: in Cycles it is not in proportion to the grid.
        parameters.pop("rgb Le", None)
        parameters |= {"float scale": density} | glow_parameters(nodes, node, grids, grid, volume.render.clipping, density)
        if "rgb glow" in parameters and self.region is not None:
            parameters["rgb glow"] = parameters["rgb glow"] * self.region.index_inside**2
        medium = f" volume {name}"
        with self.builder.block():
            self.builder.add("Transform", place)
            self.builder.add(
                "MakeNamedMedium",
                medium,
                parameters | {"string type": "nanovdb", "string filename": file, "string gridname": grid},
            )
            self.builder.add("MediumInterface", medium, self.regions.outside(self.region))
            self.builder.add("Material", "interface")
            self.builder.add("Shape", "trianglemesh", box_of(np.array(object_.bound_box, dtype=np.float64)))


def _place(matrix: Any) -> Any:
    """Rows as points, twice: nothing moves."""
    rows = np.array(matrix, dtype=np.float64).T
    return np.array([rows, rows])
