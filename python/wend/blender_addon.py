"""Wend as a render engine inside Blender, and the zip that Blender installs it from:

    python -m wend.blender_addon dist/wend-*.whl -o wend-blender.zip

In Blender: Edit, Preferences, Get Extensions, Install from Disk; then Wend is among the render engines. `register()` does the
same where Blender is a module (`bpy`).
"""

import argparse
import sys
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from ._errors import InputError, SceneWarning
from ._reader_command import as_command

#: Seconds between two looks at whether Blender wants an end.
_STEP = 0.25
#: And between two pictures.
_PICTURE = 1.0

_MANIFEST = """schema_version = "1.0.0"
id = "wend"
version = "{version}"
name = "Wend"
tagline = "Unbiased rendering of volumes and subsurface scattering"
maintainer = "The authors of Wend"
type = "add-on"
blender_version_min = "4.2.0"
license = ["SPDX:Apache-2.0"]
platforms = ["linux-x64"]
wheels = [{wheels}]

[permissions]
files = "Reads the pictures and volumes of scenes, and writes pictures that they become"
"""

_MODULE = """from wend.blender_addon import register, unregister
"""


def register() -> None:
    """Makes Wend one of Blender's render engines, with a panel of its settings."""
    import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

    for made in _classes():
        bpy.utils.register_class(made)
    bpy.types.Scene.wend = bpy.props.PointerProperty(type=_classes()[0])
    for panel in _panels_of_others():
        panel.COMPAT_ENGINES.add("WEND")
    if bpy.app.background:
        bpy.app.handlers.render_pre.append(_prepare)


def unregister() -> None:
    """Takes it back."""
    import bpy

    if _prepare in bpy.app.handlers.render_pre:
        bpy.app.handlers.render_pre.remove(_prepare)
    for panel in _panels_of_others():
        panel.COMPAT_ENGINES.discard("WEND")
    del bpy.types.Scene.wend
    for made in reversed(_classes()):
        bpy.utils.unregister_class(made)


def _panels_of_others() -> list[Any]:
    """Panels of what an engine does not change: materials, lamps, cameras, the world."""
    import bpy

    found = []
    for panel in bpy.types.Panel.__subclasses__():
        engines: set[str] = getattr(panel, "COMPAT_ENGINES", set())
        if "CYCLES" in engines or ("BLENDER_EEVEE" in engines and "BLENDER_RENDER" in engines):
            found.append(panel)
    return found


_made: list[Any] = []


def _classes() -> list[Any]:
    """Classes of Blender, which can be named only where Blender is."""
    if _made:
        return _made
    import bpy

    class WendSettings(bpy.types.PropertyGroup):  # type: ignore[misc,unused-ignore]
        """How to render."""

        samples: bpy.props.IntProperty(name="Samples", description="Of each pixel, as a mean", default=64, min=1)  # type: ignore[valid-type]
        seconds: bpy.props.FloatProperty(  # type: ignore[valid-type]
            name="Time", description="Seconds to spend in place of samples; 0: as many samples", default=0, min=0
        )
        noise: bpy.props.FloatProperty(  # type: ignore[valid-type]
            name="Noise", description="End once the relative noise is estimated to be this; 0: do not", default=0, min=0
        )
        guiding: bpy.props.EnumProperty(  # type: ignore[valid-type]
            name="Guiding",
            items=[
                ("full", "Full", "Whatever pays, where it pays"),
                ("classical", "Classical", "Nothing is guided"),
            ],
        )
        threads: bpy.props.IntProperty(name="Threads", description="0: all", default=0, min=0)  # type: ignore[valid-type]
        seed: bpy.props.IntProperty(name="Seed", default=0, min=0)  # type: ignore[valid-type]

    class WendRenderEngine(bpy.types.RenderEngine):  # type: ignore[misc,unused-ignore]
        """Final renders by Wend."""

        bl_idname = "WEND"
        bl_label = "Wend"
        bl_use_preview = False
        bl_use_shading_nodes_custom = False
        #: What was read before the render, by the scene's name and its frame: the scene or an error, and warnings.
        prepared: dict[tuple[str, int], tuple[Any, list[str]]] = {}

        def render(self, depsgraph: Any) -> None:
            _render(self, depsgraph)

        def update_render_passes(self, scene: Any, view_layer: Any) -> None:
            self.register_pass(scene, view_layer, "Combined", 4, "RGBA", "COLOR")
            if view_layer.use_pass_z:
                self.register_pass(scene, view_layer, "Depth", 1, "Z", "VALUE")
            if view_layer.use_pass_normal:
                self.register_pass(scene, view_layer, "Normal", 3, "XYZ", "VECTOR")
            if view_layer.use_pass_diffuse_color:
                self.register_pass(scene, view_layer, "Diffuse Color", 3, "RGB", "COLOR")

    class RENDER_PT_wend(bpy.types.Panel):  # type: ignore[misc,unused-ignore]
        """The settings."""

        bl_label = "Sampling"
        bl_space_type = "PROPERTIES"
        bl_region_type = "WINDOW"
        bl_context = "render"
        COMPAT_ENGINES = {"WEND"}

        @classmethod
        def poll(cls, context: Any) -> bool:
            return bool(context.engine == "WEND")

        def draw(self, context: Any) -> None:
            self.layout.use_property_split = True
            for name in ("guiding", "samples", "seconds", "noise", "threads", "seed"):
                self.layout.prop(context.scene.wend, name)

    _made.extend([WendSettings, WendRenderEngine, RENDER_PT_wend])
    return _made


