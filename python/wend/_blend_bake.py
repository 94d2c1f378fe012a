"""Textures of Blender that have no counterpart, as pictures that Cycles bakes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt
from mathutils import Matrix  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._blend_bake_nodes import TANGENT, blank, shining
from ._blend_fog import Fog
from ._blend_slices import sliced, slices
from ._blend_subsurface import albedo_inside
from ._blend_wanted import Wanted
from ._film import Film
from ._scene_reader import SceneReader

Floats = npt.NDArray[np.float32]
#: Of coordinates by UV: their least, and their largest.
Rect = tuple[float, float, float, float]

_UNIT: Rect = (0.0, 0.0, 1.0, 1.0)
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
#: Pixels that are continued around what is baked.
_MARGIN = 8


class Bakery:
    """Pictures of one object's materials.

    Args:
        all_: of all objects.
        object_: evaluated; it is looked at while materials are made.
        number: of it, among all objects.
        is_shared: whether there are several instances of it.
        is_passing: whether it is there only while it is looked at, as what nodes of geometry make and place is.
    """

    def __init__(self, all_: Bakeries, object_: Any, number: int, is_shared: bool, is_passing: bool) -> None:
        self.name: str = object_.name
        #: of the map that renders take
        self.uv_name: str = getattr(_render_layer(object_.data), "name", "")
        self.bakes_all = False  #: because the object has UVs of its own, which pictures do not know
        self.uvs: Floats | None = None  #: of corners, where there are such, after `bake`
        self.side, self.is_shared, self.is_passing = all_.side, is_shared, is_passing
        self.is_deformed = _is_deformed(object_.original)
        self._all, self._object, self._number = all_, object_, number
        self._mesh: Any = None
        self._place = object_.matrix_world.copy()
        self._like = object_.original
        self._slots = [slot.material.name if slot.material else "" for slot in object_.material_slots]
        self._made: dict[Wanted, str] = {}
        self._fogs: list[Fog] = []
        self._corners = np.array(object_.bound_box, dtype=np.float64)
        self._rect: Rect | None = None

    # ---- What is wanted ----

    def mesh(self) -> Any:
        """A copy of the object's, as evaluated, in Blender's data."""
        if self._mesh is None:
            try:
                # With all layers it would be evaluated anew, and be that of what the nodes belong to.
                self._mesh = bpy.data.meshes.new_from_object(
                    self._object, preserve_all_data_layers=not self.is_passing, depsgraph=self._all.depsgraph
                )
            except RuntimeError:  # there is no geometry
                self._mesh = bpy.data.meshes.new("wend.bake")
            source = self._object.data
            if hasattr(source, "texspace_location") and hasattr(self._mesh, "texspace_location"):
                # Generated coordinates are those of the mesh before its modifiers, but where they make another one.
                self._mesh.use_auto_texspace = False
                self._mesh.texspace_location = source.texspace_location
                self._mesh.texspace_size = source.texspace_size
        return self._mesh

    def rect(self) -> Rect:
        """That all UVs are in: the unit square, if that is so."""
        if self._rect is None:
            layer = _render_layer(self.mesh())
            uvs = _uvs_of(layer) if layer is not None else np.zeros((0, 2), dtype=np.float32)
            uvs = uvs[np.isfinite(uvs).all(axis=1)]
            if not len(uvs):
                self._rect = _UNIT
                return _UNIT
            (left, low), (right, high) = uvs.min(axis=0).tolist(), uvs.max(axis=0).tolist()
            is_in = min(left, low) >= -1e-4 and max(right, high) <= 1 + 1e-4
            self._rect = _UNIT if is_in else (left, low, max(right, left + 1e-6), max(high, low + 1e-6))
        return self._rect

    def known_wants(self, material: str) -> set[str] | None:
        """What `keep_wants` was given, for all objects whose maps are called the same."""
        return self._all.wants.get((material, self.uv_name))

    def keep_wants(self, material: str, wants: set[str]) -> None:
        self._all.wants[material, self.uv_name] = wants

    def decide(self, modes: set[str]) -> None:
        """Whether the object's UVs will do, where its materials want these modes: see `Probe`."""
        wants_object = "object" in modes or ("unit" in modes and self.rect() != _UNIT)
        self.bakes_all = self.bakes_all or (wants_object and not _can_be_baked(self.mesh()))

    def suffix(self, modes: set[str]) -> str:
        """Of the name of a material that wants these modes: the same for all objects that can share it."""
        is_own = not modes.isdisjoint({"object", "own", "fog"}) or (self.bakes_all and modes) or ("unit" in modes and self.rect() != _UNIT)
        if is_own:
            return f" of {self.name} {self._number}"
        return f" {self.rect()}" if "uv" in modes and self.rect() != _UNIT else ""

    def picture(self, wanted: Wanted) -> dict[str, Any]:
        """Parameters of a texture by a picture, which will be there after `bake`."""
        if wanted not in self._made:
            self._made[wanted] = self._all.file_for(wanted)
        parameters: dict[str, Any] = {"string filename": self._made[wanted], "string wrap": "clamp"}
        rect = self._rect_of(wanted)
        if rect is not None and rect != _UNIT:
            u, v = rect[2] - rect[0], rect[3] - rect[1]
            parameters["float uvmatrix"] = (1 / u, 0, -rect[0] / u, 0, 1 / v, -rect[1] / v)
        return parameters

    def _rect_of(self, wanted: Wanted) -> Rect | None:
        """None: by the object."""
        if wanted.is_even:
            return _UNIT
        if self.bakes_all or not wanted.is_by_uv or (wanted.is_unit and self.rect() != _UNIT):
            return None
        return self.rect()

    def side_of(self, wanted: Wanted) -> int:
        """Of its picture, in pixels."""
        return 4 if wanted.is_even else self.side

    def fill_inside(self, fog: Fog) -> None:
        """The medium inside will be there after `bake`."""
        where = f"object '{self.name}'"
        fog.spread(self._corners, np.array(self._place.to_scale(), dtype=np.float64), self.side)
        fog.tell(where)
        if fog.is_by_place and self.is_shared:
            self._all.reader.tell(where, "a volume that differs between instances is baked at the first of them")
        self._fogs.append(fog)

    # ---- Baking ----

    @property
    def is_wanted(self) -> bool:
        return bool(self._made or self._fogs)

    def bake(self, scene: Any) -> None:
        """Makes the pictures, in a scene that is shown."""
        if self.bakes_all:
            self._unwrap(scene)
        for wanted, file in self._made.items():
            rect = self._rect_of(wanted)
            made = self.mesh() if rect is None else _sheet(rect, self.uv_name)
            slots = self._slots if rect is None else [wanted.material.name]
            pixels = self._baked(scene, made, slots, wanted)
            if wanted.kind == "float":
                pixels = np.repeat((pixels @ _LUMINANCE)[..., None] ** np.float32(wanted.power), 3, axis=2)
            elif wanted.kind == "albedo":
                pixels = albedo_inside(pixels, wanted.power).astype(np.float32)
            Film.of(np.ascontiguousarray(pixels)).save(file)
            if rect is not None:
                bpy.data.meshes.remove(made)
        for fog in self._fogs:
            fog.fill(lambda wanted, places: inside(scene, wanted, places, self.mesh(), self._place, self._like))

    def _baked(self, scene: Any, mesh: Any, slots: Sequence[str], wanted: Wanted) -> Floats:
        """Black where that fails, as for a mesh without faces."""
        if len(mesh.polygons):
            try:
                size = self.side_of(wanted), self.side_of(wanted)
                return _baked(scene, mesh, slots, self._place, wanted, size, self._like)
            except RuntimeError as error:
                self._all.reader.tell(f"object '{self.name}'", f"what cannot be baked is black: {str(error).strip()}")
        return np.zeros((1, 1, 3), dtype=np.float32)

    def _unwrap(self, scene: Any) -> None:
        mesh = self.mesh()
        if not len(mesh.polygons):
            return
        layer = mesh.uv_layers.new(name="wend.bake")
        if layer is None:
            self._all.reader.tell(f"object '{self.name}'", "a mesh with eight UV maps has no room for one that is baked by")
            layer = mesh.uv_layers.active
        name = layer.name
        mesh.uv_layers.active = layer
        with _shown(scene, mesh, self._place):
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.reveal(select=True)
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.uv.smart_project(angle_limit=np.radians(66), island_margin=2 * _MARGIN / self.side / 4)
            bpy.ops.object.mode_set(mode="OBJECT")
        self.uvs = _uvs_of(mesh.uv_layers[name])

    def clear(self) -> None:
        """Takes the copy out of Blender's data."""
        if self._mesh is not None:
            bpy.data.meshes.remove(self._mesh)
            self._mesh = None


