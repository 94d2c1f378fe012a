#!/usr/bin/env python3
"""Measures what the tables of the documents tell and writes it, a row for each render, to bench/results/NAME.json.

usage: measure.py SUITE [options]; SUITE is
  scenes   the project's scenes, classical sampling against the default, in equal time
  short    the same for six seconds and eight seeds: what a first look shows, and fireflies
  demo     the scene of `wend demo`
  public   rooms by others, from a folder that is not part of the project; skipped with a word where it is absent
  peers    Wend, pbrt, its fork, Mitsuba and Cycles (bench/peers/compare.py), also of files (--files)
  planar   the samplers of `wend halfspace` at three albedos
  example  the program of examples/subsurface

Presets take turns, and all scenes are rendered with one seed before the next one. Rows are written as they are
measured: a run that was stopped goes on where it was. Rows of another commit, program, machine or setting are never
mixed: --fresh begins anew. bench/tables.py makes the tables.
"""

import argparse
import datetime
import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

SCENES = ["shield-wall", "shield-duct", "fog-door", "cloud", "haze", "smoke-room", "candles", "liquid",
          "skin-rig", "wax-backlit", "milk-key", "marble-sky", "leaf"]
PUBLIC = ["living-room-2", "living-room-2-fog", "veach-ajar", "veach-ajar-fog", "coffee", "volumetric-caustic"]
# Of these the stored references are renders of an earlier program, whose rough coats reflected too much: blocks are up
# to a third darker now, and against them no picture gets better than a relMSE of 0.05.
OUTDATED = {"living-room-2", "living-room-2-fog", "coffee"}
PEER_SCENES = ["door", "room", "lump"]
PEERS = ["pbrt", "pbrt guided", "mitsuba volpath", "cycles", "cycles guided", "wend classical", "wend full"]
PEER_THREADS = 2  # as in peers/renderers.py
ALBEDOS = [0.4, 0.8, 0.95]
SAMPLERS = ["classical", "dwivedi", "boundary", "modes"]
WALKS = 100000

# --sampling and --subsurface.
PRESETS = [("classical", "classical"), ("full", "auto")]

# Seconds of a render, and seeds.
DEFAULTS = {"scenes": (60, 3), "short": (6, 8), "demo": (20, 3), "public": (60, 3), "peers": (60, 1),
            "planar": (None, 1), "example": (None, 1)}

# What a picture depends on.
SOURCES = ["src", "cmake", "CMakeLists.txt", "CMakePresets.json", "scenes", ":!*.md"]


# ------------------------------------------------------------------------------------------------------------- the file

def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], check=True, capture_output=True, text=True).stdout.strip()


def machine():
    """The processor, how many of its cores there are to run on, and the system."""
    cpu, system = platform.processor() or platform.machine(), platform.platform()
    try:
        cpu = next(line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, StopIteration):
        pass
    return {"cpu": cpu, "cores": len(os.sched_getaffinity(0)), "os": system}


class Results:
    """One file of results: what was measured with, and a row for each render."""

    def __init__(self, path, header, fresh):
        self.path = path
        self.content = {**header, "rows": []}
        if path.exists() and not fresh:
            old = json.loads(path.read_text())
            different = [key for key in ("commit", "dirty", "machine", "settings") if old.get(key) != header[key]]
            if different:
                sys.exit(f"{path} holds rows of another {' and '.join(different)}: --fresh replaces them")
            self.content = old

    def has(self, **key):
        return any(all(row.get(k) == v for k, v in key.items()) for row in self.content["rows"])

    def append(self, row):
        """The file is always whole: it is replaced by a longer one."""
        self.content["rows"].append(row)
        header = {key: value for key, value in self.content.items() if key != "rows"}
        text = json.dumps(header, indent=2)[:-2]  # without the line that closes it
        rows = ",\n".join("    " + json.dumps(row) for row in self.content["rows"])
        self.path.parent.mkdir(parents=True, exist_ok=True)
        longer = self.path.with_suffix(".json.new")
        longer.write_text(f'{text},\n  "rows": [\n{rows}\n  ]\n}}\n')
        os.replace(longer, self.path)


def open_results(arguments, **settings):
    commit = git("rev-parse", "--short", arguments.commit)
    dirty = bool(git("diff", "--name-only", commit, "--", *SOURCES)
                 or git("ls-files", "--others", "--exclude-standard", "--", *SOURCES))
    digest = hashlib.sha256(Path(arguments.wend).read_bytes()).hexdigest()[:16]
    settings = {"seconds": arguments.time, "threads": arguments.threads, **settings, "program": digest}
    header = {"commit": commit, "dirty": dirty, "date": datetime.date.today().isoformat(), "machine": machine(),
              "settings": settings}
    return Results(arguments.results / f"{arguments.name or arguments.suite}.json", header, arguments.fresh)


# -------------------------------------------------------------------------------------------------------------- renders

