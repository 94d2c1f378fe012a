"""Values of Blender's shader nodes: constants, and textures of the renderer."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._blend_angles import View, texture_by_view, value_seen
from ._blend_pictures import picture_texture
from ._blend_reach import Reach
from ._blend_wanted import Probe, Wanted
from ._scene_reader import SceneReader

if TYPE_CHECKING:
    from ._blend_bake import Bakery

Colour = npt.NDArray[np.float64]

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def output_node(tree: Any) -> Any:
    """The output of a material, a world or a lamp that Cycles takes; None where there is none."""
    return tree.get_output_node("CYCLES")


def _like(socket: Any, sockets: Any) -> Any:
    """Of a group, the socket on the other side."""
    return next((other for other in sockets if other.identifier == socket.identifier), None)


class Nodes:
    """The nodes of a material: what their inputs are."""

    def __init__(
        self, reader: SceneReader, place: str, key: str, material: Any = None, bakery: Bakery | Probe | None = None
    ) -> None:
        self.reader, self.place, self.key = reader, place, key
        self.material, self.bakery = material, bakery
        self.bakes_all = bakery is not None and bakery.bakes_all
        self.displacement: Any = None  #: the input of the material's output, where it takes something
        #: Of each tree that was entered, by its address: the group's node, whose inputs are those of the tree.
        self._entered: dict[int, Any] = {}
        self._textures = 0
        self._view: View | None = None  #: from where values are asked for
        self.is_behind: bool | None = None  #: the side that all is seen from; None: both

    def warn(self, node: Any, text: str) -> None:
        self.reader.tell(f"{self.place}, node '{node.name}'", text)

    # ---- Links ----

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Groups that are entered meanwhile are left afterwards: one group may be there several times, with other inputs."""
        before = dict(self._entered)
        try:
            yield
        finally:
            self._entered = before

    def source(self, socket: Any) -> Any:
        """The socket of another node that the input follows, through reroutes, muted nodes and groups; None: its own
        value."""
        for _ in range(256):  # links may go in a circle
            if not socket.is_linked:
                return None
            link = next((link for link in socket.links if link.is_valid and not link.is_muted), None)
            if link is None:
                return None
            found, node = link.from_socket, link.from_node
            if node.bl_idname == "NodeReroute":
                socket = node.inputs[0]
            elif node.mute:
                socket = next((l.from_socket for l in node.internal_links if l.to_socket == found), None)
                if socket is None:
                    return None
            elif node.bl_idname == "NodeGroupInput":
                group = self._entered.get(node.id_data.as_pointer())
                socket = _like(found, group.inputs) if group is not None else None
                if socket is None or not socket.is_linked:
                    return socket
            elif node.bl_idname == "ShaderNodeGroup" and node.node_tree:
                outputs = [n for n in node.node_tree.nodes if n.bl_idname == "NodeGroupOutput" and n.is_active_output]
                socket = _like(found, outputs[0].inputs) if outputs else None
                self._entered[node.node_tree.as_pointer()] = node
                if socket is None or not socket.is_linked:
                    return socket
            else:
                return found
        return None

    def shader(self, socket: Any) -> Any:
        """The node whose shader an input takes; None for none."""
        found = self.source(socket)
        return found.node if found is not None and found.is_output else None

    def is_of_camera_rays(self, socket: Any) -> bool:
        """Whether an input is 1 for rays of the camera, and 0 for all others."""
        with self.aside():
            found = self.source(socket)
        return bool(found is not None and found.is_output and found.node.bl_idname == "ShaderNodeLightPath" and found.name == "Is Camera Ray")

    @staticmethod
    def input(node: Any, label: str) -> Any:
        """The input of that name, also where a setting of the node has put it out of use."""
        return next(socket for socket in node.inputs if socket.name == label)

    # ---- Values ----

    def number(self, socket: Any, depth: int = 0) -> float:
        """A constant; what is not is named, and taken as the input's own value."""
        value = self._value(socket, depth)
        return float(value @ _LUMINANCE) if len(value) == 3 else float(value[0])

    def colour(self, socket: Any) -> Colour:
        return np.broadcast_to(self._value(socket), 3).astype(np.float64)

    def _value(self, socket: Any, depth: int = 0) -> Colour:
        value = self.known(socket, depth)
        if value is None:
            self._left_out(socket)
        return self.value_of(socket) if value is None else value

    def value_of(self, socket: Any) -> Colour:
        """A constant; where it is not one, the input's own value."""
        value = self.known(socket)
        return np.atleast_1d(np.array(socket.default_value, dtype=np.float64))[:3] if value is None else value

    def add_to(self, parameters: dict[str, Any], socket: Any, name: str, kind: str, power: float = 1) -> None:
        """Adds the parameter, of the kind "rgb" or "float", as a constant or a texture."""
        if self.known(socket) is None:
            texture = self.texture(socket, kind, power)
            if texture is not None:
                parameters[f"texture {name}"] = texture
                return
        value = self.colour(socket) if kind == "rgb" else self.number(socket)
        if kind == "rgb" and np.max(value) > 1 + 1e-4:
            self.warn(socket.node, f"{socket.name} above 1 is taken as 1")
        parameters[f"{kind} {name}"] = np.clip(value, 0, 1) if kind == "rgb" else float(value) ** power

    def texture(self, socket: Any, kind: str, power: float = 1) -> str | None:
        """The name of a texture that the input follows; None where there is no counterpart."""
        with self.aside():
            found = self.source(socket)
            if found is None or not found.is_output:
                return None
            name = texture_by_view(self, socket, kind, power)
            if name is None and not self.bakes_all and power == 1:
                if found.node.bl_idname == "ShaderNodeTexImage" and found.node.image:
                    name = picture_texture(self, found.node, kind, found.name == "Alpha")
                elif found.node.bl_idname in ("ShaderNodeMix", "ShaderNodeMixRGB"):
                    name = self._mixed(found.node, kind)
        if name is None:
            picture = self.baked(socket, kind, power)
            name = self.add_texture(kind, "imagemap", picture) if picture is not None else None
        return name

    def baked(self, socket: Any, kind: str, power: float = 1) -> dict[str, Any] | None:
        """Parameters of a texture by a picture that Cycles makes of what an input takes; None where it cannot be called.

        Args:
            kind: "rgb", "float", or "normal".
            power: that numbers are raised to.
        """
        if self.bakery is None or self.material is None:
            return None
        reach = Reach(self, self.bakery.uv_name)
        reach.follow(socket)
        label = f"{socket.name} of node '{socket.node.name}'"
        reach.tell(socket.node, label, self.bakery)
        node = socket.node
        is_normal = kind == "normal"
        wanted = Wanted(
            self.material.original,
            self.groups_to(node.id_data),
            node.name,
            socket.identifier,
            kind,
            power,
            is_by_uv=reach.is_by_uv and not (is_normal and reach.has_bumps),
            is_even=reach.is_even and not is_normal,
            is_unit=is_normal,
        )
        return self._picture_of(wanted, label)

    def baked_light(self, output: Any) -> dict[str, Any] | None:
        """The same of what a whole surface shines with."""
        if self.bakery is None or self.material is None:
            return None
        reach = Reach(self, self.bakery.uv_name)
        reach.follow(output.inputs["Surface"])
        if reach.sees:
            self.warn(reach.sees, "Emission depends on from where it is seen, and is baked as seen from above")
        wanted = Wanted(self.material.original, (), "", "", "light", is_by_uv=reach.is_by_uv, is_even=reach.is_even, is_unit=True)
        return self._picture_of(wanted, "Emission")

    def _picture_of(self, wanted: Wanted, label: str) -> dict[str, Any]:
        assert self.bakery is not None
        if not wanted.is_even:
            side = self.bakery.side
            self.reader.tell(f"object '{self.bakery.name}'", f"{self.place}, {label} is baked, {side} x {side}", each=True)
        return self.bakery.picture(wanted)

    def groups_to(self, tree: Any) -> tuple[str, ...]:
        """Names of the groups' nodes, from the material's tree down to this one."""
        names: list[str] = []
        while (group := self._entered.get(tree.as_pointer())) is not None and len(names) < 64:
            names.insert(0, group.name)
            tree = group.id_data
        return tuple(names)

    def _left_out(self, socket: Any) -> None:
        found = self.source(socket)
        if found is not None:
            label = found.node.bl_idname.removeprefix("ShaderNode")
            self.warn(socket.node, f"{label} as {socket.name} is left out")

    def seen_at(self, socket: Any, view: View) -> Colour | None:
        """The same where a surface is seen from there: None where that is not all that it depends on."""
        self._view = view
        try:
            return self.known(socket)
        finally:
            self._view = None

    def known(self, socket: Any, depth: int = 0) -> Colour | None:
        """None where it is not the same everywhere."""
        with self.aside():
            return self._known(socket, depth)

    def _known(self, socket: Any, depth: int) -> Colour | None:
        found = self.source(socket)
        if found is None or not found.is_output:
            given = (socket if found is None else found).default_value
            return np.atleast_1d(np.array(given, dtype=np.float64))[:3]
        if depth > 64:
            return None
        node = found.node
        kind = node.bl_idname
        if kind in ("ShaderNodeValue", "ShaderNodeRGB"):
            return np.atleast_1d(np.array(found.default_value, dtype=np.float64))[:3]
        if self.is_behind is not None and kind == "ShaderNodeNewGeometry" and found.name == "Backfacing":
            return np.array([float(self.is_behind)])
        inputs = [self.known(s, depth + 1) if hasattr(s, "default_value") else None for s in node.inputs]
        if self._view is not None and (seen := value_seen(node, found.name, inputs, self._view)) is not None:
            return seen
        if kind == "ShaderNodeBlackbody" and inputs[0] is not None:
            return blackbody(float(inputs[0][0]))
        if kind == "ShaderNodeLightFalloff" and found.name == "Quadratic" and inputs[1] is not None and inputs[1][0] == 0:
            return inputs[0]
        if kind == "ShaderNodeMath":
            return _math(node.operation, [None if x is None else float(x[0]) for x in inputs], node.use_clamp)
        if kind == "ShaderNodeGamma" and inputs[0] is not None and inputs[1] is not None:
            return np.asarray(np.maximum(inputs[0], 0) ** inputs[1][0], dtype=np.float64)
        if kind == "ShaderNodeInvert" and inputs[0] is not None and inputs[1] is not None:
            return inputs[1] * (1 - inputs[0]) + (1 - inputs[1]) * inputs[0]
        if kind == "ShaderNodeRGBToBW" and inputs[0] is not None:
            return np.array([float(inputs[0] @ _LUMINANCE)])
        if kind == "ShaderNodeValToRGB" and inputs[0] is not None:
            at = float(inputs[0] @ _LUMINANCE) if len(inputs[0]) == 3 else float(inputs[0][0])
            colour = node.color_ramp.evaluate(at)
            return np.array([colour[3]]) if found.name == "Alpha" else np.array(colour[:3])
        if kind == "ShaderNodeCombineColor" and node.mode == "RGB" and all(x is not None for x in inputs[:3]):
            return np.array([float(x[0]) for x in inputs[:3] if x is not None])
        if kind in ("ShaderNodeMix", "ShaderNodeMixRGB"):
            factor, a, b = self._mix_inputs(node)
            values = [self.known(s, depth + 1) for s in (factor, a, b)]
            if any(v is None for v in values):
                return None
            return _blend(node, *values)  # type: ignore[arg-type]
        return None

    @staticmethod
    def _mix_inputs(node: Any) -> tuple[Any, Any, Any]:
        if node.bl_idname == "ShaderNodeMixRGB":
            return node.inputs[0], node.inputs[1], node.inputs[2]
        first = {"FLOAT": 2, "VECTOR": 4, "RGBA": 6}.get(node.data_type, 6)
        by_axis = node.data_type == "VECTOR" and node.factor_mode == "NON_UNIFORM"
        return node.inputs[1 if by_axis else 0], node.inputs[first], node.inputs[first + 1]

    # ---- Textures ----

    def _name(self) -> str:
        self._textures += 1
        return f"{self.key} {self._textures}"

    def _mixed(self, node: Any, kind: str) -> str | None:
        factor, a, b = self._mix_inputs(node)
        mode = _mode_of(node)
        if _clamps_result(node) or not _clamps_factor(node) or getattr(node, "factor_mode", "UNIFORM") != "UNIFORM":
            return None
        parameters: dict[str, Any] = {}
        if mode == "MIX":
            self.add_to(parameters, factor, "amount", "float")
            self.add_to(parameters, a, "tex1", kind)
            self.add_to(parameters, b, "tex2", kind)
            plugin = "mix"
        elif mode == "MULTIPLY" and self.known(factor) is not None and self.number(factor) == 1:
            self.add_to(parameters, a, "tex", kind)
            self.add_to(parameters, b, "scale", kind)
            plugin = "scale"
        else:
            return None
        return self.add_texture(kind, plugin, parameters)

    def add_texture(self, kind: str, plugin: str, parameters: dict[str, Any]) -> str:
        name = self._name()
        self.reader.builder.add("Texture", name, "spectrum" if kind == "rgb" else "float", plugin, parameters)
        return name


