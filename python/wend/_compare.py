"""Ways of sampling in equal time."""

from __future__ import annotations

import html
import itertools
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _wend
from ._arguments import names_of
from ._film import Film, Reference, halves
from ._progress import Bar
from ._scene import Scene, load
from ._table import Table

_RUN_COLUMNS = ("seed", "spp", "seconds", "work", "relmse", "relmse_std_error", "relmse_trimmed", "error_p9999", "mse",
                "mape", "ratio")
_POINT_COLUMNS = ("spp", "seconds", "work", "relmse", "relmse_trimmed")


def _row(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row of the table: what is no number is left out, and the spread over seeds is flat."""
    flat = {name: value for name, value in row.items() if name not in ("scene", "guiding", "spread", "runs")}
    error, ratio = row["spread"]["relmse"], row["spread"]["ratio"]
    for name in ("median", "min", "max", "mean"):
        flat[f"relmse_{name}"] = error[name]
    return flat | {"relmse_mean_error": error["std_error"], "ratio_min": ratio["min"], "ratio_max": ratio["max"]}


def _runs(rows: Iterable[Mapping[str, Any]]) -> Iterable[dict[str, Any]]:
    for row in rows:
        for run in row["runs"]:
            yield {"sampling": row["sampling"]} | {name: run[name] for name in _RUN_COLUMNS}


def _curves(rows: Iterable[Mapping[str, Any]]) -> Iterable[dict[str, Any]]:
    for row in rows:
        for run in row["runs"]:
            for point in run["points"]:
                yield {"sampling": row["sampling"], "seed": run["seed"]} | {n: point[n] for n in _POINT_COLUMNS}


class Comparison:
    """What `compare` found. A notebook shows its page: pictures, error maps, convergence."""

    def __init__(self, native: _wend.Comparison) -> None:
        self._native = native

    @property
    def rows(self) -> Table:
        """One row a way of sampling, of its median run: `sampling`, `spp`, `seconds`, `work` (segments of its walks),
        `relmse`, `relmse_std_error` (by the scatter over pixels), `relmse_trimmed`, `error_p9999`, `mse`, `mape`,
        `flip` and `ratio`, relMSE times seconds of classical sampling over this one's. Over the seeds:
        `relmse_median`, `relmse_min`, `relmse_max`, `relmse_mean` and its standard error `relmse_mean_error`,
        `ratio_min`, `ratio_max`."""
        return Table.of(map(_row, self._native.rows()))

    @property
    def runs(self) -> Table:
        """One row a render: `sampling`, `seed`, `spp`, `seconds`, `work`, `relmse`, `relmse_std_error`,
        `relmse_trimmed`, `error_p9999`, `mse`, `mape`, `ratio`."""
        return Table.of(_runs(self._native.rows()))

    @property
    def curves(self) -> Table:
        """How the error fell: `sampling`, `seed`, `spp`, `seconds`, `work`, `relmse`, `relmse_trimmed`."""
        return Table.of(_curves(self._native.rows()))

    @property
    def reference(self) -> dict[str, Any]:
        """Where the reference comes from: `source`, its `resolution`, the `halves` that were rendered (`seed`, `spp`,
        `seconds`), and `noise`, the relMSE of its own noise (None where one picture stands for both halves)."""
        return dict(self._native.reference_facts())

    @property
    def films(self) -> dict[str, Film]:
        """The median picture of each way, with what its walks did as layers, and the reference."""
        films = {name: Film(self._native.picture(i)) for i, name in enumerate(self._names())}
        return films | {"reference": Film(self._native.reference())}

    @property
    def errors(self) -> dict[str, Film]:
        """The errors of each way pixel by pixel, as means over the seeds: squared errors as the image, and the layers
        `relative_squared` (its mean is the mean relMSE), `relative` and `bias`."""
        return {name: Film(self._native.errors(i)) for i, name in enumerate(self._names())}

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write pictures, errors, tables and index.html into a folder."""
        self._native.save(os.fspath(folder))

    def _names(self) -> list[str]:
        return [row["sampling"] for row in self._native.rows()]

    def _repr_html_(self) -> str:
        page = html.escape(self._native.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:900px;border:0"></iframe>'

    def __repr__(self) -> str:
        return self._native.table()


class SceneComparisons(dict[str, Comparison]):
    """What `compare_scenes` found: a `Comparison` for each scene, by its name."""

    @property
    def rows(self) -> Table:
        """`Comparison.rows` of all, with a first column `scene`."""
        return self._all("rows")

    @property
    def runs(self) -> Table:
        """`Comparison.runs` of all, with a first column `scene`."""
        return self._all("runs")

    @property
    def curves(self) -> Table:
        """`Comparison.curves` of all, with a first column `scene`."""
        return self._all("curves")

    @property
    def gains(self) -> Table:
        """How gains over classical sampling are distributed over the scenes, a row for each other way: `sampling`,
        `geometric_mean`, `error_factor` (exp of the standard error of the mean logarithm), `min`, `p10`, `p25`,
        `median`, `p75`, `p90`, `max`, `losses` (scenes with a gain below 1), and the `worst` scene."""
        rows = []
        for gain in _wend.gains([(name, comparison._native) for name, comparison in self.items()]):
            numbers = {name: value for name, value in gain.items() if name not in ("scenes", "unknown")}
            rows.append(numbers | {"worst": gain["scenes"][0]["scene"] if gain["scenes"] else None})
        return Table.of(rows)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write a report over all: index.html with the gains, the worst first, and a folder for each scene."""
        _wend.write_report([(name, comparison._native) for name, comparison in self.items()], os.fspath(folder))

    def _all(self, table: str) -> Table:
        return Table.of({"scene": name} | row for name, one in self.items() for row in getattr(one, table).rows)

    def __repr__(self) -> str:
        return "\n\n".join(f"{name}\n{comparison!r}" for name, comparison in self.items())


def compare(
    scene: Scene | str | os.PathLike[str],
    *,
    time: float = 30,
    sampling: Sequence[str] = ("classical", "distance+direction", "full"),
    subsurface: Sequence[str] = ("classical",),
    seeds: int = 3,
    reference: Reference | None = None,
    reference_spp: int | None = None,
    reference_time: float | None = None,
    progress: bool = True,
) -> Comparison:
    """Render a scene in several ways for the same time, and measure each against a reference.

    Args:
        scene: a scene, or a scene file.
        time: seconds of each render, training included.
        sampling: what is compared; names as in `Render`.
        subsurface: each with these walks inside dense media.
        seeds: renders of each way, of which the median counts.
        reference: see `metric`; "render": one is rendered; None: the pair beside the scene's file, or else one is
            rendered.
        reference_spp: samples per pixel of each half of a rendered reference.
        reference_time: seconds for each half (default: eight times `time`). Either of these asks for a rendered one.
        progress: show bars (tqdm).

    Raises:
        InputError: for names that there are not, or a reference of another size.
        ValueError: where both `reference_spp` and `reference_time` are given, or with a reference that is at hand.
    """
    if not isinstance(scene, Scene):
        scene = load(scene)
    has_effort = reference_spp is not None or reference_time is not None
    asks_to_render = isinstance(reference, str) and reference == "render"
    is_given = reference is not None and not asks_to_render
    if (reference_spp is not None and reference_time is not None) or (is_given and has_effort):
        raise ValueError("reference_spp or reference_time is for a reference that is rendered")
    if reference is None and not has_effort:
        beside = os.path.splitext(scene.file)[0]
        if all(os.path.exists(f"{beside}.ref-{half}.exr") for half in "ab"):
            reference = beside
    a, b = (None, None) if reference is None or asks_to_render else halves(reference)
    bars: list[Bar] = []

    def watch(name: str, number: int, fraction: float, seconds: float) -> None:
        if seconds == 0:
            if bars:
                bars.pop().close()
            bars.append(Bar(f"{name} {number + 1}", progress))
        else:
            bars[-1].update(fraction)

    ways = [(one, inside) for one in names_of(sampling, "sampling") for inside in names_of(subsurface, "subsurface")]
    seconds = float(time) * _wend.reference_effort if reference_time is None else float(reference_time)
    try:
        return Comparison(
            _wend.compare(scene._native, ways, float(time), seeds, a, b, reference_spp or 0, seconds, watch)
        )
    finally:
        while bars:
            bars.pop().close()


def compare_scenes(scenes: Iterable[str | os.PathLike[str]] | Mapping[str, Scene], **options: Any) -> SceneComparisons:
    """Compare ways of sampling in several scenes, one after the other.

    Args:
        scenes: scene files, which are called by their names without folder and extension, or scenes by name.
        options: as those of `compare`. A `reference` that is a folder has a pair NAME.ref-a.exr, NAME.ref-b.exr for
            each scene.

    Raises:
        InputError: as `compare` does.
    """
    if isinstance(scenes, Mapping):
        named: dict[str, Scene | str | os.PathLike[str]] = dict(scenes)
    else:
        named = {}
        for file in scenes:
            stem = os.path.splitext(os.path.basename(os.fspath(file)))[0]
            names = itertools.chain([stem], (f"{stem}-{number}" for number in itertools.count(2)))
            named[next(name for name in names if name not in named)] = file
    results = SceneComparisons()
    for name, scene in named.items():
        reference = options.get("reference")
        if isinstance(reference, (str, os.PathLike)) and os.path.isdir(reference):
            results[name] = compare(scene, **(options | {"reference": os.path.join(os.fspath(reference), name)}))
        else:
            results[name] = compare(scene, **options)
    return results