def run_json(command):
    """Runs a command of wend that writes JSON to stdout; also says what processor time and time it took."""
    before, start = os.times(), time.monotonic()
    run = subprocess.run([*command, "--json", "-", "--quiet"], capture_output=True, text=True)
    wall, after = time.monotonic() - start, os.times()
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{run.stderr.strip()}")
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return json.loads(run.stdout), cpu, wall


def render(arguments, scene, preset, seed, seconds, picture, half=False):
    sampling, subsurface = preset
    command = [arguments.wend, "render", scene, "-o", picture, "--time", str(seconds), "--seed", str(seed), "--threads",
               str(arguments.threads), "--sampling", sampling, "--subsurface", subsurface]
    if arguments.resolution:
        command += ["--resolution", arguments.resolution]
    told, cpu, wall = run_json(command + ["--half"] * half)
    if told["interrupted"] and told["seconds"] < seconds:  # not where a pass was cut off because time was up
        sys.exit("stopped; the same command goes on from here")
    return told, cpu, wall


def measured(arguments, scene, reference, preset, seed, folder):
    """What one render tells, and what its picture is worth; `cpu_seconds` and `wall_seconds` are of the whole program,
    reading the scene included, `seconds` of the render alone."""
    picture = Path(folder) / "picture.exr"
    told, cpu, wall = render(arguments, scene, preset, seed, arguments.time, picture)
    metric = run_json([arguments.wend, "metric", reference, picture])[0]["rows"][0]
    return {"samples": told["spp"], "seconds": told["seconds"], "training_seconds": told["training_seconds"],
            "cpu_seconds": round(cpu, 3), "wall_seconds": round(wall, 3), "segments": told["segments"],
            "resolution": told["settings"]["resolution"], "relmse": metric["relmse"],
            "relmse_trimmed": metric["relmse_trimmed"], "error_p9999": metric["error_p9999"], "mse": metric["mse"],
            "mape": metric["mape"], "flip": metric["flip"]}


def small_reference(arguments, name, scene):
    """A reference of another size than the stored one: two halves by `full`, each for eight times --time, which are
    kept."""
    folder = ROOT / "out" / "references"
    folder.mkdir(parents=True, exist_ok=True)
    reference = folder / f"{name}.{arguments.resolution}.{arguments.time:g}s"
    for seed, half in ((1001, "a"), (1002, "b")):
        path = Path(f"{reference}.ref-{half}.exr")
        if not path.exists():
            print(f"{name}: rendering half {half} of a reference of {arguments.resolution}", flush=True)
            new = path.with_suffix(".new.exr")
            render(arguments, scene, ("full", "auto"), seed, 8 * arguments.time, new, half=True)
            os.replace(new, path)
    return reference


def measure(arguments, scenes):
    """All renders of (name, scene, reference) that the file lacks; without a reference, at a size that none is stored
    in, it is made."""
    results = open_results(arguments, resolution=arguments.resolution)
    scenes = [(name, scene, stored or small_reference(arguments, name, scene)) for name, scene, stored in scenes]
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(1, arguments.seeds + 1):
            for name, scene, reference in scenes:
                for preset in PRESETS if seed % 2 else PRESETS[::-1]:
                    key = {"scene": name, "sampling": preset[0], "subsurface": preset[1], "seed": seed}
                    if results.has(**key):
                        continue
                    row = {**key, **measured(arguments, scene, reference, preset, seed, folder)}
                    results.append(row)
                    print(f"{name:20}{preset[0]:12}seed {seed}  {row['samples']:6} samples  {row['seconds']:6.1f} s  "
                          f"relMSE {row['relmse']:.3g} ({row['relmse_trimmed']:.3g})", flush=True)
    print(results.path)


# --------------------------------------------------------------------------------------------------------------- suites

