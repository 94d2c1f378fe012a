import copy
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import wend

from conftest import SCENES


def same(a: wend.Film, b: wend.Film) -> bool:
    return set(a) == set(b) and all(np.array_equal(a[name], b[name]) for name in a)


def test_the_same_bits_as_the_program(program, tmp_path):
    scene = SCENES / "demo.pbrt"
    for sampling in ("classical", "full"):
        file = tmp_path / f"{sampling}.exr"
        options = ["--spp", "7", "--resolution", "32x18", "--sampling", sampling, "--seed", "3", "--quiet"]
        subprocess.run([program, "render", scene, *options, "-o", file], check=True)
        film = wend.render(
            wend.load(scene, resolution=(32, 18)), spp=7, sampling=sampling, seed=3, progress=False
        )
        written = wend.read(file)
        assert same(film, written)
        assert film.metadata == written.metadata


def test_a_furnace_is_white(furnace):
    for sampling in ("classical", "full", "distance+direction"):
        film = wend.render(furnace, spp=64, sampling=sampling, progress=False)
        # The mean of 64 pixels; each one's variance is on the film.
        error = float(np.sqrt(film["variance"].mean(axis=2).sum())) / 64
        assert float(film.image.mean()) == pytest.approx(1, abs=4 * error + 1e-4)


def test_a_film_is_arrays(demo):
    film = wend.render(demo, spp=3, progress=False)
    assert film.image.shape == (18, 32, 3) and film.image.dtype == np.float32
    assert film["variance"].shape == (18, 32, 3) and film["depth"].shape == (18, 32)
    assert np.shares_memory(film.image, film.image)
    assert "albedo" in film and "nothing" not in film
    with pytest.raises(KeyError, match="albedo"):
        film["nothing"]
    assert np.array_equal(np.asarray(film), film.image)
    assert film._repr_png_().startswith(b"\x89PNG")
    assert film.statistics["spp"] == 3 and film.statistics["passes"] == [1, 2]


def test_saving_and_reading(demo, tmp_path):
    film = wend.render(demo, spp=2, progress=False)
    film.save(tmp_path / "a.exr")
    assert same(film, wend.read(tmp_path / "a.exr"))
    film.save(tmp_path / "a.png")
    assert wend.read(tmp_path / "a.png").image.shape == film.image.shape
    film.save(tmp_path / "half.exr", half=True)
    with pytest.raises(wend.InputError):
        film.save(tmp_path / "a.txt")
    with pytest.raises(wend.InputError, match="no-folder") as caught:
        film.save(tmp_path / "no-folder" / "a.exr")
    assert caught.value.file == str(tmp_path / "no-folder" / "a.exr")
    with pytest.raises(wend.InputError):
        wend.read(tmp_path / "missing.exr")


def test_steps_passes_and_the_whole_agree(demo):
    whole = wend.render(demo, spp=15, progress=False)
    render = wend.Render(demo, spp=15)
    spp = [film.statistics["spp"] for film in render.passes()]
    assert spp == [1, 3, 7, 15]
    assert same(whole, render.film)
    again = wend.Render(demo, spp=15)
    while again.step(0.001):
        assert 0 <= again.progress["fraction"] <= 1
    assert same(whole, again.film)


def test_threads_do_not_matter(demo):
    assert same(
        wend.render(demo, spp=7, threads=1, progress=False), wend.render(demo, spp=7, threads=2, progress=False)
    )


def test_saved_and_resumed(demo, tmp_path):
    whole = wend.render(demo, spp=15, progress=False)
    first = wend.Render(demo, spp=15, keep_fields=False)
    first.step()
    first.step(0.001)
    first.save(tmp_path / "checkpoint")
    second = wend.Render(demo, spp=15, keep_fields=False)
    second.resume(tmp_path / "checkpoint")
    assert same(whole, second.run())
    other = wend.Render(demo, spp=15, seed=99)
    with pytest.raises(wend.InputError, match="seed"):
        other.resume(tmp_path / "checkpoint")


