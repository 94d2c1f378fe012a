"""What is inside of what, of Blender's objects with volumes and of glass. Cycles adds up all volumes that are at a place,
here each place has one medium. And light that leaves glass is as bright as inside there, here darker by its index."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from mathutils import Vector  # type: ignore[import-not-found,import-untyped,unused-ignore]
from mathutils.bvhtree import BVHTree  # type: ignore[import-not-found,import-untyped,unused-ignore]

from ._blend_medium_sums import Parameters, summed
from ._blend_shapes import box_of, is_open, triangles_of
from ._scene_reader import Look, SceneReader

Array = npt.NDArray[np.float64]

#: Of the surface of a volume, how many places are looked at; and how many volumes of one scene.
_PLACES, _MOST = 300, 512
#: Along no face of a model.
_WAYS = tuple(Vector(w).normalized() for w in ((0.36, 0.48, 0.8), (-0.79, 0.21, -0.58), (-0.17, 0.91, -0.38)))


@dataclass(eq=False)
class Region:
    """What the closed surface of an object with a volume, or of glass, encloses."""

    number: int  #: of the instance
    name: str  #: of the object
    points: Array
    triangles: npt.NDArray[np.int32]
    looks: list[Look] | None  #: with a medium; None: it is that of a file
    index: float = 1.0  #: of its glass
    index_inside: float = 1.0  #: the product of those of all glass around what is inside
    around: list[Region] = field(default_factory=list)  #: those that it lies within, the largest first

    def __post_init__(self) -> None:
        self.low, self.high = self.points.min(axis=0), self.points.max(axis=0)
        self.size = float(np.linalg.norm(self.high - self.low))
        self._tree: Any = None

    def holds(self, place: Array) -> bool:
        if (place < self.low).any() or (place > self.high).any():
            return False
        if self._tree is None:
            self._tree = BVHTree.FromPolygons(self.points.tolist(), self.triangles.tolist())
        return sum(self._is_in(Vector(place), way) for way in _WAYS) >= 2

    def _is_in(self, start: Any, way: Any) -> bool:
        crossings = 0
        for _ in range(1000):
            hit, _, _, distance = self._tree.ray_cast(start, way)
            if hit is None:
                break
            crossings += 1
            start = hit + way * (1e-6 * self.size + 1e-7 * distance)
        return crossings % 2 == 1

    def share_within(self, other: Region) -> float:
        """Of its surface."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        if not areas.sum() > 0:
            return 0.0
        random = np.random.default_rng(1)
        chosen = random.choice(len(areas), _PLACES, p=areas / areas.sum())
        u, v = np.sort(random.random((2, _PLACES, 1)), axis=0)
        places = u * a[chosen] + (v - u) * b[chosen] + (1 - v) * c[chosen]
        return sum(other.holds(place) for place in places) / _PLACES


