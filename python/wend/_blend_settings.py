"""Settings of Blender's scenes, objects and cameras that change its picture and have no counterpart."""

from __future__ import annotations

from typing import Any

from ._scene_reader import SceneReader

#: Of a view layer, what it may leave out.
_LAYER = {
    "use_sky": "the world",
    "use_solid": "surfaces",
    "use_strand": "hair",
    "use_volumes": "volumes",
    "use_motion_blur": "motion blur",
}


def tell_of_scene(reader: SceneReader, scene: Any, layer: Any) -> None:
    """Of a scene, as its view layer shows it."""
    place, render = f"scene '{scene.name}'", scene.render
    if render.use_freestyle:
        reader.tell(place, "lines of Freestyle are left out")
    if render.use_multiview:
        reader.tell(place, "of several views one is rendered")
    if render.use_compositing and getattr(scene, "compositing_node_group", None) is not None:
        reader.tell(place, "compositing is left out: the picture is the render's")
    cycles = getattr(scene, "cycles", None)
    if render.film_transparent and getattr(cycles, "film_transparent_glass", False):
        reader.tell(place, "glass before a transparent film is opaque, and shows the world")
    if render.use_motion_blur and getattr(cycles, "rolling_shutter_type", "NONE") != "NONE":
        reader.tell(place, "a rolling shutter is open everywhere at once")
    for name, label in (("caustics_reflective", "caustics of reflections"), ("caustics_refractive", "caustics of refractions")):
        if not getattr(cycles, name, True):
            reader.tell(place, f"{label}, which are switched off, are there")
    if getattr(cycles, "use_fast_gi", False):
        reader.tell(place, "the fast approximation of global illumination is left out: all of it is there")
    hidden = [label for name, label in _LAYER.items() if not getattr(layer, name, True)]
    if hidden:
        reader.tell(f"view layer '{layer.name}'", f"what it leaves out is there: {', '.join(hidden)}")
    for name in ("material_override", "world_override"):
        if getattr(layer, name, None) is not None:
            reader.tell(f"view layer '{layer.name}'", f"its {name.replace('_', ' ')} is left out")
    bounces = getattr(getattr(scene.world, "cycles", None), "max_bounces", 1024)
    if bounces < 128:
        reader.tell(f"world '{scene.world.name}'", f"light that was reflected more often than its {bounces} times is there")
    rays = getattr(scene.world, "cycles_visibility", None)
    unseen = [ray for ray in ("diffuse", "glossy", "transmission", "scatter") if not getattr(rays, ray, True)]
    if unseen:
        reader.tell(f"world '{scene.world.name}'", f"a world that rays of {', '.join(unseen)} do not see is seen by them")


def tell_of_camera(reader: SceneReader, place: str, camera: Any) -> None:
    """Of a camera's lens and reach."""
    if camera.type not in ("PERSP", "ORTHO", "PANO"):
        reader.tell(place, f"a camera of the kind {camera.type} is taken as one with a lens")
    # What is farther than the default does not reach is clipped by oversight.
    if camera.clip_start > 0.1001:
        reader.tell(place, f"what is nearer than {camera.clip_start:.4g} is not clipped")
    if camera.dof.use_dof and (camera.dof.aperture_blades > 2 or camera.dof.aperture_ratio != 1):
        reader.tell(place, "the aperture is round")


def tell_of_object(reader: SceneReader, object_: Any) -> None:
    """Of an object that is seen, or a lamp."""
    place = f"object '{object_.name}'"
    linking = getattr(object_, "light_linking", None)
    if linking is not None and (linking.receiver_collection or linking.blocker_collection):
        reader.tell(place, "a lamp that is linked to some objects shines on all, and all are in its way")
    if any(getattr(modifier, "use_adaptive_subdivision", False) for modifier in object_.modifiers):
        reader.tell(place, "adaptive subdivision is by the levels of the modifier")
