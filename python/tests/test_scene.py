import pickle
import warnings

import numpy as np
import pytest
import wend


def test_loading_says_what_is_there(demo):
    assert demo.resolution == (32, 18)
    assert demo.spp == 64
    lower, upper = demo.bounds
    assert all(a < b for a, b in zip(lower, upper))
    assert demo.parameters["medium.fog.g"] == pytest.approx(0.3)
    assert "demo.pbrt" in repr(demo)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"resolution": (0, 5)}, "resolution"),
        ({"resolution": "32x18"}, "resolution"),
        ({"resolution": (32.5, 18)}, "resolution"),
        ({"max_depth": -1}, "max-depth"),
        ({"crop": (0.5, 0.2, 0, 1)}, "crop"),
        ({"sampler": "dice"}, "sampler"),
    ],
)
def test_options_are_checked(options, message):
    with pytest.raises(wend.InputError, match=message):
        wend.load(wend.demo_scene(), **options)


def test_errors_have_a_place(tmp_path):
    broken = tmp_path / "broken.pbrt"
    broken.write_text('WorldBegin\nShape "sphere" "float radius" [ 1 ')
    with pytest.raises(wend.InputError) as caught:
        wend.load(broken)
    error = caught.value
    assert error.file == str(broken)
    assert error.line == 2 and error.column > 0
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line) == (str(error), error.line)
    with pytest.raises(wend.InputError, match="missing.pbrt"):
        wend.load(tmp_path / "missing.pbrt")


def test_scenes_of_mitsuba_are_loaded_by_their_extension(tmp_path):
    text = """<scene version="3.0.0">
        <sensor type="perspective"><float name="fov" value="40"/>
            <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="6"/></film></sensor>
        <emitter type="constant"/>
        <medium type="homogeneous" id="fog"><float name="sigma_t" value="2"/><float name="albedo" value=".25"/></medium>
        <shape type="sphere"><bsdf type="null"/><ref name="interior" id="fog"/></shape>
    </scene>"""
    (tmp_path / "scene.xml").write_text(text)
    for scene in (wend.load(tmp_path / "scene.xml"), wend.loads(text)):
        assert scene.resolution == (8, 6)
        assert scene.parameters["medium.fog.sigma_s"] == pytest.approx([0.5, 0.5, 0.5])
    with pytest.raises(wend.InputError, match=r"scene.xml:1:22: error: .*<sensr> is unknown"):
        (tmp_path / "scene.xml").write_text('<scene version="3.0"><sensr type="perspective"/></scene>')
        wend.load(tmp_path / "scene.xml")


def test_what_is_done_otherwise_is_warned_of():
    with pytest.warns(wend.SceneWarning, match="spoke"):
        scene = wend.loads('WorldBegin\nLightSource "infinite"\nShape "sphere" "float spoke" 1\n')
    assert len(scene.warnings) == 1


def test_parameters_change_in_a_copy(furnace):
    black = furnace.with_({"light[0].L": (0, 0, 0)})
    dim = furnace.with_({"light[0].L": 0.5 * np.ones(3), "camera.fov": 30})
    assert furnace.parameters["light[0].L"] == (1, 1, 1)
    assert dim.parameters["camera.fov"] == 30
    for scene, value in ((furnace, 1), (dim, 0.5), (black, 0)):
        image = wend.render(scene, spp=16, progress=False).image
        assert np.mean(image) == pytest.approx(value, rel=0.02)


TWO_BALLS = """
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" {fov}
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
Sampler "independent" "integer pixelsamples" 4
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0 0 0] "rgb sigma_s" [{fog} {fog} {fog}]
MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [{paint} 0.5 0.5]
AttributeBegin
  MediumInterface "fog" ""
  Material "interface"
  Translate -2 0 6
  Shape "sphere" "float radius" {radius}
AttributeEnd
NamedMaterial "paint"
Translate 2 0 6
Shape "trianglemesh" "point3 P" [-1 -1 0  1 -1 0  0 1 1] "integer indices" [0 1 2]
"""
AS_IT_IS = {"fov": 60, "fog": 1, "paint": 0.5, "radius": 1.5}


