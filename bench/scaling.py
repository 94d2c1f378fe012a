#!/usr/bin/env python3
"""How a picture by several processes scales: measured on this machine, and worked out for clusters.

Measures one render by 1 and 2 threads and by 1, 2 and 4 ranks of one thread each: by the clock, and by the time of
processors, which others on the machine do not change, less what starting costs. The model of docs/scaling.md is fitted to
those of 1 and 2 ranks. What it says of 4 ranks is held against the measurement. Then tiles of a large
picture are shared out among up to 4,096 ranks as the renderer does, by the work that they were in one render, and loaded
by the work that they are in another: so imbalance is counted, not assumed. Messages are as large as they are there.

Rows go to bench/results/scaling.json, tables into docs/scaling.md.

    bench/scaling.py --pairs 7      # about five minutes on two free cores

holds two ranks against two threads alone, turn by turn, beside one thread for the whole and for half of the samples, and
writes nothing: strong and weak scaling, and the ratio of each turn.
"""

import argparse
import heapq
import json
import math
import os
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ["fog-door", "cloud"]
TILE = 16
# Of the picture that is measured.
WIDTH, HEIGHT, SAMPLES = 160, 90, 31
# Learns in every pass, so that as much is exchanged as can be.
SAMPLING = "direction+roulette+splitting"
# Of a pixel of the film, and of a record of a vertex, as ranks tell them to each other.
BYTES_OF_PIXEL, BYTES_OF_RECORD, MOST_RECORDS = 168, 100, 2e6
CLUSTERS = {"100 Gb/s, 2 µs": (2e-6, 12.5e9), "10 Gb/s, 20 µs": (20e-6, 1.25e9)}


def render(wend, scene, ranks, threads, options, folder):
    told = Path(folder) / "told.json"
    command = [str(wend), "render", str(ROOT / "scenes" / f"{scene}.pbrt"), "--threads", str(threads), "--quiet",
               "--json", str(told), "-o", str(Path(folder) / "picture.exr"), *map(str, options)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_mpi_yield_when_idle="1")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return dict(json.loads(told.read_text()), cpu=cpu)


def run(wend, scene, way, samples, folder, sampling=SAMPLING):
    return render(wend, scene, *way, ["--resolution", f"{WIDTH}x{HEIGHT}", "--spp", samples, "--sampling", sampling],
                  folder)


def start(wend, scene, way, folder):
    """Seconds of processors to begin and to end."""
    return render(wend, scene, *way, ["--resolution", "16x9", "--spp", 1, "--sampling", "classical"], folder)["cpu"]


def measure(wend, scene, repetitions, folder):
    """Medians of each way to use the machine, which take turns."""
    ways = [(1, 1), (1, 2), (2, 1), (4, 1)]
    told, starts = {way: [] for way in ways}, {way: [] for way in ways}
    for _ in range(repetitions):
        for way in ways:
            starts[way].append(start(wend, scene, way, folder))
            told[way].append(run(wend, scene, way, SAMPLES, folder))
    return [{"scene": scene, "ranks": ranks, "threads": threads,
             "seconds": statistics.median(t["seconds"] for t in told[ranks, threads]),
             "cpu": statistics.median(t["cpu"] for t in told[ranks, threads]) -
                    statistics.median(starts[ranks, threads]),
             "training": statistics.median(t["training_seconds"] for t in told[ranks, threads]),
             "passes": len(told[ranks, threads][0]["settings"]["passes"]),
             "field_bytes": told[ranks, threads][0]["field_bytes"],
             "bytes_per_pass": told[ranks, threads][0].get("bytes_per_pass", 0)} for ranks, threads in ways]


