"""OpenEXR files as others read and write them, by the package OpenEXR."""

from __future__ import annotations

import json
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

import wend

OpenEXR = pytest.importorskip("OpenEXR", reason="the package OpenEXR is not installed")

SPHERE = """
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
Sampler "independent" "integer pixelsamples" 8
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0.5 0.2 0.1]
Shape "sphere" "float radius" 0.8
"""


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> wend.Film:
    file = tmp_path_factory.mktemp("exr") / "sphere.pbrt"
    file.write_text(SPHERE)
    return wend.render(str(file), sampling="classical", seed=3, progress=False)


def channels(path: pathlib.Path) -> dict[str, np.ndarray]:
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: channel.pixels for name, channel in file.channels().items()}


def test_others_find_alpha_and_numbers(film: wend.Film, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.exr"
    film.save(path, alpha=True)
    read = channels(path)
    np.testing.assert_array_equal(np.dstack([read[c] for c in "RGB"]), film.image)
    np.testing.assert_array_equal(read["A"], film["alpha"])
    assert read["A"][0, 0] == 0 and read["A"][6, 8] == 1
    np.testing.assert_array_equal(read["depth.Z"], film["depth"])
    header = OpenEXR.File(str(path)).header()
    assert header["samplesPerPixel"] == 8 and header["seed"] == 3
    assert header["wend:seed"] == "3"
    film.save(path)
    assert "A" not in channels(path) and "alpha.A" in channels(path)


@pytest.mark.parametrize("names", ["wend", "pbrt", "blender"])
def test_all_names_are_read_again(film: wend.Film, tmp_path: pathlib.Path, names: str) -> None:
    path = tmp_path / "a.exr"
    film.save(path, layer_names=names)
    again = wend.read(path)
    assert sorted(again) == sorted(film)
    for layer in film:
        np.testing.assert_array_equal(again[layer], film[layer], err_msg=layer)


def test_names_are_those_of_others(film: wend.Film, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.exr"
    film.save(path, layer_names="pbrt")
    read = channels(path)
    np.testing.assert_array_equal(read["Ns.Z"], film["normal"][:, :, 2])
    np.testing.assert_array_equal(read["Albedo.R"], film["albedo"][:, :, 0])
    np.testing.assert_array_equal(read["Variance.G"], film["variance"][:, :, 1] * 8)
    film.save(path, layer_names="blender")
    read = channels(path)
    np.testing.assert_array_equal(read["ViewLayer.Combined.G"], film.image[:, :, 1])
    np.testing.assert_array_equal(read["ViewLayer.Depth.Z"], film["depth"])


def test_colours_may_be_half_floats(film: wend.Film, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "a.exr"
    film.save(path, exr="half")
    read = channels(path)
    assert read["R"].dtype == np.float16 and read["albedo.B"].dtype == np.float16
    assert read["depth.Z"].dtype == np.float32 and read["variance.R"].dtype == np.float32
    np.testing.assert_array_equal(read["depth.Z"], film["depth"])
    with pytest.raises(wend.InputError, match="expected float or half"):
        film.save(path, exr="double")
    with pytest.raises(wend.InputError, match="expected wend, pbrt or blender"):
        film.save(path, layer_names="maya")


def test_parts_of_blenders_files_are_layers(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "b.exr"
    colour = np.arange(24, dtype=np.float32).reshape(2, 3, 4)
    parts = [
        OpenEXR.Part({}, {f"ViewLayer.Combined.{c}": colour[:, :, i].copy() for i, c in enumerate("RGBA")},
                     name="ViewLayer.Combined"),
        OpenEXR.Part({}, {"ViewLayer.Depth.Z": colour[:, :, 1].copy()}, name="ViewLayer.Depth"),
    ]
    OpenEXR.File(parts).write(str(path))
    film = wend.read(path)
    np.testing.assert_array_equal(film.image, colour[:, :, :3])
    np.testing.assert_array_equal(film["alpha"], colour[:, :, 3])
    np.testing.assert_array_equal(film["depth"], colour[:, :, 1])



def test_objects_are_found_by_their_names(tmp_path: pathlib.Path) -> None:
    scene = wend.loads(SPHERE.replace('Shape "sphere"', 'Shape "sphere" "string name" "ball"'))
    film = wend.render(scene, sampling="classical", seed=3, layers=["cryptomatte", "direct", "indirect", "background"],
                       progress=False)
    np.testing.assert_allclose(film["direct"] + film["indirect"] + film["background"], film.image, rtol=1e-5)
    path = tmp_path / "a.exr"
    film.save(path, layer_names="blender", exr="half")
    header = OpenEXR.File(str(path)).header()
    key = next(name for name, text in header.items() if text == "ViewLayer.CryptoObject").removesuffix("/name")
    assert key == "cryptomatte/542cafa"  # as Blender calls it
    number = int(json.loads(header[f"{key}/manifest"])["ball"], 16)
    read = channels(path)
    ids, coverage = (read[f"ViewLayer.CryptoObject00.{c}"] for c in "rg")
    assert coverage.dtype == np.float32
    mask = np.where(ids.view(np.uint32) == number, coverage, 0)
    np.testing.assert_allclose(mask, film["alpha"], atol=1e-6)


def test_layers_that_there_are_not(film: wend.Film) -> None:
    with pytest.raises(wend.InputError, match="there is no 'shadows'"):
        wend.render(wend.loads(SPHERE), layers=["shadows"], progress=False)


def oiiotool(*arguments: object) -> str:
    program = shutil.which("oiiotool")
    if not program:
        pytest.skip("oiiotool is not installed")
    return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


@pytest.mark.parametrize(("names", "depth", "albedo"), [("wend", "depth.Z", "albedo"), ("pbrt", "depth.Z", "Albedo"),
                                                        ("blender", "ViewLayer.Depth.Z", "ViewLayer.Denoising Albedo")])
@pytest.mark.parametrize(("exr", "rounding"), [("float", 0), ("half", 2**-11)])
def test_oiiotool_reads_channels_and_values(film: wend.Film, tmp_path: pathlib.Path, names: str, depth: str, albedo: str,
                                            exr: str, rounding: float) -> None:
    path, taken = tmp_path / "a.exr", tmp_path / "taken.exr"
    film.save(path, layer_names=names, exr=exr)
    about = oiiotool("--info", "-v", path)
    assert "16 x   12" in about
    said = about.split("channel list:")[1].splitlines()[0]
    listed = {name.split("(")[0].strip() for name in said.split(",")}
    assert listed == set(channels(path))
    assert "samplesPerPixel: 8" in about and "seed: 3" in about
    # What it takes for three channels, under names of its own.
    for source, layer in ((f"{albedo}.R,{albedo}.G,{albedo}.B", "albedo"), (f"{depth},{depth},{depth}", "depth")):
        oiiotool(path, "--ch", source, "--chnames", "R,G,B", "-d", "float", "-o", taken)
        ours = film[layer] if film[layer].ndim == 3 else np.dstack([film[layer]] * 3)
        np.testing.assert_allclose(wend.read(taken).image, ours, rtol=0 if layer == "depth" else rounding)


def test_parts_that_oiiotool_writes_are_layers(film: wend.Film, tmp_path: pathlib.Path) -> None:
    path, far, both = tmp_path / "a.exr", tmp_path / "far.exr", tmp_path / "both.exr"
    film.save(path)
    oiiotool(path, "--ch", "depth.Z", "--chnames", "Z", "--attrib", "oiio:subimagename", "far", "-o", far)
    oiiotool(path, "--ch", "R,G,B", "--attrib", "oiio:subimagename", "rgb", far, "--siappend", "-o", both)
    again = wend.read(both)
    np.testing.assert_array_equal(again.image, film.image)
    np.testing.assert_array_equal(again["far"], film["depth"])
