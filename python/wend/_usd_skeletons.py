"""Meshes of USD that skeletons and blend shapes move: their points are worked out, by USD itself, before they are read."""

from __future__ import annotations

from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel  # type: ignore[import-not-found,import-untyped,unused-ignore]


def with_overs() -> Any:
    """The predicate of all that may be copied."""
    return Usd.PrimIsActive & Usd.PrimIsLoaded & ~Usd.PrimIsAbstract


def pose(reader: Any) -> None:
    """Puts the points at the times of the shutter into the stage, in memory alone. Between the samples of an animation
    points move straight."""
    stage = reader.stage
    times = [] if reader.time.IsDefault() else [time.GetValue() for time in reader.shutter]
    before = stage.GetEditTarget()
    stage.SetEditTarget(stage.GetSessionLayer())
    try:
        # By their paths: what is put into the stage may be referred to, which makes prims anew.
        found = [prim for prim in Usd.PrimRange(stage.GetPseudoRoot(), with_overs()) if prim.IsA(UsdSkel.Root)]
        posed = {prim.GetPath(): None for prim in found}
        for path in posed:
            # USD poses what is defined; what instancers copy may be below overs.
            overs = [above for above in path.GetPrefixes() if not stage.GetPrimAtPath(above).HasDefiningSpecifier()]
            for above in overs:
                stage.GetPrimAtPath(above).SetSpecifier(Sdf.SpecifierDef)
            _pose_below(reader, stage.GetPrimAtPath(path), times)
            for above in overs:
                stage.GetPrimAtPath(above).SetSpecifier(Sdf.SpecifierOver)
    finally:
        stage.SetEditTarget(before)
    everything = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(with_overs()))
    # Those that are posed are no longer of that type.
    for root in (prim for prim in everything if prim.IsA(UsdSkel.Root) or prim.GetPath() in posed):
        if any(_is_left(prim) for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies(with_overs()))):
            reader.warn(root, "what skeletons move in instances is as at rest")


def _is_left(prim: Any) -> bool:
    """Whether a skeleton should move it, but what instances share cannot be changed, unless it refers to what can."""
    if not prim.IsInstanceProxy() or not prim.IsA(UsdGeom.Mesh):
        return False
    weights = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("skel:jointIndices")
    if not (weights and weights.HasValue()) and not prim.HasAttribute("skel:blendShapes"):
        return False
    session = prim.GetStage().GetSessionLayer()
    return all(spec.layer != session for spec in UsdGeom.Mesh(prim).GetPointsAttr().GetPropertyStack())


def _pose_below(reader: Any, root: Any, times: list[float]) -> None:
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root(root), Usd.PrimDefaultPredicate)
    for prim in Usd.PrimRange(root):
        query = cache.GetSkinningQuery(prim) if prim.IsA(UsdGeom.Mesh) else None
        if query and query.HasJointInfluences():
            _let_normals_move(UsdGeom.Mesh(prim), reader.time)
    if not UsdSkel.BakeSkinning(UsdSkel.Root(root), _around(_samples(cache, root), times)):
        reader.warn(root, "what its skeletons move is as at rest")


def _let_normals_move(mesh: Any, time: Any) -> None:
    """USD moves normals that are the mesh's attribute, of points or corners: others become such."""
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    is_primvar = bool(primvar) and primvar.HasValue()
    given = primvar.ComputeFlattened(time) if is_primvar else mesh.GetNormalsAttr().Get(time)
    kind = primvar.GetInterpolation() if is_primvar else mesh.GetNormalsInterpolation()
    is_of_more = kind in (UsdGeom.Tokens.constant, UsdGeom.Tokens.uniform)
    if not given or not (is_primvar or is_of_more):
        return
    normals = np.array(given, dtype=np.float32).reshape(-1, 3)
    if is_of_more:
        counts = np.array(mesh.GetFaceVertexCountsAttr().Get(time) or [], dtype=np.int64)
        if len(normals) != (1 if kind == UsdGeom.Tokens.constant else len(counts)) or counts.min(initial=0) < 0:
            # Told where the mesh is read.
            return
        normals = np.repeat(normals, counts.sum() if kind == UsdGeom.Tokens.constant else counts, axis=0)
        kind = UsdGeom.Tokens.faceVarying
    if is_primvar:
        primvar.GetAttr().Block()
    mesh.GetNormalsAttr().Set(normals)
    mesh.SetNormalsInterpolation(kind)


def _samples(cache: Any, root: Any) -> list[list[float]]:
    """When what moves below a root has values, each by itself: the joints of each skeleton, and its blend shapes."""
    result = []
    for binding in cache.ComputeSkelBindings(UsdSkel.Root(root), Usd.PrimDefaultPredicate):
        query = cache.GetSkelQuery(binding.GetSkeleton())
        animation = query.GetAnimQuery() if query else None
        if animation:
            result += [animation.GetJointTransformTimeSamples(), animation.GetBlendShapeWeightTimeSamples()]
    return [sorted(samples) for samples in result if len(samples)]


def _around(samples: list[list[float]], times: list[float]) -> Any:
    """From the last sample before the times to the first one after them, of each that has any: what has none in an
    interval USD poses by its default values. Nothing asks for those alone."""
    if not times:
        return Gf.Interval()
    starts = [max((t for t in of_one if t <= min(times)), default=of_one[0]) for of_one in samples]
    ends = [min((t for t in of_one if t >= max(times)), default=of_one[-1]) for of_one in samples]
    return Gf.Interval(min([*starts, *times]), max([*ends, *times]))
