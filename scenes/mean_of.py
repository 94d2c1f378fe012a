"""Writes the mean of renders of one scene, weighted by their samples per pixel, in half floats as references are kept.

    python scenes/mean_of.py OUT.exr FIRST.exr SAMPLES SECOND.exr SAMPLES ...

So a reference is refined without rendering again what it has: the seeds must differ. Needs OpenEXR and NumPy.
"""

import sys

import numpy as np
import OpenEXR


def colours(path):
    channels = OpenEXR.File(path).channels()
    rgb = channels["RGB"].pixels if "RGB" in channels else np.stack([channels[c].pixels for c in "RGB"], axis=-1)
    return rgb.astype(np.float64)


def main(out, *renders):
    if not renders or len(renders) % 2:
        sys.exit(__doc__)
    samples = np.array([int(n) for n in renders[1::2]])
    mean = np.average([colours(path) for path in renders[0::2]], axis=0, weights=samples)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": mean.astype(np.float16)}).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
