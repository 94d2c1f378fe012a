#!/usr/bin/env python3
"""Writes every table of measurements in the documents from bench/results/*.json.

usage: tables.py            rewrites what stands between the lines `<!-- table: NAME -->` and `<!-- /table -->`
       tables.py --check    changes nothing; exit status 1 and one line for each table that is not what the results give

TABLES, at the end, says which there are. bench/measure.py measures.
"""

import argparse
import datetime
import json
import math
import re
import statistics
import sys
from pathlib import Path

DOCUMENTS = ["README.md", "scenes/README.md", "bench/README.md", "docs/*.md", "docs/experiments/*.md"]
MARKED = re.compile(r"(<!-- table: ([\w-]+) -->\n)(.*?)(<!-- /table -->|(?=<!-- table: )|\Z)", re.DOTALL)

CLASSICAL = {"sampling": "classical", "subsurface": "classical"}
FULL = {"sampling": "full", "subsurface": "auto"}

VOLUMES = ["shield-duct", "fog-door", "cloud", "haze", "smoke-room", "candles", "liquid"]
DENSE = ["skin-rig", "wax-backlit", "milk-key", "marble-sky", "leaf"]
SCENES = ["shield-wall", *VOLUMES, *DENSE]
PUBLIC = ["living-room-2", "living-room-2-fog", "veach-ajar", "veach-ajar-fog", "coffee", "volumetric-caustic"]
PEERS = {"pbrt": "pbrt-v4", "pbrt guided": "its guiding fork", "mitsuba volpath": "Mitsuba `volpath`",
         "cycles": "Cycles", "cycles guided": "Cycles, guided", "wend classical": "Wend, `classical`",
         "wend full": "Wend, `full`"}
PEER_SCENES = {"door": "fog, the lamp in the next room", "room": "the same fog, the lamp in the same room",
               "lump": "a dense ball under a sky and a lamp"}


# -------------------------------------------------------------------------------------------------------------- figures

def digits(x):
    """Three that count, or as few as the file has."""
    if x is None or not math.isfinite(x):
        return "–"
    if x != 0 and abs(x) < 0.0005:
        mantissa, exponent = (f"{x:.1e}" if float(f"{x:.1e}") == x else f"{x:.2e}").split("e")
        return f"{mantissa}e{int(exponent)}"
    if abs(x) >= 100:
        return f"{float(f'{x:.3g}'):.0f}"
    return f"{x:.2g}" if float(f"{x:.2g}") == x else f"{x:#.3g}".rstrip(".")


def ratio(a, b):
    return a / b if a is not None and b else math.nan


def geometric_mean(values):
    return statistics.geometric_mean(values) if values and all(v > 0 for v in values) else math.nan


def both(plain, trimmed):
    """A figure, and in brackets the same without the worst 0.1 % of pixels."""
    return f"{digits(plain)} ({digits(trimmed)})"


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


# ----------------------------------------------------------------------------------------------------------------- rows

class Runs:
    """The renders of one scene by one preset."""

    def __init__(self, results, **key):
        rows = [row for row in results["rows"] if all(row.get(k) == v for k, v in key.items())]
        self.rows = [row for row in rows if not row.get("not_run")]
        self.not_run = ": ".join(["not run", *[row["not_run"] for row in rows if row.get("not_run")][:1]])

    def median(self, what):
        """Of a column, or of what a function says of a row."""
        values = [what(row) if callable(what) else row[what] for row in self.rows]
        return statistics.median(values)

    def samples(self):
        return str(round(self.median("samples")))

    def relmse(self):
        return both(self.median("relmse"), self.median("relmse_trimmed"))

    def cost(self, column):
        """Error times seconds: the inverse of efficiency."""
        return self.median(lambda row: row[column] * row["seconds"])


def pair(results, scene):
    """Classical and guided renders of a scene, or None where one is missing."""
    runs = [Runs(results, scene=scene, **preset) for preset in (CLASSICAL, FULL)]
    return runs if all(r.rows for r in runs) else None


def measured(results, scenes):
    return {scene: runs for scene in scenes if (runs := pair(results, scene))}


def counted(n, noun):
    words = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"]
    return f"{words[n] if n < len(words) else n} {noun}{'' if n == 1 else 's'}"


