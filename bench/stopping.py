#!/usr/bin/env python3
"""How soon a large render has a picture on disk, and how soon it ends when it is told to.

usage: bench/stopping.py [--wend BIN] [--scenes NAME...] [--stops N] [--resolution WxH] [--commit REV]

Each render of scenes/NAME.pbrt writes pictures on the way (--write-every). What counts for the first is when the file is
there, under its name and complete. Some seconds later, at another phase of the render each time, it gets SIGTERM. The
time from that to the end of the process includes the writing of the last picture, which is then read. All by the clock,
with all threads: on a machine that does nothing else. Rows go to bench/results/stopping.json, the table into
docs/farms.md by bench/tables.py.
"""

import argparse
import random
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from measure import ROOT, open_results

# Seconds after the first picture within which the signal comes.
LATEST = 12
# Of the poll for the file: what times are known to.
STEP = 0.005


def stop_once(options, scene, random_numbers, folder):
    """A row: seconds until the first picture, and from the signal to the end."""
    picture = Path(folder) / "picture.exr"
    picture.unlink(missing_ok=True)
    begun = time.monotonic()
    process = subprocess.Popen([options.wend, "render", ROOT / "scenes" / f"{scene}.pbrt", "-o", picture,
                                "--resolution", options.resolution, "--spp", "100000", "--write-every", "30",
                                "--quiet"])
    while not picture.exists():
        if process.poll() is not None:
            raise SystemExit(f"{scene}: the render ended by itself, with status {process.returncode}")
        time.sleep(STEP)
    first = time.monotonic() - begun
    wait = random_numbers.uniform(0, LATEST)
    time.sleep(wait)
    process.send_signal(signal.SIGTERM)
    told = time.monotonic()
    status = process.wait()
    stopped = time.monotonic() - told
    if status != 143:
        raise SystemExit(f"{scene}: status {status} after SIGTERM, not 143")
    # Reads all layers, and fails where one is cut off.
    subprocess.run([options.wend, "metric", picture, picture, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return {"scene": scene, "first_picture": round(first, 3), "signal_at": round(first + wait, 3),
            "stopped": round(stopped, 3)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wend", type=Path, default=ROOT / "build/release/bin/wend")
    parser.add_argument("--scenes", nargs="+", default=["fog-door", "cloud"])
    parser.add_argument("--stops", type=int, default=10)
    parser.add_argument("--resolution", default="1920x1080")
    parser.add_argument("--commit", default="HEAD", help="that the program was built from")
    options = parser.parse_args()
    header = argparse.Namespace(commit=options.commit, wend=options.wend, results=ROOT / "bench/results", time=None,
                                threads=0, name="stopping", fresh=True)
    results = open_results(header, resolution=options.resolution)
    random_numbers = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            for _ in range(options.stops):
                row = stop_once(options, scene, random_numbers, folder)
                results.append(row)
                print(row, flush=True)


if __name__ == "__main__":
    main()
