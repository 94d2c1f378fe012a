#!/usr/bin/env python3
"""What Open Image Denoise makes of pictures, by what it is told beside the colours.

usage: bench/denoising.py [--wend BIN] [--oidn PATH] [--spp N] [--seeds N ...] [--scenes NAME ...]

Renders each scene of scenes/ and denoises it by its colours alone, by its layers without `volume`, and as `wend render
--denoise` does. Prints relMSE against the scene's reference as a table of docs/experiments/denoising.md.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What is rendered, and whether it is denoised: options of `wend render`.
COLOURS, LAYERS, DENOISED = ["--half"], [], ["--denoise"]


def errors_of(wend, scene, pictures):
    """relMSE of each picture against the scene's reference."""
    answer = subprocess.run([wend, "metric", ROOT / "scenes" / scene, *pictures, "--json", "-", "--quiet"], check=True,
                            capture_output=True, text=True)
    return [picture["relmse"] for picture in json.loads(answer.stdout)["rows"]]


def row_of(options, scene, seed, folder):
    """Errors raw, of the colours alone, without the layer of media, and as --denoise does it."""
    library = ["--oidn", options.oidn] if options.oidn else []
    render = [options.wend, "render", ROOT / "scenes" / f"{scene}.pbrt", "--spp", str(options.spp), "--seed", str(seed),
              "--quiet"]
    raw, colours = folder / "raw.exr", folder / "colours.exr"
    pictures = [raw, *(folder / f"{name}.exr" for name in ("by_colours", "by_layers", "denoised"))]
    subprocess.run([*render, "-o", raw, *LAYERS], check=True)
    subprocess.run([*render, "-o", colours, *COLOURS], check=True)
    subprocess.run([*render, "-o", pictures[3], *DENOISED, *library], check=True)
    for source, target in ((colours, pictures[1]), (raw, pictures[2])):
        subprocess.run([options.wend, "denoise", source, "-o", target, "--quiet", *library], check=True)
    return errors_of(options.wend, scene, pictures)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wend", default=str(ROOT / "build/release/bin/wend"))
    parser.add_argument("--oidn", help="the library, if wend does not find it by itself")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seeds", type=int, nargs="+", default=[5])
    parser.add_argument("--scenes", nargs="+", default=sorted(p.name.removesuffix(".ref-a.exr") for p in (ROOT / "scenes").glob("*.ref-a.exr")))
    options = parser.parse_args()
    print("| scene | seed | raw | colours alone | without `volume` | `--denoise` |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            for seed in options.seeds:
                errors = row_of(options, scene, seed, Path(folder))
                print(f"| `{scene}` | {seed} | " + " | ".join(f"{error:.3g}" for error in errors) + " |", flush=True)


if __name__ == "__main__":
    main()
