#!/usr/bin/env python3
"""Wend and other renderers in equal time: `compare.py SCENE --time 60 --wend build/release/bin/wend --out DIR`.

SCENE is one of scenes.py, which all of them take, or a file: .pbrt for pbrt-v4 and its guiding fork, .xml for Mitsuba,
.blend for Cycles; Wend takes any. Needs `pip install OpenEXR numpy pillow`, and for its renderers `mitsuba`, `bpy`
(Blender, with Cycles and Open PGL; another Python may have it: --blender-python), and programs of pbrt (--pbrt,
--pbrt-guided). A renderer that was not run has a row that says why.

All are judged by `wend metric` against one reference: --reference, or two halves by Wend. Means of the channels over
the reference's show a renderer that took the scene for another one; a spectral one has other colours. So errors are
also given with each channel scaled to the reference's mean. The pictures of the first seed, in their order, and a half
of the reference are written side by side as SCENE.png.
"""

import argparse
import json
import os
import subprocess
import sys

import numpy as np
import OpenEXR
from PIL import Image

import files
import renderers
from one import RENDERERS, add_options, options_of, scene_of
from scenes import SCENES


def why_not(a, scene, name):
    """A renderer is not run, or None."""
    if not files.is_read_by(scene, name):
        return f'reads no {scene.kind} files'
    missing = {'pbrt': not a.pbrt and '--pbrt', 'pbrt guided': not a.pbrt_guided and '--pbrt-guided'}.get(name)
    return f'no program: {missing}' if missing else None


def version_of(a, name):
    """Of the package that renders; Wend's is that of the results."""
    package = {'mitsuba': 'mitsuba', 'cycles': 'bpy'}.get(name.split()[0])
    if not package:
        return os.path.basename({'pbrt': a.pbrt, 'pbrt guided': a.pbrt_guided}.get(name) or '') or None
    asked = f'import importlib.metadata as m; print(m.version("{package}"))'
    return f'{package} ' + subprocess.run([python_of(a, name), '-c', asked], capture_output=True,
                                          text=True).stdout.strip()


def python_of(a, name):
    return a.blender_python if name.startswith('cycles') else sys.executable


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


def scaled_to(means, path):
    """A copy whose channels have these means, as far as they are not 0."""
    pixels = pixels_of(path).astype(np.float32)
    own = pixels.mean(axis=(0, 1))
    copy = path.replace('.exr', '.scaled.exr')
    scaled = np.ascontiguousarray(pixels * np.where(own > 0, means / np.maximum(own, 1e-30), 1).astype(np.float32))
    OpenEXR.File({'type': OpenEXR.scanlineimage}, {'RGB': scaled}).write(copy)
    return copy


def judged(a, reference, halves, path):
    """Errors of a picture as it is and as it would be in the reference's colours, and how its means compare."""
    means = 0.5 * sum(pixels_of(half).astype(float).mean(axis=(0, 1)) for half in halves)
    pictures = [path, scaled_to(means, path)]
    metric = subprocess.run([a.wend, 'metric', reference, *pictures, '--json', '-', '--quiet'], capture_output=True,
                            text=True, check=True)
    plain, scaled = json.loads(metric.stdout)['rows']
    own = pixels_of(path).astype(float).mean(axis=(0, 1))
    return {'relmse': plain['relmse'], 'relmse_trimmed': plain['relmse_trimmed'], 'error_p9999': plain['error_p9999'],
            'relmse_scaled': scaled['relmse'], 'relmse_scaled_trimmed': scaled['relmse_trimmed'],
            'mean_over_reference': float(own.mean() / means.mean()),
            'channels_over_reference': [float(x) for x in own / np.maximum(means, 1e-30)]}


def render_by(a, scene, name, seed, path):
    """By a process of its own: what the renderer tells, or why there is no picture."""
    command = [python_of(a, name), os.path.join(os.path.dirname(__file__), 'one.py'), name, a.scene, path, '--seed',
               str(seed), *options_of(a)]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        return (run.stderr.strip() or f'status {run.returncode}').splitlines()[-1]
    return json.loads(run.stdout.strip().splitlines()[-1])


def reference_of(a, scene):
    """Its name, and its two halves."""
    reference = a.reference or os.path.join(a.out, scene.name)
    halves = [f'{reference}.ref-{half}.exr' for half in 'ab']
    for seed, half in enumerate(halves, 1001):
        if not os.path.exists(half):
            if a.reference:
                sys.exit(f'no {half}')
            renderers.wend(a.wend)(scene, a.reference_time or 8 * a.time, half, seed)
    return reference, halves


def measure(a, scene, picture):
    reference, halves = reference_of(a, scene)
    print(f'{"":24}{"spp":>8}{"seconds":>9}{"relMSE":>12}{"trimmed":>12}{"99.99 %":>10}{"mean":>8}  channels', flush=True)
    for name in a.only or RENDERERS:
        row = {'scene': scene.name, 'renderer': name}
        reason = why_not(a, scene, name)
        for seed in [] if reason else range(a.seed, a.seed + a.seeds):
            path = picture(name, seed)
            told = render_by(a, scene, name, seed, path)
            if isinstance(told, str):
                reason = told
                break
            row |= {'version': version_of(a, name), 'seed': seed, 'samples': told['spp'], 'seconds': told['seconds'],
                    **judged(a, reference, halves, path)}
            print(f'{name:24}{told["spp"] or "-":>8}{told["seconds"]:9.1f}{row["relmse"]:12.4g}'
                  f'{row["relmse_trimmed"]:12.4g}{row["error_p9999"]:10.4g}{row["mean_over_reference"]:8.4f}  '
                  + ' '.join(f'{x:.4f}' for x in row['channels_over_reference']), flush=True)
            yield dict(row)
        if reason:
            print(f'{name:24}not run: {reason}', flush=True)
            yield {'scene': scene.name, 'renderer': name, 'seed': a.seed, 'not_run': reason}
    made = [picture(name, a.seed) for name in RENDERERS]
    write_row([p for p in made if os.path.exists(p)] + halves[:1], os.path.join(a.out, f'{scene.name}.png'))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('scene', help=f'{", ".join(SCENES)}, or a file: .pbrt, .xml, .blend')
    add_options(parser)
    parser.add_argument('--seeds', type=int, default=1)
    parser.add_argument('--seed', type=int, default=1, help='the first')
    parser.add_argument('--json', help='file for the rows, one for each picture')
    parser.add_argument('--reference', help='NAME of NAME.ref-a.exr and NAME.ref-b.exr (default: rendered by Wend)')
    parser.add_argument('--reference-time', type=float, help='seconds for each half (default: eight times --time)')
    parser.add_argument('--only', choices=RENDERERS, action='append')
    a = parser.parse_args()
    os.makedirs(a.out, exist_ok=True)
    try:
        scene = scene_of(a)
    except ValueError as error:
        parser.error(str(error))

    picture = lambda name, seed: os.path.join(a.out, f'{scene.name}.{name.replace(" ", "-")}.{seed}.exr')
    rows = list(measure(a, scene, picture))
    if a.json:
        with open(a.json, 'w') as out:
            json.dump(rows, out)


if __name__ == '__main__':
    main()
