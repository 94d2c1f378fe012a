"""What the commands of readers of foreign scenes share: options, messages, and what is done with a scene."""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path

from ._builder import SceneBuilder
from ._errors import InputError, SceneWarning


def add_options(parser: argparse.ArgumentParser) -> None:
    """Where the scene goes, and how it is rendered."""
    parser.add_argument("-o", "--output", metavar="SCENE.pbrt", help="write the scene as a pbrt-v4 file")
    parser.add_argument("--render", metavar="PICTURE", help="render it: .exr, .png or .jpg")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (64)")
    parser.add_argument("--time", type=float, help="seconds to spend, in place of samples")
    parser.add_argument("--noise", type=float, help="relative noise to end at, in place of samples")
    parser.add_argument("--sampling", default="full")
    parser.add_argument("--alpha", action="store_true", help="write opacity into an .exr: holdouts and the sky are holes")


def parsed(parser: argparse.ArgumentParser, arguments: list[str] | None) -> argparse.Namespace:
    """The options, of which there must be one that says where the scene goes."""
    options = parser.parse_args(arguments)
    if not options.output and not options.render:
        parser.error("give --render PICTURE, or -o SCENE.pbrt, or both")
    return options


def size_of(text: str) -> tuple[int, int]:
    """Of --resolution.

    Raises:
        InputError: for what is no size.
    """
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) > 0 and int(height) > 0):
        raise InputError(f"--resolution {text}: expected WIDTHxHEIGHT")
    return int(width), int(height)


def maps_of(output: str) -> Path | None:
    """The folder of pictures that are made for a scene that is written."""
    return Path(output).with_suffix(".maps") if output else None


def deliver(builder: SceneBuilder, options: argparse.Namespace, output: str, picture: str) -> None:
    """Writes and renders, as far as there are names for that. What it costs until there is a scene goes to standard
    error."""
    import wend

    if output:
        Path(output).write_text(builder.text())
    if picture:
        until = {"time": options.time, "noise": options.noise}
        amount = {name: value for name, value in until.items() if value is not None} or {"spp": options.spp}
        start = time.process_time()
        scene = builder.scene()
        made = time.process_time() - start
        print(
            f"{builder.name}: {len(builder)} directives with {builder.size / 1e6:.1f} MB of numbers, read in {start:.1f} s "
            f"of processor time, made into a scene in {made:.1f} s",
            file=sys.stderr,
        )
        wend.render(scene, sampling=options.sampling, **amount).save(picture, alpha=options.alpha)


def as_command(action: Callable[[], None]) -> int:
    """Does it, with warnings and errors on standard error; the exit status."""
    warnings.simplefilter("always", SceneWarning)
    warnings.showwarning = lambda message, *_, **__: print(message, file=sys.stderr)
    try:
        action()
    except (InputError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0
