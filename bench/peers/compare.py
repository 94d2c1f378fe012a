#!/usr/bin/env python3
"""Wend and other renderers in equal time: `compare.py SCENE --time 60 --wend build/release/bin/wend --out DIR`.

Needs `pip install OpenEXR numpy pillow mitsuba bpy` (bpy is Blender, with Cycles and Open PGL); a renderer that does not
run is left out with a word. The reference is two halves by Wend, and the last column of the table is a picture's mean
over theirs: a renderer that converged to something else, or took the scene for another one, would show it there. The
pictures of the first seed, in their order, and a half of the reference are written side by side as SCENE.png.
"""

import argparse
import importlib.metadata
import json
import os
import subprocess
import sys

import numpy as np
import OpenEXR
from PIL import Image

import renderers
from scenes import SCENES

RENDERERS = {
    'mitsuba volpath': lambda a: renderers.mitsuba,
    'cycles': lambda a: renderers.cycles(False),
    'cycles guided': lambda a: renderers.cycles(True),
    'wend classical': lambda a: renderers.wend(a.wend, '--sampling', 'classical', '--subsurface', 'classical'),
    'wend full': lambda a: renderers.wend(a.wend),
}


def version_of(name):
    """Of the package that renders; Wend's is that of the results."""
    package = {'mitsuba': 'mitsuba', 'cycles': 'bpy'}.get(name.split()[0])
    return package and f'{package} {importlib.metadata.version(package)}'


def pixels_of(path):
    channels = OpenEXR.File(path).channels()
    return channels['RGB' if 'RGB' in channels else 'RGBA'].pixels[..., :3]


def mean_of(path):
    return float(pixels_of(path).mean())


def write_row(paths, path):
    """Side by side, lighter where they are dark, as screens have it."""
    rows = [pixels_of(p) / (4 * mean_of(paths[-1])) for p in paths]
    row = np.clip(np.concatenate(rows, axis=1), 0, 1) ** (1 / 2.2)
    Image.fromarray((255 * row + 0.5).astype(np.uint8)).save(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('scene', choices=SCENES)
    parser.add_argument('--time', type=float, default=60)
    parser.add_argument('--seeds', type=int, default=1)
    parser.add_argument('--seed', type=int, default=1, help='the first')
    parser.add_argument('--json', help='file for the rows, one for each picture')
    parser.add_argument('--wend', required=True, help='the program')
    parser.add_argument('--out', required=True, help='folder')
    parser.add_argument('--reference-time', type=float, help='seconds for each half (default: eight times --time)')
    parser.add_argument('--only', choices=RENDERERS, action='append')
    parser.add_argument('--one', help=argparse.SUPPRESS)  # render with one renderer in this process
    a = parser.parse_args()
    os.makedirs(a.out, exist_ok=True)
    scene = SCENES[a.scene]()
    picture = lambda name, seed: os.path.join(a.out, f'{a.scene}.{name.replace(" ", "-")}.{seed}.exr')

    if a.one:
        spp, seconds = RENDERERS[a.one](a)(scene, a.time, picture(a.one, a.seed), a.seed)
        print(json.dumps({'spp': spp, 'seconds': seconds}))
        return

    reference = os.path.join(a.out, a.scene)
    halves = [f'{reference}.ref-{half}.exr' for half in 'ab']
    for seed, half in enumerate(halves, 1001):
        if not os.path.exists(half):
            renderers.wend(a.wend)(scene, a.reference_time or 8 * a.time, half, seed)

    rows = []
    print(f'{"":24}{"spp":>8}{"seconds":>9}{"relMSE":>12}{"trimmed":>12}{"99.99 %":>10}{"mean":>8}')
    for name in a.only or RENDERERS:
        for seed in range(a.seed, a.seed + a.seeds):
            command = [sys.executable, __file__, a.scene, '--time', str(a.time), '--wend', a.wend, '--out', a.out,
                       '--one', name, '--seed', str(seed)]
            run = subprocess.run(command, capture_output=True, text=True)
            if run.returncode != 0:
                print(f'{name:24}left out: {(run.stderr.strip() or "?").splitlines()[-1]}')
                break
            told = json.loads(run.stdout.strip().splitlines()[-1])
            metric = subprocess.run([a.wend, 'metric', reference, picture(name, seed), '--json', '-', '--quiet'],
                                    capture_output=True, text=True, check=True)
            m = json.loads(metric.stdout)['rows'][0]
            mean = mean_of(picture(name, seed)) / (0.5 * sum(mean_of(half) for half in halves))
            print(f'{name:24}{told["spp"] or "-":>8}{told["seconds"]:9.1f}{m["relmse"]:12.4g}'
                  f'{m["relmse_trimmed"]:12.4g}{m["error_p9999"]:10.4g}{mean:8.4f}', flush=True)
            rows.append({'scene': a.scene, 'renderer': name, 'version': version_of(name), 'seed': seed,
                         'samples': told['spp'], 'seconds': told['seconds'], 'relmse': m['relmse'],
                         'relmse_trimmed': m['relmse_trimmed'], 'error_p9999': m['error_p9999'],
                         'mean_over_reference': mean})
    if a.json:
        with open(a.json, 'w') as out:
            json.dump(rows, out)
    made = [picture(name, a.seed) for name in RENDERERS]
    write_row([p for p in made if os.path.exists(p)] + halves[:1], f'{reference}.png')


if __name__ == '__main__':
    main()