@pytest.mark.parametrize(
    "changes, values, shares",
    [
        ({"camera.fov": 45}, {"fov": 45}, True),
        ({"medium.fog.sigma_s": (2, 2, 2)}, {"fog": 2}, True),
        ({"material.paint.reflectance": (0.25, 0.5, 0.5)}, {"paint": 0.25}, True),
        ({"medium.fog.sigma_s": (2, 2, 2), "camera.fov": 45}, {"fog": 2, "fov": 45}, True),
        ({"shape[0].radius": 1.25}, {"radius": 1.25}, False),
    ],
)
def test_changed_scenes_share_geometry_and_are_those_of_the_file(changes, values, shares):
    scene = wend.loads(TWO_BALLS.format(**AS_IT_IS))
    changed = scene.with_(changes)
    written = wend.loads(TWO_BALLS.format(**(AS_IT_IS | values)))
    assert changed.shares_geometry_with(scene) == shares
    assert not written.shares_geometry_with(scene)
    back = changed.with_({name: scene.parameters[name] for name in changes})
    assert back.shares_geometry_with(changed) == shares
    films = [wend.render(one, seed=1, progress=False) for one in (changed, written, back, scene)]
    for name in films[0]:
        np.testing.assert_array_equal(films[0][name], films[1][name], err_msg=name)
        np.testing.assert_array_equal(films[2][name], films[3][name], err_msg=name)
    assert not np.array_equal(films[0].image, films[3].image)


def test_changed_scenes_outlive_what_they_were_made_of():
    scene = wend.loads(TWO_BALLS.format(**AS_IT_IS))
    image = wend.render(scene, seed=1, progress=False).image
    for _ in range(3):
        scene = scene.with_({"camera.fov": 45}).with_({"camera.fov": 60})
    np.testing.assert_array_equal(wend.render(scene, seed=1, progress=False).image, image)


def test_files_of_changed_scenes_are_not_read_again(tmp_path):
    (tmp_path / "mesh.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 4\n1 0 4\n0 1 4\n3 0 1 2\n"
    )
    (tmp_path / "scene.pbrt").write_text(
        'WorldBegin LightSource "infinite" Shape "plymesh" "string filename" "mesh.ply"'
    )
    scene = wend.load(tmp_path / "scene.pbrt", resolution=(4, 4))
    before = wend.render(scene.with_({"camera.fov": 45}), spp=1, seed=1, progress=False)
    (tmp_path / "mesh.ply").write_text("something else")
    changed = scene.with_({"camera.fov": 45})
    assert changed.shares_geometry_with(scene)
    # It is known again by what was read.
    after = wend.render(changed, spp=1, seed=2, progress=False)
    assert wend.merge([before, after]).image.shape == (4, 4, 3)
    with pytest.raises(wend.InputError, match="mesh.ply"):
        scene.with_({"shape[0].filename": ("string", "mesh.ply")})


def test_types_are_kept_or_said(furnace):
    assert furnace.with_({"integrator.maxdepth": 7}).max_depth == 7
    gold = furnace.with_({"medium.fog.sigma_s": ("spectrum", "metal-Au-eta")})
    assert gold.parameters["medium.fog.sigma_s"] == "metal-Au-eta"
    with pytest.raises(wend.InputError, match="no whole"):
        furnace.with_({"light[0].L": ("rgb", [1, 2])})
    with pytest.raises(wend.InputError, match="numbers"):
        furnace.with_({"camera.fov": ("float", "wide")})


def test_unknown_names_are_refused_or_warned_of(furnace):
    with pytest.raises(wend.InputError, match="medium.fog"):
        furnace.with_({"medium.smoke.g": 0})
    with pytest.raises(wend.InputError, match="no such directive"):
        furnace.with_({"fov": 30})
    with pytest.warns(wend.SceneWarning, match="fovv"):
        furnace.with_({"camera.fovv": 30})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        furnace.with_({"camera.fov": 30})


def test_changed_scenes_are_other_scenes(furnace):
    a = wend.render(furnace, spp=1, seed=1, progress=False)
    b = wend.render(furnace.with_({"camera.fov": 40}), spp=1, seed=2, progress=False)
    with pytest.raises(wend.InputError, match="scene"):
        wend.merge([a, b])