def seeds_of(results):
    """How many renders there are of what was rendered."""
    counts = {}
    for row in (row for row in results["rows"] if not row.get("not_run")):
        key = tuple(row.get(k) for k in ("scene", "sampling", "subsurface", "renderer", "albedo", "sampler"))
        counts[key] = counts.get(key, 0) + 1
    least, most = min(counts.values()), max(counts.values())
    return counted(most, "seed") if least == most else f"{least} to {counted(most, 'seed')}"


def where(results):
    """The commit, the date and the machine."""
    date = datetime.date.fromisoformat(results["date"])
    machine, commit = results["machine"], f"`{results['commit']}`" + (" with changes" if results["dirty"] else "")
    cpu = machine["cpu"] and re.sub(r"\(R\)|\(TM\)| Processor| CPU", "", machine["cpu"])
    names = [cpu, counted(machine["cores"], "core"), machine["os"]]
    return f"Commit {commit}, {date.day} {date:%B %Y}, " + ", ".join(name for name in names if name)


def note(results, *sentences):
    """The line under a table."""
    shares = [row["cpu_seconds"] / row["wall_seconds"] for row in results["rows"] if row.get("wall_seconds")]
    threads = results["settings"].get("threads") or results["machine"]["cores"]
    if shares and statistics.median(shares) < 0.85 * threads:
        sentences += (f"Others used the machine: a render had {statistics.median(shares):.1f} of its "
                      f"{counted(threads, 'core')} (median)",)
    if results.get("origin"):
        sentences += (results["origin"],)
    return "\n*" + ". ".join([where(results), *sentences]) + ".*\n"


def budget(results):
    seeds = seeds_of(results)
    return f"{results['settings']['seconds']:g} seconds for each render, training included, {seeds}" + (
        "" if seeds == "one seed" else " (medians)")


def warnings(scenes, found):
    """What a reader of ratios should know."""
    names = [f"`{scene}`" for scene in scenes if scene not in found]
    few = min((len(r.rows) for runs in found.values() for r in runs), default=0) < 3
    return ["Fewer than three seeds: compare orders of magnitude alone"] * few + (
        [f"Not measured: {', '.join(names)}"] if names else [])


RATIO = "The ratio is that of relMSE × seconds"


# --------------------------------------------------------------------------------------------------------------- tables

def equal_time(results, scenes, groups=()):
    """Classical sampling against the default; groups are pairs of a name and scenes, for geometric means."""
    found = measured(results, scenes)
    gains, rows = {}, []
    for scene, (classical, full) in found.items():
        gains[scene] = [ratio(classical.cost(c), full.cost(c)) for c in ("relmse", "relmse_trimmed")]
        cells = [f"{r.samples()}, {r.relmse()}" for r in (classical, full)]
        rows.append([f"`{scene}`", *cells, both(*gains[scene])])
    for name, group in groups:
        if all(scene in gains for scene in group):
            rows.append([f"geometric mean {name}".strip(), "", "",
                         both(*(geometric_mean([gains[scene][i] for scene in group]) for i in range(2)))])
    head = ["scene", "`classical`: samples, relMSE", "`full`: samples, relMSE", "ratio"]
    return table(head, rows) + note(results, budget(results), RATIO, *warnings(scenes, found))


def scenes_equal_time(results):
    return equal_time(results, SCENES, [("from `shield-duct` to `liquid`", VOLUMES), ("from `skin-rig` on", DENSE)])


def public_equal_time(results):
    return equal_time(results, PUBLIC, [("", PUBLIC)])


def demo(results):
    return equal_time(results, ["demo"])


def fireflies(results, short):
    found, found_short = measured(results, SCENES), measured(short, SCENES)
    rows = []
    for scene in SCENES:
        cells = [[""] * 3, [""] * 3]
        if scene in found:
            errors = [r.median("error_p9999") for r in found[scene]]
            cells[0] = [digits(e) for e in errors] + [digits(ratio(*errors))]
        if scene in found_short:
            errors = [r.median("error_p9999") for r in found_short[scene]]
            cells[1] = [f"{r.samples()}, {r.relmse()}, {digits(e)}" for r, e in zip(found_short[scene], errors)]
            cells[1].append(digits(ratio(*errors)))
        rows.append([f"`{scene}`", *cells[0], *cells[1]])
    long_time, short_time = (f"{r['settings']['seconds']:g} s" for r in (results, short))
    head = ["scene", f"{long_time}: `classical`", "`full`", "ratio",
            f"{short_time}: `classical`: samples, relMSE, 99.99 %", "`full`", "ratio"]
    return table(head, rows) + note(results, budget(results), *warnings(SCENES, found)) + note(
        short, budget(short), *warnings(SCENES, found_short))


