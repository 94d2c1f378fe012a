"""Rendering: in one call, or step by step."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator
from time import monotonic
from typing import Any, NoReturn

from . import _wend
from ._arguments import instance, names_of, whole
from ._errors import InputError
from ._film import Film
from ._progress import Bar
from ._scene import Scene, load
from .guide import Fields

#: Seconds between looks at the keyboard.
_STEP = 0.2

_MOST_SAMPLES = 1 << 30
_MOST_THREADS = 4096
_MOST_SEED = (1 << 64) - 1


class Render:
    """A render that is stepped, looked at, saved and resumed.

    The picture does not depend on how it is stepped, nor on the number of threads, unless time ends it.

    Args:
        scene: what to render.
        spp: samples per pixel; None: the scene's.
        time: seconds to spend, training included, in place of `spp`.
        noise: end where the relative noise is estimated to be no more than this, such as 0.02, in every square of
            16x16 pixels.
        passes: repeat these passes of an earlier render (its `statistics["passes"]`).
        sampling: "classical"; "full", whatever pays, where it pays; or decisions to guide everywhere, joined by "+":
            scatter, distance, direction, roulette, splitting.
        subsurface: walks inside dense media: "auto", "classical" or the name of a technique.
        fields: what an earlier render of the scene learned.
        seed: of the random numbers; None: the scene's.
        threads: 0: all.
        layers: more layers of the film: "emission", "background", "direct", "indirect", "volume", "lights", "halves",
            "geometry" (docs/pictures.md).
        keep_fields: whether `fields` is wanted at the end: then the last pass teaches them, too.

    Raises:
        InputError: for a value that there is not.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        spp: int | None = None,
        time: float | None = None,
        noise: float | None = None,
        passes: list[int] | None = None,
        sampling: str = "full",
        subsurface: str = "auto",
        fields: Fields | None = None,
        seed: int | None = None,
        threads: int = 0,
        layers: Iterable[str] = (),
        keep_fields: bool = True,
    ) -> None:
        if sum(x is not None for x in (spp, time, passes)) > 1:
            raise InputError("give one of spp, time and passes")
        for name, value in (("time", time), ("noise", noise)):
            if value is not None and not (value > 0 and math.isfinite(value)):
                raise InputError(f"{name}: expected a positive number, not {value}")
        self._scene: Scene = instance(scene, Scene, "scene", "wend.load")
        self._native = _wend.Render(
            self._scene._native,
            0 if spp is None else whole(spp, "spp", 1, _MOST_SAMPLES),
            float(time or 0),
            float(noise or 0),
            [] if passes is None else [whole(count, "passes", 1, _MOST_SAMPLES) for count in passes],
            sampling,
            subsurface,
            None if fields is None else instance(fields, Fields, "fields", "Render.fields, or wend.guide")._native,
            keep_fields and sampling != "classical",
            None if seed is None else whole(seed, "seed", 0, _MOST_SEED),
            whole(threads, "threads", 0, _MOST_THREADS),
            names_of(layers, "layers"),
        )
        self._ended = False

    @property
    def scene(self) -> Scene:
        """What is rendered."""
        return self._scene

    def step(self, seconds: float = math.inf) -> bool:
        """Go on for about so many seconds, or to the end of a pass if that comes first.

        Returns:
            Whether there is more to do. Other Python threads run meanwhile, and Ctrl-C ends it within a second: the
            render can be gone on with.
        """
        if math.isnan(seconds):
            raise InputError("seconds: expected a number")
        end = monotonic() + seconds
        while True:
            left = end - monotonic()
            self._ended = not self._native.step(min(max(left, 0), _STEP))
            if self._ended or left <= _STEP or not self._native.is_within_pass or self._native.is_stopped:
                return not self._ended

    def passes(self) -> Iterator[Film]:
        """Go on pass by pass, giving the film after each one. A pass has twice the samples of the one before, up to
        32; what was learned in it guides the next."""
        while not self._ended and not self._native.is_stopped:
            self.step()
            yield self.film

    def run(self, *, progress: bool = False) -> Film:
        """Go on to the end, where Ctrl-C stops within a second: the render can be gone on with.

        Args:
            progress: show a bar (tqdm).
        """
        bar = Bar(os.path.basename(self._scene.file), progress)
        try:
            while not self._ended and not self._native.is_stopped:
                self.step(_STEP)
                state = self._native.progress()
                noise = f", noise {100 * state['relative_noise']:.1f} %" if state["relative_noise"] > 0 else ""
                bar.update(state["fraction"], f"{state['spp']} spp{noise}")
        finally:
            bar.close()
        return self.film

    def stop(self) -> None:
        """Let what is under way in another thread, `step`, `run` or `passes`, end within a second, and do nothing from
        then on."""
        self._native.set_stop(True)

    @property
    def film(self) -> Film:
        """The picture so far, a copy: all samples that have ended."""
        return Film(self._native.picture(), self.statistics)

    @property
    def progress(self) -> dict[str, float]:
        """`fraction` of the whole, `seconds` so far, `seconds_left`, `spp` and `relative_noise`: of the
        picture, or, where noise is to end the render, of the noisiest square of 16x16 pixels."""
        return self._native.progress()

    @property
    def statistics(self) -> dict[str, Any]:
        """What it did so far: `spp`, `seconds`, `training_seconds`, `paths`, `segments`, `passes`, `guiding`."""
        return self._native.statistics()

    @property
    def fields(self) -> Fields | None:
        """What was learned, a copy; None for classical sampling."""
        native = self._native.fields()
        return None if native is None else Fields._of(native)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a checkpoint: all that is needed to go on, the film included. `wend render --resume` takes it, too."""
        self._native.save(os.fspath(path))

    def resume(self, path: str | os.PathLike[str]) -> None:
        """Go on from a checkpoint, whatever was done before.

        Raises:
            InputError: for a checkpoint of another scene or other settings, naming what differs.
        """
        self._native.resume(os.fspath(path))
        self._ended = False

    def __reduce_ex__(self, protocol: object) -> NoReturn:
        raise TypeError("a render can neither be copied nor pickled: save it, and resume from the file")


def render(
    scene: Scene | str | os.PathLike[str],
    *,
    spp: int | None = None,
    time: float | None = None,
    noise: float | None = None,
    passes: list[int] | None = None,
    sampling: str = "full",
    subsurface: str = "auto",
    fields: Fields | None = None,
    seed: int | None = None,
    threads: int = 0,
    layers: Iterable[str] = (),
    progress: bool = True,
) -> Film:
    """Render a scene, or a scene file. The arguments are those of `Render`; `progress` shows a bar (tqdm).

    The same scene, samples and seed give the same bits as `wend render`, by any number of threads.
    """
    if not isinstance(scene, Scene):
        scene = load(scene)
    return Render(
        scene,
        spp=spp,
        time=time,
        noise=noise,
        passes=passes,
        sampling=sampling,
        subsurface=subsurface,
        fields=fields,
        seed=seed,
        threads=threads,
        layers=layers,
        keep_fields=False,
    ).run(progress=progress)
