"""What is to be baked of Blender's materials, and what they would want."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Wanted:
    """A picture of what an input takes."""

    material: Any
    groups: tuple[str, ...]  #: names of the nodes, from the material's tree down to that of the node
    node: str  #: its name; nothing: what the whole surface shines with
    socket: str  #: identifier of an input of it
    kind: str  #: "rgb", "float", "normal" in the frame of the surface, "light", or "albedo" of what is inside
    power: float = 1.0  #: that numbers are raised to; of an albedo, the anisotropy
    is_by_uv: bool = False  #: whether it depends on UV and nothing else
    is_even: bool = False  #: whether it is the same all over the object
    is_unit: bool = False  #: whether the picture's corners must be 0 and 1


class Probe:
    """Stands for a bakery while a material is looked through for what it wants: "picture" is a texture that needs no
    baking, "own" is the same all over an object; by UV alone can be baked "uv", and "unit" where that is in the unit
    square; all else is by "object", or inside it as "fog"."""

    bakes_all = is_shared = is_deformed = False
    side = 0

    def __init__(self, name: str, uv_name: str) -> None:
        self.name, self.uv_name = name, uv_name
        self.modes: set[str] = set()

    def picture(self, wanted: Wanted) -> dict[str, Any]:
        """Parameters of no texture."""
        if wanted.is_even:
            self.modes.add("own")
        else:
            self.modes.add("object" if not wanted.is_by_uv else "unit" if wanted.is_unit else "uv")
        return {"string filename": ""}

    def fill_inside(self, fog: Any) -> None:
        """Bakes what is inside an object."""
        self.modes.add("fog")