class Bakeries:
    """Those of a scene.

    Args:
        reader: of it.
        depsgraph: the evaluated scene.
        side: of pictures, in pixels.
    """

    def __init__(self, reader: SceneReader, depsgraph: Any, side: int) -> None:
        self.reader, self.depsgraph, self.side = reader, depsgraph, side
        self._by_key: dict[str, Bakery] = {}
        self._files = 0
        self.wants: dict[tuple[str, str], set[str]] = {}  #: by the names of material and UV map

    def get(self, key: str) -> Bakery | None:
        return self._by_key.get(key)

    def add(self, object_: Any, key: str, is_shared: bool, is_passing: bool) -> Bakery:
        self._by_key[key] = Bakery(self, object_, len(self._by_key), is_shared, is_passing)
        return self._by_key[key]

    def file_for(self, wanted: Wanted) -> str:
        self._files += 1
        name = bpy.path.clean_name(f"{wanted.material.name}.{wanted.node or 'light'}.{wanted.socket}")
        return self.reader.map_file(f"{name}.{self._files}.exr")

    def bake(self, before: Any) -> None:
        """Makes all pictures that were wanted. `before`: the scene that is shown, and will be again."""
        try:
            chosen = [bakery for bakery in self._by_key.values() if bakery.is_wanted]
            if chosen:
                with studio(before) as scene:
                    for bakery in chosen:
                        bakery.bake(scene)
        finally:
            for bakery in self._by_key.values():
                bakery.clear()


