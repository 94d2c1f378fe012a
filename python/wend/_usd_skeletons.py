"""Meshes of USD that skeletons and blend shapes move: their points are worked out, by USD itself, before they are read."""

from __future__ import annotations

from typing import Any

from pxr import Gf, Usd, UsdSkel  # type: ignore[import-not-found,import-untyped,unused-ignore]


def pose(reader: Any) -> None:
    """Puts the points at the times of the shutter into the stage, in memory alone. Between the samples of an animation
    points move straight."""
    roots = [prim for prim in reader.stage.Traverse() if prim.IsA(UsdSkel.Root)]
    if not roots:
        return
    times = [] if reader.time.IsDefault() else [time.GetValue() for time in reader.shutter]
    before = reader.stage.GetEditTarget()
    reader.stage.SetEditTarget(reader.stage.GetSessionLayer())
    try:
        for root in roots:
            interval = _around(_samples(reader.stage, root), times)
            if not UsdSkel.BakeSkinning(UsdSkel.Root(root), interval):
                reader.warn(root, "what its skeletons move is as at rest")
            if any(prim.IsInstance() for prim in Usd.PrimRange(root)):
                reader.warn(root, "what skeletons move in instances is as at rest")
    finally:
        reader.stage.SetEditTarget(before)


def _samples(stage: Any, root: Any) -> list[float]:
    """When the animations of the skeletons below a root have values."""
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root(root), Usd.PrimDefaultPredicate)
    times: set[float] = set()
    for prim in Usd.PrimRange(root):
        query = cache.GetSkelQuery(UsdSkel.Skeleton(prim)) if prim.IsA(UsdSkel.Skeleton) else None
        animation = query.GetAnimQuery() if query else None
        if animation:
            times |= {*animation.GetJointTransformTimeSamples(), *animation.GetBlendShapeWeightTimeSamples()}
    return sorted(times)


def _around(samples: list[float], times: list[float]) -> Any:
    """The samples from the last one before the times to the first one after them."""
    if not samples or not times:
        return Gf.Interval.GetFullInterval()
    start = max((t for t in samples if t <= min(times)), default=samples[0])
    end = min((t for t in samples if t >= max(times)), default=samples[-1])
    return Gf.Interval(start, end)
