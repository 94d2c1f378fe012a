"""What nodes of geometry make in Blender, against Cycles."""

import pytest

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import check, link, material, mesh, node, scene, sky, takes  # noqa: E402, F401

from wend._blend_render_mode import as_rendered  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")


def grown(scene, place, material_):
    """A mesh with nodes that make a box, and what `place` links of the mesh and of the box."""
    sky(scene, (0.8, 0.8, 0.8))
    tree = bpy.data.node_groups.new("growing", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    box, dressed = tree.nodes.new("GeometryNodeMeshCube"), tree.nodes.new("GeometryNodeSetMaterial")
    box.inputs["Size"].default_value = (0.7, 0.5, 0.9)
    dressed.inputs["Material"].default_value = material_
    tree.links.new(box.outputs[0], dressed.inputs["Geometry"])
    tree.links.new(place(tree, begin.outputs[0], dressed.outputs[0]), end.inputs[0])
    ground = mesh(scene, "grid", material("BsdfDiffuse", color=(0.2, 0.5, 0.1)), x_subdivisions=3, y_subdivisions=3, size=3)
    ground.data.materials.append(material_)
    ground.modifiers.new("growing", "NODES").node_group = tree


def on_points(tree, ground, box):
    made = tree.nodes.new("GeometryNodeInstanceOnPoints")
    tree.links.new(ground, made.inputs["Points"])
    tree.links.new(box, made.inputs["Instance"])
    return made.outputs[0]


def in_place(tree, ground, box):
    return box


@pytest.mark.parametrize("place", [on_points, in_place])
def test_what_nodes_make_is_baked_as_it_is(scene, tmp_path, place):
    """By its own box, also where it is there on points alone."""
    grown(scene, place, takes("BsdfDiffuse", "Color", lambda tree, socket: link(tree, node(tree, "TexCoord"), socket, "Generated")))
    check(scene, tmp_path, 500, bake_resolution=256)


def test_nodes_and_modifiers_are_as_in_a_render(scene):
    """What they make for views is something else."""
    made = mesh(scene, "cube", material("BsdfDiffuse"))
    group = bpy.data.node_groups.new("nodes", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        group.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    begin, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    switch, asks = group.nodes.new("GeometryNodeSwitch"), group.nodes.new("GeometryNodeIsViewport")
    switch.input_type = "GEOMETRY"
    group.links.new(asks.outputs[0], switch.inputs[0])
    group.links.new(begin.outputs[0], switch.inputs[1])
    group.links.new(switch.outputs[0], end.inputs[0])
    made.modifiers.new("nodes", "NODES").node_group = group
    water = mesh(scene, "plane", material("BsdfDiffuse"))
    ocean = water.modifiers.new("ocean", "OCEAN")
    ocean.resolution, ocean.viewport_resolution = 2, 6
    with as_rendered(scene):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        assert len(made.evaluated_get(depsgraph).data.polygons) == 6
        faces = len(water.evaluated_get(depsgraph).data.polygons)
    ocean.viewport_resolution = 2
    assert len(water.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.polygons) == faces
    assert not asks.mute
