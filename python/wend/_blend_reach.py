"""What Blender's shader nodes depend on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._blend_bake import Bakery
    from ._blend_nodes import Nodes
    from ._blend_wanted import Probe

#: That depend on their inputs and nothing else.
_PLAIN = {
    "ShaderNode" + name
    for name in (
        "AddShader", "Blackbody", "BrightContrast", "Bump", "Clamp", "CombineColor", "CombineXYZ", "CombineHSV", "CombineRGB",
        "Emission", "FloatCurve", "Gamma", "HueSaturation", "Invert", "MapRange", "Mapping", "Math", "Mix", "MixRGB",
        "MixShader", "NormalMap", "OutputMaterial", "RGB", "RGBCurve", "RGBToBW", "SeparateColor", "SeparateXYZ",
        "SeparateHSV", "SeparateRGB", "SubsurfaceScattering", "ValToRGB", "Value", "VectorCurve", "VectorMath",
        "VectorRotate", "Wavelength",
    )
}  # fmt: skip
#: That differ between copies of one object, but for these outputs.
_PLACED = {"ShaderNode" + name for name in ("NewGeometry", "ObjectInfo", "ParticleInfo", "HairInfo")}
_ALIKE = {"Backfacing", "Parametric", "Pointiness", "Random Per Island"}
#: That depend on what is around an object.
_AROUND = {"ShaderNodeAmbientOcclusion", "ShaderNodeBevel"}
#: That depend on from where they are seen.
_SEEING = {"ShaderNode" + name for name in ("Fresnel", "LayerWeight", "CameraData", "LightPath")}

_SEEN = {"ShaderNodeTexCoord": ("Camera", "Window", "Reflection"), "ShaderNodeNewGeometry": ("Incoming",)}


def is_uv(output: Any, uv_name: str) -> bool:
    """Whether it gives the UV coordinates of that name, which are those that renders take."""
    node = output.node
    if node.bl_idname == "ShaderNodeUVMap":
        return node.uv_map in ("", uv_name) and not node.from_instancer
    return bool(node.bl_idname == "ShaderNodeTexCoord" and output.name == "UV" and not node.from_instancer)


class Reach:
    """Of inputs that are followed.

    Args:
        nodes: of the material.
        uv_name: of the UV map that renders take.
    """

    def __init__(self, nodes: Nodes, uv_name: str) -> None:
        self.is_by_uv = True  #: whether they depend on that and nothing else
        self.is_even = True  #: whether they are the same all over an object
        self.has_bumps = False
        self.asks_side = False  #: whether they depend on the side from which a surface is seen
        self.is_generated = False  #: whether they depend on coordinates of the box around the object
        self.is_by_place = False  #: whether copies of one object differ
        self.feels: Any = None  #: a node that depends on what is around the object
        self.sees: Any = None  #: a node that depends on from where it is seen
        self._nodes, self._uv_name = nodes, uv_name
        #: sockets, by the groups that they are in
        self._seen: set[tuple[int, tuple[str, ...]]] = set()

    def follow(self, socket: Any) -> None:
        """Through all nodes that it takes something of."""
        key = (socket.as_pointer(), self._nodes.groups_to(socket.id_data))
        if key in self._seen or len(self._seen) > 4096:
            return
        self._seen.add(key)
        with self._nodes.aside():
            self._follow(socket)

    def tell(self, node: Any, label: str, bakery: Bakery | Probe) -> None:
        """What of that a picture which is baked cannot show. `node`: whose input it is; `label`: what that is called."""
        warn = self._nodes.warn
        if self.sees:
            warn(self.sees, f"{label} depends on from where it is seen, and is baked as seen from above")
        if self.asks_side:
            warn(node, f"{label} differs between the sides of a surface, and is baked as it is in front")
        if self.is_generated and bakery.is_deformed:
            warn(node, f"{label} lies by the shape as it is deformed, and not as it was before")
        if self.feels:
            warn(self.feels, f"{label} depends on what is near, and is baked without other objects")
        if self.is_by_place and bakery.is_shared:
            warn(node, f"{label} is baked at the first of several instances")

    def _follow(self, socket: Any) -> None:
        found = self._nodes.source(socket)
        if found is None or not found.is_output:
            return
        node = found.node
        kind = node.bl_idname
        self.has_bumps = self.has_bumps or kind == "ShaderNodeBump"
        self.asks_side = self.asks_side or (kind == "ShaderNodeNewGeometry" and found.name == "Backfacing")
        by_object = kind == "ShaderNodeAttribute" and node.attribute_type in ("OBJECT", "INSTANCER")
        by_other = by_object or (kind == "ShaderNodeTexCoord" and found.name == "Object" and node.object is not None)
        self.is_by_place = self.is_by_place or (kind in _PLACED and found.name not in _ALIKE) or by_other
        self.is_even = self.is_even and (kind in _PLAIN or kind == "ShaderNodeObjectInfo" or by_object)
        if kind in _AROUND and not getattr(node, "only_local", False):
            self.feels = self.feels or node
        by_camera = kind == "ShaderNodeVectorTransform" and "CAMERA" in (node.convert_from, node.convert_to)
        if kind in _SEEING or by_camera or found.name in _SEEN.get(kind, ()):
            self.sees = self.sees or node
            self.is_by_uv = False
        elif kind.startswith("ShaderNodeTex") and kind not in ("ShaderNodeTexCoord", "ShaderNodeTexEnvironment"):
            by_default = kind == "ShaderNodeTexImage" and node.projection == "FLAT"
            # Without coordinates a picture is by UV, all else by the object.
            is_placed = self._is_placed(node)
            self.is_by_uv = self.is_by_uv and (by_default or is_placed)
            self.is_generated = self.is_generated or not (by_default or is_placed)
        elif not is_uv(found, self._uv_name) and kind not in _PLAIN and not kind.startswith("ShaderNodeBsdf"):
            self.is_by_uv = False
        elif kind == "ShaderNodeNormalMap" and (node.space != "TANGENT" or node.uv_map not in ("", self._uv_name)):
            self.is_by_uv = False
        self.is_generated = self.is_generated or (kind == "ShaderNodeTexCoord" and found.name == "Generated")
        for other in node.inputs:
            self.follow(other)

    def _is_placed(self, node: Any) -> bool:
        vector = node.inputs.get("Vector")
        with self._nodes.aside():
            return vector is None or self._nodes.source(vector) is not None
