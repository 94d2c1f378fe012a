"""Photometric files of lamps (IES LM-63): how much light goes into which direction."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._errors import InputError

Angles = npt.NDArray[np.float64]

#: A file with more angles than this is none.
_MOST_ANGLES = 10**6


@dataclass
class Profile:
    """Candela by vertical angle from the lamp's axis, and by horizontal angle around it, both in degrees."""

    vertical: Angles
    horizontal: Angles
    candela: npt.NDArray[np.float64]  #: (horizontal, vertical)

    def at(self, vertical: Angles, horizontal: Angles) -> Angles:
        """In between by interpolation; nothing beyond the vertical angles of the file."""
        last = self.horizontal[-1]
        turned = np.mod(horizontal, 360)
        # What a file leaves out is the mirror image of what it has.
        if last <= 90:
            turned = np.where(turned > 180, 360 - turned, turned)
            turned = np.where(turned > 90, 180 - turned, turned)
        elif last <= 180:
            turned = np.where(turned > 180, 360 - turned, turned)
        h0, part_h = _between(self.horizontal, turned)
        v0, part_v = _between(self.vertical, vertical)
        h1, v1 = np.minimum(h0 + 1, len(self.horizontal) - 1), np.minimum(v0 + 1, len(self.vertical) - 1)
        low = self.candela[h0, v0] * (1 - part_v) + self.candela[h0, v1] * part_v
        high = self.candela[h1, v0] * (1 - part_v) + self.candela[h1, v1] * part_v
        inside = (vertical >= self.vertical[0] - 1e-6) & (vertical <= self.vertical[-1] + 1e-6)
        return np.where(inside, low * (1 - part_h) + high * part_h, 0.0)

    def mean(self) -> float:
        """Over the sphere, or over the hemisphere of a file that has no more."""
        v, h = np.linspace(0, 180, 721)[:-1] + 0.125, np.linspace(0, 360, 361)[:-1] + 0.5
        weight = np.sin(np.radians(v))[None, :]
        mean = float((self.at(v[None, :], h[:, None]) * weight).sum() / (weight.sum() * len(h)))
        return mean if self.vertical[-1] - self.vertical[0] > 91 else 2 * mean


def _between(grid: Angles, values: Angles) -> tuple[npt.NDArray[np.int64], Angles]:
    """The place below each value, and how far it is from there to the next."""
    if len(grid) == 1:
        return np.zeros(np.shape(values), dtype=np.int64), np.zeros(np.shape(values))
    below = np.clip(np.searchsorted(grid, values, side="right") - 1, 0, len(grid) - 2)
    step = np.maximum(grid[below + 1] - grid[below], 1e-12)
    return below, np.clip((values - grid[below]) / step, 0, 1)


def read(path: str | os.PathLike[str]) -> Profile:
    """A file.

    Raises:
        InputError: for one that cannot be read, is no such file, or is not of type C (around the vertical axis).
    """
    name = os.fspath(path)
    try:
        with open(name, encoding="latin-1") as file:
            return parsed(file.read(), name)
    except OSError as error:
        raise InputError(f"{name}: error: {error.strerror}") from None


def parsed(text: str, name: str) -> Profile:
    """What is in a file. `name`: of it, for errors; those of `read`."""
    tilt = re.search(r"^TILT\s*=\s*(\S+).*$", text, re.MULTILINE)
    if tilt is None:
        raise InputError(f"{name}: error: no line TILT=, which an IES file has")
    line = text.count("\n", 0, tilt.end()) + 2
    try:
        numbers = [float(word) for word in re.split(r"[\s,]+", text[tilt.end() :].strip()) if word]
    except ValueError as error:
        raise InputError(f"{name}:{line}: error: after TILT= come numbers alone: {error}") from None
    try:
        return _profile(numbers, tilt.group(1).upper() == "INCLUDE")
    except (ValueError, IndexError) as error:
        raise InputError(f"{name}:{line}: error: {error}") from None


def _profile(numbers: list[float], has_tilt: bool) -> Profile:
    if has_tilt:
        # Orientation, count, and as many angles and factors.
        numbers = numbers[2 + 2 * int(numbers[1]) :]
    if len(numbers) < 13:
        raise ValueError("the numbers of a lamp are missing")
    multiplier, count_v, count_h, kind = numbers[2], int(numbers[3]), int(numbers[4]), int(numbers[5])
    if kind != 1:
        raise ValueError("the angles are not around the vertical axis (type C)")
    if not (count_v >= 1 and count_h >= 1 and count_v * count_h <= _MOST_ANGLES):
        raise ValueError(f"{count_v} vertical and {count_h} horizontal angles are none or too many")
    rest = np.array(numbers[13 : 13 + count_v + count_h + count_v * count_h])
    if len(rest) != count_v + count_h + count_v * count_h:
        raise ValueError(f"{len(rest)} numbers are too few for {count_v} x {count_h} directions")
    vertical, horizontal, candela = np.split(rest, [count_v, count_v + count_h])
    if not np.isfinite(rest).all() or (np.diff(vertical) < 0).any() or (np.diff(horizontal) < 0).any():
        raise ValueError("angles do not grow, or a number is not finite")
    factor = multiplier * numbers[10]
    return Profile(vertical, horizontal, np.maximum(candela.reshape(count_h, count_v) * factor, 0))
