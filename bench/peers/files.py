"""Scenes that are files, of pbrt, Mitsuba or Blender, and the renderers that read them.

Nobody converts: pbrt-v4 and its fork render pbrt files, Mitsuba its own XML (its package reads nothing else), Cycles
Blender's files. Wend reads all of them.
"""

import os
import re
import subprocess
import time

import renderers

READERS = {'.pbrt': ('pbrt', 'wend'), '.xml': ('mitsuba', 'wend'), '.blend': ('cycles', 'wend')}


class FileScene:
    """`wend_file` is what Wend reads: for Blender's files, what `wend.blend` makes of them."""

    def __init__(self, path, out, blender_python):
        self.path = os.path.abspath(path)
        self.kind = os.path.splitext(path)[1]
        if self.kind not in READERS:
            raise ValueError(f'{path}: neither .pbrt, .xml nor .blend')
        if not os.path.exists(path):
            raise ValueError(f'{path}: no such file')
        self.name = os.path.basename(path)[:-len(self.kind)]
        self.wend_file = self.path
        if self.kind == '.blend':
            self.wend_file = os.path.join(out, f'{self.name}.pbrt')
            if not os.path.exists(self.wend_file):
                run = subprocess.run([blender_python, '-m', 'wend.blend', self.path, '-o', self.wend_file],
                                     capture_output=True, text=True)
                if run.returncode != 0:
                    raise ValueError(f'{path}: {(run.stderr.strip() or "cannot be read").splitlines()[-1]}')

    def readers(self):
        return READERS[self.kind]


def is_read_by(scene, renderer):
    """pbrt's renderers also take the scenes of scenes.py, as Wend does."""
    return hasattr(scene, 'meshes') or renderer.split()[0] in scene.readers()


def guided_copy(file):
    """Of the main file, beside it, where what it includes is found: with the fork's integrator."""
    with open(file) as text:
        changed, count = re.subn(r'(Integrator\s+)"(?:vol)?path"', r'\1"guidedvolpath"', text.read())
    if count == 0:
        changed = 'Integrator "guidedvolpath"\n' + changed
    path = os.path.join(os.path.dirname(file), f'guided-{os.getpid()}-{os.path.basename(file)}')
    with open(path, 'w') as out:
        out.write(changed)
    return path


def pbrt(program, guided):
    """pbrt-v4, or its fork with Open PGL. Samples, not a time, can be asked of it: how many fit is found by shorter
    renders, each of at least twice the samples. Loading, which one sample shows, does not count."""
    def render(scene, seconds, path, seed):
        file = renderers.pbrt_file(scene, path)
        copy = guided_copy(file) if guided else None

        def run(spp):
            start = time.time()
            subprocess.run([program, '--quiet', '--nthreads', str(renderers.THREADS), '--seed', str(seed), '--spp',
                            str(spp), '--outfile', path, copy or file], check=True, stdout=subprocess.DEVNULL)
            return time.time() - start
        try:
            first, spp = run(1), 2
            while (spent := run(spp) - first) < seconds / 6 and spp < 1 << 24:
                spp *= max(2, min(8, int(seconds / 4 / max(spent, 1e-3))))
            spp = max(1, round((spp - 1) * seconds / max(spent, 1e-3)))
            return spp, run(spp) - first
        finally:
            if copy:
                os.remove(copy)
    return render


def mitsuba(scene, seconds, path, seed):
    """By the integrator that the file names."""
    mi = renderers.quiet_mitsuba()
    return renderers.render_by_mitsuba(mi, mi.load_file(scene.path), None, seconds, path, seed)


def cycles(guided):
    """Bounces, size and light are the file's; no clamping, denoising or adaptive sampling."""
    def render(scene, seconds, path, seed):
        import bpy
        bpy.ops.wm.open_mainfile(filepath=scene.path)
        return renderers.render_by_cycles(bpy, guided, None, seconds, path, seed)
    return render
