"""Light of Blender's surfaces that depends on the side from which they are seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ._blend_nodes import Nodes
from ._blend_reach import Reach
from ._blend_surface import Surface
from ._blend_wanted import Probe
from ._scene_reader import Silent

if TYPE_CHECKING:
    from ._blend_bake import Bakery


def of_one_side(nodes: Nodes, output: Any, surface: Surface, made: Callable[[Nodes, Any], Surface]) -> Surface:
    """The surface, shining to the side that it does by the nodes. What both sides shine with is that of the front, and
    named.

    Args:
        nodes: of the material.
        output: of the material.
        surface: as it is whatever the side.
        made: makes it of its nodes, and the node that the output takes.
    """
    if not _shines(surface):
        return surface
    bakery: Bakery | Probe | None = nodes.bakery
    reach = Reach(nodes, bakery.uv_name if bakery is not None else "")
    reach.follow(output.inputs["Surface"])
    if not reach.asks_side:
        return surface
    front, back = (_seen_from(nodes, output, made, is_behind) for is_behind in (False, True))
    as_in_front = replace(surface, emission=front.emission, shines_by_a_picture=front.shines_by_a_picture)
    if not _shines(back):
        return replace(as_in_front, is_one_sided=True)
    if not _shines(front):
        nodes.warn(output, "a surface whose back alone shines is dark")
    elif front.shines_by_a_picture or back.shines_by_a_picture or np.abs(front.emission - back.emission).max() > 0:
        nodes.warn(output, "Emission that differs between the sides of a surface is as in front")
    return as_in_front


def _shines(surface: Surface) -> bool:
    return surface.shines_by_a_picture or bool(surface.emission.max() > 0)


def _seen_from(nodes: Nodes, output: Any, made: Callable[[Nodes, Any], Surface], is_behind: bool) -> Surface:
    """What is shone with is all that counts of it."""
    probe = Probe("", nodes.bakery.uv_name) if nodes.bakery is not None else None
    aside = Nodes(Silent(nodes.reader), nodes.place, nodes.key, nodes.material, probe)
    aside.is_behind = is_behind
    node = aside.shader(output.inputs["Surface"])
    return made(aside, node) if node else Surface()
