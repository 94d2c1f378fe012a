"""Nothing of Blender's nodes and lamps is ignored without a word: of each, in Blender's own list, every input and setting
changes the scene or what is told."""

import warnings

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import by_cycles, camera, lamp, link, mesh, scene, sky  # noqa: E402, F401

from wend import blend  # noqa: E402
from wend._blend_nodes import Nodes  # noqa: E402
from wend._scene_reader import SceneReader  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")

#: What makes other inputs count: values of inputs, by name, and settings, by @name.
WITH = {
    "BsdfPrincipled": [
        {"Coat Weight": 0.5},
        {"Sheen Weight": 0.5},
        {"Transmission Weight": 0.5},
        {"Subsurface Weight": 0.5},
        {"Subsurface Weight": 0.5, "@subsurface_method": "BURLEY"},
        {"Subsurface Weight": 0.5, "@subsurface_method": "RANDOM_WALK_SKIN"},
        {"Emission Strength": 1.0},
        {"Metallic": 1.0, "Anisotropic": 0.5},
    ],
    "BsdfAnisotropic": [{"Anisotropy": 0.5}],
    "BsdfMetallic": [{"Anisotropy": 0.5}, {"@fresnel_type": "PHYSICAL_CONDUCTOR"}],
    "BsdfGlass": [{"Roughness": 0.3}],
    "BsdfRefraction": [{"Roughness": 0.3}],
    "BsdfHairPrincipled": [{"@parametrization": kind} for kind in ("MELANIN", "ABSORPTION")],
    "SubsurfaceScattering": [{"@falloff": "BURLEY"}, {"@falloff": "RANDOM_WALK_SKIN"}],
    "VolumePrincipled": [{"Emission Strength": 1.0}, {"Blackbody Intensity": 0.5}],
    "VolumeScatter": [{"@phase": kind} for kind in ("RAYLEIGH", "DRAINE", "MIE", "FOURNIER_FORAND")],
    "VolumeCoefficients": [
        {"@phase": kind, "Scatter Coefficients": (1, 1, 1)} for kind in ("RAYLEIGH", "DRAINE", "MIE", "FOURNIER_FORAND")
    ],
}
#: Without an effect in Cycles, unless what is told already is there, or a grid has that name.
IDLE = {
    "BsdfPrincipled": {"Thin Film IOR"},
    "BsdfGlass": {"Thin Film IOR"},
    "BsdfMetallic": {"Thin Film IOR"},
    "BsdfHairPrincipled": {"Random"},
    "VolumePrincipled": {"Color Attribute", "Density Attribute", "Temperature Attribute"},
}


def shader_kinds():
    tree = bpy.data.materials.new("probe").node_tree
    for name in sorted(dir(bpy.types)):
        if name.startswith("ShaderNode") and name != "ShaderNode":
            try:
                made = tree.nodes.new(name)
            except RuntimeError:  # a base of others
                continue
            if any(socket.type == "SHADER" for socket in made.outputs):
                yield name.removeprefix("ShaderNode")


def facing_cube(kind, given):
    """A cube of one shader; its node."""
    made = bpy.data.materials.new(kind)
    tree = made.node_tree
    tree.nodes.clear()
    end, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(f"ShaderNode{kind}")
    for socket in [socket for socket in node.inputs if socket.type == "SHADER"]:
        link(tree, tree.nodes.new("ShaderNodeBsdfDiffuse"), socket)
    link(tree, node, end.inputs["Volume" if kind.startswith("Volume") else "Surface"])
    for name, value in given.items():
        if name.startswith("@"):
            setattr(node, name[1:], value)
        else:
            next(socket for socket in node.inputs if socket.name == name).default_value = value
    mesh(bpy.context.scene, "cube", made)
    return node


