"""Writes into the heads of the scenes here what Mitsuba makes of them: `python reference.py [scene.xml ...]`.

Wants the wheel mitsuba 3.9.1. Each scene is rendered with other seeds until the standard error of its mean is below a
tenth of the tolerance.
"""

import re
import sys
from pathlib import Path

import mitsuba
import numpy as np

HERE = Path(__file__).parent
HEAD = re.compile(r"# Right mean: (.*) within (.*) %\n")


def mean_of(file: Path, tolerance: float) -> tuple[np.ndarray, int]:
    """The mean of each channel, and how many samples a pixel it took."""
    scene = mitsuba.load_file(str(file))
    samples, means = 1024, []
    while True:
        film = np.array(mitsuba.render(scene, spp=samples, seed=len(means) + 1))
        means.append(film[..., :3].mean(axis=(0, 1)))
        if len(means) < 4:
            continue
        mean, error = np.mean(means, axis=0), np.std(means, axis=0, ddof=1) / np.sqrt(len(means))
        if (error <= 0.1 * tolerance * mean).all() or len(means) == 40:
            return mean, samples * len(means)


def main() -> None:
    mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    for file in [Path(name) for name in sys.argv[1:]] or sorted(HERE.glob("*.xml")):
        text = file.read_text()
        tolerances = HEAD.search(text).group(2)
        mean, samples = mean_of(file, float(tolerances.split()[0]) / 100)
        numbers = " ".join(f"{channel:.5g}" for channel in mean)
        file.write_text(HEAD.sub(f"# Right mean: {numbers} within {tolerances} %\n", text))
        print(f"{file.name}: {numbers}, {samples} samples a pixel", flush=True)


if __name__ == "__main__":
    main()
