"""The gallery's page, of the pictures that make_gallery.py left and of what it noted about them."""

import json
import os
import re

from .layout import Layout
from .options import SPECIAL

PICTURES = "docs/site/gallery"
HEAD = """# Gallery

Each scene is rendered twice in the same time of two cores: on the left by classical path tracing, on the right with every decision guided. Training counts. Both pictures converge to the same one; only their noise differs.

The times below are those of the processors, summed over threads. The scenes are files of this repository, and the commands are those that made the pictures: `docs/site/make_gallery.py` runs both of a pair at once. [Scenes](project/scenes.md) has the measured errors.
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


def section(layout: Layout, scene: str, pair: dict) -> str:
    lines = [f"## {scene}", "", about(layout, scene), "", "::::{grid} 1 2 2 2", ":gutter: 1", ""]
    for preset, what in pair.items():
        file = os.path.relpath(layout.root / PICTURES / f"{scene}-{preset}.jpg", layout.pages)
        label = "every decision guided" if preset == "full" else "classical"
        lines += [
            ":::{grid-item}",
            f"```{{figure}} {file}",
            f":alt: {scene}, {label}",
            "",
            f"{label}: {what['spp']} samples, {what['processor_seconds']:.0f} s",
            "```",
            ":::",
        ]
    scene_link = layout.link(f"../../scenes/{scene}.pbrt", "docs/site/index.md")
    commands = [re.sub(r" -o \S+/", " -o ", what["command"]) for what in pair.values()]
    return "\n".join([*lines, "::::", "", "```sh", *commands, "```", "", f"[scenes/{scene}.pbrt]({scene_link})", ""])
