"""Blender's scene as its renders see it, where it is evaluated for its views."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy  # type: ignore[import-not-found,import-untyped,unused-ignore]

#: Of modifiers, settings of views and those of renders.
_OF_MODIFIERS = (
    ("show_viewport", "show_render"),
    ("levels", "render_levels"),
    ("viewport_resolution", "resolution"),
)
_OF_SIMPLIFICATION = (
    ("simplify_subdivision", "simplify_subdivision_render"),
    ("simplify_child_particles", "simplify_child_particles_render"),
)


@contextmanager
def as_rendered(scene: Any) -> Iterator[None]:
    """What is evaluated meanwhile has the modifiers, levels, particles and objects of renders; afterwards all is as before."""
    before: list[tuple[Any, str, Any]] = []
    # Hidden by the eye in the list of objects, which renders do not look at.
    asleep = [(layer, o) for layer in scene.view_layers for o in layer.objects if o.hide_get(view_layer=layer)]

    def put(owner: Any, name: str, value: Any) -> None:
        now = getattr(owner, name)
        if now != value:
            try:
                setattr(owner, name, value)
            except AttributeError:  # of a library, which cannot be changed
                return
            before.append((owner, name, now))

    try:
        for layer, object_ in asleep:
            object_.hide_set(False, view_layer=layer)
        for views, renders in _OF_SIMPLIFICATION:
            put(scene.render, views, getattr(scene.render, renders))
        # Also those that are in collections which are instanced alone.
        for object_ in bpy.data.objects:
            put(object_, "hide_viewport", object_.hide_render)
            put(object_, "show_instancer_for_viewport", object_.show_instancer_for_render)
            for modifier in object_.modifiers:
                for views, renders in _OF_MODIFIERS:
                    if hasattr(modifier, views) and hasattr(modifier, renders):
                        put(modifier, views, getattr(modifier, renders))
        for collection in [c for c in bpy.data.collections if not c.library]:
            put(collection, "hide_viewport", collection.hide_render)
        for group in bpy.data.node_groups:
            for node in group.nodes:
                if node.bl_idname == "GeometryNodeIsViewport":
                    # Then it says that it is none.
                    put(node, "mute", True)
        for system in bpy.data.particles:
            put(system, "display_percentage", 100)
            put(system, "child_percent", system.rendered_child_count)
            # Of strands there are no more points than this says.
            put(system, "display_step", system.render_step)
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
        for layer, object_ in asleep:
            object_.hide_set(True, view_layer=layer)