def blackbody(kelvin: float) -> Colour:
    """Of luminance 1, by Planck's law and fits of the colour matching functions (wyman2013)."""
    nanometres = np.arange(380.0, 781.0, 5.0)

    def bell(centre: float, below: float, above: float) -> Colour:
        scaled = (nanometres - centre) * np.where(nanometres < centre, below, above)
        return np.asarray(np.exp(-0.5 * scaled**2), dtype=np.float64)

    x = 0.362 * bell(442.0, 0.0624, 0.0374) + 1.056 * bell(599.8, 0.0264, 0.0323) - 0.065 * bell(501.1, 0.0490, 0.0382)
    y = 0.821 * bell(568.8, 0.0213, 0.0247) + 0.286 * bell(530.9, 0.0613, 0.0322)
    z = 1.217 * bell(437.0, 0.0845, 0.0278) + 0.681 * bell(459.0, 0.0385, 0.0725)
    metres = nanometres * 1e-9
    light = metres**-5 / np.expm1(0.014387769 / (metres * min(max(kelvin, 800.0), 20000.0)))
    xyz = np.array([(light * match).sum() for match in (x, y, z)]) / (light * y).sum()
    from_xyz = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
    return np.asarray(np.maximum(from_xyz @ xyz, 0), dtype=np.float64)


