"""What a shader node of Blender's stands for, before it is a material."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._blend_nodes import Colour
from ._scene_reader import Brush


@dataclass
class Surface:
    """What a shader node stands for."""

    material: dict[str, Any] | None = None  #: parameters of a MakeNamedMaterial; None: nothing is reflected
    mixed: tuple[Surface, Surface, dict[str, Any]] | None = None  #: two of them, and how much of the second
    emission: Colour = field(default_factory=lambda: np.zeros(3))
    alpha: dict[str, Any] = field(default_factory=dict)  #: of the shape; nothing: certain
    shines_by_a_picture: bool = False  #: because what it shines with varies
    is_one_sided: bool = False  #: its front alone shines
    is_clear: bool = False  #: light goes straight through
    brushed: Brush | None = None  #: along which way
    is_held_out: bool = False  #: there is a hole in the picture
    is_hidden: bool = False  #: from the camera


def is_nothing(surface: Surface) -> bool:
    is_made = surface.material is not None or surface.mixed is not None or bool(surface.alpha)
    return not (is_made or surface.is_clear or surface.shines_by_a_picture or surface.emission.max() > 0)


def reflecting(surface: Surface) -> Surface:
    """What only shines reflects nothing, and hides what is behind it."""
    if surface.material is None and surface.mixed is None:
        surface.material = {"string type": "diffuse", "rgb reflectance": (0, 0, 0)}
    return surface
