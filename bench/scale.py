#!/usr/bin/env python3
"""How cost and memory grow with the work: samples, pixels, lights, depth, cells, extent, triangles, instances, grids.

usage: scale.py [AXIS ...] [--wend BIN] [--large] [--page]

Writes its scenes into a temporary folder (bench/scale_scenes.py). Each point is two processes: one that renders one
sample of sixteen by nine pixels, which is what loading costs, and one that renders. Counted are processor seconds of
both, segments of walks, and the most memory. A slope is that of a straight line through the logarithms of the last
three points: 1 is linear, 0 is constant. Rows go to bench/results/scale.json, axis by axis, and all of them into the
page docs/scale.md, which --page alone writes anew.
"""

import argparse
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

import scale_scenes as scenes
from measure import ROOT, git, machine

RESULTS = ROOT / "bench/results/scale.json"
PAGE = ROOT / "docs/scale.md"
LOADING = ["--resolution", "16x9", "--spp", "1", "--sampling", "classical"]


# ------------------------------------------------------------------------------------------------------------- measuring

def run(wend, scene, folder, options):
    """What a render tells, its processor seconds, and the most memory that it had, in MB."""
    told = folder / "told.json"
    command = [wend, "render", scene, "-o", folder / "picture.exr", "--json", told, "--quiet", *map(str, options)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    error = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if status != 0:
        sys.exit(f"{' '.join(map(str, command))}: {error.strip() or process.returncode}")
    return json.loads(told.read_text()), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def made(write, folder, *arguments):
    """By another process: the memory of this one would count for those that it starts."""
    with multiprocessing.Pool(1) as pool:
        return pool.apply(write, (folder, *arguments))


def point(wend, scene, folder, options, **row):
    _, load, _ = run(wend, scene, folder, LOADING)
    told, cpu, megabytes = run(wend, scene, folder, options)
    row |= {"load_cpu": round(load, 3), "cpu": round(max(cpu - load, 0), 3), "megabytes": round(megabytes, 1),
            "paths": told["paths"], "segments": told["segments"], "field_bytes": told["field_bytes"]}
    print("  ".join(f"{k} {v}" for k, v in row.items()), flush=True)
    return row


def squared_error(folder):
    """Of a picture that should be 1 everywhere, and its mean."""
    import OpenEXR
    pixels = OpenEXR.File(str(folder / "picture.exr")).channels()["RGB"].pixels
    return float(((pixels.astype(float) - 1) ** 2).mean()), float(pixels.mean())


def over(name, values, write, options, presets=("full",)):
    """Rows of scenes that grow: what is written, and how it is rendered, by value."""
    def rows(wend, folder, _):
        for value in values:
            scene = made(write, folder, *write_arguments(name, value))
            for preset in presets:
                yield point(wend, scene, folder, [*options, "--sampling", preset], axis=name, value=value, preset=preset)
    return rows


def write_arguments(name, value):
    return ((16, 9) if name == "depth" else (64, 36), value)


def samples(wend, folder, _):
    scene = made(scenes.equilibrium, folder, (8, 4))
    for preset in ("classical", "full"):
        for value in (16, 100, 1000, 10_000, 100_000):
            row = point(wend, scene, folder, ["--spp", value, "--sampling", preset], axis="samples", value=value,
                        preset=preset)
            row["error"], row["mean"] = squared_error(folder)
            yield row


def pixels(axis, sizes, spp):
    def rows(wend, folder, _):
        scene = made(scenes.open_floor, folder, (64, 36))
        for width in sizes:
            height = width * 9 // 16
            yield point(wend, scene, folder, ["--spp", spp, "--resolution", f"{width}x{height}"], axis=axis,
                        value=width * height, preset="full")
    return rows


def extent(wend, folder, _):
    for value in (1, 10, 100, 1000, 10_000, 100_000, 1_000_000):
        scene = made(scenes.equilibrium, folder, (32, 18), 10000, float(value))
        row = point(wend, scene, folder, ["--spp", 31], axis="extent", value=value, preset="full")
        row["error"], row["mean"] = squared_error(folder)
        yield row


def cells(wend, folder, _):
    """A field is taught by more and more samples, and followed by as many each time."""
    scene = made(scenes.equilibrium, folder, (96, 54), 30)
    preset = "direction"
    field = folder / "field"
    for spp in (1, 3, 7, 15, 31, 63):
        run(wend, scene, folder, ["--spp", spp, "--sampling", preset, "--save-field", field])
        told = json.loads(subprocess.run([wend, "field", field, "--json", "-", "--quiet"], check=True,
                                         capture_output=True, text=True).stdout)
        # Fields stay as they are where nothing is to be learned from the first pass.
        yield point(wend, scene, folder, ["--spp", 1, "--sampling", preset, "--load-field", field], axis="cells",
                    value=told["cells"], preset=preset)


def grids(wend, folder, large):
    for side in (64, 128, 256, 512, *([1024] if large else [])):
        scene = made(scenes.grid, folder, (64, 36), side)
        for preset in ("classical", "full"):
            yield point(wend, scene, folder, ["--spp", 15, "--sampling", preset], axis="grid", value=side**3,
                        preset=preset)


AXES = {
    "samples": samples,
    "pixels": pixels("pixels", (480, 960, 1920, 3840, 7680), 1),
    "pixels, 15 samples": pixels("pixels, 15 samples", (240, 480, 960, 1920), 15),
    "lights": over("lights", (1, 10, 100, 1000, 10_000, 100_000), scenes.many_lights, ["--spp", 127]),
    "depth": over("depth", (8, 32, 128, 512, 2048), scenes.bright_cube, ["--spp", 15], ("classical", "full")),
    "cells": cells,
    "extent": extent,
    "triangles": over("triangles", (10_000, 100_000, 1_000_000, 10_000_000), scenes.many_triangles, ["--spp", 15]),
    "instances": over("instances", (1000, 10_000, 100_000, 1_000_000), scenes.many_instances, ["--spp", 15]),
    "grid": grids,
}


# ------------------------------------------------------------------------------------------------------------------ page

SAYS = {
    "samples": "A cube of walls that shine as much as they absorb, in fog that absorbs nothing: every pixel is 1. "
               "8 × 4 pixels; the error is the mean square of what a pixel is off by. It falls as 1/N: slope −1.",
    "pixels": "A floor under a sky and a lamp, one sample a pixel, with all layers written.",
    "pixels, 15 samples": "The same with what is done after each pass: weights of stages, noise, estimates of pixels.",
    "lights": "So many lamps above a floor, 64 × 36 pixels, 127 samples.",
    "depth": "A closed cube of white walls: walks end at the depth alone. 16 × 9 pixels, 15 samples.",
    "cells": "The cube of the first table, 96 × 54 pixels: fields taught by 1 to 63 samples, then one that follows "
             "them, and teaches them on. The value is their cells.",
    "extent": "The cube of the first table, that many times as large. 32 × 18 pixels, 31 samples.",
    "triangles": "A wavy square from a binary PLY file, 64 × 36 pixels, 15 samples.",
    "instances": "One triangle so many times, from text, 64 × 36 pixels, 15 samples.",
    "grid": "A ball of smoke, 64 × 36 pixels, 15 samples. More voxels are more detail of the same density.",
}
# What a reader of the rows would ask.
WHY = {
    "samples": "An error of 32 pixels is known to a quarter, so a slope over two decades to .08. From the first row to "
               "the last there is no floor.",
    "pixels": "From 3,840 to 7,680 pixels of width time grows more than the pixels do, with some 290 bytes of memory a "
              "pixel. Why is not known. `classical` at widths of 1,920, 3,840 and 5,760, one run of each, took 1.71, "
              "1.68 and 1.73 s a million pixels, of which the system's are .20, .25 and .25 for 85, 96 and 102 thousand "
              "page faults: linear up to there. `full` and 7,680 were not measured again.",
    "lights": "A walk costs a little more with more lamps, as trees that choose among them are deeper and leave the "
              "caches. Loading is linear.",
    "cells": "A segment looks up a cell by a tree, so it costs what the tree's depth does.",
    "extent": "Nothing depends on units: the rows differ by chance alone.",
    "grid": "A flight meets more steps of the majorant's grid, and voxels that are not in the caches: about as the "
            "cube root of the voxels, which is how many a ray may meet.",
    "triangles": "Loading reads the file and builds Embree's structure. A ray costs the depth of that.",
    "instances": "Loading is of text, a kilobyte of memory for each instance with all that is read on the way.",
}


def slope(rows, column):
    """Of the last three points; None where there is nothing to take a logarithm of."""
    last = [(math.log(row["value"]), math.log(row[column])) for row in rows[-3:] if row.get(column, 0) > 0]
    if len(last) < 3 or last[0][0] == last[-1][0]:
        return None
    x, y = zip(*last)
    return float(numpy.polyfit(x, y, 1)[0])


def number(value):
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"


def table(rows):
    for row in rows:
        row["nanoseconds"] = 1e9 * row["cpu"] / max(row["segments"], 1)
    columns = {"load_cpu": "loading, s", "cpu": "rendering, s", "segments": "segments",
               "nanoseconds": "ns a segment", "megabytes": "memory, MB"}
    if any("error" in row for row in rows):
        columns |= {"error": "squared error", "mean": "mean"}
    yield "| | preset | " + " | ".join(columns.values()) + " |"
    yield "|---|---|" + "---|" * len(columns)
    for preset in dict.fromkeys(row["preset"] for row in rows):
        own = [row for row in rows if row["preset"] == preset]
        for row in own:
            cells = [f"{row[c]:.5f}" if c == "mean" else number(row[c]) for c in columns]
            yield f"| {row['value']:,} | `{preset}` | " + " | ".join(cells) + " |"
        slopes = [None if c == "mean" else slope(own, c) for c in columns]
        yield f"| *slope* | `{preset}` | " + " | ".join("" if s is None else f"*{s:.2f}*" for s in slopes) + " |"


def page(results):
    lines = ["# How cost grows", "",
             "What happens to time and memory as the work grows, measured by `bench/scale.py`, which writes this page. "
             "Seconds are of processors, of whole processes, less those of one that only loads. A slope is that of the "
             "last three points, of logarithms: 1 is linear, 0 constant. Small times are of the start, and noisy. Where "
             "loading is most, rendering is a small difference of two processes, uncertain by a tenth of loading.", ""]
    for axis, found in results.items():
        where = found["machine"]
        lines += [f"## {axis[0].upper() + axis[1:]}", "", SAYS[axis], "", *table(found["rows"]), ""]
        lines += [WHY[axis], ""] if WHY.get(axis) else []
        lines += [f"*Commit `{found['commit']}`, {where['cpu']}, {where['cores']} cores, which others used as well.*", ""]
    PAGE.write_text("\n".join(lines[:-1]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axes", nargs="*", metavar="AXIS", help=f"these alone: {', '.join(AXES)}")
    parser.add_argument("--wend", type=Path, default=ROOT / "build/release/bin/wend", help="the program")
    parser.add_argument("--commit", default="HEAD", help="what the program was built from")
    parser.add_argument("--large", action="store_true", help="a grid of 1024³ too: some 10 GB of memory")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page")
    arguments = parser.parse_args()
    unknown = set(arguments.axes) - set(AXES)
    if unknown:
        parser.error(f"no axis {', '.join(sorted(unknown))}; there are {', '.join(AXES)}")
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    for axis in [] if arguments.page else arguments.axes or AXES:
        with tempfile.TemporaryDirectory() as folder:
            rows = list(AXES[axis](arguments.wend.resolve(), Path(folder), arguments.large))
        results[axis] = {"commit": git("rev-parse", "--short", arguments.commit), "machine": machine(), "rows": rows}
        results = {name: results[name] for name in AXES if name in results}
        RESULTS.write_text(json.dumps(results, indent=1) + "\n")
    page(results)


if __name__ == "__main__":
    main()
