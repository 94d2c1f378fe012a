"""One picture by one renderer, in a process of its own and in the Python that has it: prints samples and seconds as
JSON. compare.py calls it."""

import argparse
import json
import sys

import files
import renderers
from scenes import SCENES

# Of a scene as data and of one in a file; what each is made of is known once arguments are.
RENDERERS = {
    'pbrt': lambda a: (files.pbrt(a.pbrt, False),) * 2,
    'pbrt guided': lambda a: (files.pbrt(a.pbrt_guided, True),) * 2,
    'mitsuba volpath': lambda a: (renderers.mitsuba, files.mitsuba),
    'cycles': lambda a: (renderers.cycles(False), files.cycles(False)),
    'cycles guided': lambda a: (renderers.cycles(True), files.cycles(True)),
    'wend classical': lambda a: (renderers.wend(a.wend, '--sampling', 'classical', '--subsurface', 'classical'),) * 2,
    'wend full': lambda a: (renderers.wend(a.wend),) * 2,
}


def scene_of(a):
    """Of its name, or its file."""
    if a.scene in SCENES:
        scene = SCENES[a.scene]()
        scene.name = a.scene
        return scene
    return files.FileScene(a.scene, a.out, a.blender_python)


def add_options(parser):
    """Those that a renderer is made by."""
    parser.add_argument('--time', type=float, default=60, help='seconds for each picture')
    parser.add_argument('--wend', required=True, help='the program')
    parser.add_argument('--pbrt', help='the program of pbrt-v4')
    parser.add_argument('--pbrt-guided', help='that of its fork with Open PGL')
    parser.add_argument('--blender-python', default=sys.executable, help='a Python that has bpy (default: this one)')
    parser.add_argument('--out', required=True, help='folder')


def options_of(a):
    """The same, as they are written."""
    names = ('time', 'wend', 'pbrt', 'pbrt_guided', 'blender_python', 'out')
    return [word for name in names if getattr(a, name) is not None
            for word in ('--' + name.replace('_', '-'), str(getattr(a, name)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('renderer', choices=RENDERERS)
    parser.add_argument('scene')
    parser.add_argument('picture', help='file to write')
    parser.add_argument('--seed', type=int, default=1)
    add_options(parser)
    a = parser.parse_args()
    scene = scene_of(a)
    as_data, as_file = RENDERERS[a.renderer](a)
    samples, seconds = (as_data if hasattr(scene, 'meshes') else as_file)(scene, a.time, a.picture, a.seed)
    print(json.dumps({'spp': samples, 'seconds': seconds}))


if __name__ == '__main__':
    main()
