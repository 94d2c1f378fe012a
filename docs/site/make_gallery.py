#!/usr/bin/env python3
"""Renders the pictures of the gallery: each scene classically and guided, in equal time.

They go to docs/site/gallery, with what was rendered and how in gallery.json; the reference beside each scene is put there as
well. Both renders of a scene run at once, so that they share the processors evenly whatever else runs. PYTHONPATH has to have
the package wend (build/release/python).
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import wend

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
PICTURES = HERE / "gallery"
RECORD = PICTURES / "gallery.json"

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


def command(scene: str, preset: str, seconds: int) -> list[str]:
    """What is said to the program, as one would from the repository."""
    picture = f"docs/site/gallery/{scene}-{preset}.jpg"
    return ["render", f"scenes/{scene}.pbrt", "--time", str(seconds), *PRESETS[preset], "-o", picture]


def render_at_once(program: Path, scene: str, seconds: int) -> dict:
    """Both pictures of a scene; what was said, and what came of it."""
    runs = {}
    for preset in PRESETS:
        words = [program, *command(scene, preset, seconds), "--json", "-", "--quiet"]
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
            "command": " ".join(["wend", *command(scene, preset, seconds)]),
            "spp": json.loads(printed)["spp"],
            "processor_seconds": round(usage.ru_utime + usage.ru_stime, 1),
        }
    return pair


def render_pair(program: Path, scene: str, seconds: int) -> dict:
    """Both pictures of a scene, again if they had unlike shares of the processors."""
    for _ in range(TRIES):
        pair = render_at_once(program, scene, seconds)
        print(scene, *(f"{name}: {it['spp']} samples, {it['processor_seconds']} s" for name, it in pair.items()), sep="; ", flush=True)
        times = [it["processor_seconds"] for it in pair.values()]
        if max(times) < LARGEST_RATIO * min(times):
            return pair
    sys.exit(f"make_gallery.py: {scene}: the pictures had unlike shares of the processors {TRIES} times; try again when the machine is idle")


def save_reference(scene: str) -> None:
    """The mean of both halves of the reference, as a picture."""
    halves = [wend.read(str(ROOT / "scenes" / f"{scene}.ref-{half}.exr")).image for half in "ab"]
    wend.Film.of((halves[0] + halves[1]) / 2).save(str(PICTURES / f"{scene}-reference.jpg"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="wend")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"of {', '.join(SCENES)} (default: all)")
    parser.add_argument("--time", type=int, default=40, help="seconds for each pair (default: 40)")
    options = parser.parse_intermixed_args()
    unknown = sorted(set(options.scenes) - set(SCENES))
    if unknown:
        parser.error(f"not in the gallery: {', '.join(unknown)}; it has {', '.join(SCENES)}")
    PICTURES.mkdir(exist_ok=True)
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    for scene in options.scenes or SCENES:
        record[scene] = render_pair(options.program.resolve(), scene, options.time)
        save_reference(scene)
        RECORD.write_text(json.dumps({name: record[name] for name in SCENES if name in record}, indent=2) + "\n")


if __name__ == "__main__":
    main()
