"""Skies of Mitsuba scenes as pictures: `python -m wend.mitsuba_sky scene.xml -o sky.exr`.

Wants `mitsuba` (`pip install mitsuba`), whose tables the model of its `sunsky` is made of. The sky becomes a picture,
the sun a light from afar: what takes the place of the emitter in the file is printed.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _reader_command as command
from ._errors import InputError


def bake(scene: str | os.PathLike[str], picture: str | os.PathLike[str], *, width: int = 512) -> str:
    """Writes what the `sunsky` of a Mitsuba scene shows of the sky, by longitude and latitude.

    Args:
        scene: the .xml file.
        picture: the .exr file to write.
        width: of the picture, in pixels; it is half as high.

    Returns:
        The two emitters of Mitsuba that take the place of the `sunsky`: `envmap`, and `directional` for the sun, whose
        shadows are sharp then.

    Raises:
        InputError: for a scene without a `sunsky`, that Mitsuba cannot read, or another width.
        ImportError: without `mitsuba`.
    """
    if not 16 <= width <= 16384 or width % 4:
        raise InputError(f"the width must be a multiple of 4 from 16 to 16384, not {width}")
    try:
        import mitsuba  # type: ignore[import-not-found,import-untyped,unused-ignore]
    except ImportError as error:
        raise ImportError("wend.mitsuba_sky wants mitsuba: pip install mitsuba") from error

    if not Path(scene).is_file():
        raise InputError(f"{scene}: there is no such file")
    mitsuba.set_variant("scalar_rgb")
    try:
        sky = mitsuba.load_file(os.fspath(scene)).environment()
    except RuntimeError as error:
        raise InputError(f"{scene}: Mitsuba cannot read it: {error}") from error
    parameters = mitsuba.traverse(sky) if sky is not None else {}
    if "sun_direction" not in parameters:
        raise InputError(f"{scene}: there is no <emitter type=\"sunsky\"> in it")
    sun_scale, sky_scale = parameters["sun_scale"], parameters["sky_scale"]
    _set(parameters, sun_scale=0.0, sky_scale=sky_scale)
    mitsuba.Bitmap(_seen(mitsuba, sky, width)).write(os.fspath(picture))
    _set(parameters, sun_scale=sun_scale, sky_scale=0.0)
    return _emitters(Path(picture).name, *_sun(mitsuba, sky))


def _set(parameters: Any, **values: float) -> None:
    for name, value in values.items():
        parameters[name] = value
    parameters.update()


def _seen(mitsuba: Any, sky: Any, width: int) -> npt.NDArray[np.float32]:
    """As Mitsuba's `envmap` has it: the first and the last row are the poles, +y and -y, the middle is -z."""
    height = width // 2
    longitude = 2 * np.pi * np.arange(width) / width
    latitude = np.pi * np.arange(height) / (height - 1)
    picture = np.empty((height, width, 3), np.float32)
    point = mitsuba.SurfaceInteraction3f()
    for row, down in zip(picture, latitude, strict=True):
        x, z = -np.sin(longitude) * np.sin(down), np.cos(longitude) * np.sin(down)
        y = -float(np.cos(down))
        for pixel, across, ahead in zip(row, x.tolist(), z.tolist(), strict=True):
            point.wi = [across, y, ahead]
            pixel[:] = sky.eval(point)
    return picture


def _sun(mitsuba: Any, sky: Any) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Where its light goes, and its irradiance across that: means over its disk, by a grid of samples."""
    side = 64
    middle = (np.arange(side) + 0.5) / side
    seen_from = mitsuba.Interaction3f()
    directions, weights = [], []
    for u in middle.tolist():
        for v in middle.tolist():
            sample, weight = sky.sample_direction(seen_from, [u, v])
            directions.append(-np.array(sample.d))
            weights.append(np.array(weight))
    direction = np.mean(directions, axis=0)
    return direction / np.linalg.norm(direction), np.mean(weights, axis=0)


def _emitters(picture: str, direction: npt.NDArray[np.float64], irradiance: npt.NDArray[np.float64]) -> str:
    text = f'<emitter type="envmap"><string name="filename" value="{picture}"/></emitter>\n'
    if irradiance.max() > 0:
        towards, light = (" ".join(f"{number:.7g}" for number in numbers) for numbers in (direction, irradiance))
        text += (
            f'<emitter type="directional"><vector name="direction" value="{towards}"/>'
            f'<rgb name="irradiance" value="{light}"/></emitter>\n'
        )
    return text


def main(arguments: list[str] | None = None) -> int:
    """The command; its exit status."""
    parser = argparse.ArgumentParser(prog="python -m wend.mitsuba_sky", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scene", metavar="SCENE.xml")
    parser.add_argument("-o", "--output", metavar="SKY.exr", default="sky.exr", help="the picture (sky.exr)")
    parser.add_argument("--width", type=int, default=512, help="of the picture, in pixels (512)")
    options = parser.parse_args(arguments)
    try:
        return command.as_command(lambda: print(bake(options.scene, options.output, width=options.width), end=""))
    except ImportError as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
