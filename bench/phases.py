#!/usr/bin/env python3
"""Whether every phase function is guided as well as Henyey and Greenstein's.

usage: bench/phases.py [--wend BIN] [--samples N] [--seeds N] [--classical-seeds N] [--reference-samples N]
                       [--resolution WxH] [--commit REV]

Renders scenes/fog-door.pbrt with each phase function in its fog, and with Henyey and Greenstein's of the same mean
cosine: relMSE times processor time of classical sampling over that of the default, on one thread, with as many samples.
Means over seeds; those of classical sampling vary more and cost less, so that there are more of them. Each scene's
reference is rendered first, as two halves. Rows go to bench/results/phases.json, the table into docs/pbrt.md by
bench/tables.py.
"""

import argparse
import json
import math
import statistics
import subprocess
import tempfile
from pathlib import Path

from measure import ROOT
from never_worse import CLASSICAL, DEFAULT, processor_time

# Parameters of the medium, and their mean cosine.
FUNCTIONS = {
    "isotropic": ('"float g" 0', 0),
    "Rayleigh": ('"string phase" "rayleigh"', 0),
    "Cornette and Shanks, g = 0.6": ('"string phase" "cornetteshanks" "float g" .6', 0.665),
    "Draine, g = 0.5, α = 2": ('"string phase" "draine" "float g" .5 "float alpha" 2', 0.6),
    "mixture of g = 0.8 and −0.3": ('"string phase" "henyeygreensteinmixture" "float g" [.8 -.3] '
                                    '"float weights" [.7 .3]', 0.47),
    "fog droplets of 20 µm": ('"string phase" "fog"', 0.88),
    "Fournier and Forand": ('"string phase" "fournierforand"', 0.93),
    "by a table": ('"string phase" "tabulated" "float angles" [0 10 30 60 120 180] "float values" [40 12 3 .6 .2 .4]',
                   0.65),
}
PLACE = '"float g" [ 0.4 ]'


def write_scene(folder, name, parameters):
    text = (ROOT / "scenes/fog-door.pbrt").read_text()
    if text.count(PLACE) != 1:
        raise SystemExit(f"fog-door.pbrt has not one {PLACE}")
    path = Path(folder) / f"{name}.pbrt"
    path.write_text(text.replace(PLACE, parameters))
    return path


class Bench:
    def __init__(self, options, folder):
        self.options, self.folder = options, Path(folder)

    def render(self, scene, preset, samples, seed, picture, *more):
        sampling, subsurface = preset
        return processor_time([self.options.wend, "render", scene, "-o", picture, "--spp", str(samples), "--seed",
                               str(seed), "--threads", "1", "--sampling", sampling, "--subsurface", subsurface,
                               "--quiet", "--resolution", self.options.resolution, *more])[0]

    def cost(self, scene, reference, preset, seed):
        """relMSE times processor time, plain and without the worst pixels."""
        picture = self.folder / "picture.exr"
        seconds = self.render(scene, preset, self.options.samples, seed, picture)
        row = json.loads(processor_time([self.options.wend, "metric", reference, picture, "--json", "-",
                                         "--quiet"])[1])["rows"][0]
        return seconds * row["relmse"], seconds * row["relmse_trimmed"]

    def gain(self, name, parameters):
        """Of classical over default, plain and without the worst pixels, and the relative standard errors of both."""
        scene, reference = write_scene(self.folder, name, parameters), self.folder / name
        for half, seed in (("a", 9001), ("b", 9002)):
            self.render(scene, DEFAULT, self.options.reference_samples, seed, f"{reference}.ref-{half}.exr", "--half")
        seeds = {CLASSICAL: self.options.classical_seeds, DEFAULT: self.options.seeds}
        costs = {preset: [self.cost(scene, reference, preset, seed) for seed in range(1, count + 1)]
                 for preset, count in seeds.items()}
        means = {preset: [mean_and_error([c[i] for c in costs[preset]]) for i in range(2)] for preset in costs}
        pairs = list(zip(means[CLASSICAL], means[DEFAULT]))
        return {"gain": [a / b for (a, _), (b, _) in pairs], "error": [math.hypot(a, b) for (_, a), (_, b) in pairs]}


def mean_and_error(values):
    """The mean, and its standard error over it."""
    mean = statistics.mean(values)
    return mean, statistics.stdev(values) / math.sqrt(len(values)) / mean


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wend", type=Path, default=ROOT / "build/release/bin/wend")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=6, help="two or more")
    parser.add_argument("--classical-seeds", type=int, default=16, help="two or more")
    parser.add_argument("--reference-samples", type=int, default=256)
    parser.add_argument("--resolution", default="80x45")
    parser.add_argument("--commit")
    options = parser.parse_args()
    commit = options.commit or subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True,
                                              capture_output=True, text=True).stdout.strip()
    rows, of_hg = [], {}
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options, folder)
        for i, (function, (parameters, mean_cosine)) in enumerate(FUNCTIONS.items()):
            if mean_cosine not in of_hg:
                of_hg[mean_cosine] = bench.gain(f"hg{i}", f'"float g" {mean_cosine}')
            own = of_hg[mean_cosine] if function == "isotropic" else bench.gain(f"function{i}", parameters)
            rows.append({"function": function, "mean_cosine": mean_cosine, "own": own, "hg": of_hg[mean_cosine]})
            print(rows[-1], flush=True)
    settings = {key: getattr(options, key)
                for key in ("resolution", "samples", "seeds", "classical_seeds", "reference_samples")}
    (ROOT / "bench/results/phases.json").write_text(
        json.dumps({"commit": commit, **settings, "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