def _prepare(scene: Any, _: Any = None) -> None:
    """Reads the scene while Cycles may still be called, for its sky and for textures that are baked. That is so before a
    render without windows, where it happens in the main thread."""
    from .blend import of_scene

    if scene.render.engine != "WEND":
        return
    told: list[str] = []
    found: Any
    with warnings.catch_warnings():
        warnings.simplefilter("always", SceneWarning)
        warnings.showwarning = lambda message, *_, **__: told.append(str(message))
        try:
            found = of_scene(scene)
        except InputError as error:
            found = error
    _classes()[1].prepared[scene.name, scene.frame_current] = found, told


def _scene_of(engine: Any, depsgraph: Any) -> Any:
    """What was prepared, or can be read while a render is going on."""
    from .blend import of_scene

    scene = depsgraph.scene
    found, told = engine.prepared.pop((scene.name, scene.frame_current), (None, []))
    for text in told:
        engine.report({"WARNING"}, text)
    if isinstance(found, InputError):
        raise found
    return found or of_scene(scene, depsgraph=depsgraph, set_frame=engine.frame_set, can_render=False)


def _render(engine: Any, depsgraph: Any) -> None:
    from ._render import Render

    settings = depsgraph.scene_eval.wend
    with warnings.catch_warnings():
        warnings.simplefilter("always", SceneWarning)
        warnings.showwarning = lambda message, *_, **__: engine.report({"WARNING"}, str(message))
        try:
            builder = _scene_of(engine, depsgraph)
            render = Render(
                builder.scene(),
                spp=None if settings.seconds > 0 else settings.samples,
                time=settings.seconds or None,
                noise=settings.noise or None,
                sampling=settings.guiding,
                threads=settings.threads,
                seed=settings.seed,
                keep_fields=False,
            )
        except InputError as error:
            engine.report({"ERROR"}, str(error))
            engine.error_set(str(error))
            return
        shown, has_sky = 0.0, not depsgraph.scene.render.film_transparent
        while render.step(_STEP):
            state = render.progress
            engine.update_progress(state["fraction"])
            engine.update_stats("", f"{state['spp']} samples, noise {100 * state['relative_noise']:.1f} %")
            if engine.test_break():
                break
            if state["seconds"] > shown + _PICTURE:
                shown = state["seconds"]
                _show(engine, render.film, has_sky, is_last=False)
        _show(engine, render.film, has_sky, is_last=True)


def _show(engine: Any, film: Any, has_sky: bool, is_last: bool) -> None:
    """Gives Blender the picture so far, from below to above as it wants it. `has_sky`: all of it is opaque."""
    height, width = film.image.shape[:2]
    result = engine.begin_result(0, 0, width, height)
    if result is None:
        return
    opacity = np.ones((height, width), dtype=np.float32) if has_sky else film["alpha"]
    values = {
        "Combined": np.dstack([film.image, opacity]),
        "Depth": film["depth"][..., None],
        "Normal": film["normal"],
        "Diffuse Color": film["albedo"],
    }
    for made in result.layers[0].passes:
        if made.name in values:
            made.rect.foreach_set(np.ascontiguousarray(values[made.name][::-1], dtype=np.float32).reshape(-1))
    engine.update_result(result)
    engine.end_result(result, cancel=False, highlight=False, do_merge_results=is_last)


def write_zip(wheel: Path, output: Path) -> None:
    """The zip that Blender's own installer takes, with the package inside.

    Args:
        wheel: of Wend, made independent of the system's libraries (auditwheel).
        output: a .zip file.

    Raises:
        InputError: for a file that is no wheel of Wend.
    """
    parts = wheel.name.split("-")
    if wheel.suffix != ".whl" or parts[0] != "wend" or len(parts) < 5 or not wheel.exists():
        raise InputError(f"{wheel}: error: expected a wheel of Wend, such as dist/wend-0.1.0-cp311-cp311-manylinux_2_28_x86_64.whl")
    manifest = _MANIFEST.format(version=parts[1], wheels=f'"./wheels/{wheel.name}"')
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("blender_manifest.toml", manifest)
        archive.writestr("__init__.py", _MODULE)
        archive.write(wheel, f"wheels/{wheel.name}")


def main(arguments: list[str] | None = None) -> int:
    """What `python -m wend.blender_addon` does; the exit status."""
    parser = argparse.ArgumentParser(prog="python -m wend.blender_addon", description="make the zip that Blender installs Wend from")
    parser.add_argument("wheel", type=Path, help="of Wend, for the Python of Blender (4.2 to 5.0: 3.11)")
    parser.add_argument("-o", "--output", type=Path, default=Path("wend-blender.zip"))
    options = parser.parse_args(arguments)
    return as_command(lambda: write_zip(options.wheel, options.output))


if __name__ == "__main__":
    sys.exit(main())
