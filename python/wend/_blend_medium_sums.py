"""Media that are at one place, as one medium."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Parameters = dict[str, Any]
Array = npt.NDArray[np.float64]

_PHASE = ("string phase", "float g", "float weights", "float alpha", "float diameter", "float index", "float slope")


def summed(given: Sequence[Parameters], tell: Callable[[str], None]) -> Parameters | None:
    """What scatters, absorbs and shines of all of them: they have no scale, and None where several vary.

    Args:
        given: parameters of media.
        tell: is given what is not so.
    """
    varying = [parameters for parameters in given if parameters["string type"] != "homogeneous"]
    if len(varying) > 1:
        return None
    parts = [_coefficients(parameters) for parameters in given]
    scattering, absorption, emission = (sum(part[k] for part in parts) for k in range(3))
    phase = _phase(given, [float(part[0].mean()) for part in parts], tell)
    result: Parameters = {"rgb sigma_s": scattering, "rgb sigma_a": absorption} | phase
    if varying:
        box = {key: value for key, value in varying[0].items() if key not in (*result, *_PHASE, "float density", "rgb glow")}
        glow = {"rgb glow": np.broadcast_to(emission, np.shape(scattering)).astype(np.float32)} if np.max(emission) > 0 else {}
        each = {key: value.astype(np.float32) for key, value in result.items() if key.startswith("rgb")}
        return box | each | glow | phase | {"string type": "rgbgrid"}
    glow = {"rgb Le": np.ravel(emission / np.maximum(absorption, 1e-30))} if np.max(emission) > 0 else {}
    coefficients = {"rgb sigma_s": np.ravel(scattering), "rgb sigma_a": np.ravel(absorption)}
    return {"string type": "homogeneous"} | coefficients | glow | phase


def _coefficients(parameters: Parameters) -> tuple[Array, Array, Array]:
    """Scattering, absorption and emission: a row, or one for each voxel."""
    s, a = (np.reshape(np.asarray(parameters[f"rgb sigma_{k}"], dtype=np.float64), (-1, 3)) for k in "sa")
    if parameters["string type"] == "homogeneous":
        return s, a, a * np.reshape(parameters.get("rgb Le", (0, 0, 0)), (-1, 3))
    density = np.reshape(parameters.get("float density", 1.0), (-1, 1))
    return density * s, density * a, np.reshape(parameters.get("rgb glow", (0, 0, 0)), (-1, 3))


def _phase(given: Sequence[Parameters], weights: list[float], tell: Callable[[str], None]) -> Parameters:
    there = [
        (weight, {key: parameters[key] for key in _PHASE if key in parameters})
        for weight, parameters in zip(weights, given)
        if weight > 0
    ]
    if not there:
        return {}
    if all(repr(phase) == repr(there[0][1]) for _, phase in there):
        return there[0][1]
    if any(phase.get("string phase", "henyeygreenstein") not in ("henyeygreenstein", "henyeygreensteinmixture") for _, phase in there):
        tell("of two phase functions the one that scatters more is taken")
        return max(there, key=lambda part: part[0])[1]
    cosines: list[float] = []
    shares: list[float] = []
    for weight, phase in there:
        lobes = np.ravel(phase.get("float weights", 1.0))
        cosines += np.ravel(phase.get("float g", 0.0)).tolist()
        shares += (weight * lobes / lobes.sum()).tolist()
    return {"string phase": "henyeygreensteinmixture", "float g": cosines, "float weights": shares}
