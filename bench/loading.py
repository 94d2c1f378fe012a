#!/usr/bin/env python3
"""What it takes to load large scenes: processor time and memory of processes that render one sample of a tiny picture.

usage: bench/loading.py [--wend BIN] [--pbrt BIN] [--repetitions N] [--commit REV]

Writes its scenes into a temporary folder: a million triangles as text and as PLY, a hundred thousand instances, a grid
of 512³ numbers as text. Where the program pbrt is given, it loads the same files. Rows go to
bench/results/loading.json, the table into docs/pbrt.md.
"""

import argparse
import json
import multiprocessing
import os
import random
import statistics
import struct
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

HEAD = """Film "rgb" "integer xresolution" 16 "integer yresolution" 16 "string filename" "o.exr"
Sampler "independent" "integer pixelsamples" 1
Integrator "volpath" "integer maxdepth" 2
LookAt 0 -3 2  0 0 0  0 0 1
Camera "perspective"
WorldBegin
LightSource "infinite"
"""


def mesh(side):
    """Vertices and triangles of a wavy square."""
    points = [(2 * x / (side - 1) - 1, 2 * y / (side - 1) - 1, 0.02 * ((x * 7 + y * 11) % 13) / 13)
              for y in range(side) for x in range(side)]
    triangles = []
    for y in range(side - 1):
        for x in range(side - 1):
            a = y * side + x
            triangles += [(a, a + 1, a + side), (a + 1, a + side + 1, a + side)]
    return points, triangles


def write_text(folder, points, triangles):
    with open(folder / "text.pbrt", "w") as file:
        file.write(HEAD + 'Shape "trianglemesh" "point3 P" [\n')
        file.writelines("%.7g %.7g %.7g\n" % p for p in points)
        file.write('] "integer indices" [\n')
        file.writelines("%d %d %d\n" % t for t in triangles)
        file.write("]\n")


def write_ply(folder, points, triangles):
    with open(folder / "mesh.ply", "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(triangles)}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        file.writelines(struct.pack("<3f", *p) for p in points)
        file.writelines(struct.pack("<B3i", 3, *t) for t in triangles)
    (folder / "ply.pbrt").write_text(HEAD + 'Shape "plymesh" "string filename" "mesh.ply"\n')


def write_instances(folder, count):
    numbers = random.Random(1)
    with open(folder / "instances.pbrt", "w") as file:
        file.write(HEAD + 'ObjectBegin "a"\nShape "trianglemesh" "point3 P" [0 0 0 .01 0 0 0 .01 0] '
                   '"integer indices" [0 1 2]\nObjectEnd\n')
        for _ in range(count):
            place = [numbers.uniform(-1, 1) for _ in range(3)]
            file.write('AttributeBegin\nTranslate %.6g %.6g %.6g\nObjectInstance "a"\nAttributeEnd\n' % tuple(place))


def write_grid(folder, size):
    numbers = random.Random(2)
    row = " ".join("%.4g" % numbers.random() for _ in range(size)) + "\n"
    with open(folder / "grid.pbrt", "w") as file:
        file.write(HEAD + f'MakeNamedMedium "m" "string type" "uniformgrid" "integer nx" {size} "integer ny" {size} '
                   f'"integer nz" {size} "rgb sigma_s" [1 1 1] "rgb sigma_a" [0 0 0] "point3 p0" [-1 -1 -1] '
                   '"point3 p1" [1 1 1] "float density" [\n')
        for _ in range(size * size):
            file.write(row)
        file.write(']\nAttributeBegin\nMediumInterface "m" ""\nMaterial "interface"\nShape "sphere"\nAttributeEnd\n')


def write_all(folder):
    points, triangles = mesh(708)
    write_text(folder, points, triangles)
    write_ply(folder, points, triangles)
    write_instances(folder, 100_000)
    write_grid(folder, 512)


def run(command, folder):
    """Seconds of processors, and the most memory that the process had, in MB."""
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: status {status}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def measure(programs, scene, repetitions, folder):
    rows = []
    for name, command in programs.items():
        runs = [run([*command, f"{scene}.pbrt"], folder) for _ in range(repetitions)]
        rows.append({"scene": scene, "program": name, "seconds": statistics.median(t[0] for t in runs),
                     "megabytes": statistics.median(t[1] for t in runs),
                     "file_megabytes": sum(f.stat().st_size for f in folder.glob(f"{scene}.pbrt")) / 2**20})
    return rows


TITLES = {"text": "a million triangles, text", "ply": "a million triangles, PLY",
          "instances": "100,000 instances", "grid": "512³ numbers, text"}


def table(rows):
    yield "| scene | program | seconds of processors | memory, MB |"
    yield "|---|---|---|---|"
    for row in rows:
        yield f"| {TITLES[row['scene']]} | {row['program']} | {row['seconds']:.2f} | {row['megabytes']:.0f} |"


def write_page(text, commit):
    page = ROOT / "docs" / "pbrt.md"
    begin, end = "<!-- loading -->", "<!-- /loading -->"
    before, rest = page.read_text().split(begin)
    after = rest.split(end)[1]
    page.write_text(f"{before}{begin}\n{text}\n\n*Commit `{commit}`.*\n{end}{after}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wend", type=Path, default=ROOT / "build/release/bin/wend")
    parser.add_argument("--pbrt", type=Path)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--commit")
    options = parser.parse_args()
    commit = options.commit or subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True,
                                              capture_output=True, text=True).stdout.strip()
    programs = {"wend": [options.wend.resolve(), "render", "-o", "o.exr", "--quiet"]}
    if options.pbrt:
        programs["pbrt"] = [options.pbrt.resolve(), "--quiet"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        # By another process: what this one has had would count for those that it starts.
        writer = multiprocessing.Process(target=write_all, args=(folder,))
        writer.start()
        writer.join()
        if writer.exitcode != 0:
            raise SystemExit("the scenes could not be written")
        rows = [row for scene in TITLES for row in measure(programs, scene, options.repetitions, folder)]
    (ROOT / "bench/results/loading.json").write_text(json.dumps({"commit": commit, "rows": rows}, indent=1) + "\n")
    write_page("\n".join(table(rows)), commit)


if __name__ == "__main__":
    main()
