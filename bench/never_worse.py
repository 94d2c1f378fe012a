#!/usr/bin/env python3
"""Asks of every scene at hand whether the default is ever worse than classical sampling, and writes a row for each
render to bench/results/NAME.json and, from all rows, the page docs/never_worse.md.

A budget is the processor time of so many classical samples a pixel, on one thread. The default is given as many samples
as it takes for that time, by what the budget before it cost; what is left of the difference is multiplied out: judged
is relMSE times processor time, of classical sampling over that of the default. Processor time of reading the scene is
not counted. Short renders are timed several times, and the least counts. References that are not stored are rendered
first and kept (out/references).

With --baseline another way of sampling takes the place of the classical one, with its own name for the results.

Half of the scenes, every other one in the order of their names, are there to choose constants by ("tuned on"), the
other half to report ("held out").
"""

import argparse
import json
import math
import os
import queue
import statistics
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import measure
from measure import ROOT

BUDGETS = [4, 16, 64, 256, 1024]
DEFAULT = ("full", "auto")
# Renders that take less, in seconds, are timed so often.
SHORT, REPEATS = 2, 3
CLASSICAL = ("classical", "classical")
SIZE = "160x90"
# Of scenes that have no stored reference: samples of each half.
REFERENCE_SAMPLES = 1024

# Folder beside the project, scene, reference in the public folder; has a medium.
OTHERS = {
    "coffee": ("public/coffee/scene-v4.pbrt", "coffee", False),
    "cornell-box": ("scenes/cornell-box/scene-v4.pbrt", None, False),
    "fog-box": ("scenes/fog-box/fog-box-filled.pbrt", None, True),
    "living-room-2": ("public/living-room-2/scene-v4.pbrt", "living-room-2", False),
    "living-room-2-fog": ("public/living-room-2/fog.pbrt", "living-room-2-fog", True),
    "sample-smoke": ("scenes/smoke/smoke.pbrt", None, True),
    "veach-ajar": ("public/veach-ajar/scene-v4.pbrt", "veach-ajar", False),
    "veach-ajar-fog": ("public/veach-ajar/fog.pbrt", "veach-ajar-fog", True),
    "volumetric-caustic": ("scenes/volumetric-caustic/scene-v4.pbrt", "volumetric-caustic", True),
    "wdas-cloud": ("scenes/cloud/cloud.pbrt", None, True),
}
OWN = [name for name in measure.SCENES if name != "shield-wall"] + ["demo"]


class Case:
    """A scene and what its pictures are compared with."""

    def __init__(self, name, scene, reference, has_media, size):
        self.name, self.scene, self.reference, self.has_media = name, scene, reference, has_media
        self.options = ["--resolution", size] if size else []
        self.lock = threading.Lock()  # for the reference


def cases(arguments):
    found = [Case(name, ROOT / "scenes" / f"{name}.pbrt", ROOT / "scenes" / name, True, None) for name in OWN]
    for name, (scene, reference, has_media) in OTHERS.items():
        path = arguments.shared / scene
        if not path.exists():
            print(f"skipped: {name}, which is not in {arguments.shared}")
            continue
        stored = arguments.shared / "public/refs" / str(reference)
        kept = ROOT / "out/references" / f"{name}.{SIZE}"
        is_stored = reference and reference not in measure.OUTDATED
        found.append(Case(name, path, stored if is_stored else kept, has_media, SIZE))
    unknown = set(arguments.scenes or []) - {case.name for case in found}
    if unknown:
        sys.exit(f"no scene {', '.join(sorted(unknown))}; there are {', '.join(case.name for case in found)}")
    return [case for case in sorted(found, key=lambda c: c.name) if case.name in (arguments.scenes or [case.name])]


def processor_time(command):
    """Of a command that must succeed, in seconds, and what it wrote to stdout."""
    with tempfile.TemporaryFile() as told:
        process = subprocess.Popen(command, stdout=told, stderr=subprocess.PIPE)
        error = process.stderr.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{error}")
        told.seek(0)
        return usage.ru_utime + usage.ru_stime, told.read()


