"""Blender's volumes of files that shine by themselves, against Cycles."""

import pathlib
import sys

import numpy as np
import pytest

import wend

bpy = pytest.importorskip("bpy", reason="bpy is not installed")
from blender_scene import (  # noqa: E402, F401
    add,
    camera,
    check,
    lamp,
    material,
    scene,
    sky,
    straight,
)

from wend import blend  # noqa: E402
from wend._blend_nodes import blackbody  # noqa: E402

# Where bpy keeps its own.
sys.path.append(str(pathlib.Path(bpy.utils.resource_path("LOCAL"), f"python/lib/python3.{sys.version_info.minor}/site-packages")))
vdb = pytest.importorskip("openvdb", reason="bpy has no openvdb")

pytestmark = pytest.mark.filterwarnings("ignore::wend.SceneWarning", "ignore::DeprecationWarning")

SIDE = 24


def grid_of(name, values, tolerance=0.0):
    grid = vdb.FloatGrid()
    grid.copyFromArray(values.astype(np.float32), tolerance=tolerance)
    grid.name = name
    grid.transform = vdb.createLinearTransform(voxelSize=2 / SIDE)
    return grid


@pytest.fixture(scope="module")
def fire(tmp_path_factory):
    """Smoke above, and heat below, where there is little smoke."""
    x, y, z = np.meshgrid(*[np.linspace(-1, 1, SIDE)] * 3, indexing="ij")
    smoke = np.clip(1 - (x**2 + y**2 + (z - 0.3) ** 2) / 0.4, 0, 1)
    heat = np.clip(1 - (x**2 + y**2 + (z + 0.3) ** 2) / 0.4, 0, 1)
    file = tmp_path_factory.mktemp("fire") / "fire.vdb"
    vdb.write(str(file), grids=[grid_of("density", smoke + 1e-4), grid_of("temperature", heat + 1e-4)])
    return file


def array_of(file, name):
    values = np.zeros((SIDE,) * 3, dtype=np.float32)
    vdb.read(str(file), name).copyToArray(values)
    return values


def heat_of(file):
    return array_of(file, "temperature")


def smoke_of(file):
    return array_of(file, "density")


def volume_of(scene, file, size=(1, 1, 1), **inputs):
    data = bpy.data.volumes.new("fire")
    data.filepath = str(file)
    made = add(scene, "fire", data, place=(-size[0], -size[1], -size[2]), size=size)
    data.materials.append(material("VolumePrincipled", "Volume", **inputs))
    camera(scene, (1, -6, 1), (0, 0, 0))
    return made


def between(values, parts=12):
    """The middles of small cells of a grid, interpolated."""
    at = np.arange(0, SIDE - 1, 1 / parts) + 0.5 / parts
    cell = at.astype(int)
    share = (at - cell)[:, None, None]
    for axis in range(3):
        along = np.moveaxis(values, axis, 0)
        values = np.moveaxis(along[cell] * (1 - share) + along[cell + 1] * share, 0, axis)
    return values, (2 / SIDE / parts) ** 3


def mean_of_a_view(scene, file, **inputs):
    """Of what an orthographic camera sees of a thin volume: all that is emitted, over the view's area of 2.4²."""
    volume_of(scene, file, color=(1, 1, 1), density=0.01, **inputs)
    camera(scene, (0, -6, 0), (0, 0, 0), type="ORTHO", ortho_scale=2.4)
    return wend.render(blend.of_scene(scene, spp=512).scene(), sampling="classical").image.mean(axis=(0, 1))


def test_fire_is_as_bright_as_its_temperatures_say(scene, fire):
    """Against quadrature. Cycles' fit of the colours of black bodies is up to 6 % redder below 3000 K."""
    heat, cell = between(np.asarray(heat_of(fire)))
    kelvins = np.arange(0, 3100, 20.0)
    bright = np.array([5.670373e-14 / np.pi * kelvin**4 * blackbody(kelvin) for kelvin in kelvins])
    wanted = [np.interp(3000 * heat, kelvins, bright[:, c]).sum() * cell / 2.4**2 for c in range(3)]
    found = mean_of_a_view(scene, fire, blackbody_intensity=1.0, temperature=3000.0)
    assert found[:2] == pytest.approx(wanted[:2], rel=0.02)
    # Blue is what is hottest alone.
    assert found[2] == pytest.approx(wanted[2], rel=0.04)


def test_what_shines_everywhere_alike_ends_with_the_volume(scene, fire):
    smoke, cell = between(np.asarray(smoke_of(fire)))
    wanted = 0.3 * np.array([1.0, 0.4, 0.1]) * (smoke > 1e-3).sum() * cell / 2.4**2
    found = mean_of_a_view(scene, fire, emission_strength=0.3, emission_color=(1.0, 0.4, 0.1))
    assert found == pytest.approx(wanted, rel=0.02)


def test_a_grid_of_temperatures_that_nobody_asks_for_is_dark(scene, tmp_path, fire):
    sky(scene, (0.5, 0.5, 0.5))
    volume_of(scene, fire, size=(1.3, 1.3, 1.3), color=(0.6, 0.5, 0.4), density=1.5)
    check(scene, tmp_path, 1000)


def test_a_volume_that_moves_is_where_it_is_half_way(scene, fire):
    straight(volume_of(scene, fire, density=1.0))
    lamp(scene, "POINT", 100, (0, 0, 3))
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter, scene.render.motion_blur_position = True, 1.0, "START"
    with pytest.warns(wend.SceneWarning, match="object 'fire': warning: what moves .* half open"):
        text = blend.of_scene(scene).text()
    place = text[: text.index("MakeNamedMedium")].rsplit("Transform [", 1)[1].split("]")[0].split()
    assert float(place[12]) == pytest.approx(-1 + 0.75)


def test_colours_by_temperature_need_temperatures(fire):
    builder = wend.SceneBuilder()
    builder.add("Camera", "perspective")
    builder.add("WorldBegin")
    glow = {"string type": "nanovdb", "string filename": str(fire), "rgb glow": [[0, 0, 0], [1, 1, 1]], "float glowstep": 1000}
    builder.add("MakeNamedMedium", "fire", glow)
    with pytest.raises(wend.InputError, match="colours by temperature need a grid"):
        builder.scene()
