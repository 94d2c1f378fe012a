"""The gallery's page, of the pictures that make_gallery.py left and of what it noted about them."""

import json
import os
import re

from .layout import Layout
from .options import SPECIAL

PICTURES = "docs/site/gallery"
HEAD = """# Gallery

Below each picture are two renders of the same scene in the same time: on the left by classical path tracing, on the right by the default, `full`, which guides every decision where that pays. Training counts. Both converge to the same image; only their noise differs. Above them is the reference, of many more samples. It has some noise of its own where light is hard to find, as in the caustics of `liquid`.

Times are those of the processors, summed over threads; the machine had other work to do as well. The scenes are files of this repository, and the commands are those that made the pictures: `docs/site/make_gallery.py` runs both of a pair at once. [Scenes](project/scenes.md) has the measured errors.
"""


def stage_gallery(layout: Layout) -> None:
    record = json.loads((layout.root / PICTURES / "gallery.json").read_text())
    layout.write("gallery.md", "\n".join([HEAD, *(section(layout, scene, pair) for scene, pair in record.items())]))


def about(layout: Layout, scene: str) -> str:
    """The comment that a scene's file begins with."""
    lines = []
    for line in (layout.root / "scenes" / f"{scene}.pbrt").read_text().split("\n"):
        if not line.startswith("#"):
            break
        lines.append(line.removeprefix("#").strip())
    return SPECIAL.sub(r"\\\1", " ".join(lines))


def figure(layout: Layout, name: str, caption: str) -> list[str]:
    file = os.path.relpath(layout.root / PICTURES / f"{name}.jpg", layout.pages)
    return [f"```{{figure}} {file}", f":alt: {name}", ":width: 100%", "", caption, "```"]


def section(layout: Layout, scene: str, pair: dict) -> str:
    lines = [f"## {scene}", "", about(layout, scene), "", *figure(layout, f"{scene}-reference", "the reference"), ""]
    lines += ["::::{grid} 1 2 2 2", ":gutter: 1", ""]
    for preset, what in pair.items():
        label = "guided" if preset == "full" else "classical"
        caption = f"{label}: {what['spp']} samples, {what['processor_seconds']:.0f} s"
        lines += [":::{grid-item}", *figure(layout, f"{scene}-{preset}", caption), ":::"]
    scene_link = layout.link(f"../../scenes/{scene}.pbrt", "docs/site/index.md")
    commands = [re.sub(r" -o \S+/", " -o ", what["command"]) for what in pair.values()]
    return "\n".join([*lines, "::::", "", "```sh", *commands, "```", "", f"[scenes/{scene}.pbrt]({scene_link})", ""])