def print_pairs(wend, scene, pairs, sampling, samples, folder):
    """Two ranks against two threads, turn by turn: processors' seconds without those of starting, and by the clock."""
    alone, threads, ranks = (1, 1), (1, 2), (2, 1)
    starts = {way: statistics.median(start(wend, scene, way, folder) for _ in range(3))
              for way in (alone, threads, ranks)}
    cpu, clock = {threads: [], ranks: []}, {threads: [], ranks: []}
    for turn in range(pairs):
        for way in (threads, ranks) if turn % 2 == 0 else (ranks, threads):
            told = run(wend, scene, way, samples, folder, sampling)
            cpu[way].append(told["cpu"] - starts[way])
            clock[way].append(told["seconds"])
    ratios = [r / t for r, t in zip(cpu[ranks], cpu[threads])]
    clocks = [r / t for r, t in zip(clock[ranks], clock[threads])]
    error = 1.25 * statistics.stdev(ratios) / math.sqrt(pairs) if pairs > 1 else float("nan")
    print(f"{scene}, {sampling}, {samples} samples: two ranks over two threads, processors' time {statistics.median(ratios):.3f} ± {error:.3f}, "
          f"clock {statistics.median(clocks):.3f}; turns " + " ".join(f"{r:.3f}" for r in sorted(ratios)))
    whole = run(wend, scene, alone, samples, folder, sampling)["seconds"] / samples
    half = run(wend, scene, alone, samples // 2, folder, sampling)["seconds"] / (samples // 2)
    for name, way in (("threads", threads), ("ranks", ranks)):
        of_sample = statistics.median(clock[way]) / samples
        print(f"{scene}: two {name}: {whole / of_sample:.2f} times one thread (strong), "
              f"{half / of_sample:.2f} times with twice the samples (weak)", flush=True)


def exchanged(rows, ranks):
    """Bytes that all ranks together take in a pass. Film and cells go to each of the others; of the records, which two
    ranks tell the size of, each goes to one rank, and one of so many stays where it is."""
    two = next(r for r in rows if r["ranks"] == 2)
    to_all = WIDTH * HEIGHT * BYTES_OF_PIXEL + two["field_bytes"]
    records = 2 * (2 * two["bytes_per_pass"] - to_all)
    return (ranks - 1) * to_all + records * (ranks - 1) / ranks


def predicted(rows, ranks):
    """Seconds of processors by the model: what is shared out, and what goes with what is exchanged."""
    one, two = (next(r for r in rows if r["ranks"] == n and r["threads"] == 1) for n in (1, 2))
    return one["cpu"] + (two["cpu"] - one["cpu"]) * exchanged(rows, ranks) / exchanged(rows, 2)


def tile_work(wend, scene, seed, folder):
    """Segments of each tile of a large picture, from its layers."""
    import numpy
    import OpenEXR
    render(wend, scene, 1, 0, ["--resolution", "1920x1080", "--spp", 4, "--seed", seed, "--sampling", "classical"],
           folder)
    channels = OpenEXR.File(str(Path(folder) / "picture.exr")).channels()
    segments = numpy.asarray(channels["segments.N"].pixels, float)
    height, width = segments.shape
    rows = [segments[y:y + TILE] for y in range(0, height, TILE)]
    return [float(row[:, x:x + TILE].sum()) for row in rows for x in range(0, width, TILE)]


def imbalance(before, now, ranks):
    """The largest load over the mean, where tiles are shared out by their work before (shares_of_ranks)."""
    loads = [(0.0, rank) for rank in range(ranks)]
    heapq.heapify(loads)
    actual = [0.0] * ranks
    for tile in sorted(range(len(before)), key=lambda t: -before[t]):
        load, rank = heapq.heappop(loads)
        actual[rank] += now[tile]
        heapq.heappush(loads, (load + before[tile] + 1, rank))
    return max(actual) * ranks / sum(actual)


def simulate(scene, before, now, segments_per_second, seconds_to_fit, field_bytes, cores_of_rank=16):
    """Seconds of a pass of 32 samples of a large picture while fields learn."""
    pixels, samples = 1920 * 1080, 32
    work = sum(now) * samples / 4 / segments_per_second / cores_of_rank
    for ranks in (1, 4, 16, 64, 256, 1024, 4096):
        balance = imbalance(before, now, ranks)
        row = {"scene": scene, "simulated_ranks": ranks, "imbalance": balance, "walks": work * balance / ranks,
               "fit": seconds_to_fit / ranks}
        # Each gets all pixels and all cells, but of the records those of its own cells.
        message = pixels * BYTES_OF_PIXEL + field_bytes + MOST_RECORDS * BYTES_OF_RECORD / ranks
        for name, (latency, bandwidth) in CLUSTERS.items():
            # Of the film and of both fields one broadcast of each rank's part, pipelined along a tree; records go from
            # each to each.
            latencies = ranks * latency * (3 * math.log2(ranks) + 1)
            row[f"messages, {name}"] = 0 if ranks == 1 else latencies + message / bandwidth
        yield row


def tables(rows):
    lines = ["| scene | ranks × threads | seconds | of processors | over two threads | model |", "|---|---|---|---|---|---|"]
    for scene in SCENES:
        measured = [r for r in rows if r["scene"] == scene and "ranks" in r]
        threads = next(r for r in measured if r["threads"] == 2)["cpu"]
        for row in measured:
            model = f"{predicted(measured, row['ranks']):.2f}" if row["threads"] == 1 else ""
            lines.append(f"| `{scene}` | {row['ranks']} × {row['threads']} | {row['seconds']:.2f} | {row['cpu']:.2f} | "
                         f"{row['cpu'] / threads:.3f} | {model} |")
    lines += ["", "| scene | ranks | imbalance | walks, s | fit, s | " +
              " | ".join(f"messages at {name}, s" for name in CLUSTERS) + " | efficiency |",
              "|---|---|---|---|---|" + "---|" * (len(CLUSTERS) + 1)]
    for scene in SCENES:
        simulated = [r for r in rows if r["scene"] == scene and "simulated_ranks" in r]
        for row in simulated:
            messages = [row[f"messages, {name}"] for name in CLUSTERS]
            whole = row["walks"] + row["fit"] + messages[0]
            ideal = (simulated[0]["walks"] + simulated[0]["fit"]) / row["simulated_ranks"]
            lines.append(f"| `{scene}` | {row['simulated_ranks']} | {row['imbalance']:.2f} | {row['walks']:.3f} | "
                         f"{row['fit']:.2f} | " + " | ".join(f"{m:.3f}" for m in messages) + f" | {ideal / whole:.2f} |")
    return "\n".join(lines)


def write_page(text, commit):
    page = ROOT / "docs" / "scaling.md"
    begin, end = "<!-- scaling -->", "<!-- /scaling -->"
    content = page.read_text()
    head, rest = content.split(begin)
    page.write_text(head + begin + "\n" + text + f"\n\n*Commit `{commit}`.*\n" + end + rest.split(end)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wend", type=Path, default=ROOT / "build/release/bin/wend")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--pairs", type=int, help="turns of two ranks and two threads, and nothing else")
    parser.add_argument("--scenes", default=",".join(SCENES), help="for --pairs: which, separated by commas")
    parser.add_argument("--sampling", default=SAMPLING, help="for --pairs")
    parser.add_argument("--spp", type=int, default=SAMPLES, help="for --pairs")
    arguments = parser.parse_args()
    if arguments.pairs:
        with tempfile.TemporaryDirectory() as folder:
            for scene in arguments.scenes.split(","):
                print_pairs(arguments.wend, scene, arguments.pairs, arguments.sampling, arguments.spp, folder)
        return
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], check=True, capture_output=True,
                            text=True).stdout.strip()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in SCENES:
            measured = measure(arguments.wend, scene, arguments.repetitions, folder)
            rows += measured
            before, now = (tile_work(arguments.wend, scene, seed, folder) for seed in (1, 2))
            told = render(arguments.wend, scene, 1, 1, ["--resolution", "320x180", "--spp", 15, "--sampling", "classical"],
                          folder)
            # Two million records a pass, by as many threads as a rank has.
            fit = measured[0]["training"] / measured[0]["passes"] / 4
            rows += simulate(scene, before, now, told["segments"] / told["seconds"], fit,
                             measured[0]["field_bytes"])
    (ROOT / "bench/results/scaling.json").write_text(json.dumps({"commit": commit, "rows": rows}, indent=1) + "\n")
    write_page(tables(rows), commit)
    print(tables(rows))


if __name__ == "__main__":
    main()