def peer_scenes(results):
    """Those of scenes.py, then those in files."""
    return list(dict.fromkeys([*PEER_SCENES, *(row["scene"] for row in results["rows"])]))


def peers(results):
    """One row for each scene: the error, the least in bold. Why something was not run, peers_all() says."""
    rows = []
    for scene in peer_scenes(results):
        runs = [Runs(results, scene=scene, renderer=name) for name in PEERS]
        least = min((r.median("relmse") for r in runs if r.rows), default=None)
        bold = lambda r: "**{}**" if r.median("relmse") == least else "{}"
        cells = [bold(r).format(r.relmse()) if r.rows else "not run" for r in runs]
        rows.append([": ".join([f"`{scene}`", *([PEER_SCENES[scene]] if scene in PEER_SCENES else [])]), *cells])
    return table(["relMSE", *PEERS.values()], rows) + note(results, budget(results))


def peers_all(results):
    """One row for each renderer: error, brightest errors, and the mean over the reference's."""
    rows = []
    for name, told in PEERS.items():
        runs = [Runs(results, scene=scene, renderer=name) for scene in peer_scenes(results)]
        rows.append([told, *(f"{r.relmse()}, {digits(r.median('error_p9999'))}, {r.median('mean_over_reference'):.3f}"
                             if r.rows else r.not_run for r in runs)])
    versions = sorted({row["version"] for row in results["rows"] if row.get("version")})
    return table(["", *(f"`{scene}`" for scene in peer_scenes(results))], rows) + note(
        results, budget(results), *([", ".join(versions)] if versions else []))


def shields(results):
    """What comes through slabs, by figure of merit with what it took to prepare."""
    rows = []
    for row in results["rows"]:
        slab = f"albedo {row['albedo']:g}, {row['thickness']:g} mean free paths"
        if row.get("not_run"):
            rows.append([slab, row["sampler"], f"not run: {row['not_run']}", "", "", ""])
            continue
        error = f"{100 * row['std_error'] / row['mean']:.2g} %" if row["mean"] else "–"
        rows.append([slab, row["sampler"], f"{row['mean']:.4g}, {row['exact']:.4g}", error,
                     f"{row['cpu_seconds']:.2g}, {row['setup_seconds']:.2g}",
                     f"{row['fom']:.2g}" if row.get("fom") else "–"])
    head = ["slab", "way", "mean, exact", "standard error", "seconds of walks, of preparing", "figure of merit"]
    return table(head, rows) + note(results, "OpenMC 0.16, one group", "One seed, others used the machine")


def planar(results):
    """The variance of one walk, and how many times the classical figure of merit the last sampler has."""
    samplers = ["classical", "dwivedi", "boundary", "modes"]
    rough = lambda x, decimals: f"{x:.{decimals}e}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
    rows = []
    for albedo in sorted({row["albedo"] for row in results["rows"]}):
        runs = [Runs(results, albedo=albedo, sampler=sampler) for sampler in samplers]
        gain = ratio(runs[-1].median("fom"), runs[0].median("fom"))
        rows.append([f"{albedo:g}", *(rough(r.median("variance"), 1) for r in runs), rough(gain, 0)])
    head = ["albedo", *(f"`{sampler}`" for sampler in samplers), "figure of merit of `modes` over `classical`"]
    return table(head, rows) + note(results, f"{results['settings']['walks']:,} walks, {seeds_of(results)}")


def example(results):
    """Means and standard errors of the channels of examples/subsurface."""
    albedo = {"red": "0.975", "green": "0.95", "blue": "0.9"}
    rows = [[f"{r['channel']} ({albedo[r['channel']]})", f"{r['classical']:.4f} ± {r['classical_error']:.4f}",
             f"{r['guided']:.4f} ± {r['guided_error']:.4f}", f"{r['gain']:.1f} ×",
             f"{r['learned']:.4f} ± {r['learned_error']:.4f}", f"{r['learned_gain']:.1f} ×"] for r in results["rows"]]
    head = ["channel (albedo)", "classical", "guided", "less variance", "with the mix learned", "less variance"]
    return table(head, rows) + note(results)


