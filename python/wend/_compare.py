"""Ways of sampling in equal time."""

from __future__ import annotations

import html
import os
from collections.abc import Sequence

from . import _wend
from ._film import Film, Reference, halves
from ._progress import Bar
from ._scene import Scene, load
from ._table import Table


class Comparison:
    """What `compare` found. A notebook shows its page: pictures, error maps, convergence."""

    def __init__(self, native: _wend.Comparison) -> None:
        self._native = native

    @property
    def rows(self) -> Table:
        """One row a way of sampling, of its median run: `sampling`, `spp`, `seconds`, `relmse`, `relmse_trimmed`,
        `error_p9999`, `mse`, `mape`, `flip` and `ratio`, relMSE times seconds of classical sampling over this one's."""
        return Table.of(
            {name: value for name, value in row.items() if name != "guiding"} for row in self._native.rows()
        )

    @property
    def runs(self) -> Table:
        """One row a render: `sampling`, `seed`, `spp`, `seconds`, `relmse`, `relmse_trimmed`, `mse`, `mape`."""
        return Table.of(self._native.runs())

    @property
    def curves(self) -> Table:
        """How the error fell: `sampling`, `seed`, `seconds`, `relmse`."""
        return Table.of(self._native.curves())

    @property
    def films(self) -> dict[str, Film]:
        """The median picture of each way, with what its walks did as layers, and the reference."""
        names = [row["sampling"] for row in self._native.rows()]
        films = {name: Film(self._native.picture(i)) for i, name in enumerate(names)}
        return films | {"reference": Film(self._native.reference())}

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write pictures, error maps and index.html into a folder."""
        self._native.save(os.fspath(folder))

    def _repr_html_(self) -> str:
        page = html.escape(self._native.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:900px;border:0"></iframe>'

    def __repr__(self) -> str:
        return self._native.table()


def compare(
    scene: Scene | str | os.PathLike[str],
    *,
    time: float = 30,
    sampling: Sequence[str] = ("classical", "distance+direction", "full"),
    subsurface: Sequence[str] = ("classical",),
    seeds: int = 3,
    reference: Reference | None = None,
    progress: bool = True,
) -> Comparison:
    """Render a scene in several ways for the same time, and measure each against a reference.

    Args:
        scene: a scene, or a scene file.
        time: seconds of each render, training included.
        sampling: what is compared; names as in `Render`.
        subsurface: each with these walks inside dense media.
        seeds: renders of each way, of which the median counts.
        reference: see `metric`; None: the pair beside the scene's file, or else one is rendered first, which takes
            sixteen times `time`.
        progress: show bars (tqdm).

    Raises:
        InputError: for names that there are not, or a reference of another size.
    """
    if not isinstance(scene, Scene):
        scene = load(scene)
    if reference is None:
        beside = os.path.splitext(scene.file)[0]
        if all(os.path.exists(f"{beside}.ref-{half}.exr") for half in "ab"):
            reference = beside
    a, b = (None, None) if reference is None else halves(reference)
    bars: list[Bar] = []

    def watch(name: str, number: int, fraction: float, seconds: float) -> None:
        if seconds == 0:
            if bars:
                bars.pop().close()
            bars.append(Bar(f"{name} {number + 1}", progress))
        else:
            bars[-1].update(fraction)

    ways = [(one, inside) for one in sampling for inside in subsurface]
    try:
        return Comparison(_wend.compare(scene._native, ways, float(time), seeds, a, b, watch))
    finally:
        while bars:
            bars.pop().close()
