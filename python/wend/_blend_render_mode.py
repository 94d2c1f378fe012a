"""Blender's scene as its renders see it, where it is evaluated for its views."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

#: Of modifiers, settings of views and those of renders.
_OF_MODIFIERS = (("show_viewport", "show_render"), ("levels", "render_levels"))
_OF_SIMPLIFICATION = (
    ("simplify_subdivision", "simplify_subdivision_render"),
    ("simplify_child_particles", "simplify_child_particles_render"),
)


@contextmanager
def as_rendered(scene: Any) -> Iterator[None]:
    """What is evaluated meanwhile has the modifiers, levels, particles and objects of renders; afterwards all is as before."""
    before: list[tuple[Any, str, Any]] = []

    def put(owner: Any, name: str, value: Any) -> None:
        if getattr(owner, name) != value:
            before.append((owner, name, getattr(owner, name)))
            setattr(owner, name, value)

    try:
        for views, renders in _OF_SIMPLIFICATION:
            put(scene.render, views, getattr(scene.render, renders))
        for object_ in scene.objects:
            put(object_, "hide_viewport", object_.hide_render)
            for modifier in object_.modifiers:
                for views, renders in _OF_MODIFIERS:
                    if hasattr(modifier, views) and hasattr(modifier, renders):
                        put(modifier, views, getattr(modifier, renders))
        for collection in [c for c in bpy.data.collections if not c.library]:
            put(collection, "hide_viewport", collection.hide_render)
        for system in bpy.data.particles:
            put(system, "display_percentage", 100)
            put(system, "child_percent", system.rendered_child_count)
        for ball in bpy.data.metaballs:
            put(ball, "resolution", ball.render_resolution)
        for curve in bpy.data.curves:
            for views, renders in (("resolution_u", "render_resolution_u"), ("resolution_v", "render_resolution_v")):
                if getattr(curve, renders) > 0:
                    put(curve, views, getattr(curve, renders))
        yield
    finally:
        for owner, name, value in reversed(before):
            setattr(owner, name, value)
