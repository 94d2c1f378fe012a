"""Skies of Mitsuba scenes as pictures: what takes the place of a `sunsky` lights as it does."""

import importlib.util
import re

import numpy as np
import pytest

import wend
from wend import mitsuba_sky

SCENE = """<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="4"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="24"/>
        <transform name="to_world"><lookat origin="1 -4 2" target="0 0 .5" up="0 0 1"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="12"/><integer name="height" value="12"/><rfilter type="box"/>
        </film>
    </sensor>
    {sky}
    <shape type="rectangle">
        <transform name="to_world"><scale value="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value=".5 .4 .3"/></bsdf>
    </shape>
    <shape type="sphere"><point name="center" x="0" y="0" z=".7"/><float name="radius" value=".6"/></shape>
</scene>
"""
SUNSKY = """<emitter type="sunsky">
        <float name="turbidity" value="4"/><transform name="to_world"><rotate z="1" angle="70"/></transform>
    </emitter>"""

needs_mitsuba = pytest.mark.skipif(importlib.util.find_spec("mitsuba") is None, reason="mitsuba is not installed")


@needs_mitsuba
def test_what_is_baked_lights_as_the_sky_does(tmp_path):
    import mitsuba

    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format(sky=SUNSKY))
    emitters = mitsuba_sky.bake(scene, tmp_path / "sky.exr")
    assert re.findall(r'<emitter type="(\w+)">', emitters) == ["envmap", "directional"]
    expected = np.array(mitsuba.render(mitsuba.load_file(str(scene)), spp=1024, seed=1))[..., :3].mean((0, 1))
    scene.write_text(SCENE.format(sky=emitters))
    film = wend.render(wend.load(scene), spp=256).image
    assert np.asarray(film)[..., :3].mean((0, 1)) == pytest.approx(expected, rel=0.01)
    # The sky alone is darker by far.
    scene.write_text(SCENE.format(sky=emitters.splitlines()[0]))
    assert wend.render(wend.load(scene), spp=16).image[..., :3].mean() < 0.8 * expected.mean()


@needs_mitsuba
def test_what_is_no_sky_is_refused(tmp_path):
    scene = tmp_path / "scene.xml"
    for sky in ("", '<emitter type="constant"/>', '<emitter type="timed_sunsky"/>'):
        scene.write_text(SCENE.format(sky=sky))
        with pytest.raises(wend.InputError, match='there is no <emitter type="sunsky"> in it'):
            mitsuba_sky.bake(scene, tmp_path / "sky.exr")
    scene.write_text("<scene")
    with pytest.raises(wend.InputError, match="Mitsuba cannot read it"):
        mitsuba_sky.bake(scene, tmp_path / "sky.exr")
    with pytest.raises(wend.InputError, match="there is no such file"):
        mitsuba_sky.bake(tmp_path / "none.xml", tmp_path / "sky.exr")
    assert not (tmp_path / "sky.exr").exists()


def test_other_widths_are_refused(tmp_path):
    for width in (0, 18, 1_000_000):
        with pytest.raises(wend.InputError, match="the width must be a multiple of 4"):
            mitsuba_sky.bake(tmp_path / "scene.xml", tmp_path / "sky.exr", width=width)


@pytest.mark.skipif(importlib.util.find_spec("mitsuba") is not None, reason="mitsuba is installed")
def test_the_package_that_is_missing_is_named(tmp_path):
    with pytest.raises(ImportError, match="pip install mitsuba"):
        mitsuba_sky.bake(tmp_path / "scene.xml", tmp_path / "sky.exr")
    assert mitsuba_sky.main(["scene.xml", "-o", str(tmp_path / "sky.exr")]) == 2
