"""Blender's pictures in tiles (UDIM), against Cycles."""

import warnings

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import add, by_cycles, blocks, agree, camera, check, lamp, link, node, scene, sky, takes  # noqa: E402, F401

from wend import blend  # noqa: E402

COLOURS = {1001: (0.8, 0.1, 0.1, 1), 1002: (0.1, 0.7, 0.2, 1), 1011: (0.2, 0.2, 0.9, 1)}


def tiles(folder, colours, name="map.<UDIM>.png", space="sRGB"):
    """A picture in tiles; of each the left half is darker."""
    for number, colour in colours.items():
        made = bpy.data.images.new("tile", 64, 64, alpha=True)
        pixels = np.broadcast_to(np.array(colour, dtype=np.float32), (64, 64, 4)).copy()
        pixels[:, :32, :3] *= 0.5
        made.pixels.foreach_set(pixels.ravel())
        made.filepath_raw, made.file_format = str(folder / name.replace("<UDIM>", str(number))), "PNG"
        made.save()
        bpy.data.images.remove(made)
    image = bpy.data.images.load(str(folder / name.replace("<UDIM>", str(min(colours)))))
    image.source, image.filepath = "TILED", str(folder / name)
    for number in colours:
        if number not in [tile.number for tile in image.tiles]:
            image.tiles.new(number)
    image.colorspace_settings.name = space
    return image


def sheet(scene, material, columns=2, rows=2):
    """A floor whose faces are each a tile, without its rim: there Cycles goes on at the other side of the tile."""
    points, faces, uvs = [], [], []
    for j in range(rows):
        for i in range(columns):
            square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
            faces.append(range(len(points), len(points) + 4))
            points += [(*(4 * (np.array((i, j)) + p) / (columns, rows) - 2), 0) for p in square]
            uvs += [np.array((i, j)) + 0.1 + 0.8 * p for p in square]
    mesh = bpy.data.meshes.new("sheet")
    mesh.from_pydata(points, [], faces)
    layer = mesh.uv_layers.new(name="UVMap")
    layer.uv.foreach_set("vector", np.ravel(uvs))
    mesh.materials.append(material)
    return add(scene, "sheet", mesh)


@pytest.fixture
def above(scene):
    camera(scene, (0, 0, 5), (0, 0, 0), type="ORTHO", ortho_scale=4)
    sky(scene, (1, 1, 1), 0.5)
    lamp(scene, "SUN", 2, (0, 0, 3), (0.4, 0.2, 0))
    return scene


def wired(image, output=0, mapping=None, **settings):
    def wire(tree, socket):
        texture = node(tree, "TexImage", image=image, **settings)
        if mapping is not None:
            coordinates, mapped = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeMapping")
            mapped.inputs["Scale"].default_value = (*mapping, 1)
            link(tree, coordinates, mapped.inputs["Vector"], "UV")
            link(tree, mapped, texture.inputs["Vector"])
        link(tree, texture, socket, output)

    return wire


@pytest.mark.parametrize("interpolation", ["Linear", "Closest"])
def test_colours_in_tiles(above, tmp_path, interpolation):
    """One of the four is not there."""
    sheet(above, takes("BsdfDiffuse", "Color", wired(tiles(tmp_path, COLOURS), interpolation=interpolation)))
    with warnings.catch_warnings():
        warnings.simplefilter("error", wend.SceneWarning)
        check(above, tmp_path, spp=64)


def test_a_mapping_is_before_tiles(above, tmp_path):
    sheet(above, takes("BsdfDiffuse", "Color", wired(tiles(tmp_path, COLOURS), mapping=(1, 0.5))))
    check(above, tmp_path, spp=64)


def test_numbers_in_tiles(above, tmp_path):
    image = tiles(tmp_path, {1001: (0.2, 0.2, 0.2, 1), 1002: (0.6, 0.6, 0.6, 1), 1012: (1, 1, 1, 1)}, space="Non-Color")
    sheet(above, takes("BsdfPrincipled", "Metallic", wired(image), base_color=(0.2, 0.5, 0.8), roughness=0.8))
    check(above, tmp_path, spp=256)


def test_an_opacity_in_tiles(above, tmp_path):
    image = tiles(tmp_path, {1001: (0.5, 0.5, 0.5, 0.2), 1002: (0.5, 0.5, 0.5, 1), 1012: (0.5, 0.5, 0.5, 0.6)})
    sheet(above, takes("BsdfPrincipled", "Alpha", wired(image, "Alpha"), base_color=(0.2, 0.5, 0.8), roughness=1))
    check(above, tmp_path, spp=1024)


def test_packed_tiles(above, tmp_path):
    image = tiles(tmp_path, COLOURS)
    image.pack()
    for file in tmp_path.glob("map.*"):
        file.unlink()
    sheet(above, takes("BsdfDiffuse", "Color", wired(image)))
    check(above, tmp_path, spp=64)
