"""The one-dimensional laboratory: half-spaces and slabs, where the exact answer is known."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterable
from typing import Any

import numpy as np

from . import _wend
from ._table import Table

#: Names of the samplers.
samplers: list[str] = _wend.planar_samplers()


#: One value, or several: an array or a list. A tuple of three numbers is one value, of three channels.
Choices = Any


def halfspace(
    *,
    albedo: Choices = None,
    extinction: Choices = None,
    g: Choices = None,
    ior: Choices = None,
    roughness: Choices = None,
    mu0: Choices = None,
    incidence: Choices = None,
    sampler: Choices = None,
    stretch: Choices = None,
    first_flight: Choices = None,
    exponentials: Choices = None,
    moments: Choices = None,
    modes: Choices = None,
    guide_albedo: Choices = None,
    window: Choices = None,
    adjoint: Iterable[Iterable[float]] | None = None,
    walks: Choices = None,
    seed: Choices = None,
    threads: Choices = None,
) -> Table:
    """Walks in an endlessly deep medium under a uniform sky of radiance 1, against the exact answer.

    Every parameter takes one value, or an array or list of values: all combinations are run, one row each. A tuple of
    three numbers is one value: a chromatic medium. None stands for the value in brackets.

    Args:
        albedo: share of collisions that scatter, 0 to 1 (0.8).
        extinction: collisions per length of each channel, relative to the first (1).
        g: mean cosine of the scattering angle, -0.95 to 0.95 (0).
        ior: refractive index, inside over outside, 1 to 3 (1).
        roughness: alpha of the GGX boundary (0).
        mu0: cosine to the normal at which walks enter (1).
        incidence: "normal" or "diffuse", in place of mu0.
        sampler: one of `wend.samplers` ("classical").
        stretch: of the sampler "stretched": how much paths stretch toward the target, below 1 (by the medium).
        first_flight: of "dwivedi": "stretched" or "classical", the flight after entry ("stretched").
        exponentials: of "boundary": how many it keeps, 1 or 2 (1).
        moments: of "boundary" with one exponential: which moments of the true fluence it has, "01" or "12" ("01").
        modes: of "modes": transients beside the discrete mode (8).
        guide_albedo: guide as if the albedo were this one (the medium's).
        window: "none", "adjoint" or "weight": what ends walks early or splits them ("none").
        adjoint: one of your own, which the sampler "modes" then follows: a table with a row for each mode, longest
            first, of (length in mean free paths, amplitude at the near side, at the far side, Legendre coefficients of
            its shape ...). The mode's part of the source is amplitude * exp(-depth / length) * shape(cosine), a
            cosine being positive deeper. The longest mode must be positive in every direction; negative terms are
            lowered where the sum would not be.
        walks: how many (1e5).
        seed: of the random numbers (0).
        threads: 0: all.

    Returns:
        A table: what was given, then `mean`, `std_error`, `variance` of one walk, `exact`, `collisions_per_walk`,
        `seconds` and `fom`, the figure of merit in 1/s.

    Raises:
        InputError: for values out of their ranges, with the range.
    """
    return _run(locals(), slab=False)


def slab(
    *,
    thickness: Choices,
    tally: Choices = None,
    albedo: Choices = None,
    extinction: Choices = None,
    g: Choices = None,
    ior: Choices = None,
    roughness: Choices = None,
    mu0: Choices = None,
    incidence: Choices = None,
    sampler: Choices = None,
    stretch: Choices = None,
    first_flight: Choices = None,
    exponentials: Choices = None,
    moments: Choices = None,
    modes: Choices = None,
    guide_albedo: Choices = None,
    window: Choices = None,
    adjoint: Iterable[Iterable[float]] | None = None,
    walks: Choices = None,
    seed: Choices = None,
    threads: Choices = None,
) -> Table:
    """Walks through a layer lit by a uniform sky from one side.

    Args:
        thickness: in mean free paths; required.
        tally: "reflectance" or "transmittance" ("reflectance").

    The others, and what comes back, are those of `halfspace`.
    """
    return _run(locals(), slab=True)


_RESULTS = ("mean", "std_error", "variance", "exact", "collisions_per_walk", "seconds", "fom")


def _choices(value: Any) -> list[Any]:
    if isinstance(value, (str, tuple)) or not isinstance(value, (Iterable, np.ndarray)):
        return [value]
    return list(value)


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return ",".join(map(_text, value))
    return value if isinstance(value, str) else repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def _run(parameters: dict[str, Any], slab: bool) -> Table:
    rows = []
    adjoint = parameters.pop("adjoint")
    modes = None if adjoint is None else [[float(x) for x in row] for row in adjoint]
    choices = {name: _choices(value) for name, value in parameters.items() if value is not None}
    for values in itertools.product(*choices.values()):
        varied = dict(zip(choices, values))
        options = [part for name, value in varied.items() for part in ("--" + name.replace("_", "-"), _text(value))]
        found = json.loads(_wend.run_experiment(options, slab, modes))
        rows.append(varied | {"sampler": found["sampler"]} | {name: found[name] for name in _RESULTS})
    return Table.of(rows)
