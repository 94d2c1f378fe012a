"""Photometric profiles (IES) of Blender's lamps."""

from __future__ import annotations

import math
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt

from . import _ies
from ._blend_nodes import Nodes
from ._errors import InputError

Angles = npt.NDArray[np.float64]

#: Cycles takes candela as watts of light like D65's.
_WATTS = 4 * math.pi / 177.83


def profile_of(nodes: Nodes, socket: Any) -> tuple[_ies.Profile | None, float]:
    """The profile that the strength of an emission takes, and what multiplies it to watts."""
    node, factor = _profile_node(nodes, socket)
    if node is None:
        return None, 1.0
    if node.inputs["Vector"].is_linked:
        nodes.warn(node, "what turns a profile is left out")
    try:
        return _read(node), factor * _WATTS
    except InputError as error:
        nodes.warn(node, f"a profile that cannot be read is left out: {error}")
        return None, 1.0


def wants_profile(nodes: Nodes, socket: Any) -> bool:
    """Whether the strength of an emission takes one, be it there or not."""
    return _profile_node(nodes, socket)[0] is not None


def _profile_node(nodes: Nodes, socket: Any) -> tuple[Any, float]:
    """The node, if there is one, and its strength with all that multiplies it."""
    with nodes.aside():
        found = nodes.source(socket)
        if found is None or not found.is_output:
            return None, 1.0
        node = found.node
        if node.bl_idname == "ShaderNodeMath" and node.operation == "MULTIPLY":
            for one, other in ((node.inputs[0], node.inputs[1]), (node.inputs[1], node.inputs[0])):
                profile, factor = _profile_node(nodes, one)
                if profile is not None:
                    return profile, factor * nodes.number(other)
        if node.bl_idname != "ShaderNodeTexIES":
            return None, 1.0
        return node, nodes.number(node.inputs["Strength"])


def _read(node: Any) -> _ies.Profile:
    if node.mode == "EXTERNAL":
        return _ies.read(bpy.path.abspath(node.filepath, library=node.id_data.library))
    if node.ies is None:
        raise InputError("there is no text")
    return _ies.parsed(node.ies.as_string(), node.ies.name)


def seen_along(profile: _ies.Profile, x: Angles, y: Angles, z: Angles) -> Angles:
    """The profile in directions from a lamp, in its own space: its axis is -z."""
    vertical = np.degrees(np.arccos(np.clip(-z, -1, 1)))
    return profile.at(vertical, np.degrees(np.arctan2(x, y)) + 180)