def _mode_of(node: Any) -> str:
    """How a node mixes; numbers and vectors have one way alone."""
    return str(node.blend_type) if getattr(node, "data_type", "RGBA") == "RGBA" else "MIX"


def _clamps_factor(node: Any) -> bool:
    return bool(getattr(node, "clamp_factor", True))


def _clamps_result(node: Any) -> bool:
    is_colour = getattr(node, "data_type", "RGBA") == "RGBA"
    return is_colour and bool(getattr(node, "clamp_result", False) or getattr(node, "use_clamp", False))


def _blend(node: Any, factor: Colour, a: Colour, b: Colour) -> Colour | None:
    mode = _mode_of(node)
    t = np.clip(factor, 0, 1) if _clamps_factor(node) else factor
    mixed = {"MIX": b, "MULTIPLY": a * b, "ADD": a + b, "SUBTRACT": a - b, "SCREEN": 1 - (1 - a) * (1 - b)}.get(mode)
    if mixed is None:
        return None
    result = np.asarray((1 - t) * a + t * mixed, dtype=np.float64)
    return np.clip(result, 0, 1) if _clamps_result(node) else result


def _math(operation: str, values: list[float | None], clamp: bool) -> Colour | None:
    a, b = values[0], values[1] if len(values) > 1 else None
    unary: dict[str, Callable[[float], float]] = {
        "SQRT": lambda x: math.sqrt(max(x, 0)),
        "ABSOLUTE": abs,
        "EXPONENT": lambda x: math.exp(min(x, 700)),
        "SINE": math.sin,
        "COSINE": math.cos,
        "FLOOR": math.floor,
        "CEIL": math.ceil,
        "ROUND": round,
        "RADIANS": math.radians,
        "DEGREES": math.degrees,
    }
    binary: dict[str, Callable[[float, float], float]] = {
        "ADD": lambda x, y: x + y,
        "SUBTRACT": lambda x, y: x - y,
        "MULTIPLY": lambda x, y: x * y,
        "DIVIDE": lambda x, y: x / y if y else 0.0,
        "POWER": lambda x, y: x**y if x >= 0 or float(y).is_integer() and (x or y >= 0) else 0.0,
        "MINIMUM": min,
        "MAXIMUM": max,
        "LESS_THAN": lambda x, y: float(x < y),
        "GREATER_THAN": lambda x, y: float(x > y),
    }
    if a is None:
        return None
    if operation in unary:
        result = float(unary[operation](a))
    elif operation in binary and b is not None:
        result = float(binary[operation](a, b))
    else:
        return None
    return np.array([min(max(result, 0.0), 1.0) if clamp else result])