def told():
    """The scene as text, and its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        text = blend.of_scene(bpy.context.scene).text()
    return text, {str(w.message) for w in caught if w.category is wend.SceneWarning}


def others(value):
    """Of a value of an input, another one; nothing where there is none."""
    if isinstance(value, str):
        return value + "x"
    if isinstance(value, float):
        return 0.3 if abs(value - 0.3) > 0.05 else 0.6
    return tuple(0.13 + 0.29 * i for i in range(3)) + (1.0,) * (len(value) - 3)


def changes(node, kind):
    """Ways to change it: what they are called, and what they do."""
    for socket in node.inputs:
        is_idle = socket.name in IDLE.get(kind, ()) or socket.name == "Weight" or socket.hide_value
        if socket.type != "SHADER" and socket.enabled and not is_idle:
            yield socket.name, lambda s=socket: setattr(s, "default_value", others(s.default_value))
    plain = set(bpy.types.ShaderNode.bl_rna.properties.keys())
    for setting in node.bl_rna.properties:
        if setting.type == "ENUM" and setting.identifier not in plain:
            for item in setting.enum_items:
                if item.identifier != getattr(node, setting.identifier):
                    yield item.identifier, lambda p=setting.identifier, v=item.identifier: setattr(node, p, v)


@pytest.mark.parametrize("kind", list(shader_kinds()))
def test_shaders(scene, kind):
    silent: dict[str, bool] = {}
    for given in [{}, *WITH.get(kind, [])]:
        node = facing_cube(kind, given)
        text, words = told()
        if any("is taken as" in word and f"'{node.name}'" in word and "is taken as MULTI" not in word for word in words):
            return  # there is nothing like it, and it is named
        before = [(socket, socket.default_value if not hasattr(socket.default_value, "__len__") or isinstance(
            socket.default_value, str) else tuple(socket.default_value))
            for socket in node.inputs if hasattr(socket, "default_value")]  # fmt: skip
        settings = {p: getattr(node, p) for p in node.bl_rna.properties.keys() if node.bl_rna.properties[p].type == "ENUM"}
        for name, change in changes(node, kind):
            if silent.get(name) is False:
                continue
            change()
            silent[name] = told() == (text, words)
            for setting, value in settings.items():
                if getattr(node, setting) != value:
                    setattr(node, setting, value)
            for socket, value in before:
                socket.default_value = value
        bpy.ops.object.delete()
    assert not [name for name, is_silent in silent.items() if is_silent]


#: Settings of lamps that change Cycles' picture.
LAMPS = {
    "POINT": {"energy": 7.0, "exposure": 1.0, "color": (0.2, 0.5, 0.7), "shadow_soft_size": 0.4, "normalize": False},
    "SPOT": {"spot_size": 0.4, "spot_blend": 0.6, "use_square": True, "shadow_soft_size": 0.4},
    "SUN": {"angle": 0.3, "energy": 7.0, "normalize": False},
    "AREA": {"size": 3.0, "shape": "DISK", "spread": 1.0, "normalize": False},
}


@pytest.mark.parametrize("kind", LAMPS)
def test_lamps(scene, kind):
    made = lamp(scene, kind, 100, (0, 0, 4))
    for name, value in (LAMPS[kind] | {"use_temperature": True, "use_shadow": False}).items():
        before = told()
        setattr(made.data, name, value)
        assert told() != before, name
    if kind == "AREA":
        made.data.cycles.is_portal = True
        made.data.update_tag()
        assert "AreaLightSource" not in told()[0]


def test_settings_that_have_no_counterpart_are_named(scene):
    made = mesh(scene, "cube")
    eye = scene.camera.data
    eye.dof.use_dof, eye.dof.aperture_ratio, eye.clip_start = True, 2, 1
    scene.render.film_transparent = scene.render.use_freestyle = scene.render.use_multiview = True
    scene.cycles.film_transparent_glass = True
    scene.world.cycles_visibility.glossy = False
    layer = bpy.context.view_layer
    layer.use_sky, layer.material_override = False, bpy.data.materials.new("clay")
    made.light_linking.receiver_collection = bpy.data.collections.new("lit")
    words = "\n".join(told()[1])
    for word in ("round", "clipped", "transparent film", "Freestyle", "views", "glossy do not see", "the world", "override", "linked"):
        assert word in words, word


MIXES = [
    {"data_type": "FLOAT", "blend_type": "MULTIPLY"},
    {"data_type": "VECTOR", "clamp_factor": False},
    {"data_type": "VECTOR", "factor_mode": "NON_UNIFORM"},
    {"data_type": "RGBA", "clamp_factor": False},
    {"data_type": "RGBA", "blend_type": "ADD", "clamp_result": True},
    {"data_type": "RGBA", "blend_type": "SCREEN"},
]


@pytest.mark.parametrize("settings", MIXES, ids=[" ".join(map(str, s.values())) for s in MIXES])
def test_mixtures_of_constants_are_those_of_cycles(scene, tmp_path, settings):
    made = bpy.data.materials.new("mix")
    tree = made.node_tree
    tree.nodes.clear()
    end, emission = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeEmission")
    node = tree.nodes.new("ShaderNodeMix")
    for name, value in settings.items():
        setattr(node, name, value)
    for i, socket in enumerate(node.inputs):
        if socket.enabled and socket.type == "VALUE":
            socket.default_value = 1.3 if i == 0 and not settings.get("clamp_factor", True) else 0.4 + 0.1 * i
        elif socket.enabled:
            socket.default_value = tuple(0.2 + 0.1 * (i + k) for k in range(3)) + (1.0,) * (socket.type == "RGBA")
    link(tree, node, emission.inputs["Color"], next(i for i, socket in enumerate(node.outputs) if socket.enabled))
    link(tree, emission, end.inputs["Surface"])
    mesh(scene, "plane", made, size=4)
    camera(scene, (0, 0, 5), (0, 0, 0))
    scene.render.resolution_x = scene.render.resolution_y = 1
    ours = Nodes(SceneReader("", None), "", "", made).known(emission.inputs["Color"])
    np.testing.assert_allclose(np.broadcast_to(ours, 3), by_cycles(scene, tmp_path, 1)[0, 0], rtol=1e-3)