class Regions:
    """Those of a scene.

    Args:
        reader: of it.
    """

    def __init__(self, reader: SceneReader) -> None:
        self._reader = reader
        self._of_instances: dict[int, Region] = {}

    def add(self, number: int, object_: Any, place: Array, looks: Iterable[Look]) -> None:
        """An object that has a volume or is of glass. `number`: of the instance. `place` has points as columns."""
        is_file = object_.type == "VOLUME"
        looks = list(looks)
        filled = [x for x in looks if x.medium is not None and (x.fog is None or x.fog.parameters is not None)]
        if len(self._of_instances) >= _MOST:
            return
        if is_file:
            box = box_of(np.array(object_.bound_box, dtype=np.float64))
            points, triangles = box["point3 P"].astype(np.float64), box["integer indices"]
        else:
            mesh = object_.to_mesh()
            try:
                if mesh is None or not len(mesh.polygons) or is_open(mesh):
                    return
                points, triangles = triangles_of(mesh)
            finally:
                object_.to_mesh_clear()
        world = points @ place[:3, :3].T + place[:3, 3]
        index = max((look.index for look in looks), key=lambda index: abs(index - 1), default=1.0)
        self._of_instances[number] = Region(number, object_.name, world, triangles, None if is_file else filled, index)

    def nest(self) -> None:
        """Finds out which lies within which, and says where that has no counterpart."""
        regions = sorted(self._of_instances.values(), key=lambda region: -region.size)
        for k, inner in enumerate(regions):
            glass = [outer.index for outer in regions[:k] if outer.index != 1 and inner.share_within(outer) > 0.99]
            inner.index_inside = inner.index * float(np.prod(glass))
        regions = [region for region in regions if region.looks is None or region.looks]
        for k, inner in enumerate(regions):
            for outer in regions[:k]:
                if (inner.low > outer.high).any() or (outer.low > inner.high).any():
                    continue
                share = inner.share_within(outer)
                if share > 0.99:
                    inner.around.append(outer)
                elif share > 0.01:
                    text = f"its volume is in part within that of object '{outer.name}': where both are, the smaller is alone"
                    self._reader.tell(f"object '{inner.name}'", text, each=True)
        for inner in regions:
            if (inner.around or self._reader.around) and self._total(inner) is None:
                names = [f"object '{outer.name}'" for outer in inner.around] or ["the world"]
                text = f"its volume is in place of that of {' and '.join(names)}, and not added to it"
                self._reader.tell(f"object '{inner.name}'", text, each=True)

    def index_at(self, places: Array, without: Region | None = None) -> float:
        """The product of the indices of the glass around all these places. Light that leaves glass is darker by its
        square, but not in Cycles."""
        bodies = (region for region in self._of_instances.values() if region.index != 1 and region is not without)
        return float(np.prod([body.index for body in bodies if all(map(body.holds, places))]))

    def of(self, number: int) -> Region | None:
        """That of an instance."""
        return self._of_instances.get(number)

    def outside(self, region: Region | None) -> str:
        """The medium around a volume."""
        return self._name_within(region.around[-1]) if region and region.around else self._reader.around or ""

    def around(self, place: Array) -> str:
        """The medium at a place of the world."""
        there = [region for region in self._of_instances.values() if region.looks and region.holds(place)]
        return self._name_within(min(there, key=lambda region: region.size)) if there else self._reader.around or ""

    def inside(self, region: Region | None, look: Look) -> tuple[str, Parameters]:
        """The medium that is seen within a volume, with what is around it: a name, which is that of no other one, and
        what it is."""
        own, parameters = _own(self._reader, region, look)
        name, made = self._total(region, look) or (own, parameters or {})
        glow = next((key for key in ("rgb Le", "rgb glow") if key in made), None)
        if glow is None or region is None or region.index_inside == 1:
            return name, made
        return f"{name} within glass", made | {glow: np.asarray(made[glow]) * region.index_inside**2}

    def _name_within(self, region: Region) -> str:
        return self.inside(region, region.looks[0])[0] if region.looks else self.outside(region)

    def _total(self, region: Region | None, look: Look | None = None) -> tuple[str, Parameters] | None:
        """None where it is not known, or nothing is to be added."""
        parts = []
        if self._reader.around:
            parts.append((self._reader.around, self._reader.media.get(self._reader.around)))
        for one in (*region.around, region) if region is not None else ():
            looks = [look] if look is not None and one is region else one.looks
            if looks is None or len({id(x) for x in looks}) != 1:
                return None
            parts.append(_own(self._reader, one, looks[0]))
        if region is None and look is not None:
            parts.append(_own(self._reader, None, look))
        known = [parameters for _, parameters in parts if parameters is not None]
        if len(known) < len(parts):
            return None
        where = f"object '{region.name}'" if region is not None else "a volume"
        made = summed(known, lambda text: self._reader.tell(where, text))
        return None if made is None else (" + ".join(name for name, _ in parts), made)


def _own(reader: SceneReader, region: Region | None, look: Look) -> tuple[str, Parameters | None]:
    if look.fog is None:
        return str(look.medium), reader.media.get(str(look.medium))
    return f"{look.medium} {region.number if region is not None else id(look)}", look.fog.parameters
