#!/usr/bin/env python3
"""Renders the pictures of the gallery: each scene classically and with all decisions guided, in equal time.

usage: make_gallery.py WEND [SCENE...]    WEND is the program; without scenes, all of them are rendered

The pictures go to docs/site/gallery, with what was rendered and how in gallery.json. They take a minute for each scene.
"""

import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
PICTURES = HERE / "gallery"
RECORD = PICTURES / "gallery.json"

SECONDS = 25
RESOLUTION = "480x270"
PRESETS = {
    "classical": ["--sampling", "classical", "--subsurface", "classical"],
    "full": [],
}
SCENES = [
    "smoke-room", "cloud", "fog-door", "candles", "liquid", "skin-rig", "wax-backlit", "milk-key", "marble-sky", "leaf", "shield-duct",
]


def command(scene: str, preset: str) -> list[str]:
    """What is said to the program, as one would from the repository."""
    picture = f"docs/site/gallery/{scene}-{preset}.jpg"
    return ["render", f"scenes/{scene}.pbrt", "--resolution", RESOLUTION, "--time", str(SECONDS), *PRESETS[preset], "-o", picture]


def render(program: str, scene: str, preset: str) -> dict:
    words = command(scene, preset)
    run = subprocess.run([program, *words, "--json", "-", "--quiet"], cwd=ROOT, check=True, capture_output=True, text=True)
    result = json.loads(run.stdout)
    print(f"{scene}, {preset}: {result['spp']} samples in {result['seconds']:.1f} s", flush=True)
    return {"command": " ".join(["wend", *words]), "spp": result["spp"], "seconds": round(result["seconds"], 1)}


def main(program: str, scenes: list[str]) -> None:
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    for scene in scenes or SCENES:
        record[scene] = {preset: render(program, scene, preset) for preset in PRESETS}
        RECORD.write_text(json.dumps({name: record[name] for name in SCENES if name in record}, indent=2) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    unknown = sorted(set(sys.argv[2:]) - set(SCENES))
    if unknown:
        sys.exit(f"make_gallery.py: no scenes of the gallery: {', '.join(unknown)}; it has {', '.join(SCENES)}")
    main(str(Path(sys.argv[1]).resolve()), sys.argv[2:])
