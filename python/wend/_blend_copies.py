"""Which things of a scene of Blender are one thing, in several places."""

from __future__ import annotations

from collections import Counter
from typing import Any

from ._blend_nodes import Nodes, output_node
from ._blend_reach import Reach
from ._scene_reader import SceneReader

#: Faces of all copies of one mesh. What has more is not told apart.
_MOST = 1 << 22


class Copies:
    """Those of a scene.

    Args:
        reader: of it.
        tells_apart: whether objects with one mesh are told apart where their materials ask for that.
    """

    def __init__(self, reader: SceneReader, tells_apart: bool) -> None:
        self._reader, self._tells_apart = reader, tells_apart
        self._times: Counter[str] = Counter()
        self._differ: dict[str, bool] = {}  #: by the names of materials

    def count(self, depsgraph: Any, seen: list[bool]) -> None:
        """How many objects there are of each kind."""
        for instance, shown in zip(depsgraph.object_instances, seen):
            if shown and not instance.is_instance:
                self._times[_kind_of(instance.object)] += 1

    def key_of(self, instance: Any) -> str:
        """Of what it looks like: things that have the same share it."""
        object_ = instance.object
        kind = _kind_of(object_)
        faces = len(getattr(object_.data, "polygons", ()))
        if instance.is_instance or not self._tells_apart or self._times[kind] < 2 or self._times[kind] * faces > _MOST:
            return kind
        return f"{kind} {object_.name}" if any(map(self._differs, object_.material_slots)) else kind

    def _differs(self, slot: Any) -> bool:
        """Whether copies with its material look different."""
        material = slot.material
        output = output_node(material.node_tree) if material and material.node_tree else None
        if output is None:
            return False
        if material.name not in self._differ:
            reach = Reach(Nodes(self._reader, material.name, material.name, material), "")
            reach.follow(output.inputs["Surface"])
            reach.follow(output.inputs["Volume"])
            self._differ[material.name] = reach.is_by_place
        return self._differ[material.name]


def _kind_of(object_: Any) -> str:
    data = object_.data
    materials = " ".join(slot.material.name if slot.material else "" for slot in object_.material_slots)
    return f"{object_.type} {data.as_pointer() if data is not None else object_.name} {materials}"
