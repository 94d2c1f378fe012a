#!/usr/bin/env python3
"""Whether two builds of wend make the same pictures, bit by bit: for changes that must not change what is computed.

usage: same_pictures.py OLD NEW [--resolution WxH] [--spp N] [SCENE...]

OLD and NEW are programs. Scenes are files; the default is those of the project. Each is rendered with every preset of
--sampling and --subsurface. Exit status 1 and one line for each picture that differs.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SAMPLING = ["classical", "scatter", "distance", "direction", "roulette", "splitting", "full"]
SUBSURFACE = ["classical", "dwivedi", "closest", "incident", "auto"]


def presets():
    """Each of one with the default of the other."""
    return [(sampling, "auto") for sampling in SAMPLING] + [("full", s) for s in SUBSURFACE if s != "auto"]


def render(program, scene, preset, picture, arguments):
    sampling, subsurface = preset
    command = [program, "render", scene, "-o", picture, "--sampling", sampling, "--subsurface", subsurface, "--quiet",
               "--resolution", arguments.resolution, "--spp", str(arguments.spp), "--seed", "3"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def differs(program, one, other):
    """The metric sums squares in double precision, where no difference of two floats is too small to count."""
    report = subprocess.run([program, "metric", one, other, "--json", "-", "--quiet"], check=True, capture_output=True)
    return json.loads(report.stdout)["rows"][0]["mse"] != 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("scenes", nargs="*", default=sorted((Path(__file__).parents[1] / "scenes").glob("*.pbrt")))
    parser.add_argument("--resolution", default="32x18")
    parser.add_argument("--spp", type=int, default=12)
    arguments = parser.parse_args()
    different = compared = 0
    with tempfile.TemporaryDirectory() as folder:
        pictures = [Path(folder) / "old.exr", Path(folder) / "new.exr"]
        for scene in arguments.scenes:
            for preset in presets():
                for program, picture in zip((arguments.old, arguments.new), pictures):
                    render(program, scene, preset, picture, arguments)
                compared += 1
                if differs(arguments.new, *pictures):
                    different += 1
                    print(f"{scene} --sampling {preset[0]} --subsurface {preset[1]}: another picture")
    print(f"{compared - different} of {compared} pictures are the same")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