def inside(
    scene: Any, wanted: Wanted, places: npt.NDArray[np.float64], mesh: Any, place: Any = None, like: Any = None
) -> Floats:
    """What is wanted at places of an object.

    Args:
        scene: that is shown.
        wanted: of the object's material.
        places: (layers, height, width, 3), in the object's own coordinates.
        mesh: the object's.
        place: where it is; None: where the world begins.
        like: the object, if there is one.
    """
    sheets, size = slices(places, mesh)
    try:
        pixels = _baked(scene, sheets, [wanted.material.name], place or Matrix(), wanted, size, like)
    finally:
        bpy.data.meshes.remove(sheets)
    return sliced(pixels, places.shape[:3])


@contextmanager
def studio(before: Any) -> Iterator[Any]:
    """A scene to bake in. `before`: the scene that is shown, and will be again."""
    scene = bpy.data.scenes.new("wend.bake")
    window = bpy.context.window
    try:
        scene.render.engine = "CYCLES"
        cycles = scene.cycles
        cycles.samples = 1
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        scene.frame_set(before.frame_current, subframe=before.frame_subframe)
        window.scene = scene
        yield scene
    finally:
        window.scene = before
        bpy.data.scenes.remove(scene)


@contextmanager
def _shown(scene: Any, mesh: Any, place: Any, like: Any = None) -> Iterator[Any]:
    """An object of the mesh, alone, active and selected. Nodes that ask for its name, colour, number or properties get
    those of the object that it is `like`."""
    made = bpy.data.objects.new("wend.bake", mesh)
    name = like.name if like is not None and not like.library else None
    try:
        made.matrix_world = place
        if like is not None:
            made.color, made.pass_index = like.color, like.pass_index
            for key, value in like.items():
                if isinstance(value, (int, float)) or hasattr(value, "to_list"):
                    made[key] = value
        if name is not None:
            # A random number of an object is made of its name.
            like.name = "wend.aside"
            made.name = name
        scene.collection.objects.link(made)
        layer = scene.view_layers[0]
        layer.objects.active = made
        made.select_set(True)
        yield made
    finally:
        bpy.data.objects.remove(made)
        if name is not None:
            like.name = name