def chosen(arguments, names):
    unknown = set(arguments.scenes or []) - set(names)
    if unknown:
        sys.exit(f"no scene {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    return [name for name in names if name in (arguments.scenes or names)]


def measure_own(arguments):
    names = chosen(arguments, ["demo"] if arguments.suite == "demo" else SCENES)
    folder = ROOT / "scenes"
    measure(arguments, [(n, folder / f"{n}.pbrt", None if arguments.resolution else folder / n) for n in names])


def measure_public(arguments):
    references = arguments.public / "refs"
    if not references.is_dir():
        print(f"skipped: the rooms by others are not in {arguments.public} (--public)")
        return
    arguments.resolution = arguments.resolution or "160x90"
    scenes = []
    for name in chosen(arguments, PUBLIC):
        place = references / f"{name}.path"
        scene = arguments.public / place.read_text().strip() if place.exists() else None
        if scene is None or not scene.exists() or not (references / f"{name}.ref-a.exr").exists():
            print(f"skipped: {name} or its reference is not in {arguments.public}")
            continue
        is_stored = arguments.resolution == "160x90" and name not in OUTDATED
        scenes.append((name, scene, references / name if is_stored else None))
    if scenes:
        measure(arguments, scenes)


def measure_peers(arguments):
    """One call of compare.py for each picture."""
    results = open_results(arguments, threads=PEER_THREADS)
    for seed in range(1, arguments.seeds + 1):
        for scene in [*chosen(arguments, PEER_SCENES), *arguments.files]:
            for peer in PEERS:
                if results.has(scene=Path(scene).stem, renderer=peer, seed=seed):
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    rows = Path(folder) / "rows.json"
                    command = [sys.executable, ROOT / "bench/peers/compare.py", scene, "--time", str(arguments.time)]
                    command += ["--wend", arguments.wend, "--out", arguments.out, "--only", peer, "--seed", str(seed)]
                    for option in ("pbrt", "pbrt_guided", "blender_python"):
                        if getattr(arguments, option):
                            command += ["--" + option.replace("_", "-"), getattr(arguments, option)]
                    subprocess.run([*command, "--json", rows], check=True)
                    for row in json.loads(rows.read_text()):
                        results.append(row)


def measure_planar(arguments):
    """Samplers of an endlessly deep medium that light enters along the normal."""
    results = open_results(arguments, walks=WALKS)
    for seed in range(1, arguments.seeds + 1):
        for albedo in ALBEDOS:
            for sampler in SAMPLERS:
                key = {"albedo": albedo, "sampler": sampler, "seed": seed}
                if results.has(**key):
                    continue
                told = run_json([arguments.wend, "halfspace", "--albedo", str(albedo), "--sampler", sampler, "--walks",
                                 str(WALKS), "--seed", str(seed), "--threads", str(arguments.threads)])[0]
                columns = ("seconds", "setup_seconds", "mean", "exact", "std_error", "variance", "fom",
                           "collisions_per_walk")
                results.append({**key, **{k: told[k] for k in columns}})
    print(results.path)


def measure_example(arguments):
    """What examples/subsurface prints, a line for each channel."""
    results = open_results(arguments)
    if results.content["rows"]:
        return
    text = subprocess.run([arguments.wend], check=True, capture_output=True, text=True).stdout
    number = r"([0-9.]+)"
    line = re.compile(rf"(\w+) +{number} \+- {number}" + 2 * rf" +{number} \+- {number} +1 / {number}")
    for channel, *numbers in line.findall(text):
        keys = ("classical", "classical_error", "guided", "guided_error", "gain", "learned", "learned_error",
                "learned_gain")
        results.append({"channel": channel, **dict(zip(keys, map(float, numbers)))})
    print(results.path)


SUITES = {"scenes": measure_own, "short": measure_own, "demo": measure_own, "public": measure_public,
          "peers": measure_peers, "planar": measure_planar, "example": measure_example}
PROGRAMS = {"example": "build/release/tests/install/find_package_for_subsurface/subsurface"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("suite", choices=SUITES)
    parser.add_argument("--time", type=float, help="seconds for each render, training included (default: the suite's)")
    parser.add_argument("--seeds", type=int, help="renders of each (default: the suite's)")
    parser.add_argument("--scenes", nargs="+", help="these alone")
    parser.add_argument("--resolution", help="WIDTHxHEIGHT; where it is not the reference's, one is rendered first")
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--wend",
                        help="the program (default: build/release/bin/wend; of 'example' what the tests have built)")
    parser.add_argument("--commit", default="HEAD", help="what the program was built from")
    parser.add_argument("--results", type=Path, default=ROOT / "bench/results", help="folder")
    parser.add_argument("--name", help="of the file (default: the suite's)")
    parser.add_argument("--fresh", action="store_true", help="replace the file instead of going on with it")
    parser.add_argument("--public", type=Path, default=ROOT.parent / "shared/public",
                        help="folder of the rooms by others")
    parser.add_argument("--files", nargs="+", default=[],
                        help="scenes for the peers that read them: .pbrt, .xml, .blend")
    parser.add_argument("--pbrt", help="the program of pbrt-v4")
    parser.add_argument("--pbrt-guided", help="that of its fork with Open PGL")
    parser.add_argument("--blender-python", help="a Python that has bpy (default: this one)")
    parser.add_argument("--out", default=str(ROOT / "out/peers"), help="folder for the pictures of other renderers")
    arguments = parser.parse_args()
    seconds, seeds = DEFAULTS[arguments.suite]
    arguments.time = seconds if arguments.time is None else arguments.time
    arguments.seeds = seeds if arguments.seeds is None else arguments.seeds
    if arguments.wend is None:
        arguments.wend = str(ROOT / PROGRAMS.get(arguments.suite, "build/release/bin/wend"))
    if not os.access(arguments.wend, os.X_OK):
        parser.error(f"no program {arguments.wend}: build it, or say where it is (--wend)")
    try:
        SUITES[arguments.suite](arguments)
    except KeyboardInterrupt:
        sys.exit("stopped; the same command goes on from here")


if __name__ == "__main__":
    main()
