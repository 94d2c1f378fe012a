"""What Cycles makes of the tests' scenes, kept where rendering it takes long: means of blocks over `RENDERS` pictures.

`cycles_references.json` has them by the test's name, with the standard error of a block. They are taken where `bpy` has
the version that made them; otherwise, and with WEND_CYCLES=render, Cycles renders as many samples as the test asks for.
WEND_CYCLES=record renders and keeps them: that is for a test that is new or whose scene has changed.
"""

import json
import os
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

FILE = Path(__file__).with_name("cycles_references.json")
RENDERS = 4


def _kept() -> dict:
    kept = json.loads(FILE.read_text()) if FILE.exists() else {}
    return kept if kept.get("bpy") == bpy.app.version_string else {"bpy": bpy.app.version_string, "tests": {}}


def _test() -> str:
    return os.environ["PYTEST_CURRENT_TEST"].rsplit("/", 1)[-1].split(" (", 1)[0]


def _record(name: str, pictures: np.ndarray) -> np.ndarray:
    mean, deviation = pictures.mean(axis=0), pictures.std(axis=0, ddof=1)
    error = np.sqrt(np.mean((deviation / np.maximum(mean, 0.05 * mean.mean())) ** 2) / len(pictures))
    kept = _kept()
    # Six digits, a row of blocks a line.
    rows = [" ".join(f"{value:.6g}" for value in row.ravel()) for row in mean]
    kept["tests"][name] = {"error": float(f"{error:.2g}"), "blocks": rows}
    kept["tests"] = dict(sorted(kept["tests"].items()))
    FILE.write_text(json.dumps(kept, indent=1) + "\n")
    return mean


def reference(render: Callable[[int], np.ndarray]) -> np.ndarray:
    """The means of blocks for the test that runs; `render` makes those of a picture with a seed."""
    name, wish = _test(), os.environ.get("WEND_CYCLES")
    if wish == "record":
        return _record(name, np.array([render(seed) for seed in range(RENDERS)]))
    found = None if wish == "render" else _kept()["tests"].get(name)
    if found is None:
        return render(0)
    rows = np.array([row.split() for row in found["blocks"]], dtype=float)
    return rows.reshape(len(rows), -1, 3)