class Judge:
    def __init__(self, arguments):
        self.arguments = arguments
        self.loading = {}
        self.lock = threading.Lock()

    def command(self, case, preset, samples, seed, picture, *more):
        sampling, subsurface = preset
        return [self.arguments.wend, "render", case.scene, "-o", picture, "--spp", str(samples), "--seed", str(seed),
                "--threads", "1", "--sampling", sampling, "--subsurface", subsurface, "--quiet", *case.options, *more]

    def reading_time(self, case):
        """Processor time of what is not rendering."""
        if case.name not in self.loading:
            with tempfile.TemporaryDirectory() as folder:
                command = self.command(case, CLASSICAL, 1, 0, Path(folder) / "picture.exr", "--json", "-")
                runs = [processor_time(command) for _ in range(REPEATS)]
            rendering = min(json.loads(told)["seconds"] for _, told in runs)
            self.loading[case.name] = max(0.0, min(whole for whole, _ in runs) - rendering)
        return self.loading[case.name]

    def make_reference(self, case):
        with case.lock:
            for seed, half in ((9001, "a"), (9002, "b")):
                path = Path(f"{case.reference}.ref-{half}.exr")
                if not path.exists():
                    path.parent.mkdir(parents=True, exist_ok=True)
                    new = path.with_suffix(".new.exr")
                    processor_time(self.command(case, CLASSICAL, REFERENCE_SAMPLES, seed, new, "--half"))
                    os.replace(new, path)

    def render(self, case, preset, samples, seed, folder):
        picture = Path(folder) / "picture.exr"
        command = self.command(case, preset, samples, seed, picture, "--json", "-")
        seconds, told = processor_time(command)
        # The same picture each time, and other work on the machine only makes it slower.
        for _ in range(REPEATS - 1 if seconds < SHORT else 0):
            seconds = min(seconds, processor_time(command)[0])
        told = json.loads(told)
        metric = json.loads(processor_time([self.arguments.wend, "metric", case.reference, picture, "--json", "-",
                                            "--quiet"])[1])["rows"][0]
        return {"samples": samples, "seconds": round(seconds - self.reading_time(case), 4),
                "training_seconds": round(told["training_seconds"], 4), "segments": told["segments"],
                "relmse": metric["relmse"], "relmse_trimmed": metric["relmse_trimmed"],
                "error_p9999": metric["error_p9999"]}

    def judge(self, case, seed, results):
        """All budgets of a scene with one seed."""
        self.make_reference(case)
        price = 1.1  # of a sample of the default, in classical ones: a guess, for the first budget
        for budget in self.arguments.budgets:
            key = {"scene": case.name, "seed": seed, "budget": budget}
            if results.has(**key):
                continue
            with tempfile.TemporaryDirectory() as folder:
                classical = self.render(case, baseline(self.arguments), budget, seed, folder)
                default = self.render(case, DEFAULT, max(1, round(budget / price)), seed, folder)
            price = (default["seconds"] / default["samples"]) / (classical["seconds"] / classical["samples"])
            with self.lock:
                for sampling, row in ((self.arguments.baseline, classical), ("default", default)):
                    results.append({**key, "sampling": sampling, **row})
                print(f"{case.name:20}seed {seed} at {budget:4}: {ratio(classical, default, 'relmse'):6.3f} "
                      f"({ratio(classical, default, 'relmse_trimmed'):6.3f})  p99.99 "
                      f"{default['error_p9999'] / classical['error_p9999']:6.3f}  price {price:5.2f}  "
                      f"training {default['training_seconds'] / default['seconds']:5.1%}", flush=True)

    def run(self, all_cases, results):
        """Scenes beside each other, one to each worker, so that a picture has a core of its own."""
        waiting = queue.Queue()
        for seed in range(self.arguments.first_seed, self.arguments.first_seed + self.arguments.seeds):
            for case in all_cases:
                waiting.put((case, seed))
        failed = []

        def work():
            while not failed:
                try:
                    case, seed = waiting.get_nowait()
                except queue.Empty:
                    return
                try:
                    self.judge(case, seed, results)
                except SystemExit as error:
                    failed.append(str(error))

        workers = [threading.Thread(target=work) for _ in range(self.arguments.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        if failed:
            sys.exit(failed[0])


def baseline(arguments):
    return CLASSICAL if arguments.baseline == "classical" else (arguments.baseline, "auto")


def ratio(classical, default, what):
    return classical[what] * classical["seconds"] / (default[what] * default["seconds"])


# ------------------------------------------------------------------------------------------------------------- the page

def pairs(rows):
    """{(scene, budget): [(classical, default) of each seed]}"""
    by_key = {}
    for row in rows:
        by_key.setdefault((row["scene"], row["budget"], row["seed"]), {})[row["sampling"]] = row
    found = {}
    for (scene, budget, _), both in sorted(by_key.items()):
        if len(both) == 2:
            default = both.pop("default")
            found.setdefault((scene, budget), []).append((*both.values(), default))
    return found


def summary(of_seeds):
    """Medians over seeds: ratios, outliers, price, training."""
    def median(f):
        return statistics.median(f(c, d) for c, d in of_seeds)

    return {"plain": median(lambda c, d: ratio(c, d, "relmse")),
            "trimmed": median(lambda c, d: ratio(c, d, "relmse_trimmed")),
            "outliers": median(lambda c, d: d["error_p9999"] / c["error_p9999"]),
            "price": median(lambda c, d: d["seconds"] / d["samples"] / (c["seconds"] / c["samples"])),
            "training": median(lambda _, d: d["training_seconds"] / d["seconds"])}


def geometric_mean(values):
    return math.exp(statistics.fmean(math.log(v) for v in values))


def page(results, baseline):
    found = {key: summary(of_seeds) for key, of_seeds in pairs(results["rows"]).items()}
    names = sorted(set(OWN) | set(OTHERS))
    tuned_on = set(names[::2])
    media = {name: name not in OTHERS or OTHERS[name][2] for name in names}
    budgets = sorted({budget for _, budget in found})
    by_budget = {b: [len(of) for (_, other), of in pairs(results["rows"]).items() if other == b] for b in budgets}
    notes = ["Scenes and fewest seeds of a scene: "
             + ", ".join(f"{len(of)} and {min(of)} at {b}" for b, of in by_budget.items()) + "."]
    missing = [name for name in names if name not in {scene for scene, _ in found}]
    if missing:
        notes.append(f"Not measured: {', '.join(missing)}.")
    lines = ["# Never worse" if baseline == "classical" else f"# The default and {baseline}", "",
             f"Sampling `{baseline}` over the default: relMSE × processor time, medians of seeds (without the worst "
             "0.1 % of pixels in brackets). Above 1 the default is ahead. A budget is the time of so many samples of "
             f"`{baseline}`. {results['machine']['cpu']}, one thread for each picture, commit {results['commit']}. "
             "`bench/never_worse.py` measures and writes this page.", "", *notes, "",
             "## Geometric means", "", "| scenes | " + " | ".join(str(b) for b in budgets) + " |",
             "|---|" + "---|" * len(budgets)]
    groups = [("others', with media", lambda n: n in OTHERS and media[n]),
              ("others', without", lambda n: n in OTHERS and not media[n]),
              ("own", lambda n: n in OWN),
              ("tuned on", lambda n: n in tuned_on), ("held out", lambda n: n not in tuned_on)]
    for title, belongs in groups:
        cells = []
        for budget in budgets:
            chosen = [s for (name, b), s in found.items() if b == budget and belongs(name)]
            cells.append(f"{geometric_mean([s['plain'] for s in chosen]):.2f} "
                         f"({geometric_mean([s['trimmed'] for s in chosen]):.2f})" if chosen else "")
        lines.append(f"| {title} | " + " | ".join(cells) + " |")
    lines += ["", "## Every scene and budget, worst first", "",
              "Outliers: the error that one pixel in ten thousand exceeds, of the default over that of "
              f"`{baseline}`. Price: of a sample, in those of `{baseline}`.", "",
              "Light that `classical` seldom finds is in few of its pixels, and in few of its pictures. Medians of few seeds "
              "and trimmed errors leave it out ([experiments](experiments/guiding_choice.md), \"What medians and trimming "
              "say of rare light\").", "",
              "| scene | budget | ratio | outliers | price | training |", "|---|---|---|---|---|---|"]
    for (name, budget), s in sorted(found.items(), key=lambda item: item[1]["trimmed"]):
        lines.append(f"| {name} | {budget} | {s['plain']:.2f} ({s['trimmed']:.2f}) | {s['outliers']:.2f} | "
                     f"{s['price']:.2f} | {s['training']:.1%} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--budgets", type=int, nargs="+", default=BUDGETS, help="in samples of the baseline, rising")
    parser.add_argument("--baseline", default="classical", help="what the default is compared with, as --sampling has it")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--scenes", nargs="+", help="these alone")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="pictures beside each other")
    parser.add_argument("--wend", default=str(ROOT / "build/release/bin/wend"), help="the program")
    parser.add_argument("--commit", default="HEAD", help="what the program was built from")
    parser.add_argument("--shared", type=Path, default=ROOT.parent / "shared", help="folder of scenes by others")
    parser.add_argument("--results", type=Path, default=ROOT / "bench/results", help="folder")
    parser.add_argument("--name", default="never_worse", help="of the file")
    parser.add_argument("--page", type=Path, help="where to write it (default: docs/never_worse.md for that name)")
    parser.add_argument("--fresh", action="store_true", help="replace the file instead of going on with it")
    arguments = parser.parse_args()
    arguments.suite, arguments.time, arguments.threads = "never_worse", None, 1
    if not os.access(arguments.wend, os.X_OK):
        parser.error(f"no program {arguments.wend}: build it, or say where it is (--wend)")
    results = measure.open_results(arguments)
    try:
        Judge(arguments).run(cases(arguments), results)
    except KeyboardInterrupt:
        sys.exit("stopped; the same command goes on from here")
    where = arguments.page or (ROOT / "docs/never_worse.md" if arguments.name == "never_worse" else None)
    if where:
        where.write_text(page(results.content, arguments.baseline))
    else:
        print(page(results.content, arguments.baseline))


if __name__ == "__main__":
    main()