def test_fields_carry_over(demo, tmp_path):
    render = wend.Render(demo, spp=15)
    render.run()
    fields = render.fields
    assert fields.surface.is_trained and len(fields.volume) > 0
    fields.save(tmp_path / "field")
    loaded = wend.guide.Fields.load(tmp_path / "field")
    assert loaded.volume.to_bytes() == fields.volume.to_bytes()
    film = wend.render(demo, spp=4, fields=loaded, progress=False)
    assert np.isfinite(film.image).all()
    assert wend.Render(demo, spp=1, sampling="classical").fields is None
    with pytest.raises(wend.InputError, match="classical"):
        wend.Render(demo, sampling="classical", fields=loaded)


@pytest.mark.parametrize(
    "options, message",
    [
        ({"spp": 1, "time": 1}, "one of"),
        ({"spp": -1}, "positive"),
        ({"time": float("nan")}, "positive"),
        ({"sampling": "magic"}, "magic"),
        ({"subsurface": "magic"}, "magic"),
        ({"spp": 0.5}, "spp: expected a positive whole number"),
        ({"spp": "4"}, "spp"),
        ({"spp": 10**12}, "spp"),
        ({"passes": [1, 1.5]}, "passes"),
        ({"seed": -1}, "seed"),
        ({"seed": 1 << 64}, "seed"),
        ({"threads": -1}, "threads"),
        ({"threads": 10**6}, "threads: expected a whole number from 0 to 4096"),
        ({"layers": "volume"}, "layers: expected a list of names"),
    ],
)
def test_arguments_are_checked(demo, options, message):
    with pytest.raises(wend.InputError, match=message):
        wend.Render(demo, **options)


def test_numbers_of_other_types_are_numbers(demo):
    render = wend.Render(demo, spp=np.float32(3), seed=np.uint64((1 << 64) - 1), passes=None, threads=np.int8(1))
    assert render.run().statistics["spp"] == 3
    assert wend.Render(demo, passes=np.array([1, 2])).run().statistics["passes"] == [1, 2]


def test_names_alone_are_no_lists(demo):
    with pytest.raises(wend.InputError, match="sampling: expected a list"):
        wend.compare(demo, time=1, sampling="full")


def test_what_is_no_scene_is_named():
    with pytest.raises(TypeError, match="wend.Scene"):
        wend.Render("room.pbrt")
    with pytest.raises(TypeError, match="wend.Fields"):
        wend.Render(wend.load(wend.demo_scene(), resolution=(4, 4)), fields=3)


def test_no_number_of_threads_is_too_large_for_the_guide(furnace):
    render = wend.Render(furnace, spp=7)
    render.run()
    places = np.zeros((2000, 3), np.float32)
    assert np.array_equal(
        render.fields.volume.fluence(places), render.fields.volume.fluence(places, threads=10**6)
    )


def test_a_render_is_neither_copied_nor_pickled(demo):
    render = wend.Render(demo, spp=1)
    for attempt in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="save it"):
            attempt(render)


def test_what_has_ended_goes_back_to_a_checkpoint(demo, tmp_path):
    render = wend.Render(demo, spp=7)
    render.step()
    render.save(tmp_path / "checkpoint")
    whole = render.run()
    render.resume(tmp_path / "checkpoint")
    assert render.progress["spp"] == 1
    assert same(whole, render.run())
    with pytest.raises(wend.InputError, match="no folder"):
        render.save(tmp_path / "none" / "checkpoint")


def test_another_thread_may_stop_it(demo):
    render = wend.Render(demo, spp=1 << 20)
    worker = threading.Thread(target=render.run)
    worker.start()
    time.sleep(0.3)
    render.stop()
    # `run` looks whether it was stopped.
    worker.join(timeout=30)
    assert not worker.is_alive()
    assert render.film.statistics["spp"] < 1 << 20


