"""Lights as USD had them before 21.02: without a namespace."""

from __future__ import annotations

from typing import Any

from pxr import Usd, UsdLux  # type: ignore[import-not-found,import-untyped,unused-ignore]

_NAMES = (
    "intensity", "exposure", "color", "diffuse", "specular", "normalize", "enableColorTemperature", "colorTemperature",
    "radius", "width", "height", "length", "angle", "texture:file", "texture:format", "shaping:focus", "shaping:focusTint",
    "shaping:cone:angle", "shaping:cone:softness", "shaping:ies:file", "shaping:ies:angleScale", "shaping:ies:normalize",
)  # fmt: skip


def rename(reader: Any) -> None:
    """Gives lights with old names the new ones, in the stage in memory alone."""
    stage = reader.stage
    everything = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    old = [prim for prim in everything if prim.HasAPI(UsdLux.LightAPI) and any(_is_old(prim, name) for name in _NAMES)]
    for prim in [prim for prim in old if prim.IsInstanceProxy()]:
        reader.warn(prim, "what lights in instances have by names of before USD 21.02 is left out")
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        # By their paths: what is put into the stage may be referred to, which makes prims anew.
        for path in [prim.GetPath() for prim in old if not prim.IsInstanceProxy()]:
            for name in _NAMES:
                prim = stage.GetPrimAtPath(path)
                if _is_old(prim, name):
                    _copy(prim.GetAttribute(name), prim, f"inputs:{name}")


def _is_old(prim: Any, name: str) -> bool:
    return bool(prim.GetAttribute(name).HasAuthoredValue()) and not prim.GetAttribute(f"inputs:{name}").HasAuthoredValue()


def _copy(source: Any, prim: Any, name: str) -> None:
    target = prim.CreateAttribute(name, source.GetTypeName(), custom=False)
    if source.ValueMightBeTimeVarying() or source.GetNumTimeSamples():
        for time in source.GetTimeSamples():
            target.Set(source.Get(time), time)
    else:
        target.Set(source.Get())
