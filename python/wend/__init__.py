"""Wend: an unbiased renderer of participating media, guided by what it learns.

    import wend

    scene = wend.load("room.pbrt")                        # a pbrt-v4 scene
    film = wend.render(scene, time=30)                    # or spp=, or noise=
    film.save("room.exr")                                 # film.image is a NumPy array, film["variance"] a layer

    foggy = scene.with_({"medium.fog.scale": 2})          # with another parameter; shapes are shared
    wend.compare(foggy, time=10)                          # ways of sampling in equal time
    wend.halfspace(albedo=[0.8, 0.95], sampler=["classical", "modes"])

Colours are linear (Rec. 709 primaries), arrays float32, rows from the top. What is wrong raises `InputError`, with
file, line and column. Long work lets other Python threads run, and Ctrl-C ends it within a second.

`wend.SceneBuilder` takes a scene from a program, arrays as they are; `wend.Render` steps a render; `wend.guide` guides a renderer of your own.
"""

from . import guide
from ._builder import SceneBuilder
from ._compare import Comparison, SceneComparisons, compare, compare_scenes
from ._errors import InputError, SceneWarning
from ._film import Film, merge, metric, read
from ._planar import halfspace, samplers, slab
from ._render import Render, render
from ._scene import Scene, demo_scene, load, loads
from ._table import Table
from ._wend import version as __version__

__all__ = [
    "Comparison",
    "Film",
    "InputError",
    "Render",
    "Scene",
    "SceneBuilder",
    "SceneComparisons",
    "SceneWarning",
    "Table",
    "compare",
    "compare_scenes",
    "demo_scene",
    "guide",
    "halfspace",
    "load",
    "loads",
    "merge",
    "metric",
    "read",
    "render",
    "samplers",
    "slab",
]