def phases(results):
    """What guiding brings with each phase function, beside Henyey and Greenstein's of the same mean cosine."""
    told = lambda value, error: f"{value:.2g} ± {100 * error:.0f} %"
    rows = []
    for row in results["rows"]:
        cells = [f"{told(gains['gain'][0], gains['error'][0])} ({told(gains['gain'][1], gains['error'][1])})"
                 for gains in (row["own"], row["hg"])]
        shares = [row["own"]["gain"][i] / row["hg"]["gain"][i] for i in range(2)]
        rows.append([row["function"], f"{row['mean_cosine']:.2f}", *cells, both(*shares)])
    head = ["phase function", "mean cosine", "gain", "of Henyey and Greenstein's", "one over the other"]
    samples = (f"{results['samples']} samples, means over {results['classical_seeds']} seeds of `classical` and "
               f"{results['seeds']} of the default")
    return table(head, rows) + f"\n*Commit `{results['commit']}`, {results['resolution']}, {samples}.*\n"


def stopping(results):
    """When large renders had a picture on disk, and how long they went on after a signal: medians and the longest."""
    rows = []
    for scene in dict.fromkeys(row["scene"] for row in results["rows"]):
        runs = [row for row in results["rows"] if row["scene"] == scene]
        told = lambda what: (f"{statistics.median(r[what] for r in runs):.2f} s ({max(r[what] for r in runs):.2f} s)")
        rows.append([f"`{scene}`", told("first_picture"), told("stopped"), str(len(runs))])
    head = ["scene", "first picture", "from SIGTERM to the end", "renders"]
    return table(head, rows) + note(results, results["settings"]["resolution"].replace("x", " × ") + " pixels",
                                    "Medians, and the longest in brackets")


# Name: what makes it, of which files of bench/results.
TABLES = {
    "scenes-equal-time": (scenes_equal_time, "scenes"),
    "scenes-fireflies": (fireflies, "scenes", "short"),
    "public-equal-time": (public_equal_time, "public"),
    "demo": (demo, "demo"),
    "peers": (peers, "peers"),
    "peers-all": (peers_all, "peers"),
    "phases": (phases, "phases"),
    "shields": (shields, "shields"),
    "planar": (planar, "planar"),
    "stopping": (stopping, "stopping"),
    "example-subsurface": (example, "example"),
}


# ------------------------------------------------------------------------------------------------------------ documents

def made(root, name):
    """The text of a table; a ValueError says what is wrong."""
    if name not in TABLES:
        raise ValueError(f"no table '{name}' in bench/tables.py")
    make, *files = TABLES[name]
    paths = [root / "bench/results" / f"{file}.json" for file in files]
    for path, file in zip(paths, files):
        if not path.exists():
            raise ValueError(f"table '{name}' lacks {path}: bench/measure.py {file}")
    return make(*(json.loads(path.read_text()) for path in paths))


def rewritten(root, text):
    """The text with its tables as they are to be, and (line number, what is wrong) of each that was not."""
    wrong = []

    def replace(match):
        line = text.count("\n", 0, match.start()) + 1
        try:
            if match[4] == "":
                raise ValueError(f"table '{match[2]}' has no end")
            new = made(root, match[2])
        except ValueError as error:
            wrong.append((line, str(error)))
            return match[0]
        if new != match[3]:
            wrong.append((line, f"table '{match[2]}' is not what the results give: run bench/tables.py"))
        return match[1] + new + match[4]

    return MARKED.sub(replace, text), wrong


def documents(root):
    return sorted(path for pattern in DOCUMENTS for path in root.glob(pattern))


def offences(root):
    for path in documents(root):
        for line, what in rewritten(root, path.read_text())[1]:
            yield f"{path}:{line}: {what}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[1], help="of the checkout")
    arguments = parser.parse_args()
    if not arguments.check:
        for path in documents(arguments.root):
            old = path.read_text()
            new = rewritten(arguments.root, old)[0]
            if new != old:
                path.write_text(new)
                print(path)
    found = list(offences(arguments.root))
    if found or arguments.check:
        print("\n".join(found) or "every table is what the results give")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