def _baked(scene: Any, mesh: Any, slots: Sequence[str], place: Any, wanted: Wanted, size: tuple[int, int], like: Any) -> Floats:
    """(height, width, 3), rows from above."""
    image = bpy.data.images.new("wend.bake", *size, alpha=False, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    aside = bpy.data.images.new("wend.aside", 4, 4, float_buffer=True)
    source, other = shining(wanted, image), blank(aside)
    before = list(mesh.materials)
    try:
        if wanted.kind == "normal":
            _add_tangents(mesh)
        for i, name in enumerate(slots):
            chosen = source.material if name == wanted.material.name else other
            if i < len(mesh.materials):
                mesh.materials[i] = chosen
            else:
                mesh.materials.append(chosen)
        with _shown(scene, mesh, place, like):
            bpy.ops.object.bake(
                type="EMIT", margin=_MARGIN, margin_type="EXTEND", use_clear=True, target="IMAGE_TEXTURES",
                save_mode="INTERNAL", use_selected_to_active=False,
            )  # fmt: skip
        pixels = np.empty(size[0] * size[1] * 4, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        return np.ascontiguousarray(pixels.reshape(size[1], size[0], 4)[::-1, :, :3])
    finally:
        for i, material in enumerate(before):
            mesh.materials[i] = material
        source.remove()
        bpy.data.materials.remove(other)
        bpy.data.images.remove(image)
        bpy.data.images.remove(aside)


# ---- Meshes ----

#: Modifiers that move points.
_MOVING = {
    "ARMATURE", "CAST", "CLOTH", "CORRECTIVE_SMOOTH", "CURVE", "DISPLACE", "HOOK", "LAPLACIANDEFORM", "LAPLACIANSMOOTH", "LATTICE",
    "MESH_CACHE", "MESH_DEFORM", "MESH_SEQUENCE_CACHE", "SHRINKWRAP", "SIMPLE_DEFORM", "SMOOTH", "SOFT_BODY", "SURFACE_DEFORM",
    "WARP", "WAVE",
}  # fmt: skip


def _is_deformed(object_: Any) -> bool:
    """Whether something moves the points of its mesh."""
    keys = getattr(object_.data, "shape_keys", None)
    is_keyed = keys is not None and any(abs(key.value) > 0 for key in keys.key_blocks[1:])
    return is_keyed or any(modifier.type in _MOVING and modifier.show_render for modifier in object_.modifiers)


def _render_layer(data: Any) -> Any:
    return next((layer for layer in getattr(data, "uv_layers", ()) if layer.active_render), None)


def _uvs_of(layer: Any) -> Floats:
    uvs = np.empty(len(layer.uv) * 2, dtype=np.float32)
    layer.uv.foreach_get("vector", uvs)
    return uvs.reshape(-1, 2)


def _triangles_of(mesh: Any) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Corners, and the number of the material."""
    mesh.calc_loop_triangles()
    corners = np.empty(len(mesh.loop_triangles) * 3, dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", corners)
    materials = np.empty(len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("material_index", materials)
    return corners.reshape(-1, 3), materials


def _can_be_baked(mesh: Any) -> bool:
    """By its own UVs: they are in the unit square, and no place there is two of the surface."""
    layer = _render_layer(mesh)
    corners, materials = _triangles_of(mesh)
    if layer is None or not len(corners):
        return False
    mesh.uv_layers.active = layer
    uvs = _uvs_of(layer)[corners].astype(np.float64)
    if not np.isfinite(uvs).all() or uvs.min() < -1e-4 or uvs.max() > 1 + 1e-4:
        return False
    edges = uvs[:, 1:] - uvs[:, :1]
    areas = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    if not areas.sum() > 0 or (areas <= 1e-12).mean() > 0.01:
        return False
    return _overlap(uvs, areas, materials) < 0.01


def _overlap(uvs: npt.NDArray[np.float64], areas: npt.NDArray[np.float64], materials: npt.NDArray[np.int32]) -> float:
    """The share of their area where several triangles of one material are, by what is drawn of it."""
    count = int(np.clip(1e8 / len(uvs), 64, 1024))
    drawn = np.random.default_rng(1).choice(len(uvs), count, p=areas / areas.sum())
    several = 0
    for i in drawn:
        offsets = uvs - uvs[i].mean(axis=0)
        following = np.roll(offsets, -1, axis=1)
        sides = offsets[..., 0] * following[..., 1] - offsets[..., 1] * following[..., 0]
        holds = ((sides > 1e-12).all(axis=1) | (sides < -1e-12).all(axis=1)) & (materials == materials[i])
        several += int(holds.sum() > 1)
    return several / count


def _sheet(rect: Rect, name: str) -> Any:
    """A square whose UVs are these, and which is baked by others that fill the picture."""
    mesh = bpy.data.meshes.new("wend.bake")
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32)
    mesh.from_pydata([(*map(float, p), 0.0) for p in square], [], [(0, 1, 2, 3)])
    low, high = np.array(rect, dtype=np.float32).reshape(2, 2)
    own = name or "UVMap"
    for layer, uvs in ((own, low + square * (high - low)), ("wend.bake", square)):
        mesh.uv_layers.new(name=layer).uv.foreach_set("vector", uvs.ravel())
    mesh.uv_layers[own].active_render = True
    mesh.uv_layers.active = mesh.uv_layers["wend.bake"]
    return mesh


def _add_tangents(mesh: Any) -> None:
    """How places change with u, by which pictures of normals are read, as an attribute of corners."""
    if TANGENT in mesh.attributes:
        return
    corners, _ = _triangles_of(mesh)
    points = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    p = points.reshape(-1, 3)[vertices[corners]]
    uv = _uvs_of(mesh.uv_layers.active)[corners]
    dp, duv = p[:, 1:] - p[:, :1], uv[:, 1:] - uv[:, :1]
    turned = np.sign(duv[:, 0, 0] * duv[:, 1, 1] - duv[:, 0, 1] * duv[:, 1, 0])
    along = (dp[:, 0] * duv[:, 1, 1, None] - dp[:, 1] * duv[:, 0, 1, None]) * turned[:, None]
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = np.divide(along, length, out=np.zeros_like(along), where=length > 0)
    values = np.zeros((len(mesh.loops), 3), dtype=np.float32)
    values[corners.ravel()] = np.repeat(along, 3, axis=0)
    mesh.attributes.new(TANGENT, "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", values.ravel())