def test_control_c_ends_it(tmp_path):
    code = (
        "import wend\n"
        "scene = wend.load(wend.demo_scene(), resolution=(32, 18))\n"
        "print('go', flush=True)\n"
        "try:\n"
        "    wend.render(scene, spp=1 << 20, progress=False)\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted')\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out == "interrupted\n"


def test_control_c_ends_a_step_within_a_pass():
    # A pass takes seconds.
    render = wend.Render(wend.load(wend.demo_scene(), resolution=(960, 540)), spp=1, threads=1)
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        render.step()
    timer.join()
    assert render.progress["spp"] == 0 and 0 < render.progress["fraction"] < 1
    assert render.step(0.01), "it goes on"


def test_merging(demo):
    films = [wend.render(demo, spp=8, seed=seed, progress=False) for seed in (1, 2, 3)]
    merged = wend.merge(films)
    assert sum(merged.statistics["shares"]) == pytest.approx(1)
    assert merged["variance"].mean() < films[0]["variance"].mean()
    with pytest.raises(wend.InputError, match="seed"):
        wend.merge([films[0], films[0]])
    with pytest.raises(wend.InputError, match="two"):
        wend.merge(films[:1])


def test_metrics():
    reference = np.full((20, 30, 3), 2.0, dtype=np.float32)
    measured = wend.metric(reference * 1.1, reference)
    assert measured["mse"] == pytest.approx(0.04, rel=1e-4)
    assert measured["relmse"] == pytest.approx(0.04 / (4 + 0.01 * 4), rel=1e-4)
    assert wend.metric(reference, (reference, reference))["flip"] == 0
    with pytest.raises(wend.InputError, match="size|20|30"):
        wend.metric(reference[:10], reference)
    with pytest.raises(wend.InputError, match="shape"):
        wend.metric(np.zeros(5), reference)


def test_comparing(demo, tmp_path):
    reference = wend.render(demo, spp=32, progress=False)
    comparison = wend.compare(
        demo, time=0.3, seeds=2, sampling=["classical", "full"], reference=reference, progress=False
    )
    rows = comparison.rows
    assert list(rows["sampling"]) == ["classical", "full"]
    assert rows["ratio"][0] == pytest.approx(1)
    assert len(comparison.runs["seed"]) == 4
    assert set(comparison.curves) == {"sampling", "seed", "spp", "seconds", "work", "relmse", "relmse_trimmed"}
    assert set(comparison.runs) >= {"sampling", "seed", "spp", "seconds", "work", "relmse", "relmse_trimmed", "ratio"}
    for name, errors in comparison.errors.items():
        mean = comparison.runs["relmse"][comparison.runs["sampling"] == name].mean()
        assert errors["relative_squared"].mean() == pytest.approx(mean, rel=1e-4)
        assert rows["relmse_mean"][list(rows["sampling"]).index(name)] == pytest.approx(mean)
    assert comparison.reference["noise"] is None
    assert comparison.films["full"].image.shape == (18, 32, 3)
    assert "iframe" in comparison._repr_html_()
    comparison.save(tmp_path / "page")
    assert (tmp_path / "page" / "index.html").exists()
    assert (tmp_path / "page" / "runs.csv").read_text().count("\n") == 1 + 4
    with pytest.raises(ValueError, match="reference"):
        wend.compare(demo, reference=reference, reference_spp=4, progress=False)
    with pytest.raises(wend.InputError, match="the picture 32 x 18"):
        wend.compare(demo, reference=np.ones((9, 16, 3), np.float32), progress=False)
    with pytest.raises(wend.InputError, match="magic"):
        wend.compare(demo, sampling=["magic"], reference=reference, progress=False)


def test_comparing_scenes(demo, tmp_path):
    compared = wend.compare_scenes(
        {"one": demo, "other": demo}, time=0.1, seeds=1, sampling=["classical", "full"], reference="render",
        reference_spp=4, progress=False,
    )
    assert list(compared) == ["one", "other"]
    assert list(compared.rows["scene"]) == ["one", "one", "other", "other"]
    assert compared["one"].reference["halves"][0]["spp"] == 4
    assert compared["one"].reference["noise"] > 0
    gains = compared.gains
    assert list(gains["sampling"]) == ["full"]
    ratios = compared.rows["ratio"][compared.rows["sampling"] == "full"]
    if (ratios > 0).all():
        assert gains["geometric_mean"][0] == pytest.approx(np.sqrt(ratios.prod()))
        assert gains["worst"][0] == ("one" if ratios[0] <= ratios[1] else "other")
    compared.save(tmp_path / "report")
    for name in ("index.html", "rows.csv", "one/index.html", "other/full-error.exr"):
        assert (tmp_path / "report" / name).exists()
