"""What instancers of USD copy: each is made once, as an object, and placed wherever a copy is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from pxr import UsdGeom, UsdVol  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _usd_lights as lights
from . import _usd_materials as materials
from ._errors import InputError
from ._scene_reader import Places
from ._usd_errors import named

#: Instances within instances multiply.
_MOST_NESTED = 2**20

#: Of lights and what shines, of which each copy is a light of its own.
_MOST_LIGHTS = 2**14


@dataclass
class Prototype:
    """What an instancer copies: an object, and what it copies itself, with where to."""

    name: str | None  #: None: it has no shapes of its own
    inner: list[tuple[Prototype, Places]]
    #: what no object may hold: lights, what shines, volumes; with where in the prototype it is
    lights: list[tuple[Any, Places]]
    is_made: bool


class Copies:
    """Of all instancers of a stage. The reader is an argument, so that it goes away, and with it the stage's file, once it
    has been read."""

    def __init__(self) -> None:
        self.prototypes: dict[str, Prototype] = {}
        self.nested = self.lights = 0

    def add(self, reader: Any, prim: Any, world: Places) -> None:
        for prototype, places in self._instances(reader, prim, world):
            self._place(reader, prim, prototype, places)

    def _instances(self, reader: Any, prim: Any, world: Places) -> Iterator[tuple[Prototype, Places]]:
        """What an instancer copies, and where to."""
        instancer = UsdGeom.PointInstancer(prim)
        prototypes = [self._prototype(reader, target) for target in instancer.GetPrototypesRel().GetForwardedTargets()]
        indices = instancer.GetProtoIndicesAttr().Get(reader.time) or []
        # USD itself reads beyond their ends.
        for name in ("orientations", "orientationsf", "scales"):
            given = prim.GetAttribute(name).Get(reader.time) if prim.HasAttribute(name) else None
            if given and len(given) < len(indices):
                reader.warn(prim, f"an instancer whose {name} are not as many as what it copies is left out")
                return
        start, end = (np.array(instancer.ComputeInstanceTransformsAtTime(time, reader.time)) for time in reader.shutter)
        own = [p.GetPrimvarName() for p in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues() if p.GetInterpolation() != "constant"]
        if own:
            reader.warn(prim, f"what an instancer gives to each of its copies is left out: {', '.join(sorted(own))}")
        mask = instancer.ComputeMaskAtTime(reader.time)
        shown = [i for i in range(len(indices)) if not mask or mask[i]]
        if not len(start) == len(end) == len(shown):
            reader.warn(prim, "an instancer whose positions are not as many as what it copies is left out")
            return
        for i, places in zip(shown, zip(start, end)):
            if not 0 <= indices[i] < len(prototypes):
                raise InputError(f"{prim.GetPath()}: error: prototype {indices[i]} of {len(prototypes)}")
            yield prototypes[indices[i]], np.array(places) @ world

    def _prototype(self, reader: Any, path: Any) -> Prototype:
        """Made once. Of one that is within itself nothing is there."""
        key = str(path)
        if key in self.prototypes:
            if not self.prototypes[key].is_made:
                reader.warn(reader.stage.GetPrimAtPath(path), "what copies itself is left out")
                return Prototype(None, [], [], True)
            return self.prototypes[key]
        made = self.prototypes[key] = Prototype(None, [], [], False)
        root = reader.stage.GetPrimAtPath(path)
        if not root:
            raise InputError(f"{path}: error: what an instancer copies is not there")
        from_root = np.linalg.inv(reader.world(root))
        held = []
        # An object holds no instances and no lights: they are placed where all of it is.
        for part in reader.prims(root):
            with named(part):
                place = reader.world(part) @ from_root
            if part.IsA(UsdGeom.PointInstancer):
                made.inner += self._instances(reader, part, place)
            elif lights.is_light(part) or part.IsA(UsdVol.Volume) or materials.shines(reader, part):
                made.lights.append((part, place))
            else:
                held.append((part, place))
        empty = len(reader.builder) + 2
        with reader.builder.block("Object", key):
            for part, place in held:
                with named(part):
                    reader.add_prim(part, place, in_object=True)
        made.name = key if len(reader.builder) > empty else None
        made.is_made = True
        return made

    def _place(self, reader: Any, prim: Any, prototype: Prototype, places: Places) -> None:
        if prototype.name is not None:
            with reader.builder.block():
                reader.put(places)
                reader.builder.add("ObjectInstance", prototype.name)
        for part, within in prototype.lights:
            self.lights += 1
            if self.lights > _MOST_LIGHTS:
                reader.warn(prim, f"of copies of lights, of what shines and of volumes no more than {_MOST_LIGHTS} are there")
                break
            reader.add_prim(part, within @ places, in_object=False)
        for inner, within in prototype.inner:
            self.nested += 1
            if self.nested > _MOST_NESTED:
                reader.warn(prim, f"of instances within instances no more than {_MOST_NESTED} are there")
                return
            self._place(reader, prim, inner, within @ places)
