"""The live view in a real browser: what a person sees there and does."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")
CHROMIUM = shutil.which("chromium")
if CHROMIUM is None:
    pytest.skip("there is no chromium", allow_module_level=True)

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "fog-door.pbrt"
PATIENCE = 60_000  # milliseconds; for machines that are busy


class View:
    """`wend view` with its address."""

    def __init__(self, folder, *arguments):
        self.process = subprocess.Popen(
            [os.environ["WEND_PROGRAM"], "view", *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        assert self.url.startswith("http://127.0.0.1:")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=60)


@pytest.fixture(scope="module")
def browser():
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


def open_page(browser, url, **choices):
    """A page on which nothing goes wrong unnoticed."""
    page = browser.new_page(**choices)
    page.problems = []
    page.on("pageerror", lambda error: page.problems.append(str(error)))
    page.on("console", lambda message: message.type == "error" and page.problems.append(message.text))
    page.set_default_timeout(PATIENCE)
    page.goto(url)
    page.wait_for_selector("#empty", state="hidden")
    return page


def wait_for_text(page, selector, pattern):
    page.locator(selector).filter(has_text=re.compile(pattern)).first.wait_for()


def click_picture(page, x, y):
    box = page.locator("#stage").bounding_box()
    page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])


def test_a_render_is_watched_asked_stopped_and_saved(browser, tmp_path):
    with View(tmp_path, SCENE, "--resolution", "160x90", "--sampling", "direction+distance", "-o", "now.exr") as view:
        page = open_page(browser, view.url)
        wait_for_text(page, "#bars", r"[1-9]\d* spp")
        click_picture(page, 0.3, 0.6)
        page.wait_for_selector("#guide:not([hidden])")
        assert "through a medium" in page.inner_text("#where")
        wait_for_text(page, "#share", "of directions are drawn classically")
        wait_for_text(page, "#seen-caption", r"what [1-9]\d* records saw")
        assert page.locator("#flight-plot rect").count() > 10
        wait_for_text(page, "#values", "pixel .* beauty")

        page.select_option("#layer", "noise")
        wait_for_text(page, "#scale", "noise: dark")
        page.click("#pause")
        wait_for_text(page, "#bars", "paused")
        time.sleep(0.5)
        before = page.inner_text("#bars")
        time.sleep(1)
        assert page.inner_text("#bars") == before, "nothing goes on"
        page.click("#go-on")
        wait_for_text(page, "#bars", "learning|rendering")
        page.click("#save")
        wait_for_text(page, "#note", "written: now.exr")
        assert (tmp_path / "now.exr").stat().st_size > 160 * 90
        assert page.problems == []
        assert view.end() == 128 + signal.SIGINT


def test_presets_have_equal_time_and_more_of_it(browser, tmp_path):
    with View(tmp_path, SCENE, "--resolution", "80x45", "--sampling", "full,classical", "--time", "1.5") as view:
        page = open_page(browser, view.url)
        page.locator("#bars .bar:nth-child(1)").filter(has_text="done").wait_for()
        page.locator("#bars .bar:nth-child(2)").filter(has_text="done").wait_for()
        seconds = [float(s) for s in re.findall(r"in ([\d.]+) s", page.inner_text("#bars"))]
        assert len(seconds) == 2 and max(seconds) - min(seconds) < 1
        page.select_option("#mode", "difference")
        wait_for_text(page, "#scale", "Relative difference")
        assert page.is_hidden("#split"), "a difference has no divider"
        page.click("#more")
        wait_for_text(page, "#bars", "learning|rendering")
        page.select_option("#restart-of", "1")
        page.select_option("#restart-sampling", "direction")
        page.click("#restart button")
        wait_for_text(page, "#bars", "direction")
        assert page.problems == []


def test_keys_do_what_the_mouse_does(browser, tmp_path):
    with View(tmp_path, SCENE, "--resolution", "80x45") as view:
        page = open_page(browser, view.url)
        page.focus("#stage")
        page.keyboard.press("ArrowRight")
        wait_for_text(page, "#values", "pixel 41, 22")
        page.keyboard.press("ArrowUp")
        wait_for_text(page, "#values", "pixel 41, 21")
        page.keyboard.press("Enter")
        page.wait_for_selector("#guide:not([hidden])")
        page.keyboard.press("]")
        assert page.inner_text("#exposure-value") == "0.5 EV"
        assert page.problems == []


@pytest.mark.parametrize("scheme, width", [("light", 1400), ("dark", 1400), ("light", 390), ("dark", 390)])
def test_nothing_is_hard_to_reach_or_to_read(browser, tmp_path, scheme, width):
    with View(tmp_path, SCENE, "--resolution", "80x45", "--sampling", "full,classical", "--time", "2") as view:
        page = open_page(browser, view.url, viewport={"width": width, "height": 800}, color_scheme=scheme)
        wait_for_text(page, "#bars", r"[1-9]\d* spp")
        click_picture(page, 0.3, 0.6)
        page.wait_for_selector("#guide:not([hidden])")
        page.click("summary")
        page.wait_for_timeout(300)
        report = axe.Axe().run(page)
        assert report.violations_count == 0, report.generate_report()
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "it scrolls sideways"


def test_two_viewers_and_one_of_another_origin(browser, tmp_path):
    with View(tmp_path, SCENE, "--resolution", "80x45") as view:
        one, two = open_page(browser, view.url), open_page(browser, view.url)
        wait_for_text(one, "#bars", r"[1-9]\d* spp")
        wait_for_text(two, "#bars", r"[1-9]\d* spp")
        stranger = browser.new_page()
        answer = stranger.evaluate(
            """url => new Promise(resolve => {
                 const socket = new WebSocket(url.replace("http:", "ws:") + "socket");
                 socket.onopen = () => resolve("open");
                 socket.onerror = () => resolve("refused");
               })""", view.url)
        assert answer == "refused"
        assert one.problems == [] and two.problems == []


def test_finished_pictures_are_looked_at_the_same_way(browser, tmp_path):
    for name, seed in (("a.exr", "1"), ("b.exr", "2")):
        subprocess.run([os.environ["WEND_PROGRAM"], "render", str(SCENE), "--resolution", "32x18", "--spp", "2", "--seed",
                        seed, "-o", name, "--quiet"], cwd=tmp_path, check=True)
    with View(tmp_path, "a.exr", "b.exr") as view:
        page = open_page(browser, view.url)
        assert page.inner_text("#title") == "a.exr"
        assert page.inner_text("#run-title") == "Pictures"
        page.select_option("#mode", "difference")
        wait_for_text(page, "#scale", "Relative difference")
        page.select_option("#layer", "depth")
        click_picture(page, 0.5, 0.5)
        wait_for_text(page, "#values", "depth")
        assert page.is_hidden("#pause") and page.is_hidden("#save")
        assert page.problems == []


def test_a_render_of_the_command_line_is_watched_and_ended(browser, tmp_path):
    process = subprocess.Popen(
        [os.environ["WEND_PROGRAM"], "render", str(SCENE), "--resolution", "80x45", "--spp", "100000", "-o", "x.exr",
         "--quiet", "--live"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    try:
        page = open_page(browser, process.stderr.readline().removeprefix("view: ").strip())
        wait_for_text(page, "#bars", r"[1-9]\d* spp")
        page.click("#stop")
        assert process.wait(timeout=60) == 128 + signal.SIGINT
        assert (tmp_path / "x.exr").exists()
        wait_for_text(page, "#status", "has ended")
        assert page.is_disabled("#save"), "there is nobody to save it"
    finally:
        process.kill()
