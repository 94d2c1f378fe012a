#!/usr/bin/env python3
"""Holds the example of embedding to what the renderer gains in the same rooms.

usage: embed_gain.py EMBED ROOMS    EMBED is the example's program, ROOMS the scene; exit status 1 if it gains too little

A gain is the variance of classical sampling over that of guided sampling, by as many samples: no clock is read. The
example, which guides the first two flights of a walk alone, must have at least half of the renderer's.
"""

import re
import subprocess
import sys

import numpy as np

import wend


def gain_of_example(program: str) -> float:
    said = subprocess.run([program], check=True, stdout=subprocess.PIPE, text=True).stdout
    found = re.search(r"([\d.]+) times less variance by as many samples", said)
    if not found:
        raise SystemExit(f"the example does not say what it gains: {said}")
    return float(found[1])


def gain_of_renderer(scene: wend.Scene, spp: int) -> float:
    def variance(sampling: str) -> float:
        # Of several seeds, since a few bright samples make the variance itself noisy.
        films = [wend.render(scene, spp=spp, sampling=sampling, seed=seed, progress=False) for seed in (1, 2, 3)]
        return float(np.median([film["variance"].mean() for film in films]))

    return variance("classical") / variance("full")


def main() -> int:
    program, rooms = sys.argv[1:]
    example = gain_of_example(program)
    renderer = gain_of_renderer(wend.load(rooms), 128)
    print(f"the example gains {example:.1f} times, the renderer {renderer:.1f} times: {example / renderer:.2f} of it")
    return 0 if example >= renderer / 2 else 1


if __name__ == "__main__":
    sys.exit(main())
