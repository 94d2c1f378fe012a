#!/usr/bin/env python3
"""Renders the pictures of the gallery: each scene classically and with every decision guided, in equal time.

usage: make_gallery.py WEND [SCENE...]    WEND is the program; without scenes, all of them are rendered

The pictures go to docs/site/gallery, with what was rendered and how in gallery.json. Both of a scene are rendered at once,
so that they share the processors evenly whatever else runs. All of them take ten minutes.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
PICTURES = HERE / "gallery"
RECORD = PICTURES / "gallery.json"

SECONDS = 40
# How unlike the processor times of a pair may be, and how often it is tried.
LARGEST_RATIO = 1.1
TRIES = 3
PRESETS = {
    "classical": ["--sampling", "classical", "--subsurface", "classical"],
    "full": [],
}
SCENES = [
    "smoke-room", "cloud", "fog-door", "candles", "liquid", "skin-rig", "wax-backlit", "milk-key", "marble-sky", "shield-duct",
]


def command(scene: str, preset: str) -> list[str]:
    """What is said to the program, as one would from the repository."""
    picture = f"docs/site/gallery/{scene}-{preset}.jpg"
    return ["render", f"scenes/{scene}.pbrt", "--time", str(SECONDS), *PRESETS[preset], "-o", picture]


def render_at_once(program: str, scene: str) -> dict:
    """Both pictures of a scene; what was said, and what came of it."""
    runs = {}
    for preset in PRESETS:
        words = [program, *command(scene, preset), "--json", "-", "--quiet"]
        runs[preset] = subprocess.Popen(words, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    pair = {}
    for preset, run in runs.items():
        assert run.stdout is not None  # it is a pipe
        printed = run.stdout.read()
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
        if run.returncode != 0:
            sys.exit(f"make_gallery.py: {scene}, {preset}: the program ended with status {run.returncode}")
        pair[preset] = {
            "command": " ".join(["wend", *command(scene, preset)]),
            "spp": json.loads(printed)["spp"],
            "processor_seconds": round(usage.ru_utime + usage.ru_stime, 1),
        }
    return pair


def render_pair(program: str, scene: str) -> dict:
    """Both pictures of a scene, again if they had unlike shares of the processors."""
    for _ in range(TRIES):
        pair = render_at_once(program, scene)
        print(scene, *(f"{name}: {it['spp']} samples, {it['processor_seconds']} s" for name, it in pair.items()), sep="; ", flush=True)
        times = [it["processor_seconds"] for it in pair.values()]
        if max(times) < LARGEST_RATIO * min(times):
            return pair
    sys.exit(f"make_gallery.py: {scene}: the pictures had unlike shares of the processors {TRIES} times; try again when the machine is idle")


def main(program: str, scenes: list[str]) -> None:
    PICTURES.mkdir(exist_ok=True)
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    for scene in scenes or SCENES:
        record[scene] = render_pair(program, scene)
        RECORD.write_text(json.dumps({name: record[name] for name in SCENES if name in record}, indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    unknown = sorted(set(sys.argv[2:]) - set(SCENES))
    if unknown:
        sys.exit(f"make_gallery.py: not in the gallery: {', '.join(unknown)}; it has {', '.join(SCENES)}")
    main(str(Path(sys.argv[1]).resolve()), sys.argv[2:])
