"""Scenes that a program tells are those of a file that says the same."""

import numpy as np
import pytest
import wend

TETRAHEDRON = np.array([[0, 1, 0], [-1, -0.7, 0.6], [1, -0.7, 0.6], [0, -0.7, -1]], dtype=np.float64)
FACES = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])


def told(points=TETRAHEDRON, faces=FACES):
    b = wend.SceneBuilder(name="told")
    b.add("LookAt", 0, 0, -4, [0, 0, 0], 0, 1, 0)
    b.add("Camera", "perspective", {"float fov": 40})
    b.add("Film", "rgb", {"integer xresolution": 24, "integer yresolution": 16, "string filename": "a.exr"})
    b.add("Sampler", "sobol", {"integer pixelsamples": 4})
    b.add("Option", {"bool disabletexturefiltering": True})
    b.add("WorldBegin")
    b.add("MakeNamedMedium", "fog", {"string type": "homogeneous", "rgb sigma_s": (2, 1, 1), "rgb sigma_a": (0.1, 0.2, 0.3)})
    b.add("LightSource", "infinite", {"rgb L": (0.4, 0.5, 0.6)})
    b.add("Texture", "grey", "spectrum", "constant", {"rgb value": (0.3, 0.3, 0.3)})
    with b.block():
        b.add("Transform", np.eye(4))
        b.add("Translate", 0, 0.25, 0)
        b.add("MediumInterface", "fog", "")
        b.add("Material", "interface")
        b.add("Shape", "trianglemesh", {"point3 P": points, "integer indices": faces})
    with b.block("Object", "ball"):
        b.add("Material", "diffuse", {"texture reflectance": "grey"})
        b.add("Shape", "sphere", {"float radius": 0.3, "bool unused": [True]})
    b.add("ActiveTransform", "All")
    with b.block("Transform"):
        b.add("Translate", 1.5, 0, 0)
        b.add("ObjectInstance", "ball")
    return b


@pytest.mark.filterwarnings("ignore::wend.SceneWarning")
def test_the_picture_is_that_of_the_text():
    b = told()
    picture = wend.render(b.scene(), progress=False).image
    assert picture.shape == (16, 24, 3) and np.isfinite(picture).all() and picture.std() > 0.01
    assert np.array_equal(picture, wend.render(wend.loads(b.text()), progress=False).image)
    # The builder goes on, and a scene is what it was.
    with b.block():
        b.add("Translate", -1, 0, 0)
        b.add("Shape", "sphere", {"float radius": 0.5})
    other = wend.render(b.scene(resolution=(24, 16)), progress=False).image
    assert not np.array_equal(other, picture)


@pytest.mark.filterwarnings("ignore::wend.SceneWarning")
def test_checkpoints_know_the_arrays(tmp_path):
    first = wend.Render(told().scene(), spp=4)
    first.step()
    first.save(tmp_path / "a.checkpoint")
    same = wend.Render(told().scene(), spp=4)
    same.resume(tmp_path / "a.checkpoint")
    with pytest.raises(wend.InputError):
        wend.Render(told(points=TETRAHEDRON * 1.01).scene(), spp=4).resume(tmp_path / "a.checkpoint")


def test_a_large_mesh_goes_over_as_arrays():
    n = 300
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1, dtype=np.float32), np.linspace(-1, 1, n + 1, dtype=np.float32))
    points = np.stack([x, y, 0.1 * np.sin(9 * x)], axis=-1)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    faces = np.concatenate([np.stack([corner, corner + 1, corner + n + 1], 1), np.stack([corner + 1, corner + n + 2, corner + n + 1], 1)])
    b = wend.SceneBuilder()
    b.add("WorldBegin")
    b.add("LightSource", "infinite")
    b.add("Shape", "trianglemesh", {"point3 P": points, "integer indices": faces})
    low, high = b.scene().bounds
    assert low == pytest.approx((-1, -1, -0.1), abs=1e-3) and high == pytest.approx((1, 1, 0.1), abs=1e-3)


@pytest.mark.parametrize(
    ("directive", "message"),
    [
        (("Shap", "sphere"), "told:2: error: 'Shap' is no directive"),
        (("Shape",), "told:2: .* wants 1 texts"),
        (("Camera", "perspective"), "not allowed after WorldBegin"),
        (("Translate", 1, 2), "wants 0 texts, 3 numbers"),
        (("Include", "file"), "for files"),
        (("ActiveTransform", "Never"), "StartTime"),
        (("Shape", "sphere", {"radius": 1}), "type name"),
        (("Shape", "sphere", {"flaot radius": 1}), "type name"),
        (("Shape", "trianglemesh", {"point3 P": [1, 2]}), "make no whole ones"),
        (("Shape", "trianglemesh", {"point3 P": []}), "make no whole ones"),
        (("Shape", "sphere", {"string alpha": [1.0]}), "TypeError|text|incompatible"),
    ],
)
def test_what_is_wrong_is_named(directive, message):
    b = wend.SceneBuilder(name="told")
    b.add("WorldBegin")
    with pytest.raises((wend.InputError, TypeError), match=message):
        b.add(*directive)
        b.scene()


def test_a_material_that_is_not_there_is_named_by_the_shape_that_wants_it():
    b = wend.SceneBuilder(name="told")
    b.add("WorldBegin")
    b.add("NamedMaterial", "none")
    b.scene()  # as in pbrt: nothing wants it
    b.add("Shape", "sphere")
    with pytest.raises(wend.InputError, match="none"):
        b.scene()


@pytest.mark.parametrize("values", [{"integer n": 1.5}, {"integer n": 2**40}, {"float x": "a b".split()}, {"float x": object()}])
def test_values_of_another_kind_are_refused(values):
    b = wend.SceneBuilder()
    with pytest.raises(wend.InputError):
        b.add("Film", "rgb", values)
        b.scene()


def test_what_another_was_given_may_be_put_before_the_rest():
    b, other = wend.SceneBuilder(), wend.SceneBuilder()
    b.add("Camera", "perspective")
    b.add("WorldBegin")
    other.add("Film", "rgb", {"integer xresolution": 8})
    b.insert(1, other)
    assert [line.split()[0] for line in b.text().splitlines() if line[0] != " "] == ["Camera", "Film", "WorldBegin"]
