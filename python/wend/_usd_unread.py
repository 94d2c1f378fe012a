"""What prims of USD say that nothing here reads: it is told, once for each kind."""

from __future__ import annotations

import warnings
from typing import Any

from pxr import Usd, UsdGeom, UsdLux, UsdShade  # type: ignore[import-not-found,import-untyped,unused-ignore]

from . import _usd_lights as lights
from ._errors import SceneWarning


def tell(reader: Any, prim: Any) -> None:
    """Of a prim that is to be seen."""
    kind = str(prim.GetTypeName())
    if prim.IsA(UsdGeom.Gprim) and prim.HasAPI(UsdLux.LightAPI):
        what = "mesh" if kind == "Mesh" else kind
        reader.warn(prim, f"a {what} that is a light shines by its material alone")
    elif kind and not Usd.SchemaRegistry().GetTypeFromName(kind):
        reader.warn(prim, f"a {kind}, which USD does not know, is left out")
    elif prim.IsA(UsdGeom.Boundable) and not prim.IsA(UsdGeom.Gprim) and not _is_read(prim):
        reader.warn(prim, f"a {kind} is left out")
    model = UsdGeom.ModelAPI(prim)
    if prim.HasAPI(UsdGeom.ModelAPI) and model.ComputeModelDrawMode() not in (UsdGeom.Tokens.default_, UsdGeom.Tokens.inherited):
        reader.warn(prim, f"model:drawMode = {model.ComputeModelDrawMode()}: the model itself is there")
    if prim.HasAPI(UsdGeom.MotionAPI) and prim.GetAttribute("motion:blurScale").HasAuthoredValue():
        reader.warn(prim, "motion:blurScale is left out")
    if lights.is_light(prim):
        _tell_of_light(reader, prim)
    if prim.IsA(UsdGeom.Gprim):
        _tell_of_binding(reader, prim)


def _is_read(prim: Any) -> bool:
    kind = str(prim.GetTypeName())
    return lights.is_light(prim) or prim.IsA(UsdGeom.PointInstancer) or kind in ("SkelRoot", "Skeleton")


def _tell_of_light(reader: Any, prim: Any) -> None:
    """What counts only where its schema is applied."""
    for start, schema in (("inputs:shaping:", UsdLux.ShapingAPI), ("inputs:shadow:", UsdLux.ShadowAPI)):
        if not prim.HasAPI(schema):
            given = [name for name in prim.GetAuthoredPropertyNames() if name.startswith(start)]
            if given:
                reader.warn(prim, f"{given[0]} is left out, as {schema.__name__} is not applied")


def _tell_of_binding(reader: Any, prim: Any) -> None:
    """Materials that are not there, and what is bound that is none of a surface."""
    for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim)):
        targets = UsdShade.MaterialBindingAPI(subset.GetPrim()).GetDirectBindingRel().GetTargets()
        if targets and subset.GetFamilyNameAttr().Get() != UsdShade.Tokens.materialBind:
            reader.warn(subset.GetPrim(), "a material of faces is left out, as they are not of the family materialBind")
        elif targets and not prim.GetStage().GetPrimAtPath(targets[0]):
            reader.warn(subset.GetPrim(), f"the material that is bound is not there: {targets[0]}")
    api = UsdShade.MaterialBindingAPI(prim)
    material, relationship = api.ComputeBoundMaterial(reader.binding_purpose)
    if not material:
        targets = api.GetDirectBindingRel().GetTargets()
        if targets:
            reader.warn(prim, f"the material that is bound is not there: {targets[0]}")
        return
    for name in ("displacement", "volume"):
        outputs = [output for output in material.GetOutputs() if output.GetBaseName().split(":")[-1] == name]
        if any(output.HasConnectedSource() for output in outputs):
            reader.warn(material.GetPrim(), f"outputs:{name} is left out")


def first_time(stage: Any, file: str) -> float | None:
    """The first frame; of a stage that does not say which that is, but has samples, the first of these."""
    if stage.HasAuthoredTimeCodeRange():
        return float(stage.GetStartTimeCode())
    samples = [time for layer in stage.GetUsedLayers() for time in layer.ListAllTimeSamples()]
    if not samples:
        return None
    warnings.warn(
        f"{file}: warning: the stage has samples but no startTimeCode: it is taken at the first, {min(samples):g}",
        SceneWarning,
        stacklevel=3,
    )
    return float(min(samples))
