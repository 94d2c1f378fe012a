"""What an object of Blender is to be seen by, or to hide."""

from __future__ import annotations

from typing import Any

from ._scene_reader import SceneReader


def view_of(reader: SceneReader, instance: Any) -> str:
    """What an instance of the depsgraph is to rays of the camera: a shape's "cameraview". What is asked of other rays is
    named."""
    object_ = instance.object
    if object_.type in ("CAMERA", "EMPTY", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"):
        return "shown"
    where = f"object '{object_.name}'"
    is_lamp = object_.type == "LIGHT"
    # The lamp of a default file is one, without an effect.
    if object_.is_shadow_catcher and not is_lamp:
        reader.tell(where, "a shadow catcher is an object like others")
    rays = ("diffuse", "glossy", "transmission", "volume_scatter", "shadow")
    unseen = [ray.replace("_", " ") for ray in rays if not getattr(object_, f"visible_{ray}")]
    if unseen:
        reader.tell(where, f"an object that rays of {', '.join(unseen)} do not see is seen by them")
    if is_lamp:
        return "shown"
    placed = (instance.parent if instance.is_instance and instance.parent else object_).original
    if object_.is_holdout or placed.holdout_get():
        view = "holdout"
    elif not object_.visible_camera or not placed.visible_camera or placed.indirect_only_get():
        view = "hidden"
    else:
        return "shown"
    if object_.type == "VOLUME":
        reader.tell(where, "a volume that the camera does not see, or that is held out, is seen by it")
        return "shown"
    return view
